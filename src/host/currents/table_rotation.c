/* Where a drive reads a table. In: the waves of a table, a recording of phase currents over the angle; out:
 * the shift at which the one fits the other best: of the phase currents as a whole, or of i_d and i_q in the
 * frame of the recorded angle, as a drive that commutates by itself plays them. The table is computed on a
 * fine grid, all shifts by whole steps of it are tried on some samples, and the best is refined by Newton's
 * method on all of them. */
#include "hci/host/currents/table_rotation.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"

/* Grid points of an electrical turn, turns of a table at most, samples that shifts are tried on, and pole
 * pairs that are. */
enum { GRID = 512, MOST_TURNS = 64, TRIED = 600, MOST_PAIRS = 64 };

/* Of the rms: a table that leaves more is not in the recording; other pole pairs are named from the second
 * on. */
static const double FOUND = 0.95, SEEN = 0.5;

/* Of what differs as it is: a rotation that leaves more mends nothing. Of what is left where the phases are
 * turned: the index of a table in the frame of i_d and i_q leaves less, where it is that which is rotated. */
static const double LESSENED = 0.95, CLEARLY = 0.5, NOTHING = 1e-3;

typedef struct {
    const hci_currents *table;
    const hci_run *run;
    double pole_pairs;
    size_t turns;
    double *grid;           /* [GRID·turns][3] */
    bool in_frame;          /* i_d, i_q and zero sequence are compared, and not the phases */
    const double *measured; /* [samples][3], in the same */
} comparison;

/* Sums over samples: measured², table², measured·table. */
typedef struct {
    double mm, tt, mt;
} sums;

static size_t period_of(const hci_currents *table)
{
    for (size_t turns = 1; turns <= MOST_TURNS; ++turns) {
        bool whole = true;
        for (size_t k = 0; k < table->count; ++k) {
            const double cycles = table->wave[k].order * (double)turns;
            whole = whole && fabs(cycles - floor(cycles + 0.5)) < 10.0 * HCI_ORDER_TOLERANCE;
        }
        if (whole) return turns;
    }
    return MOST_TURNS;
}

static void to_frame(double x[3], double theta)
{
    const hci_dq in = hci_park(hci_clarke(x), theta);
    x[0] = in.d;
    x[1] = in.q;
    x[2] = in.zero;
}

static void value_at(const comparison *c, double theta, double value[3])
{
    hci_waves_at(c->table->wave, c->table->count, theta, value);
    if (c->in_frame) to_frame(value, theta);
}

static hci_status make_grid(comparison *c, hci_note *note)
{
    c->turns = period_of(c->table);
    c->grid = hci_memory_new(GRID * c->turns * 3, sizeof *c->grid);
    if (!c->grid) return hci_note_memory(note, c->run->name, "%zu turns of the table", c->turns);
    for (size_t k = 0; k < GRID * c->turns; ++k)
        value_at(c, 2.0 * HCI_PI * (double)k / GRID, c->grid + 3 * k);
    return HCI_OK;
}

static double theta_rad(const comparison *c, size_t sample, bool backwards)
{
    const double theta = c->run->theta_m_rad[sample] * c->pole_pairs;
    return backwards ? -theta : theta;
}

static void add(sums *s, const double measured[3], const double table[3])
{
    for (int k = 0; k < 3; ++k) {
        s->mm += measured[k] * measured[k];
        s->tt += table[k] * table[k];
        s->mt += measured[k] * table[k];
    }
}

/* Share of the measured square that no gain > 0 explains. */
static double left_of(const sums *s)
{
    if (!(s->mt > 0.0) || !(s->tt > 0.0)) return 1.0;
    return fmax(0.0, 1.0 - s->mt * s->mt / (s->mm * s->tt));
}

/* At a shift of whole grid points, on some samples, by the golden ratio all over the recording. */
static double try_shift(const comparison *c, size_t shift, bool backwards)
{
    const size_t all = GRID * c->turns;
    sums s = {0.0, 0.0, 0.0};
    for (uint32_t n = 0; n < TRIED; ++n) {
        const size_t k = (size_t)(((uint64_t)(n * 2654435769u) * c->run->count) >> 32);
        const double turns = theta_rad(c, k, backwards) / (2.0 * HCI_PI * (double)c->turns);
        const size_t place = (size_t)((turns - floor(turns)) * (double)all + 0.5) + shift;
        add(&s, c->measured + 3 * k, c->grid + 3 * (place % all));
    }
    return left_of(&s);
}

/* The table and its slope at an angle. */
static void table_at(const comparison *c, double theta, double value[3], double slope[3])
{
    const double step = 1e-5;
    double before[3], after[3];
    value_at(c, theta, value);
    value_at(c, theta - step, before);
    value_at(c, theta + step, after);
    for (int k = 0; k < 3; ++k)
        slope[k] = (after[k] - before[k]) / (2.0 * step);
}

/* One step of Gauss and Newton for the gain and the rotation, on all samples; and what is left before it. */
static void refine(const comparison *c, hci_table_rotation *x)
{
    double tt = 0.0, ts = 0.0, ss = 0.0, rt = 0.0, rs = 0.0, rr = 0.0, mm = 0.0, determinant;
    for (size_t k = 0; k < c->run->count; ++k) {
        const double *i = c->measured + 3 * k;
        double t[3], slope[3];
        table_at(c, theta_rad(c, k, x->backwards) + x->rotation_rad, t, slope);
        for (int s = 0; s < 3; ++s) {
            const double r = i[s] - x->gain * t[s], g = x->gain * slope[s];
            mm += i[s] * i[s], rr += r * r, tt += t[s] * t[s], ts += t[s] * g, ss += g * g, rt += r * t[s],
                rs += r * g;
        }
    }
    determinant = tt * ss - ts * ts;
    x->left = sqrt(rr / mm);
    if (!(determinant > 0.0)) return;
    x->error_rad = sqrt(rr / (2.0 * (double)c->run->count) * tt / determinant);
    x->gain += (rt * ss - rs * ts) / determinant;
    x->rotation_rad += (rs * tt - rt * ts) / determinant;
}

/* What is left as it is, and the gain of a start. */
static double gain_at(const comparison *c, double rotation_rad, bool backwards, double *left)
{
    sums s = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < c->run->count; ++k) {
        double t[3];
        value_at(c, theta_rad(c, k, backwards) + rotation_rad, t);
        add(&s, c->measured + 3 * k, t);
    }
    *left = sqrt(left_of(&s));
    return s.tt > 0.0 ? s.mt / s.tt : 0.0;
}

/* The best of all shifts in both directions; those backwards behind the others. *best: what it leaves. */
static size_t best_shift(const comparison *c, double *best)
{
    const size_t all = GRID * c->turns;
    size_t at = 0;
    *best = 2.0;
    for (size_t k = 0; k < (c->in_frame ? 1 : 2) * all; ++k) {
        const double left = try_shift(c, k % all, k >= all);
        if (!(left < *best)) continue;
        *best = left;
        at = k;
    }
    return at;
}

/* Times what the best shift leaves: one within half an electrical turn that leaves no more is as good. */
#define AS_GOOD 1.1

static size_t as_good_near(const comparison *c, double best, size_t at)
{
    const size_t all = GRID * c->turns;
    double least = AS_GOOD * best + 1e-9;
    for (size_t k = 0; k < GRID; ++k) {
        const size_t near = (k + all - GRID / 2) % all;
        const double left = try_shift(c, near, false);
        if (!(left < least)) continue;
        least = left;
        at = near;
    }
    return at;
}

/* What is left at the lowest point of a parabola through a shift and its neighbours; 2: it is no lowest. */
static double lowest_at(const comparison *c, size_t at)
{
    const size_t all = GRID * c->turns;
    const double here = try_shift(c, at, false), on = try_shift(c, (at + 1) % all, false),
                 back = try_shift(c, (at + all - 1) % all, false), bend = on - 2.0 * here + back;
    if (here > on || here > back) return 2.0;
    return bend > 0.0 ? here - 0.125 * (on - back) * (on - back) / bend : here;
}

/* i_d and i_q repeat six times in a turn: of places that are as good the one nearest to none. */
static size_t nearest_place(const comparison *c, size_t at)
{
    const size_t all = GRID * c->turns;
    const double most = AS_GOOD * lowest_at(c, at) + 1e-9;
    for (size_t k = 0; k <= GRID / 2; ++k) {
        if (lowest_at(c, k) < most) return k;
        if (lowest_at(c, (all - k) % all) < most) return (all - k) % all;
    }
    return at;
}

/* The best shift, and the best in another electrical turn. */
static void search(const comparison *c, hci_table_rotation *x)
{
    const size_t all = GRID * c->turns;
    double best, elsewhere = 2.0;
    size_t at = best_shift(c, &best);
    x->backwards = at >= all;
    at %= all;
    if (!x->backwards) at = as_good_near(c, best, at);
    if (c->in_frame) at = nearest_place(c, at);
    for (size_t turn = 1; turn < c->turns; ++turn)
        for (size_t k = 0; k < 33; ++k)
            elsewhere = fmin(elsewhere, try_shift(c, (at + turn * GRID + k + all - 16) % all, x->backwards));
    x->left_elsewhere = c->turns > 1 ? sqrt(elsewhere) : 1.0;
    x->rotation_rad = 2.0 * HCI_PI * (double)at / GRID;
    if (at > all / 2) x->rotation_rad -= 2.0 * HCI_PI * (double)c->turns;
}

/* Pole pairs with which a table of one electrical turn is in the recording, or 0. */
static size_t pole_pairs_seen(comparison c)
{
    double least = SEEN * SEEN;
    size_t seen = 0;
    for (size_t pairs = 1; c.turns == 1 && pairs <= MOST_PAIRS; ++pairs) {
        double left;
        c.pole_pairs = (double)pairs;
        (void)best_shift(&c, &left);
        if (!(left < least)) continue;
        least = left;
        seen = pairs;
    }
    return seen;
}

/* Electrical step of an angle that stands still at a fifth of the samples or more: of a coarse encoder. */
static double step_of(const comparison *c)
{
    size_t still = 0, moves = 0;
    double sum = 0.0;
    for (size_t k = 1; k < c->run->count; ++k) {
        const double step = fabs(c->run->theta_m_rad[k] - c->run->theta_m_rad[k - 1]) * c->pole_pairs;
        still += step < 1e-9;
        moves += step >= 1e-9;
        sum += step;
    }
    return moves > 0 && 5 * still >= c->run->count ? sum / (double)moves : 0.0;
}

static void conclude(const comparison *c, hci_table_rotation *x)
{
    const double rotation = fabs(x->rotation_rad);
    x->step_rad = step_of(c);
    x->is_found = x->left < FOUND;
    if (!x->is_found) x->pole_pairs_seen = pole_pairs_seen(*c);
    x->is_rotated = x->is_found &&
                    (x->backwards || (rotation > 3.0 * x->error_rad + 0.5 * x->step_rad && rotation > 0.01));
}

static hci_status check_inputs(const comparison *c, hci_note *note)
{
    double sum = 0.0;
    if (!c->run->theta_m_rad || c->run->zero_is_unknown || c->run->only_mean)
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: found no angle from a known zero, expected theta_m_rad or theta_e_rad; log the angle "
            "with which the table is read",
            c->run->name);
    for (size_t k = 0; k < 3 * c->run->count; ++k)
        sum += c->run->i_A[k] * c->run->i_A[k];
    if (!(sum > 0.0))
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: found no current, expected ia_A, ib_A, ic_A or id_A, iq_A; log what flows",
                            c->run->name);
    if (c->table->count == 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "the table has no currents; solve for a torque or a cogging torque");
    return HCI_OK;
}

static void fit(const comparison *c, hci_table_rotation *x)
{
    *x = (hci_table_rotation){.period_turns = c->turns, .samples = c->run->count, .of_index = c->in_frame};
    search(c, x);
    (void)gain_at(c, 0.0, false, &x->left_as_is);
    x->gain = gain_at(c, x->rotation_rad, x->backwards, &x->left);
    for (int k = 0; k < 4; ++k)
        refine(c, x);
    if (x->backwards || x->left < LESSENED * x->left_as_is || x->left >= FOUND) return;
    x->rotation_rad = 0.0; /* what mends nothing is no rotation */
    x->gain = gain_at(c, 0.0, false, &x->left);
    refine(c, x); /* its error */
    x->rotation_rad = 0.0;
    x->gain = gain_at(c, 0.0, false, &x->left);
}

/* The same in the frame of the recorded angle, if that can leave less than the phases. */
static hci_status fit_in_frame(comparison c, double phases_left, hci_table_rotation *x, hci_note *note)
{
    double *measured = hci_memory_new(c.run->count, 3 * sizeof *measured);
    if (!measured) return hci_note_memory(note, c.run->name, "%zu samples", c.run->count);
    memcpy(measured, c.run->i_A, c.run->count * 3 * sizeof *measured);
    c.in_frame = true;
    c.measured = measured;
    for (size_t k = 0; k < c.run->count; ++k)
        to_frame(measured + 3 * k, theta_rad(&c, k, false));
    for (size_t k = 0; k < GRID * c.turns; ++k)
        to_frame(c.grid + 3 * k, 2.0 * HCI_PI * (double)k / GRID);
    double best;
    (void)best_shift(&c, &best);
    if (sqrt(best) < phases_left) {
        fit(&c, x);
        conclude(&c, x);
    }
    hci_memory_free(measured);
    return HCI_OK;
}

/* ---- what the table has beside its fundamental */

/* Of the table's rms: less is none. Errors by which the harmonics stand out, and share of the gain. */
static const double NO_HARMONICS = 1e-3, STANDS_OUT = 5.0, OF_GAIN = 0.3;

enum { FUNDAMENTAL, QUADRATURE, HARMONICS, MEASURED, PARTS };

/* The fundamental of the table where it is read, the same a quarter on, the rest, and what was measured. */
static void parts_at(const comparison *c, const hci_table_rotation *x, size_t sample, double part[PARTS][3])
{
    const double theta = theta_rad(c, sample, x->backwards) + x->rotation_rad;
    memset(part, 0, PARTS * sizeof *part);
    for (size_t k = 0; k < c->table->count; ++k) {
        double wave[3], on[3];
        const bool is_fundamental = fabs(c->table->wave[k].order - 1.0) < 10.0 * HCI_ORDER_TOLERANCE;
        hci_waves_at(&c->table->wave[k], 1, theta, wave);
        hci_waves_at(&c->table->wave[k], 1, theta + 0.5 * HCI_PI, on);
        for (int s = 0; s < 3; ++s) {
            part[is_fundamental ? FUNDAMENTAL : HARMONICS][s] += wave[s];
            part[QUADRATURE][s] += is_fundamental ? on[s] : 0.0;
        }
    }
    memcpy(part[MEASURED], c->run->i_A + 3 * sample, 3 * sizeof(double));
}

/* Takes out of the products of all parts what the first of them explains. */
static void take_out(double gram[PARTS][PARTS], int first)
{
    const double pivot = gram[first][first];
    double row[PARTS];
    memcpy(row, gram[first], sizeof row);
    for (int a = 0; a < PARTS && pivot > 0.0; ++a)
        for (int b = 0; b < PARTS; ++b)
            gram[a][b] -= row[a] * row[b] / pivot;
}

static void harmonics_find(const comparison *c, hci_table_rotation *x)
{
    double gram[PARTS][PARTS] = {{0.0}}, table = 0.0;
    for (size_t k = 0; k < c->run->count; ++k) {
        double part[PARTS][3];
        parts_at(c, x, k, part);
        for (int s = 0; s < 3; ++s)
            for (int a = 0; a < PARTS; ++a)
                for (int b = 0; b < PARTS; ++b)
                    gram[a][b] += part[a][s] * part[b][s];
    }
    table = gram[FUNDAMENTAL][FUNDAMENTAL] + gram[HARMONICS][HARMONICS];
    x->is_seen = !(gram[HARMONICS][HARMONICS] > NO_HARMONICS * NO_HARMONICS * table);
    if (x->is_seen) return;
    take_out(gram, FUNDAMENTAL);
    take_out(gram, QUADRATURE);
    const double own = gram[HARMONICS][HARMONICS];
    x->harmonics = own > 0.0 ? gram[HARMONICS][MEASURED] / own : 0.0;
    const double left = fmax(0.0, gram[MEASURED][MEASURED] - x->harmonics * gram[HARMONICS][MEASURED]);
    x->harmonics_error = own > 0.0 ? sqrt(left / (2.0 * (double)c->run->count) / own) : HUGE_VAL;
    x->is_seen = x->harmonics > STANDS_OUT * x->harmonics_error && x->harmonics > OF_GAIN * x->gain;
}

hci_status hci_table_rotation_of(const hci_currents *table, const hci_run *run, int pole_pairs,
                                 hci_table_rotation *x, hci_note *note)
{
    comparison c = {table, run, pole_pairs, 1, NULL, false, run->i_A};
    const bool is_dq = !run->has_sum && run->computed_phase == 0;
    hci_table_rotation of_index;
    hci_status status = check_inputs(&c, note);
    if (!status) status = make_grid(&c, note);
    if (status) return status;
    fit(&c, x);
    conclude(&c, x);
    of_index.is_rotated = false;
    if (!x->backwards && x->left > NOTHING) status = fit_in_frame(c, x->left, &of_index, note);
    if (!status && of_index.is_rotated && of_index.left < (is_dq ? LESSENED : CLEARLY) * x->left)
        *x = of_index;
    if (!status && x->of_index)
        x->is_seen = true; /* what is rotated there is the harmonics */
    else if (!status)
        harmonics_find(&c, x);
    hci_memory_free(c.grid);
    return status;
}
