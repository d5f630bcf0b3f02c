#include "host/drive/response_curve.h"

#include <math.h>
#include <stdbool.h>

#include "hci/math/harmonic.h"

static const double complex J = (double complex)I;

/* Of half the sampling, up to which points tell of the loop. */
static const double USABLE = 0.95;

enum { NOBODY = -1, LEAST = 4, FOLDS = 32 };

static double sinc(double x)
{
    return fabs(x) < 1e-9 ? 1.0 : sin(x) / x;
}

/* T/(z − 1) = −T/2 − j (T/2) cot(νT/2). */
static double complex sum_at(double sample_s, double nu)
{
    return -0.5 * sample_s * (1.0 + J / tan(0.5 * nu * sample_s));
}

static double complex hold_at(double sample_s, double delay_s, double nu)
{
    return sinc(0.5 * nu * sample_s) * cexp(-J * nu * delay_s);
}

static double complex loop_at(const hci_response_curve *c, const hci_curve_loop *l, double nu)
{
    return (l->kp_ohm + l->ki_ohm_per_s * sum_at(c->sample_s, nu)) * hold_at(c->sample_s, l->delay_s, nu);
}

/* ---- the loop that makes the points ---- */

/* Normal equations of Σ weight²|y (k_p + k_i s) − 1|², y = through·H: only the right side depends on the
 * delay. */
typedef struct {
    double pp, pi, ii, p, i; /* weighted sums of |y|², |y|² Re s, |y|² |s|²; Re y, Re(y s) */
} equations;

static equations equations_of(const hci_response_curve *c, double delay_s, int without)
{
    equations e = {0.0, 0.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < c->usable; ++k) {
        if ((int)k == without) continue;
        const double nu = c->point[k].rad_per_s;
        const double complex y = c->point[k].through * hold_at(c->sample_s, delay_s, nu);
        const double complex s = sum_at(c->sample_s, nu);
        const double weight = c->point[k].weight * c->point[k].weight;
        const double square = weight * creal(y * conj(y));
        e.pp += square;
        e.pi += square * creal(s);
        e.ii += square * creal(s * conj(s));
        e.p += weight * creal(y);
        e.i += weight * creal(y * s);
    }
    return e;
}

/* Returns by how much the gains take the sum of the squares down; gains: out. */
static double solve(const equations *e, hci_curve_loop *l)
{
    const double determinant = e->pp * e->ii - e->pi * e->pi;
    l->kp_ohm = e->p / e->pp;
    l->ki_ohm_per_s = 0.0;
    if (determinant > 1e-12 * e->pp * e->ii) {
        l->kp_ohm = (e->p * e->ii - e->i * e->pi) / determinant;
        l->ki_ohm_per_s = (e->i * e->pp - e->p * e->pi) / determinant;
    }
    return l->kp_ohm * e->p + l->ki_ohm_per_s * e->i;
}

static double gained_with(const hci_response_curve *c, double delay_s, int without)
{
    hci_curve_loop l;
    const equations e = equations_of(c, delay_s, without);
    return solve(&e, &l);
}

enum { DELAYS = 96, NARROWINGS = 60 };

/* The delay between two at which most is gained, by golden section. */
static double narrow_s(const hci_response_curve *c, double low, double high, int without)
{
    const double golden = 0.5 * (sqrt(5.0) - 1.0);
    for (int k = 0; k < NARROWINGS && high - low > 1e-7 * c->sample_s; ++k) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (gained_with(c, a, without) > gained_with(c, b, without))
            high = b;
        else
            low = a;
    }
    return 0.5 * (low + high);
}

/* Of delays up to 6 samples each that its neighbours are not better than, narrowed: few points are met nearly
 * as well with a delay that turns the highest of them once more. */
static double best_delay_s(const hci_response_curve *c, int without)
{
    const double step = 6.0 * c->sample_s / DELAYS;
    double most = -HUGE_VAL, best = 0.0, before = -HUGE_VAL, here = gained_with(c, 0.0, without);
    for (int k = 0; k <= DELAYS; ++k) {
        const double after = k < DELAYS ? gained_with(c, (k + 1) * step, without) : -HUGE_VAL;
        if (here >= before && here >= after) {
            const double delay_s = narrow_s(c, (k - 1) * step, (k + 1) * step, without);
            const double gained = gained_with(c, delay_s, without);
            if (gained > most) most = gained, best = delay_s;
        }
        before = here;
        here = after;
    }
    return best;
}

static hci_curve_loop find_loop(const hci_response_curve *c, int without)
{
    hci_curve_loop l = {.delay_s = best_delay_s(c, without)};
    const equations e = equations_of(c, l.delay_s, without);
    solve(&e, &l);
    return l;
}

/* ---- between the points ---- */

/* Of points one of which may be left out: the next below a frequency and the next above it; twice the
 * outermost one where there is none. */
static void neighbours(const hci_response_curve *c, size_t count, double nu, int without, size_t at[2])
{
    size_t below = count, above = count;
    for (size_t k = 0; k < count && above == count; ++k) {
        if ((int)k == without) continue;
        if (c->point[k].rad_per_s < nu)
            below = k;
        else
            above = k;
    }
    at[0] = below < count ? below : above;
    at[1] = above < count ? above : below;
}

static double way_between(const hci_response_curve *c, const size_t at[2], double nu)
{
    const double low = c->point[at[0]].rad_per_s, high = c->point[at[1]].rad_per_s;
    return at[0] == at[1] ? 0.0 : (nu - low) / (high - low);
}

static double complex straight_at(const hci_response_curve *c, double nu, int without)
{
    size_t at[2];
    neighbours(c, c->count, nu, without, at);
    const double complex low = c->point[at[0]].through, high = c->point[at[1]].through;
    if (c->point[at[0]].rad_per_s > nu) return low * nu / c->point[at[0]].rad_per_s;
    return low + way_between(c, at, nu) * (high - low);
}

static double complex ratio_at(const hci_response_curve *c, const hci_curve_loop *l, double nu, int without)
{
    size_t at[2];
    double complex ratio[2];
    neighbours(c, c->usable, nu, without, at);
    for (int k = 0; k < 2; ++k)
        ratio[k] = c->point[at[k]].through * loop_at(c, l, c->point[at[k]].rad_per_s);
    return (ratio[0] + way_between(c, at, nu) * (ratio[1] - ratio[0])) / loop_at(c, l, nu);
}

static double complex told_at(const hci_response_curve *c, hci_curve_kind kind, const hci_curve_loop *l,
                              double nu, int without)
{
    if (kind == HCI_CURVE_STRAIGHT) return straight_at(c, nu, without);
    return kind == HCI_CURVE_RATIO ? ratio_at(c, l, nu, without) : 1.0 / loop_at(c, l, nu);
}

double complex hci_response_curve_at(const hci_response_curve *c, double nu)
{
    return told_at(c, c->kind, &c->loop, nu, NOBODY);
}

/* ---- which kind ---- */

/* Sums of the squares over the inner points, each told by the others. */
static void leave_out(const hci_response_curve *c, double square[3], size_t *folds)
{
    const size_t inner = c->usable - 2, step = inner > FOLDS ? inner / FOLDS : 1;
    for (size_t k = 1; k <= inner; k += step) {
        const hci_curve_loop l = find_loop(c, (int)k);
        for (int kind = 0; kind < 3; ++kind) {
            const double complex told = told_at(c, (hci_curve_kind)kind, &l, c->point[k].rad_per_s, (int)k);
            const double off = c->point[k].weight * cabs(told / c->point[k].through - 1.0);
            square[kind] += isfinite(off) ? off * off : HUGE_VAL;
        }
        ++*folds;
    }
}

hci_response_curve hci_response_curve_of(const hci_curve_point *point, size_t count, double sample_s)
{
    hci_response_curve c = {.point = point, .count = count, .sample_s = sample_s};
    double square[3] = {0.0, 0.0, 0.0};
    size_t folds = 0;
    while (c.usable < count && point[c.usable].rad_per_s < USABLE * HCI_PI / sample_s)
        ++c.usable;
    c.error = (double)NAN;
    if (c.usable < LEAST) return c;
    leave_out(&c, square, &folds);
    for (int kind = 1; kind < 3; ++kind)
        if (square[kind] < square[c.kind]) c.kind = (hci_curve_kind)kind;
    c.error = sqrt(square[c.kind] / (double)folds);
    if (c.kind == HCI_CURVE_LOOP) c.error *= sqrt(1.5 / (double)c.usable);
    if (c.kind != HCI_CURVE_STRAIGHT) c.loop = find_loop(&c, NOBODY);
    return c;
}

/* ---- as straight lines ---- */

/* Share of a value that a straight line may be off; values that are small beside the largest count as a
 * twentieth of that. */
static const double CHORD = 1e-3, SMALL = 0.05;

/* Largest error of the line from low to high in units of what is allowed. */
static double chord_error(const hci_response_curve *c, double low, double high, double most)
{
    const double complex a = low > 0.0 ? hci_response_curve_at(c, low) : 0.0;
    const double complex b = hci_response_curve_at(c, high);
    double worst = 0.0;
    for (int k = 1; k < 8; ++k) {
        const double complex x = hci_response_curve_at(c, low + 0.125 * k * (high - low));
        const double off = cabs(a + 0.125 * k * (b - a) - x) / (CHORD * fmax(cabs(x), SMALL * most));
        worst = fmax(worst, off);
    }
    return worst;
}

static double largest_at(const hci_response_curve *c, double highest)
{
    double most = 0.0;
    for (int k = 1; k <= 64; ++k)
        most = fmax(most, cabs(hci_response_curve_at(c, highest * k / 64.0)));
    return most;
}

typedef struct {
    const hci_response_curve *curve; /* two */
    double most[2], highest, allowed;
} grid;

/* The next frequency: as far as both lines are good. */
static double next_of(const grid *g, double low)
{
    double step = g->highest - low;
    for (int k = 0; k < 40; ++k, step *= 0.7) {
        const double high = low + step;
        if (chord_error(&g->curve[0], low, high, g->most[0]) <= g->allowed &&
            chord_error(&g->curve[1], low, high, g->most[1]) <= g->allowed)
            break;
    }
    return low + step;
}

size_t hci_response_curve_grid(const hci_response_curve curve[2], double highest_rad_per_s, size_t most,
                               double *rad_per_s)
{
    grid g = {.curve = curve, .highest = highest_rad_per_s, .allowed = 1.0};
    for (int a = 0; a < 2; ++a)
        g.most[a] = largest_at(&curve[a], highest_rad_per_s);
    for (;; g.allowed *= 2.0) {
        size_t n = 0;
        double at = 0.0;
        bool ended = false;
        while (n < most && !ended) {
            at = rad_per_s[n++] = next_of(&g, at);
            ended = at > 0.999 * highest_rad_per_s;
        }
        if (!ended) continue;
        if (n == 1) {
            rad_per_s[1] = rad_per_s[0];
            rad_per_s[0] *= 0.5;
            n = 2;
        }
        return n;
    }
}
