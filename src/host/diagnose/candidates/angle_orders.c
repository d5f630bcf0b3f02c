#include "host/diagnose/candidates/angle_orders.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/rotor.h"
#include "host/numeric/wide.h"

#define STANDS_OUT 20.0 /* fall of χ² */
#define AGREES     0.8  /* share of what two angles explain, one for each torque, that one explains */
#define OF_ALL     0.5  /* share of what an angle for each run explains, that one for all does */
#define APART      1e-6 /* of the squares of two slopes, by which they are not the same */

enum { MOST_PERIODS = 300 /* in a mechanical turn */ };

enum { LOAD, TEETH, KINDS };

/* Sums over all samples, with orders 1 … count of the stride, of both slopes. */
typedef struct {
    size_t stride, count;
    double *wave[KINDS];  /* [2][count + 1]: Σ w r g × cos and sin of 0 … count */
    double *of_run;       /* the same of one run, both slopes together */
    double run_square;    /* Σ w g² of it */
    double *own;          /* [count]: what errors of their own would explain, each in its run */
    size_t run, runs;     /* that one; that have such a slope */
    double square[KINDS]; /* Σ w g² */
    double cross;         /* Σ w g g of the two */
    double *left;         /* [count][2]: of both together, of what is left */
    bool *open;           /* [count] */
    double *spectrum;     /* [2][2 count + 1]: Σ w g² of both together × cos and sin of 0 … 2 count */
} sums;

static bool shows(const hci_candidates_source *s, size_t run)
{
    const hci_run *r = &s->runs[run];
    return s->use[run] && !r->only_mean && r->torque_source == HCI_TORQUE_MEASURED;
}

/* weighted: w r g. */
HCI_WIDE static void waves_add(sums *sum, double theta_m_rad, const double weighted[KINDS])
{
    const size_t count = sum->count + 1;
    hci_rotor r = hci_rotor_at(theta_m_rad * (double)sum->stride);
    for (size_t k = 0; k < count; k += HCI_ROTOR_LANES) {
        const size_t lanes = count - k < HCI_ROTOR_LANES ? count - k : HCI_ROTOR_LANES;
        for (int kind = 0; kind < KINDS; ++kind)
            hci_rotor_add(&r, weighted[kind], sum->wave[kind] + k, lanes, count);
        hci_rotor_add(&r, weighted[LOAD] + weighted[TEETH], sum->of_run + k, lanes, count);
        hci_rotor_turn(&r);
    }
}

/* weighted: w g² of both slopes together. */
HCI_WIDE static void spectrum_add(sums *sum, double theta_m_rad, double weighted)
{
    hci_rotor_sum(theta_m_rad * (double)sum->stride, weighted, 2 * sum->count + 1, sum->spectrum);
}

/* ∂T/∂θ_m of the torque with the currents and of the cogging torque. */
static void slopes_at(const hci_machine *machine, const hci_sample *x, double slope[KINDS])
{
    static const double NONE[3] = {0.0, 0.0, 0.0};
    const double theta_rad = machine->pole_pairs * x->theta_m_rad;
    slope[TEETH] = hci_torque_slopes_at(machine, theta_rad, NONE).by_angle;
    slope[LOAD] = hci_torque_slopes_at(machine, theta_rad, x->i_abc).by_angle - slope[TEETH];
}

static double mean_of(const hci_candidates_source *s, const hci_segment *segment)
{
    double sum = 0.0, weight = 0.0;
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        sum += s->residual_Nm[j] / s->variance[j];
        weight += 1.0 / s->variance[j];
    }
    return weight > 0.0 ? sum / weight : 0.0;
}

static double fall_of(double cosine, double sine, double square)
{
    return square > 0.0 ? 2.0 * (cosine * cosine + sine * sine) / square : 0.0;
}

/* What the run that ends here asks for, by itself. */
static void run_end(sums *sum, size_t next)
{
    const double *cosine = sum->of_run + 1, *sine = cosine + sum->count + 1;
    for (size_t k = 0; k < sum->count; ++k)
        sum->own[k] += fall_of(cosine[k], sine[k], sum->run_square);
    sum->runs += sum->run_square > 0.0;
    sum->run_square = 0.0;
    sum->run = next;
    memset(sum->of_run, 0, 2 * (sum->count + 1) * sizeof *sum->of_run);
}

static void segment_add(const hci_candidates_source *s, const hci_segment *segment, sums *sum)
{
    const double mean = mean_of(s, segment);
    if (segment->run != sum->run) run_end(sum, segment->run);
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        const hci_sample *x = &s->samples->sample[j].reading;
        const double w = 1.0 / s->variance[j], residual_Nm = s->residual_Nm[j] - mean;
        double slope[KINDS];
        slopes_at(s->machine, x, slope);
        const double weighted[KINDS] = {w * slope[LOAD] * residual_Nm, w * slope[TEETH] * residual_Nm};
        waves_add(sum, x->theta_m_rad, weighted);
        for (int kind = 0; kind < KINDS; ++kind)
            sum->square[kind] += w * slope[kind] * slope[kind];
        sum->cross += w * slope[LOAD] * slope[TEETH];
        sum->run_square += w * pow(slope[LOAD] + slope[TEETH], 2.0);
    }
}

static void segment_spectrum_add(const hci_candidates_source *s, const hci_segment *segment, sums *sum)
{
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        double slope[KINDS];
        slopes_at(s->machine, &s->samples->sample[j].reading, slope);
        spectrum_add(sum, s->samples->sample[j].reading.theta_m_rad,
                     pow(slope[LOAD] + slope[TEETH], 2.0) / s->variance[j]);
    }
}

/* What two errors of the angle of one order would explain, one for each torque. */
static double strength_of_two(const sums *sum, const double *load, const double *teeth)
{
    const double a = sum->square[LOAD], b = sum->square[TEETH], x = sum->cross, d = a * b - x * x;
    if (!(d > APART * a * b)) return fmax(fall_of(load[0], load[1], a), fall_of(teeth[0], teeth[1], b));
    double fall = 0.0;
    for (int k = 0; k < 2; ++k)
        fall += 2.0 * (b * load[k] * load[k] - 2.0 * x * load[k] * teeth[k] + a * teeth[k] * teeth[k]) / d;
    return fall;
}

/* What one error explains of what is left. */
static double strength(const sums *sum, size_t k)
{
    const double square = sum->square[LOAD] + sum->square[TEETH] + 2.0 * sum->cross;
    return fall_of(sum->left[2 * k], sum->left[2 * k + 1], square);
}

/* Whether one error for all runs explains what each would ask for, less what chance makes of that. */
static bool is_of_all(const sums *sum, size_t k)
{
    return strength(sum, k) > OF_ALL * (sum->own[k] - 2.0 * (double)sum->runs);
}

/* Those of which neither the two torques nor the runs ask for different errors. Whether one of them stands
 * out. */
static bool open_find(sums *sum)
{
    bool any = false;
    for (size_t k = 0; k < sum->count; ++k) {
        const double load[2] = {sum->wave[LOAD][k + 1], sum->wave[LOAD][sum->count + k + 2]};
        const double teeth[2] = {sum->wave[TEETH][k + 1], sum->wave[TEETH][sum->count + k + 2]};
        sum->left[2 * k] = load[0] + teeth[0];
        sum->left[2 * k + 1] = load[1] + teeth[1];
        sum->open[k] = strength(sum, k) > AGREES * strength_of_two(sum, load, teeth) && is_of_all(sum, k);
        any = any || (sum->open[k] && strength(sum, k) > STANDS_OUT);
    }
    return any;
}

/* Takes what one error explains out of all waves: it has orders of its own on both sides of all orders of g,
 * which look like other errors. With C(m) + jS(m) the spectrum of w g², Σ w g² cos jθ (a cos kθ + b sin kθ)
 * is ½a(C(j−k) + C(j+k)) + ½b(S(j+k) − S(j−k)), and with sin jθ ½a(S(j+k) + S(j−k)) + ½b(C(j−k) − C(j+k)). */
static void take_out(sums *sum, size_t k)
{
    const double *cosines = sum->spectrum, *sines = cosines + 2 * sum->count + 1, whole = cosines[0];
    const double cosine = sum->left[2 * k], sine = sum->left[2 * k + 1];
    const double cc = 0.5 * (whole + cosines[2 * k + 2]), ss = 0.5 * (whole - cosines[2 * k + 2]);
    const double cs = 0.5 * sines[2 * k + 2];
    const double d = cc * ss - cs * cs;
    sum->open[k] = false;
    if (!(d > APART * whole * whole)) return;
    const double a = (ss * cosine - cs * sine) / d, b = (cc * sine - cs * cosine) / d;
    for (size_t j = 0; j < sum->count; ++j) {
        const size_t more = j + k + 2, less = j > k ? j - k : k - j;
        const double turned = j > k ? sines[less] : -sines[less];
        sum->left[2 * j] -= 0.5 * (a * (cosines[less] + cosines[more]) + b * (sines[more] - turned));
        sum->left[2 * j + 1] -= 0.5 * (a * (sines[more] + turned) + b * (cosines[less] - cosines[more]));
    }
}

/* The strongest first, each beside those before it. */
static void strongest(sums *sum, int pole_pairs, hci_angle_orders *x)
{
    for (x->count = 0; x->count < HCI_ANGLE_ORDERS; ++x->count) {
        size_t best = sum->count;
        for (size_t k = 0; k < sum->count; ++k)
            if (sum->open[k] && (best == sum->count || strength(sum, k) > strength(sum, best))) best = k;
        if (best == sum->count || !(strength(sum, best) > STANDS_OUT)) return;
        x->order[x->count] = (double)((best + 1) * sum->stride) / pole_pairs;
        take_out(sum, best);
    }
}

static bool sums_make(sums *sum)
{
    const size_t one = 2 * (sum->count + 1);
    sum->wave[LOAD] = hci_memory_new((KINDS + 1) * one + 7 * sum->count + 2, sizeof *sum->wave[LOAD]);
    sum->open = hci_memory_new(sum->count + 1, sizeof *sum->open);
    if (!sum->wave[LOAD] || !sum->open) return false;
    sum->wave[TEETH] = sum->wave[LOAD] + one;
    sum->of_run = sum->wave[TEETH] + one;
    sum->left = sum->of_run + one;
    sum->own = sum->left + 2 * sum->count;
    sum->spectrum = sum->own + sum->count;
    return true;
}

static void segments_add(const hci_candidates_source *s, sums *sum,
                         void (*add)(const hci_candidates_source *s, const hci_segment *x, sums *sum))
{
    for (size_t k = 0; k < s->samples->segment_count; ++k)
        if (shows(s, s->samples->segment[k].run)) add(s, &s->samples->segment[k], sum);
}

bool hci_angle_orders_find(const hci_candidates_source *s, size_t stride, double resolved,
                           hci_angle_orders *x)
{
    const double most = fmin(MOST_PERIODS, resolved * s->machine->pole_pairs);
    sums sum = {.stride = stride, .count = isfinite(resolved) ? (size_t)(most / (double)stride) : 0};
    const bool made = sums_make(&sum);
    x->count = 0;
    if (made) segments_add(s, &sum, segment_add);
    if (made) run_end(&sum, sum.run);
    if (made && open_find(&sum)) {
        segments_add(s, &sum, segment_spectrum_add);
        strongest(&sum, s->machine->pole_pairs, x);
    }
    hci_memory_free(sum.wave[LOAD]);
    hci_memory_free(sum.open);
    return made;
}
