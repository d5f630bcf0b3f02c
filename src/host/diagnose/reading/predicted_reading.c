#include "host/diagnose/reading/predicted_reading.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/prepare/turns.h"
#include "host/diagnose/reading/between_samples.h"
#include "host/diagnose/reading/shorter_list.h"
#include "host/diagnose/reading/wide_bins.h"
#include "host/machine/torque_constant.h"
#include "host/numeric/slope_average.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define ROUNDING_OF_MEAN 1e-9 /* of the mean size of a derivative, that a mean of 0 has */
#define SAME_SCALE       1e-6 /* departure of a torque per ampere that is rounding */
#define LARGEST_SCALE    1e3  /* of a torque per ampere that has vanished */

/* Of what a sample counts, a place between samples counts one in so many. It takes as long: but lists with few
 * samples in a period of the slots are to be looked at as far as others. */
enum { LESS_BETWEEN = 3 };

enum { ANGLES_OF_MEAN = 97 /* a prime: evenly spread over the electrical and the mechanical turn */ };

/* Place of a time constant of 0 among all terms, or their number. */
static size_t dormant_lag(const hci_effects *effects)
{
    size_t place = 0;
    for (size_t k = 0; k < effects->count; ++k) {
        const hci_effect *e = &effects->effect[k];
        for (size_t j = 0; j < e->count; ++j, ++place)
            if ((hci_effect_traits(e, j) & HCI_PARAMETER_LAG) && !(e->term[j].value > 0.0)) return place;
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
    return s->timed && (s->smooth || hci_has_dynamics(e->declared)) &&
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

/* The step of the angle from sample to sample in which a place of a segment lies on the average, of a mean
 * turn around it: where samples stand close together in some places, that is the step from one such place to
 * the next.
 */
static double usual_step_rad(const hci_regression *e, const hci_segment *s)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const double turn_rad = s->turns > 0 ? hci_turn_rad(&e->runs[s->run], e->machine->pole_pairs) : 0.0;
    const double span_rad = fabs(sample[s->count - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad);
    const double last_rad = fmax(turn_rad - span_rad, 0.0);
    double square = last_rad * last_rad, sum = last_rad;
    for (size_t k = 1; k < s->count; ++k) {
        const double step_rad = sample[k].reading.theta_m_rad - sample[k - 1].reading.theta_m_rad;
        square += step_rad * step_rad;
        sum += fabs(step_rad);
    }
    return sum > 0.0 ? square / sum : 0.0;
}

/* Whether the samples of a segment are means over bins. */
static bool is_spread(const hci_regression *e, const hci_segment *s)
{
    for (size_t k = 0; k < s->count; ++k)
        if (e->samples->sample[s->first + k].spread_rad2 > 0.0) return true;
    return false;
}

/* In how many parts the steps of a segment are taken, at which the torque is asked: 1 where its samples lie
 * close enough to tell what is between them, or nothing asks for that. */
static size_t parts_of_step(const hci_regression *e, const hci_segment *s, bool dynamic, double finest_order)
{
    const bool asked =
        (dynamic && hci_predicted_reading_is_dynamic(e, s)) || (s->turns > 0 && is_spread(e, s));
    if (!asked || is_slope(e, s) || s->count < 3) return 1;
    return hci_parts_of_step(usual_step_rad(e, s), finest_order, s->turns == 0);
}

/* The most room that a segment takes. */
static size_t longest_run_through(const hci_regression *e, bool dynamic, double finest_order)
{
    size_t most = 1;
    for (size_t k = 0; k < e->samples->segment_count; ++k) {
        const hci_segment *s = &e->samples->segment[k];
        const size_t before = s->turns > 0 ? HCI_SETTLING_TURNS : 2;
        const size_t parts = parts_of_step(e, s, dynamic, finest_order);
        const size_t n = s->count * parts * (dynamic ? before : turns_through(e, s));
        most = n > most ? n : most;
    }
    return most;
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
    const double finest_order =
        hci_has_dynamics(effects) ? hci_finest_order(e->machine, effects) : (double)NAN;
    const size_t most = longest_run_through(e, hci_has_dynamics(effects), finest_order);
    memset(o, 0, sizeof *o);
    o->finest_order = finest_order;
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

/* The reading of row k. */
static void row_fill(const hci_regression *e, const hci_effects *effects, const place *at, size_t k,
                     hci_predicted_reading *o)
{
    double *by_value = o->by_value ? o->by_value + k * o->terms : NULL, current_Nm;
    o->torque_Nm[k] = torque_at(e, effects, at, o, by_value, &current_Nm);
    if (o->current_Nm) o->current_Nm[k] = current_Nm;
}

/* Without the dynamics of the sensor: rows of the samples, `parts` apart. */
static void fill_static(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                        size_t parts, hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    for (size_t k = 0; k < s->count; ++k) {
        const place at = {&e->runs[s->run], e->raw ? &sample[k].raw : &sample[k].reading,
                          e->parts ? &e->parts[s->first + k] : NULL};
        row_fill(e, effects, &at, k * parts, o);
        o->time_s[k * parts] = sample[k].time_s;
    }
}

/* The sample that follows sample k of a segment, around a mean turn, and its time. */
static hci_sample next_of(const hci_regression *e, const hci_segment *s, size_t k, double *time_s)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const bool closes = k + 1 == s->count;
    const hci_binned_sample *next = &sample[closes ? 0 : k + 1];
    const double turn_rad = closes ? hci_turn_rad(&e->runs[s->run], e->machine->pole_pairs) : 0.0;
    hci_sample x = e->raw ? next->raw : next->reading;
    const double way = sample[s->count - 1].reading.theta_m_rad - sample[0].reading.theta_m_rad;
    x.theta_m_rad += copysign(turn_rad, way);
    *time_s = next->time_s + (closes ? s->period_s : 0.0);
    return x;
}

/* And of the places between them, where there are parts. */
static void fill_between(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                         size_t parts, hci_predicted_reading *o)
{
    const hci_binned_sample *sample = e->samples->sample + s->first;
    const size_t steps = s->turns > 0 ? s->count : s->count - 1;
    for (size_t k = 0; parts > 1 && k < steps; ++k) {
        double next_s;
        const hci_sample *from = e->raw ? &sample[k].raw : &sample[k].reading, to = next_of(e, s, k, &next_s);
        for (size_t j = 1; j < parts; ++j) {
            const double share = (double)j / (double)parts;
            const hci_sample x = hci_sample_between(from, &to, e->machine->pole_pairs, share);
            row_fill(e, effects, &(place){&e->runs[s->run], &x, NULL}, k * parts + j, o);
            o->time_s[k * parts + j] = sample[k].time_s + share * (next_s - sample[k].time_s);
        }
    }
}

/* ---- means over bins ---- */

static hci_wide_bins bins_of(const hci_regression *e, const hci_segment *s)
{
    const double turn_rad = s->turns > 0 ? hci_turn_rad(&e->runs[s->run], e->machine->pole_pairs) : 0.0;
    return (hci_wide_bins){e->samples->sample + s->first, s->count, turn_rad};
}

static void means_widen(const hci_regression *e, const hci_segment *s, hci_predicted_reading *o)
{
    const hci_wide_bins bins = bins_of(e, s);
    if (!is_spread(e, s) || s->count < 3) return;
    hci_bins_widen(&bins, o->torque_Nm, 1, o->row);
    if (o->current_Nm) hci_bins_widen(&bins, o->current_Nm, 1, o->row);
    if (o->by_value && o->terms > 0) hci_bins_widen(&bins, o->by_value, o->terms, o->row);
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

/* Of rows in parts, behind so many others, those of the samples. */
static void parts_close(const hci_regression *e, const hci_segment *s, size_t parts, size_t lead,
                        hci_predicted_reading *o)
{
    const hci_wide_bins bins = bins_of(e, s);
    if (parts > 1 && s->turns > 0) {
        hci_parts_widen(&bins, parts, lead, o->torque_Nm, 1);
        if (o->by_value) hci_parts_widen(&bins, parts, lead, o->by_value, o->terms);
    }
    if (lead > 0 || parts > 1) hci_samples_keep(o, s->count, lead, parts);
}

/* The torque at the samples of a segment, in parts of the steps where there are. */
static void fill(const hci_regression *e, const hci_effects *effects, const hci_segment *s, size_t parts,
                 hci_predicted_reading *o)
{
    o->asked = s->count + s->count * (parts - 1) / LESS_BETWEEN;
    fill_static(e, effects, s, parts, o);
    if (parts > 1)
        fill_between(e, effects, s, parts, o);
    else
        means_widen(e, s, o);
}

void hci_predicted_reading_fill(const hci_regression *e, const hci_effects *effects, const hci_segment *s,
                                hci_predicted_reading *o)
{
    const bool sensor = hci_predicted_reading_is_dynamic(e, s), dynamic = sensor && hci_has_dynamics(effects);
    const size_t turns = turns_through(e, s), lag = dormant_lag(effects);
    const size_t parts = parts_of_step(e, s, dynamic, o->finest_order);
    const bool of_steps = is_coarse_slope(e, effects, s, o);
    o->asked = o->filtered = 0;
    if (of_steps)
        steps_fill(e, effects, s, o);
    else
        fill(e, effects, s, parts, o);
    if (o->by_value && sensor && lag < o->terms)
        lag_derivative(o->torque_Nm, o->time_s, hci_rows_in(s, parts), o->by_value + lag, o->terms);
    for (size_t turn = 1; turn < turns; ++turn)
        hci_turn_repeat(o, s->count, turn, s->period_s);
    parts_close(e, s, parts, dynamic ? hci_reading_along_time(e, effects, s, parts, o) : 0, o);
    if (is_slope(e, s) && !o->instant) average(e, s, turns * s->count, of_steps, o);
    if (turns > 1) hci_turn_keep(o, s->count, turns / 2 * s->count);
    if (o->current_Nm && !o->apart) scale_hold(o, s->count);
}

#define WITHIN 2.0 /* standard deviations */

/* Of a load that is not known only what varies is left; of one that is known within so much, what is beyond.
 */
static void take_mean_out(const hci_binned_sample *sample, double *residual_Nm, size_t count,
                          double unknown_Nm)
{
    double telling = 0.0;
    for (size_t j = 0; j < count; ++j)
        telling += sample[j].count > 0.0;
    const double mean_Nm = telling > 0.0 ? hci_mean(residual_Nm, count) * (double)count / telling : 0.0,
                 out_Nm = fmax(-WITHIN * unknown_Nm, fmin(WITHIN * unknown_Nm, mean_Nm));
    for (size_t j = 0; j < count; ++j)
        if (sample[j].count > 0.0) residual_Nm[j] -= out_Nm;
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
        const double unknown_Nm = hci_regression_mean_unknown_Nm(e, s);
        if (unknown_Nm > 0.0) take_mean_out(sample, residual_Nm + s->first, s->count, unknown_Nm);
    }
    hci_predicted_reading_release(&predicted);
    return HCI_OK;
}
