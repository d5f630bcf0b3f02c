#include "host/diagnose/fit/predicted_reading.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/fit/between_samples.h"
#include "host/diagnose/fit/shorter_list.h"
#include "host/diagnose/prepare/turns.h"
#include "host/machine/torque_constant.h"
#include "host/numeric/slope_average.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define ROUNDING_OF_MEAN 1e-9 /* of the mean size of a derivative, that a mean of 0 has */
#define SAME_SCALE       1e-6 /* departure of a torque per ampere that is rounding */
#define LARGEST_SCALE    1e3  /* of a torque per ampere that has vanished */
#define CLOSE            0.25 /* of the mean step: between angles that tell no curvature */

enum { LEAST_LEAD = 4 /* samples, that inputs between samples are told from */ };

enum { ANGLES_OF_MEAN = 97 /* a prime: evenly spread over the electrical and the mechanical turn */ };

static unsigned traits_of(const hci_effect *effect, size_t term)
{
    return effect->type->parameter[effect->term[term].parameter].traits;
}

/* A lag or a resonance; a time constant of 0 is none. */
static bool has_dynamics(const hci_effects *effects)
{
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        for (size_t j = 0; j < e->count; ++j)
            if ((traits_of(e, j) & HCI_PARAMETER_ALONG_TIME) && e->term[j].value != 0.0) return true;
    }
    return false;
}

/* Place of a time constant of 0 among all terms, or their number. */
static size_t dormant_lag(const hci_effects *effects)
{
    size_t place = 0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        for (size_t j = 0; j < e->count; ++j, ++place)
            if ((traits_of(e, j) & HCI_PARAMETER_LAG) && !(e->term[j].value > 0.0)) return place;
    }
    return place;
}

/* A lag of no duration answers with −dT/dt to a longer one. */
static void lag_derivative(const double *torque, const double *time_s, size_t n, double *column,
                           size_t stride)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t a = k > 0 ? k - 1 : k, b = k + 1 < n ? k + 1 : k;
        const double step_s = time_s[b] - time_s[a];
        column[k * stride] = step_s > 0.0 ? -(torque[b] - torque[a]) / step_s : 0.0;
    }
}

bool hci_predicted_reading_is_dynamic(const hci_regression *e, const hci_segment *s)
{
    return s->timed && (s->smooth || has_dynamics(e->declared)) &&
           e->runs[s->run].torque_source == HCI_TORQUE_MEASURED;
}

/* Whether the torque is a slope of the speed. */
static bool is_slope(const hci_regression *e, const hci_segment *s)
{
    return s->timed && e->runs[s->run].torque_source == HCI_TORQUE_INERTIA;
}

/* How often a segment is run through for its slopes. */
static size_t turns_through(const hci_regression *e, const hci_segment *s)
{
    return s->turns > 0 && is_slope(e, s) ? HCI_SETTLING_TURNS : 1;
}

/* The most room that a segment takes. */
static size_t longest_run_through(const hci_regression *e, bool dynamic)
{
    size_t most = 1;
    for (size_t k = 0; k < e->samples->segment_count; ++k) {
        const hci_segment *s = &e->samples->segment[k];
        const size_t before = s->turns > 0 ? HCI_SETTLING_TURNS : 2;
        const size_t n = s->count * (dynamic ? before : turns_through(e, s));
        most = n > most ? n : most;
    }
    return most;
}

/* Lags and resonances that there are. */
static size_t stages_in(const hci_effects *effects)
{
    size_t stages = 0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        stages += e->type->lag && hci_effect_value(e, e->type->lag[0]) > 0.0;
        stages += e->type->resonance && hci_effect_value(e, e->type->resonance[0]) > 0.0;
    }
    return stages;
}

double hci_settling_s(const hci_effects *effects)
{
    double sum_s = 0.0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        const double tau_s = e->type->lag ? hci_effect_value(e, e->type->lag[0]) : 0.0;
        const double omega =
            e->type->resonance ? 2.0 * HCI_PI * hci_effect_value(e, e->type->resonance[0]) : 0.0;
        const double damping = e->type->resonance ? hci_effect_value(e, e->type->resonance[1]) : 0.0;
        const double slow = damping > 1.0 ? damping - sqrt(damping * damping - 1.0) : damping;
        sum_s += HCI_SETTLED * tau_s;
        if (omega > 0.0) sum_s += slow > 0.0 ? HCI_SETTLED / (slow * omega) : (double)INFINITY;
    }
    return sum_s;
}

size_t hci_settling_samples(const hci_binned_sample *sample, const hci_segment *s, double settling_s)
{
    const size_t most = (HCI_SETTLING_TURNS - 1) * s->count;
    const double turns = s->period_s > 0.0 ? settling_s / s->period_s : 0.0;
    if (!(turns < HCI_SETTLING_TURNS - 1)) return most;
    const double last_s = sample[0].time_s + s->period_s - (settling_s - floor(turns) * s->period_s);
    size_t of_turn = s->count;
    while (of_turn > 0 && sample[of_turn - 1].time_s >= last_s)
        --of_turn;
    const size_t lead = (size_t)turns * s->count + (s->count - of_turn) + LEAST_LEAD;
    return lead < most ? lead : most;
}

bool hci_run_reads_current(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_HOLDING || run->hardly_accelerates;
}

/* Declared over modelled torque per ampere; 1 where no run reads currents. */
static double holding_scale(const hci_regression *e, const hci_effects *effects)
{
    bool holds = false;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        holds = holds || (e->use[r] && hci_run_reads_current(&e->runs[r]));
    if (!holds) return 1.0;
    const double declared = fabs(e->declared_constant);
    const double modelled = fabs(hci_torque_constant(e->machine, effects));
    if (!(declared > 0.0) || fabs(modelled - declared) < SAME_SCALE * declared) return 1.0;
    return modelled * LARGEST_SCALE > declared ? declared / modelled : LARGEST_SCALE;
}

static bool any_hardly_accelerates(const hci_regression *e)
{
    bool any = false;
    for (size_t r = 0; r < e->samples->run_count; ++r)
        any = any || (e->use[r] && e->runs[r].hardly_accelerates);
    return any;
}

static bool present_make(const hci_effects *effects, hci_predicted_reading *o)
{
    bool *left = hci_memory_new(o->terms + 1, sizeof *left);
    o->present_effect = hci_memory_new(effects->count + 1, sizeof *o->present_effect);
    o->present_term = hci_memory_new(o->terms + 1, sizeof *o->present_term);
    const bool made = left && o->present_effect && o->present_term;
    if (made) o->present = hci_effects_present(effects, o->present_effect, o->present_term, left);
    hci_memory_free(left);
    return made;
}

bool hci_predicted_reading_make(const hci_regression *e, const hci_effects *effects, bool derivatives,
                                hci_predicted_reading *o)
{
    const size_t most = longest_run_through(e, has_dynamics(effects));
    memset(o, 0, sizeof *o);
    o->terms = hci_effects_terms(effects);
    o->torque_Nm = hci_memory_new(5 * most + 5 * o->terms + 2, sizeof *o->torque_Nm);
    if (derivatives) o->by_value = hci_memory_new(most * (o->terms + 1), sizeof *o->by_value);
    if (!o->torque_Nm || (derivatives && !o->by_value) || !present_make(effects, o)) {
        hci_predicted_reading_release(o);
        return false;
    }
    o->holding_scale = holding_scale(e, &o->present);
    o->time_s = o->torque_Nm + most;
    o->work = o->time_s + most;
    o->sum = o->work + 2 * most;
    o->row = o->sum + 2 * o->terms;
    o->constant_by_value = o->row + 2 * (o->terms + 1);
    if (!derivatives || !any_hardly_accelerates(e)) return true;
    o->current_Nm = o->constant_by_value + o->terms;
    o->constant_Nm_per_A = hci_torque_constant_by_value(e->machine, effects, o->constant_by_value, o->sum);
    return true;
}

void hci_predicted_reading_release(hci_predicted_reading *o)
{
    hci_memory_free(o->torque_Nm);
    hci_memory_free(o->by_value);
    hci_memory_free(o->present_effect);
    hci_memory_free(o->present_term);
    memset(o, 0, sizeof *o);
}

/* The mean over a turn at constant currents in the rotor frame, of a run that tells means only. The reading
 * is that at angle 0. What is nothing but the rounding of such a mean is 0. */
static double mean_over_turn(const hci_regression *e, const hci_effects *effects, const hci_sample *reading,
                             hci_predicted_reading *o, double *by_value)
{
    const hci_dq i = hci_sample_dq(reading, e->machine->pole_pairs);
    double mean_Nm = 0.0;
    memset(o->sum, 0, 2 * o->terms * sizeof *o->sum);
    for (int k = 0; k < ANGLES_OF_MEAN; ++k) {
        hci_sample x = *reading;
        x.theta_m_rad = 2.0 * HCI_PI * k / ANGLES_OF_MEAN;
        hci_phases_of_dq(i, e->machine->pole_pairs * x.theta_m_rad, x.i_abc);
        mean_Nm += hci_effects_predict(e->machine, effects, &x, by_value) / ANGLES_OF_MEAN;
        for (size_t c = 0; by_value && c < o->terms; ++c) {
            o->sum[c] += by_value[c] / ANGLES_OF_MEAN;
            o->sum[o->terms + c] += fabs(by_value[c]) / ANGLES_OF_MEAN;
        }
    }
    for (size_t c = 0; by_value && c < o->terms; ++c)
        by_value[c] = fabs(o->sum[c]) > ROUNDING_OF_MEAN * o->sum[o->terms + c] ? o->sum[c] : 0.0;
    return mean_Nm;
}

/* What of a torque a current makes. */
static double of_current(const hci_regression *e, const hci_effects *effects, const hci_sample *reading,
                         double torque_Nm)
{
    hci_sample without = *reading;
    without.i_abc[0] = without.i_abc[1] = without.i_abc[2] = 0.0;
    return torque_Nm - hci_effects_predict(e->machine, effects, &without, NULL);
}

/* Where a torque is asked for. parts: what is known of it; NULL: nothing. */
typedef struct {
    const hci_run *run;
    const hci_sample *reading;
    hci_torque_parts *parts;
} place;

static double at_once(const hci_regression *e, const hci_effects *effects, const place *at, double *by_value)
{
    if (!at->parts) return hci_effects_predict(e->machine, effects, at->reading, by_value);
    return hci_effects_predict_again(e->machine, effects, at->reading, at->parts, by_value);
}

/* The torque that is read at one sample, without the dynamics of the sensor. current_Nm: out, what of that a
 * current makes, if it is wanted. */
static double torque_at(const hci_regression *e, const hci_effects *effects, const place *at,
                        hci_predicted_reading *o, double *by_value, double *current_Nm)
{
    const double torque_Nm = at->run->only_mean ? mean_over_turn(e, effects, at->reading, o, by_value)
                                                : at_once(e, effects, at, by_value);
    const double scale = hci_run_reads_current(at->run) ? o->holding_scale : 1.0;
    *current_Nm = at->run->hardly_accelerates && by_value
                      ? scale * of_current(e, &o->present, at->reading, torque_Nm)
                      : 0.0;
    for (size_t c = 0; scale != 1.0 && by_value && c < o->terms; ++c)
        by_value[c] *= scale;
    return scale * torque_Nm;
}

/* Without the dynamics of the sensor. */
static void fill_static(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                        hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    for (size_t k = 0; k < s->count; ++k) {
        double *by_value = o->by_value ? o->by_value + k * o->terms : NULL;
        const place at = {&e->runs[s->run], e->raw ? &sample[k].raw : &sample[k].reading,
                          e->parts ? &e->parts[s->first + k] : NULL};
        double current_Nm;
        o->torque_Nm[k] = torque_at(e, effects, &at, o, by_value, &current_Nm);
        if (o->current_Nm) o->current_Nm[k] = current_Nm;
        o->time_s[k] = sample[k].time_s;
    }
}

/* ---- means over bins ---- */

/* The step of angle from sample k to the next one, around the turn; 0 where there is none. */
static double step_at(const hci_binned_sample *sample, size_t n, double turn_rad, size_t k)
{
    const size_t next = k + 1 < n ? k + 1 : 0;
    const double step = fabs(sample[next].reading.theta_m_rad - sample[k].reading.theta_m_rad);
    return k + 1 < n ? step : turn_rad > step ? turn_rad - step : 0.0;
}

/* What the curvatures by the angle are multiplied with, and the steps behind and ahead. */
typedef struct {
    double half_spread, behind, ahead;
} bend;

/* Adds to a row half the variance of the angles times the curvature of a parabola through its neighbours.
 * before: in and out, the row before as it was. */
static void row_bend(const bend *x, double *row, const double *after, double *before, size_t columns)
{
    const double scale = 2.0 * x->half_spread / (x->behind + x->ahead);
    for (size_t c = 0; c < columns; ++c) {
        const double here = row[c];
        row[c] += scale * ((after[c] - here) / x->ahead - (here - before[c]) / x->behind);
        before[c] = here;
    }
}

/* A sample that is the mean over a wide bin shows the mean of the torque over it, not the torque at its mean
 * angle. turn_rad: 0 where the last sample is not followed by the first. row: [2 columns]. */
static void bins_widen(const hci_binned_sample *sample, size_t n, double turn_rad, double *x, size_t columns,
                       double *row)
{
    const double least =
        CLOSE * fabs(sample[n - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad) / (double)n;
    double *first = row + columns, last_step = step_at(sample, n, turn_rad, n - 1);
    memcpy(row, x + (n - 1) * columns, columns * sizeof *row);
    memcpy(first, x, columns * sizeof *first);
    for (size_t k = 0; k < n; ++k) {
        const bend b = {0.5 * sample[k].spread_rad2, last_step, step_at(sample, n, turn_rad, k)};
        last_step = b.ahead;
        if (b.half_spread > 0.0 && b.behind > least && b.ahead > least)
            row_bend(&b, x + k * columns, k + 1 < n ? x + (k + 1) * columns : first, row, columns);
        else
            memcpy(row, x + k * columns, columns * sizeof *row);
    }
}

static void means_widen(const hci_regression *e, const hci_segment *s, hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const double turn_rad = s->turns > 0 ? hci_turn_rad(&e->runs[s->run], e->machine->pole_pairs) : 0.0;
    bool spread = false;
    for (size_t k = 0; k < s->count && !spread; ++k)
        spread = sample[k].spread_rad2 > 0.0;
    if (!spread || s->count < 3) return;
    bins_widen(sample, s->count, turn_rad, o->torque_Nm, 1, o->row);
    if (o->current_Nm) bins_widen(sample, s->count, turn_rad, o->current_Nm, 1, o->row);
    if (o->by_value && o->terms > 0) bins_widen(sample, s->count, turn_rad, o->by_value, o->terms, o->row);
}

/* ---- along time ---- */

/* Writes the first turn n samples long again behind it. */
static void turn_repeat(hci_predicted_reading *o, size_t n, size_t turn, double period_s)
{
    memcpy(o->torque_Nm + turn * n, o->torque_Nm, n * sizeof *o->torque_Nm);
    if (o->current_Nm) memcpy(o->current_Nm + turn * n, o->current_Nm, n * sizeof *o->current_Nm);
    if (o->by_value)
        memcpy(o->by_value + turn * n * o->terms, o->by_value, n * o->terms * sizeof *o->by_value);
    for (size_t k = 0; k < n; ++k)
        o->time_s[turn * n + k] = o->time_s[k] + (double)turn * period_s;
}

/* Keeps n samples from one on: of the last turn, in which a sensor has settled, or of one between others. */
static void turn_keep(hci_predicted_reading *o, size_t n, size_t first)
{
    memmove(o->torque_Nm, o->torque_Nm + first, n * sizeof *o->torque_Nm);
    if (o->current_Nm) memmove(o->current_Nm, o->current_Nm + first, n * sizeof *o->current_Nm);
    if (o->by_value) memmove(o->by_value, o->by_value + first * o->terms, n * o->terms * sizeof *o->by_value);
}

/* Puts as many samples before a steady turn of n as those of the turns before it. */
static void turns_before(hci_predicted_reading *o, size_t n, size_t lead, double period_s)
{
    memmove(o->torque_Nm + lead, o->torque_Nm, n * sizeof *o->torque_Nm);
    memmove(o->time_s + lead, o->time_s, n * sizeof *o->time_s);
    if (o->by_value) memmove(o->by_value + lead * o->terms, o->by_value, n * o->terms * sizeof *o->by_value);
    for (size_t k = lead; k-- > 0;) {
        o->torque_Nm[k] = o->torque_Nm[k + n];
        o->time_s[k] = o->time_s[k + n] - period_s;
        if (o->by_value)
            memcpy(o->by_value + k * o->terms, o->by_value + (k + n) * o->terms,
                   o->terms * sizeof *o->by_value);
    }
}

/* Samples of the first period of a segment; 0 where it is shorter than that. */
static size_t first_period(const hci_binned_sample *sample, size_t count, double period_rad)
{
    for (size_t k = 1; k < count; ++k)
        if (fabs(sample[k].reading.theta_m_rad - sample[0].reading.theta_m_rad) >= period_rad) return k;
    return 0;
}

/* A sensor that swings has been swinging before a steady recording began: its first turn, or where it has
 * none its first electrical period, is run through before. Returns of how many samples that is. */
static size_t lead_in(const hci_regression *e, const hci_segment *s, hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const int p = e->machine->pole_pairs;
    double period_rad = hci_turn_rad(&e->runs[s->run], p);
    size_t lead = first_period(sample, s->count, period_rad);
    if (lead == 0) lead = first_period(sample, s->count, period_rad = 2.0 * HCI_PI / p);
    if (lead == 0) return 0;
    const double beyond = fabs(sample[lead].reading.theta_m_rad - sample[0].reading.theta_m_rad) - period_rad;
    const double step = fabs(sample[lead].reading.theta_m_rad - sample[lead - 1].reading.theta_m_rad);
    const double period_s =
        o->time_s[lead] - beyond / step * (o->time_s[lead] - o->time_s[lead - 1]) - o->time_s[0];
    turn_repeat(o, s->count, 1, 0.0);
    memmove(o->torque_Nm + lead, o->torque_Nm + s->count, s->count * sizeof *o->torque_Nm);
    memmove(o->time_s + lead, o->time_s + s->count, s->count * sizeof *o->time_s);
    if (o->by_value)
        memmove(o->by_value + lead * o->terms, o->by_value + s->count * o->terms,
                s->count * o->terms * sizeof *o->by_value);
    for (size_t k = 0; k < lead; ++k)
        o->time_s[k] -= period_s;
    return lead;
}

/* Samples of a segment that a window of so many of its run spans. */
static size_t window_in(const hci_run *run, const hci_segment *s, size_t window)
{
    if (s->turns == 0 || window == 0 || !(s->period_s > 0.0)) return window;
    const double step_s = (run->time_s[run->count - 1] - run->time_s[0]) / (double)(run->count - 1);
    return (size_t)((double)(window - 1) * step_s * (double)s->count / s->period_s + 0.5) + 1;
}

/* ---- of a slope ---- */

/* Whether samples lie too far apart for their torques to tell what is between them. */
static bool is_coarse_slope(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                            const hci_predicted_reading *o)
{
    return is_slope(e, s) && !o->instant && s->turns == 0 && s->count > 2 &&
           e->runs[s->run].torque_window > 2 &&
           hci_is_coarse(e->samples->sample + s->first, s->count, hci_finest_order(e->machine, effects));
}

/* The mean of the torque along step k of a run. */
static void step_fill(const hci_regression *e, const hci_effects *effects, const hci_run *run,
                      const hci_between *between, size_t k, hci_predicted_reading *o)
{
    const double count = (double)between->count;
    double *mean = o->by_value ? o->by_value + k * o->terms : NULL, *row = mean ? o->row : NULL;
    o->torque_Nm[k] = 0.0;
    if (o->current_Nm) o->current_Nm[k] = 0.0;
    if (mean) memset(mean, 0, o->terms * sizeof *mean);
    for (size_t j = 0; j < between->count; ++j) {
        const hci_sample x = hci_between_at(between, j);
        const place there = {run, &x, NULL};
        double current_Nm;
        o->torque_Nm[k] += torque_at(e, effects, &there, o, row, &current_Nm) / count;
        if (o->current_Nm) o->current_Nm[k] += current_Nm / count;
        for (size_t c = 0; row && c < o->terms; ++c)
            mean[c] += row[c] / count;
    }
}

/* Puts the means of the steps from sample to sample in place of the torques at them. */
static void steps_fill(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                       hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const double finest_order = hci_finest_order(e->machine, effects);
    for (size_t k = 0; k < s->count; ++k)
        o->time_s[k] = sample[k].time_s;
    for (size_t k = 0; k + 1 < s->count; ++k) {
        const hci_sample *from = e->raw ? &sample[k].raw : &sample[k].reading;
        const hci_sample *to = e->raw ? &sample[k + 1].raw : &sample[k + 1].reading;
        const hci_between between = hci_between_of(from, to, e->machine->pole_pairs, finest_order);
        o->asked += between.count;
        step_fill(e, effects, &e->runs[s->run], &between, k, o);
    }
}

/* The slopes over a window of the torque and of its derivatives. */
static void windows_take(size_t count, size_t window, bool of_steps, hci_predicted_reading *o)
{
    void (*take)(const double *, size_t, size_t, double *, size_t, double *) =
        of_steps ? hci_slope_average_of_steps : hci_slope_average;
    take(o->time_s, count, window, o->torque_Nm, 1, o->work);
    if (o->current_Nm) take(o->time_s, count, window, o->current_Nm, 1, o->work);
    for (size_t c = 0; o->by_value && c < o->terms; ++c)
        take(o->time_s, count, window, o->by_value + c, o->terms, o->work);
}

/* The mean over the windows of the slopes that make an acceleration. of_steps: of what steps_fill left. */
static void average(const hci_regression *e, const hci_segment *s, size_t count, bool of_steps,
                    hci_predicted_reading *o)
{
    const hci_run *run = &e->runs[s->run];
    windows_take(count, window_in(run, s, run->torque_window), of_steps, o);
    windows_take(count, window_in(run, s, run->speed_window), false, o);
}

/* The scale of what the current makes is no value of these rows: friction and cogging torque are found times
 * it. */
static void scale_hold(const hci_predicted_reading *o, size_t count)
{
    const double share = o->constant_Nm_per_A != 0.0 ? 1.0 / o->constant_Nm_per_A : 0.0;
    for (size_t k = 0; k < count; ++k)
        for (size_t c = 0; c < o->terms; ++c)
            o->by_value[k * o->terms + c] -= o->current_Nm[k] * share * o->constant_by_value[c];
}

void hci_predicted_reading_fill(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                                hci_predicted_reading *o)
{
    const bool sensor = hci_predicted_reading_is_dynamic(e, s), dynamic = sensor && has_dynamics(effects);
    const size_t turns = turns_through(e, s), lag = dormant_lag(effects);
    size_t lead = 0;
    const bool of_steps = is_coarse_slope(e, effects, s, o);
    o->asked = of_steps ? 0 : s->count;
    if (of_steps)
        steps_fill(e, effects, s, o);
    else {
        fill_static(e, effects, s, o);
        means_widen(e, s, o);
    }
    if (o->by_value && sensor && lag < o->terms)
        lag_derivative(o->torque_Nm, o->time_s, s->count, o->by_value + lag, o->terms);
    for (size_t turn = 1; turn < turns; ++turn)
        turn_repeat(o, s->count, turn, s->period_s);
    if (dynamic && s->turns > 0) {
        lead = hci_settling_samples(e->samples->sample + s->first, s, hci_settling_s(effects));
        turns_before(o, s->count, lead, s->period_s);
    } else if (dynamic)
        lead = lead_in(e, s, o);
    o->filtered = dynamic ? stages_in(effects) * (lead + s->count) : 0;
    if (dynamic) hci_effects_filter(effects, o->time_s, lead + s->count, o->torque_Nm, o->by_value);
    if (is_slope(e, s) && !o->instant) average(e, s, turns * s->count, of_steps, o);
    if (lead > 0) turn_keep(o, s->count, lead);
    if (turns > 1) turn_keep(o, s->count, turns / 2 * s->count);
    if (o->current_Nm && !o->apart) scale_hold(o, s->count);
}

/* Of a load that is not known only what varies is left. */
static void take_mean_out(const hci_binned_sample *sample, double *residual_Nm, size_t count)
{
    double telling = 0.0;
    for (size_t j = 0; j < count; ++j)
        telling += sample[j].count > 0.0;
    const double mean_Nm = telling > 0.0 ? hci_mean(residual_Nm, count) * (double)count / telling : 0.0;
    for (size_t j = 0; j < count; ++j)
        if (sample[j].count > 0.0) residual_Nm[j] -= mean_Nm;
}

/* 0 where a sample tells no torque. */
static void residual_fill(const hci_binned_sample *sample, size_t count,
                          const hci_predicted_reading *predicted, double *residual_Nm)
{
    for (size_t j = 0; j < count; ++j)
        residual_Nm[j] = sample[j].count > 0.0 ? sample[j].torque_Nm - predicted->torque_Nm[j] : 0.0;
}

hci_status hci_regression_residual(const hci_regression *e, const hci_effects *effects, double *residual_Nm,
                                   hci_note *note)
{
    hci_predicted_reading predicted;
    if (!hci_predicted_reading_make(e, effects, false, &predicted))
        return hci_note_memory(note, NULL, "comparing model and recordings");
    memset(residual_Nm, 0, e->samples->count * sizeof *residual_Nm);
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL;) {
        hci_predicted_reading_fill(e, effects, s, &predicted);
        hci_regression_count(e, predicted.asked, predicted.terms);
        hci_regression_count_filtered(e, predicted.filtered, 0);
        const hci_binned_sample *sample = e->samples->sample + s->first;
        residual_fill(sample, s->count, &predicted, residual_Nm + s->first);
        if (hci_regression_mean_is_free(e, s)) take_mean_out(sample, residual_Nm + s->first, s->count);
    }
    hci_predicted_reading_release(&predicted);
    return HCI_OK;
}
