#include "host/diagnose/prepare/swing.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/machine/torque_constant.h"
#include "host/numeric/fft.h"
#include "host/numeric/peak.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

enum {
    LEAST_SAMPLES = 1024,
    LEAST_OF_TURN = 64, /* samples */
    MOST_MEANS = 8192,  /* that the differences are reduced to */
    NEAR = 64,          /* places of the spectrum on each side that tell the noise */
    PLACES = 6,         /* on each side, that are tried for a frequency */
    SWEEPS = 3,
    LEAST_RUNS = 2 /* that show a swing, to be looked for in others */
};

#define TURNS      1.3   /* of a run, to have a swing that others show */
#define OWN_TURNS  3.2   /* to show one by itself */
#define STEADY     0.05  /* of the speed, rms about its mean */
#define EVEN       0.1   /* of the current, rms of its change over a turn */
#define OF_NOISE   30.0  /* times the noise at a frequency, of a line: of 10⁸ by chance one */
#define FOOT       0.01  /* of the power of a line, beside it */
#define FASTEST    0.125 /* periods for each sample */
#define IN_MEANS   0.4   /* periods for each mean */
#define SLOWEST    2.0   /* periods in the run */
#define APART      0.4 /* change over a turn, as a share of the amplitude: below it passes for one of the turn */
#define OF_CURRENT 0.3  /* of a swing, that the current makes or may have made */
#define OF_SPEED   5.0  /* times the error, of a swing of the speed */
#define REFUSED    2.0  /* of what the length of the run tells apart, about a frequency */
#define ALIAS      0.03 /* of an electrical order, that is the order */
#define FOLDED     64.0 /* samples in an electrical period: with more no order of note is above half of them */
#define ALIKE      1.5  /* times as large or as small as in other runs */
#define MULTIPLE   4.0  /* errors of a frequency */
#define OFF        0.5  /* of a line, that it may be another one in the torque itself */

/* Each torque less that of one turn before, as means over some neighbours. */
typedef struct {
    double *change_Nm, *time_s, *before_s; /* [count]; before_s: one turn earlier */
    double *re, *im;                       /* [size], of the transform */
    size_t count, size;
    double turn_s, span_s, mean_s; /* time of a turn, of all, of one mean */
    double most_Hz;
    double refused_Hz[HCI_MOST_SWINGS]; /* that turned out to be none, and are not looked at again */
    size_t refused;
} changes;

/* What is asked, and of each sample the current in the rotor frame and what it does not make. */
typedef struct {
    const hci_run *run;
    const hci_run_statistics *statistics;
    double constant_Nm_per_A; /* of the machine */
    int pole_pairs;
    hci_dq *current; /* to be freed */
    double *left_Nm; /* what the current does not make of the torque; to be freed */
} question;

/* False when memory is out. */
static bool question_make(const hci_swing_question *from, question *x)
{
    static const hci_effects none = {NULL, 0};
    const hci_run *r = from->run;
    const int p = from->machine->pole_pairs;
    *x = (question){r, from->statistics, hci_torque_constant(from->machine, &none), p, NULL, NULL};
    x->current = hci_memory_new(r->count, sizeof *x->current);
    x->left_Nm = hci_memory_new(r->count, sizeof *x->left_Nm);
    for (size_t k = 0; x->current && x->left_Nm && k < r->count; ++k) {
        x->current[k] = hci_run_dq(r, p, k);
        x->left_Nm[k] = r->torque_Nm[k] - hci_torque_at(from->machine, p * r->theta_m_rad[k], r->i_A + 3 * k);
    }
    return x->current && x->left_Nm;
}

static void question_release(question *x)
{
    hci_memory_free(x->current);
    hci_memory_free(x->left_Nm);
}

/* ---- one turn before ---- */

/* A place between two samples, one turn before another one. */
typedef struct {
    size_t at;    /* the sample before it */
    double share; /* of the way to the next */
} place;

/* Goes on from the place of the sample before. False: there is no turn before it. */
static bool place_find(const hci_run *r, size_t k, double direction, place *p)
{
    const double wanted = direction * r->theta_m_rad[k] - 2.0 * HCI_PI;
    if (direction * r->theta_m_rad[0] > wanted) return false;
    while (p->at + 2 < k && direction * r->theta_m_rad[p->at + 1] <= wanted)
        ++p->at;
    const double from = direction * r->theta_m_rad[p->at], to = direction * r->theta_m_rad[p->at + 1];
    p->share = to > from ? fmin(1.0, fmax(0.0, (wanted - from) / (to - from))) : 0.0;
    return true;
}

static double between(const place *p, double from, double to)
{
    return from + p->share * (to - from);
}

/* Adds the change of sample k to its mean. Returns the square of the change of the current. */
static double change_add(const question *x, size_t k, const place *p, double weight, changes *c, size_t mean)
{
    const hci_run *r = x->run;
    const hci_dq now = x->current[k], from = x->current[p->at], to = x->current[p->at + 1];
    c->change_Nm[mean] += weight * (x->left_Nm[k] - between(p, x->left_Nm[p->at], x->left_Nm[p->at + 1]));
    c->time_s[mean] += weight * r->time_s[k];
    c->before_s[mean] += weight * between(p, r->time_s[p->at], r->time_s[p->at + 1]);
    const double d = now.d - between(p, from.d, to.d), q = now.q - between(p, from.q, to.q);
    return d * d + q * q;
}

/* Fills the means. False: the current changes from turn to turn. */
static bool changes_fill(const question *x, double direction, size_t first, size_t group, changes *c)
{
    double square = 0.0;
    place p = {0, 0.0};
    for (size_t k = first; k < first + c->count * group; ++k) {
        (void)place_find(x->run, k, direction, &p);
        square += change_add(x, k, &p, 1.0 / (double)group, c, (k - first) / group);
    }
    square /= (double)(c->count * group);
    const double most_A = EVEN * x->statistics->current_A;
    return x->statistics->no_current || square <= most_A * most_A || x->statistics->current_A == 0.0;
}

/* ---- lines ---- */

/* Share of a swing that is seen in the change over a turn. */
static double seen(const changes *c, double frequency_Hz)
{
    return 2.0 * fabs(sin(HCI_PI * frequency_Hz * c->turn_s));
}

static bool is_refused(const changes *c, double frequency_Hz)
{
    for (size_t k = 0; k < c->refused; ++k)
        if (fabs(frequency_Hz - c->refused_Hz[k]) < REFUSED / c->span_s) return true;
    return false;
}

/* Power at each frequency: im, of the changes; re, of the swing, −1 where that is hardly seen. */
static void spectrum_fill(changes *c)
{
    const double middle = hci_mean(c->change_Nm, c->count);
    for (size_t k = 0; k < c->size; ++k) {
        const double window =
            k < c->count ? 1.0 - cos(2.0 * HCI_PI * ((double)k + 0.5) / (double)c->count) : 0.0;
        c->re[k] = k < c->count ? window * (c->change_Nm[k] - middle) : 0.0;
        c->im[k] = 0.0;
    }
    hci_fft(c->re, c->im, c->size, -1);
    for (size_t k = 0; k < c->size / 2; ++k) {
        const double frequency_Hz = (double)k / ((double)c->size * c->mean_s), part = seen(c, frequency_Hz);
        const bool told = frequency_Hz * (c->span_s + c->turn_s) > SLOWEST && frequency_Hz < c->most_Hz &&
                          part > APART && !is_refused(c, frequency_Hz);
        c->im[k] = c->re[k] * c->re[k] + c->im[k] * c->im[k];
        c->re[k] = told ? c->im[k] / (part * part) : -1.0;
    }
}

/* The mean power of noise about a place, of its neighbours' median; INFINITY where there are too few. */
static double noise_about(const changes *c, size_t at)
{
    double near[2 * NEAR + 1];
    const size_t own = 2 * c->size / c->count + 1; /* places that a line takes */
    size_t count = 0;
    for (size_t k = at > NEAR ? at - NEAR : 0; k <= at + NEAR && k < c->size / 2; ++k)
        if ((k + own < at || k > at + own) && c->re[k] >= 0.0) near[count++] = c->re[k];
    return count > NEAR / 2 ? hci_median(near, count) / log(2.0) : (double)INFINITY;
}

static double largest_of(const double *x, size_t count)
{
    double most = 0.0;
    for (size_t k = 0; k < count; ++k)
        most = fmax(most, x[k]);
    return most;
}

/* The largest line that is no noise, nor the foot of one that cannot be told; 0: none. */
static double line_find(const changes *c)
{
    const double least = FOOT * largest_of(c->im, c->size / 2);
    double most = 0.0, frequency_Hz = 0.0;
    for (size_t k = 1; k + 1 < c->size / 2; ++k) {
        if (!(c->re[k] > most) || c->im[k] < c->im[k - 1] || c->im[k] < c->im[k + 1]) continue;
        if (c->im[k] < least || !(c->re[k] > OF_NOISE * noise_about(c, k))) continue;
        most = c->re[k];
        frequency_Hz = (double)k / ((double)c->size * c->mean_s);
    }
    return frequency_Hz;
}

/* A cos ωt + B sin ωt whose changes over a turn are nearest to those recorded. */
typedef struct {
    double frequency_Hz, cosine, sine;
    double square; /* that it takes off the sum of squares */
} line;

static line line_fit(const changes *c, double frequency_Hz)
{
    const double omega = 2.0 * HCI_PI * frequency_Hz;
    double cc = 0.0, cs = 0.0, ss = 0.0, cy = 0.0, sy = 0.0;
    for (size_t k = 0; k < c->count; ++k) {
        const double x = cos(omega * c->time_s[k]) - cos(omega * c->before_s[k]);
        const double y = sin(omega * c->time_s[k]) - sin(omega * c->before_s[k]);
        cc += x * x;
        cs += x * y;
        ss += y * y;
        cy += x * c->change_Nm[k];
        sy += y * c->change_Nm[k];
    }
    const double det = cc * ss - cs * cs;
    line a = {frequency_Hz, 0.0, 0.0, 0.0};
    if (!(det > 0.0)) return a;
    a.cosine = (ss * cy - cs * sy) / det;
    a.sine = (cc * sy - cs * cy) / det;
    a.square = a.cosine * cy + a.sine * sy;
    return a;
}

static double square_at(const void *changes_of, double frequency_Hz)
{
    return line_fit(changes_of, frequency_Hz).square;
}

/* The best frequency near one, within what the length of the run tells apart. */
static line line_near(const changes *c, double frequency_Hz)
{
    const hci_peak_function square = {square_at, c};
    hci_peak_refine(&square, 0.25 / c->span_s, &frequency_Hz);
    return line_fit(c, frequency_Hz);
}

/* The best frequency about one. */
static line line_refine(const changes *c, double frequency_Hz)
{
    const double step_Hz = 0.25 / c->span_s;
    line best = line_fit(c, frequency_Hz);
    for (int k = -PLACES; k <= PLACES; ++k) {
        const line a = line_fit(c, frequency_Hz + k * step_Hz);
        if (a.frequency_Hz > 0.0 && a.square > best.square) best = a;
    }
    return line_near(c, best.frequency_Hz);
}

/* Takes a line out (share 1) or puts it back (−1). */
static void line_leave(changes *c, const line *a, double share)
{
    const double omega = 2.0 * HCI_PI * a->frequency_Hz;
    for (size_t k = 0; k < c->count; ++k)
        c->change_Nm[k] -= share * (a->cosine * (cos(omega * c->time_s[k]) - cos(omega * c->before_s[k])) +
                                    a->sine * (sin(omega * c->time_s[k]) - sin(omega * c->before_s[k])));
}

/* Lines that are near each other share what they explain: each in turn beside the others. */
static void lines_settle(changes *c, line *lines, size_t count)
{
    for (int sweep = 0; sweep < SWEEPS && count > 1; ++sweep)
        for (size_t k = 0; k < count; ++k) {
            line_leave(c, &lines[k], -1.0);
            lines[k] = line_near(c, lines[k].frequency_Hz);
            line_leave(c, &lines[k], 1.0);
        }
}

/* ---- what else it may be ---- */

/* Sums of a quantity with a wave. */
typedef struct {
    double cosine, sine, sum, square, of_cosine, of_sine;
} wave_sums;

static void wave_add(wave_sums *w, double phase_rad, double x)
{
    w->cosine += cos(phase_rad);
    w->sine += sin(phase_rad);
    w->of_cosine += x * cos(phase_rad);
    w->of_sine += x * sin(phase_rad);
    w->sum += x;
    w->square += x * x;
}

static double wave_amplitude(const wave_sums *w, double count)
{
    const double mean = w->sum / count;
    return 2.0 / count * hypot(w->of_cosine - mean * w->cosine, w->of_sine - mean * w->sine);
}

/* Whether the current makes a part of it, or the speed swings too, which an inertia makes a torque of. */
static bool is_caused(const question *x, const line *a)
{
    const hci_run *r = x->run;
    const double n = (double)r->count, swing_Nm = hypot(a->cosine, a->sine);
    wave_sums d = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, q = d, speed = d;
    for (size_t k = 0; k < r->count; ++k) {
        const double phase_rad = 2.0 * HCI_PI * a->frequency_Hz * r->time_s[k];
        const hci_dq i = x->current[k];
        wave_add(&d, phase_rad, i.d);
        wave_add(&q, phase_rad, i.q);
        wave_add(&speed, phase_rad, r->speed_rad_per_s ? r->speed_rad_per_s[k] : 0.0);
    }
    const double current_A = hypot(wave_amplitude(&d, n), wave_amplitude(&q, n));
    const double scatter = sqrt(fmax(0.0, speed.square / n - pow(speed.sum / n, 2.0)));
    return fabs(x->constant_Nm_per_A) * current_A > OF_CURRENT * swing_Nm ||
           wave_amplitude(&speed, n) > OF_SPEED * scatter * sqrt(2.0 / n) + 1e-12;
}

/* Whether an order above half the samples in a turn, of those that a balanced machine has, looks like it. */
static bool is_folded(const question *x, const changes *c, double frequency_Hz)
{
    const hci_run *r = x->run;
    const double rate_Hz = (double)(r->count - 1) / (r->time_s[r->count - 1] - r->time_s[0]);
    const double period_s = c->turn_s / x->pole_pairs;
    if (rate_Hz * period_s > FOLDED) return false;
    for (int k = -2; k <= 2; ++k) {
        const double order = (k * rate_Hz + frequency_Hz) * period_s;
        if (k != 0 && fabs(order / 6.0 - round(order / 6.0)) < ALIAS / 6.0) return true;
    }
    return false;
}

/* ---- all ---- */

static bool is_asked(const hci_swing_question *x)
{
    const hci_run *r = x->run;
    const hci_run_statistics *f = x->statistics;
    return r->torque_source == HCI_TORQUE_MEASURED && r->time_s && !r->only_mean &&
           r->count >= LEAST_SAMPLES && f->turns >= TURNS && (double)r->count > LEAST_OF_TURN * f->turns &&
           f->speed_deviation <= STEADY * fabs(f->mean_speed_rad_per_s) &&
           r->time_s[r->count - 1] > r->time_s[0];
}

/* False when memory is out. */
static bool changes_make(changes *c, size_t samples, size_t *group)
{
    *group = (samples + MOST_MEANS - 1) / MOST_MEANS;
    c->count = samples / *group;
    c->size = hci_fft_size(2.0 * (double)c->count);
    c->change_Nm = hci_memory_new(3 * c->count + 2 * c->size, sizeof *c->change_Nm);
    if (!c->change_Nm) return false;
    c->time_s = c->change_Nm + c->count;
    c->before_s = c->time_s + c->count;
    c->re = c->before_s + c->count;
    c->im = c->re + c->size;
    return true;
}

static void times_set(const hci_run *r, size_t group, changes *c)
{
    const double sample_s = (r->time_s[r->count - 1] - r->time_s[0]) / (double)(r->count - 1);
    c->span_s = c->time_s[c->count - 1] - c->time_s[0];
    c->mean_s = c->span_s / (double)(c->count - 1);
    c->turn_s = hci_mean(c->time_s, c->count) - hci_mean(c->before_s, c->count);
    c->most_Hz = fmin(FASTEST / sample_s, group > 1 ? IN_MEANS / c->mean_s : (double)INFINITY);
}

/* In so much noise a frequency is known to √6/π of noise over amplitude and √n periods. */
static hci_swing swing_of(const changes *c, const line *a)
{
    const double amplitude = hypot(a->cosine, a->sine), n = (double)c->count;
    const double noise =
        sqrt(hci_mean_square_about(c->change_Nm, c->count, hci_mean(c->change_Nm, c->count)));
    const double part = fmax(APART, seen(c, a->frequency_Hz));
    return (hci_swing){a->frequency_Hz, sqrt(6.0) / HCI_PI * noise / (amplitude * part * sqrt(n) * c->span_s),
                       1.0 / c->turn_s, a->cosine, a->sine};
}

/* The line of a frequency as it stands in the torque itself. */
static line line_of_torque(const question *x, double frequency_Hz)
{
    const hci_run *r = x->run;
    wave_sums w = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    const double n = (double)r->count;
    for (size_t k = 0; k < r->count; ++k)
        wave_add(&w, 2.0 * HCI_PI * frequency_Hz * r->time_s[k], x->left_Nm[k]);
    const double mean = w.sum / n;
    return (line){frequency_Hz, 2.0 / n * (w.of_cosine - mean * w.cosine),
                  2.0 / n * (w.of_sine - mean * w.sine), 0.0};
}

/* Whether the torque itself has about the line that its changes over a turn show. */
static bool is_in_torque(const question *x, const line *a)
{
    const line b = line_of_torque(x, a->frequency_Hz);
    return hypot(a->cosine - b.cosine, a->sine - b.sine) < OFF * hypot(a->cosine, a->sine);
}

/* Lines that stand out of the noise. Returns how many. The foot of a multiple of the turn, of which rounded
 * angles leave a little in the changes, leads to that, which is no swing. */
static size_t lines_take(const question *x, changes *c, line *lines)
{
    size_t count = 0;
    while (count < HCI_MOST_SWINGS && x->statistics->turns >= OWN_TURNS) {
        spectrum_fill(c);
        const double frequency_Hz = line_find(c);
        if (!(frequency_Hz > 0.0)) break;
        const line a = line_refine(c, frequency_Hz);
        if (!(a.square > 0.0)) break;
        if (!(seen(c, a.frequency_Hz) > APART) && c->refused < HCI_MOST_SWINGS) {
            c->refused_Hz[c->refused++] = frequency_Hz;
            continue;
        }
        if (!(seen(c, a.frequency_Hz) > APART) || !is_in_torque(x, &a)) break;
        if (is_caused(x, &a) || is_folded(x, c, a.frequency_Hz)) break;
        line_leave(c, &a, 1.0);
        lines[count++] = a;
        lines_settle(c, lines, count);
    }
    return count;
}

/* ---- known of other runs ---- */

static bool has(const changes *c, const line *lines, size_t count, const hci_swing_group *known)
{
    for (size_t k = 0; k < count; ++k) {
        const hci_swing x = swing_of(c, &lines[k]);
        if (hci_swing_is_of(&x, known)) return true;
    }
    return false;
}

/* Whether a swing is one of other runs too: several show it, or a part of it of which it is a multiple, as of
 * the mains. */
static bool is_known(const hci_swing_groups *known, const hci_swing_group *x)
{
    for (size_t g = 0; g < known->count; ++g) {
        const hci_swing_group *y = &known->group[g];
        const double times = round(x->frequency / y->frequency), off = x->frequency - times * y->frequency;
        if (y->runs >= LEAST_RUNS && y->of_turn == x->of_turn && times >= 1.0 &&
            fabs(off) < MULTIPLE * fmax(x->error, times * y->error))
            return true;
    }
    return false;
}

/* Adds those that other runs show, where they are about as large here. Returns how many there are then. */
static size_t known_take(const question *x, changes *c, const hci_swing_groups *known, line *lines,
                         size_t count)
{
    for (size_t g = 0; g < known->count && count < HCI_MOST_SWINGS; ++g) {
        const hci_swing_group *k = &known->group[g];
        const double frequency_Hz = k->of_turn ? k->frequency / c->turn_s : k->frequency;
        if (!is_known(known, k) || has(c, lines, count, k)) continue;
        const line a = seen(c, frequency_Hz) > APART ? line_fit(c, frequency_Hz)
                                                     : line_of_torque(x, frequency_Hz); /* hardly shows */
        const double ratio = hypot(a.cosine, a.sine) / k->amplitude_Nm;
        if (!(ratio > 1.0 / ALIKE && ratio < ALIKE) || is_caused(x, &a)) continue;
        line_leave(c, &a, 1.0);
        lines[count++] = a;
    }
    return count;
}

double hci_swings_at_Nm(const hci_run_statistics *f, double time_s)
{
    double sum_Nm = 0.0;
    for (size_t k = 0; k < f->swings; ++k) {
        const double phase_rad = 2.0 * HCI_PI * f->swing[k].frequency_Hz * time_s;
        sum_Nm += f->swing[k].cosine_Nm * cos(phase_rad) + f->swing[k].sine_Nm * sin(phase_rad);
    }
    return sum_Nm;
}

static size_t take(const question *x, changes *c, const hci_swing_groups *known, hci_swing *swing)
{
    line lines[HCI_MOST_SWINGS];
    size_t count = lines_take(x, c, lines);
    if (known) count = known_take(x, c, known, lines, count);
    for (size_t k = 0; k < count; ++k)
        swing[k] = swing_of(c, &lines[k]);
    return count;
}

/* known: NULL: of no other runs. SIZE_MAX when memory is out. */
static size_t find(const question *x, const hci_swing_groups *known, hci_swing *swing)
{
    const hci_run *r = x->run;
    size_t first = 1, group = 1, count = 0;
    changes c = {.refused = 0};
    const double direction = r->theta_m_rad[r->count - 1] > r->theta_m_rad[0] ? 1.0 : -1.0;
    place p = {0, 0.0};
    while (first < r->count && !place_find(r, first, direction, &p))
        ++first;
    if (r->count - first < LEAST_SAMPLES / 2) return 0;
    if (!changes_make(&c, r->count - first, &group)) return SIZE_MAX;
    if (changes_fill(x, direction, first, group, &c)) {
        times_set(r, group, &c);
        if (c.turn_s > 0.0 && c.mean_s > 0.0) count = take(x, &c, known, swing);
    }
    hci_memory_free(c.change_Nm);
    return count;
}

size_t hci_swings_find(const hci_swing_question *asked, const hci_swing_groups *known,
                       hci_swing swing[HCI_MOST_SWINGS])
{
    question x = {0};
    if (!is_asked(asked)) return 0;
    const size_t count = question_make(asked, &x) ? find(&x, known, swing) : SIZE_MAX;
    question_release(&x);
    return count;
}
