/* From machine, drive and currents to what a controller holds in flash: which orders matter, their currents
 * and voltages at each level of torque, how many points a table over the angle needs, and where it ends. */
#include "host/drive/loop_set.h"
#include "host/numeric/divisor.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/drive/coarse_angle.h"
#include "host/drive/measured_loop.h"
#include "host/drive/turn_samples.h"
#include "host/drive/voltage_fade.h"

/* Orders are kept whose current is more than this share of the largest current, or whose voltage is more than
 * this share of the fundamental's. */
static const double LEAST_CURRENT = 1e-4, LEAST_VOLTAGE = 2e-4;

static const double ERROR_SHARE = 2e-4;

typedef struct {
    const hci_loop_task *task;
    hci_loop_set *set;
    hci_note *note;
    hci_machine_model machine, own; /* as the loop and its decoupling know it */
    hci_machine_model plant;        /* with its effects, as it is driven */
    hci_turn_samples level[HCI_LOOP_MOST_LEVELS];
    size_t order[HCI_LOOP_MOST_ORDERS], count; /* kept, in periods of all turns */
    double voltage_end;                        /* electrical */
} maker;

/* ---- levels ---- */

static hci_status check_levels(const maker *m)
{
    const hci_loop_task *t = m->task;
    const size_t n = t->level_count;
    const double first = t->levels[0].torque_Nm, last = t->levels[n - 1].torque_Nm;
    if (n > HCI_LOOP_MOST_LEVELS || (n > 2 && n % 2 == 0))
        return hci_note_set(m->note, HCI_ERROR_ARGUMENT,
                            "levels of torque: found %zu, expected 1, 2 or an odd number up to %d", n,
                            (int)HCI_LOOP_MOST_LEVELS);
    if (n > 1 && !(last > first))
        return hci_note_set(m->note, HCI_ERROR_ARGUMENT,
                            "levels of torque: found %g N·m after %g N·m, expected them to ascend", last,
                            first);
    for (size_t k = 0; k < n; ++k) {
        const double wanted = first + (last - first) * (double)k / fmax((double)n - 1.0, 1.0);
        if (fabs(t->levels[k].torque_Nm - wanted) > 1e-6 * (last - first) + 1e-12)
            return hci_note_set(
                m->note, HCI_ERROR_ARGUMENT,
                "levels of torque: found %g N·m, expected %g N·m: levels are equally far apart",
                t->levels[k].torque_Nm, wanted);
    }
    return HCI_OK;
}

static hci_status make_samples(maker *m)
{
    const hci_drive_data *d = m->task->drive;
    hci_status status = hci_machine_model_make(m->task->machine, &m->machine, m->note);
    if (!status)
        status = hci_machine_model_make_whole(m->task->machine, m->task->effects, &m->plant, m->note);
    if (!status && d->decoupling == HCI_DECOUPLING_CONSTANT)
        status = hci_machine_model_make_constant(m->task->machine, &m->own, m->note);
    const hci_machine_model *own = d->decoupling == HCI_DECOUPLING_NONE       ? NULL
                                   : d->decoupling == HCI_DECOUPLING_CONSTANT ? &m->own
                                                                              : &m->machine;
    for (size_t k = 0; k < m->task->level_count && !status; ++k)
        status = hci_turn_samples_make(&m->plant, own, &m->task->levels[k], &m->level[k], m->note);
    for (size_t k = 1; k < m->task->level_count && !status; ++k)
        if (m->level[k].turns != m->level[0].turns)
            status = hci_note_set(m->note, HCI_ERROR_ARGUMENT,
                                  "levels of torque: some have fractional orders and others not");
    return status;
}

/* ---- orders ---- */

static double size_of(const maker *m, int value, size_t k)
{
    double most = 0.0;
    for (size_t l = 0; l < m->task->level_count; ++l)
        for (int a = 0; a < 2; ++a) {
            const hci_harmonic h = m->level[l].order[value + a][k];
            most = fmax(most, hypot(h.sine, h.cosine));
        }
    return most;
}

static void find_peak(maker *m)
{
    for (size_t l = 0; l < m->task->level_count; ++l)
        for (size_t k = 0; k < m->level[l].samples; ++k)
            m->set->peak_A = fmax(m->set->peak_A, hypot(m->level[l].value[HCI_TURN_CURRENT][k],
                                                        m->level[l].value[HCI_TURN_CURRENT + 1][k]));
}

static hci_status choose_orders(maker *m)
{
    const double voltage = size_of(m, HCI_TURN_VOLTAGE, 0);
    double left_out = 0.0;
    find_peak(m);
    for (size_t k = 0; k < m->level[0].samples / 2; ++k) {
        const double current = size_of(m, HCI_TURN_CURRENT, k);
        if (k == 0 || current > LEAST_CURRENT * m->set->peak_A ||
            size_of(m, HCI_TURN_VOLTAGE, k) > LEAST_VOLTAGE * voltage) {
            if (m->count == HCI_LOOP_MOST_ORDERS)
                return hci_note_set(
                    m->note, HCI_ERROR_ARGUMENT,
                    "currents and back-EMF have more than %d orders that matter; leave small ones "
                    "out",
                    (int)HCI_LOOP_MOST_ORDERS);
            m->order[m->count++] = k;
        } else {
            left_out = fmax(left_out, current);
        }
    }
    m->set->share_left_out = left_out / fmax(m->set->peak_A, 1e-300);
    return HCI_OK;
}

static hci_loop_pair pair_of(const maker *m, size_t level, int value, size_t k)
{
    const hci_harmonic h = m->level[level].order[value][k];
    return (hci_loop_pair){(float)h.cosine, k == 0 ? 0.0f : (float)h.sine};
}

static void fill_wave(const maker *m, size_t level, size_t k, hci_loop_wave *wave)
{
    for (int a = 0; a < 2; ++a) {
        wave->current_A[a] = pair_of(m, level, HCI_TURN_CURRENT + a, k);
        wave->voltage_Vs[a] = pair_of(m, level, HCI_TURN_VOLTAGE + a, k);
        wave->own_Vs[a] = pair_of(m, level, HCI_TURN_OWN + a, k);
    }
}

static hci_status fill_waves(maker *m)
{
    hci_loop_set *set = m->set;
    hci_loop_f32 *loop = &set->loop;
    const size_t levels = m->task->level_count, turns = m->level[0].turns;
    size_t base = 0;
    set->waves = hci_memory_new(m->count * levels, sizeof *set->waves);
    set->orders = hci_memory_new(m->count, sizeof *set->orders);
    if (!set->waves || !set->orders) return hci_note_memory(m->note, NULL, "%zu orders", m->count);
    for (size_t k = 1; k < m->count; ++k)
        base = hci_common_divisor(m->order[k], base);
    base = base > 0 ? base : turns;
    for (size_t k = 0; k < m->count; ++k) {
        set->orders[k] = (uint16_t)(m->order[k] / base);
        for (size_t l = 0; l < levels; ++l)
            fill_wave(m, l, m->order[k], &set->waves[k * levels + l]);
    }
    loop->waves = set->waves;
    loop->orders = set->orders;
    loop->order_count = (uint32_t)m->count;
    loop->levels = (uint32_t)levels;
    loop->repeats = (uint32_t)base;
    loop->period_turns = (uint32_t)turns;
    loop->base_order = (float)base / (float)turns;
    loop->torque_low_Nm = (float)m->task->levels[0].torque_Nm;
    loop->torque_high_Nm = (float)m->task->levels[levels - 1].torque_Nm;
    return HCI_OK;
}

/* ---- the loop ---- */

#define LITTLE_RAD 0.5 /* lateness of i_q that is in proportion to the frequency, or nearly */

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median over the frequencies at which the current is a little late: the lowest one alone is as good as
 * the smallest angle that was measured. */
static hci_status measured_lead(const hci_drive_data *d, double *lead_s, hci_note *note)
{
    double *late_s = hci_memory_new(d->response_count, sizeof *late_s);
    size_t n = 0;
    if (!late_s) return hci_note_memory(note, NULL, "%zu frequencies", d->response_count);
    for (; n < d->response_count && (n == 0 || fabs(d->response[n].phase_rad[1]) < LITTLE_RAD); ++n)
        late_s[n] = -d->response[n].phase_rad[1] / (2.0 * HCI_PI * d->response[n].frequency_Hz);
    qsort(late_s, n, sizeof *late_s, compare);
    *lead_s = 0.5 * (late_s[(n - 1) / 2] + late_s[n / 2]);
    hci_memory_free(late_s);
    return HCI_OK;
}

/* How late the current is at low frequency: −arg G/ν. */
static hci_status lead_find(const maker *m, double *lead_s)
{
    const hci_drive_data *d = m->task->drive;
    if (d->response_count > 0) return measured_lead(d, lead_s, m->note);
    const hci_loop_model model = hci_drive_loop(d, &m->machine, 0.0);
    const double nu = 0.02 * HCI_PI / d->sample_s;
    *lead_s = -carg(hci_loop_answer_at(&model, nu).reference.m[1][1]) / nu;
    return HCI_OK;
}

static hci_status fill_responses(maker *m)
{
    hci_loop_set *set = m->set;
    size_t count;
    set->response_error[0] = set->response_error[1] = (double)NAN;
    if (m->task->drive->response_count == 0) return HCI_OK;
    const hci_status status = hci_measured_loop_make(m->task->drive, &m->machine, &set->responses, &count,
                                                     set->response_error, m->note);
    if (status) return status;
    set->loop.responses = set->responses;
    set->loop.response_count = (uint32_t)count;
    return HCI_OK;
}

static hci_status fill_loop(maker *m)
{
    double lead_s = 0.0;
    const hci_status status = lead_find(m, &lead_s);
    const hci_drive_data *d = m->task->drive;
    hci_loop_f32 *loop = &m->set->loop;
    loop->resistance_ohm = (float)m->machine.resistance_ohm;
    loop->inductance_H[0] = (float)m->machine.inductance_H[0];
    loop->inductance_H[1] = (float)m->machine.inductance_H[1];
    loop->proportional_ohm[0] = (float)d->kp_ohm;
    loop->proportional_ohm[1] = (float)d->kp_q_ohm;
    loop->integral_ohm_per_s[0] = (float)d->ki_ohm_per_s;
    loop->integral_ohm_per_s[1] = (float)d->ki_q_ohm_per_s;
    loop->filter = (float)hci_drive_filter_share(d);
    loop->sample_s = (float)d->sample_s;
    loop->delay_s = (float)(d->computing_delay_s + 0.5 * d->sample_s);
    loop->lead_s = (float)lead_s;
    return status;
}

/* ---- where it ends ---- */

/* Whether the levels are of negative torques alone, or more of them: those drive backward. */
static bool drives_backward(const hci_loop_task *t)
{
    return t->levels[0].torque_Nm + t->levels[t->level_count - 1].torque_Nm < 0.0;
}

/* The dc link that a level needs at a speed, turning as the torque drives. */
static double needed_V(const maker *m, size_t level, double speed_rad_per_s)
{
    return hci_turn_samples_dc_link_V(&m->level[level], m->machine.resistance_ohm, m->task->drive->modulation,
                                      drives_backward(m->task) ? -speed_rad_per_s : speed_rad_per_s);
}

/* Electrical speed up to which the voltage does for a level; `beyond` where it does for that, too. */
static double voltage_end(const maker *m, size_t level, double beyond)
{
    const hci_drive_data *d = m->task->drive;
    const double there_V = d->dc_link_voltage_V * (1.0 - 2.0 * hci_drive_dead_share(d));
    double low = 0.0, high = beyond;
    for (int k = 0; k < 32; ++k) {
        const double speed = 0.5 * (low + high);
        if (needed_V(m, level, speed) < there_V)
            low = speed;
        else
            high = speed;
    }
    return high < beyond ? low : beyond;
}

/* The level that the voltage does for up to the least speed, which is the end. */
static size_t find_voltage_end(maker *m)
{
    const double beyond = HCI_PI / m->task->drive->sample_s;
    size_t hardest = 0;
    m->voltage_end = HUGE_VAL;
    for (size_t l = 0; l < m->task->level_count; ++l) {
        const double end = voltage_end(m, l, beyond);
        if (!(end < beyond) || !(end < m->voltage_end)) continue;
        m->voltage_end = end;
        hardest = l;
    }
    return hardest;
}

/* The loop with one of its levels alone. waves: one for each order. */
static hci_loop_f32 level_of(const maker *m, size_t level, hci_loop_wave *waves)
{
    hci_loop_f32 loop = m->set->loop;
    for (size_t k = 0; k < m->count; ++k)
        waves[k] = m->set->waves[k * loop.levels + level];
    loop.waves = waves;
    loop.levels = 1;
    loop.torque_low_Nm = loop.torque_high_Nm = (float)m->task->levels[level].torque_Nm;
    return loop;
}

/* Times the end of the voltage, up to which is looked what orders are worth; and samples in an electrical
 * turn that a drive has at least. */
static const double LOOK = 4.0, LEAST_SAMPLES = 10.0;

static hci_status end_by_voltage(maker *m)
{
    const size_t level = find_voltage_end(m);
    const double sampled = 2.0 * HCI_PI / (LEAST_SAMPLES * m->task->drive->sample_s);
    hci_loop_wave *waves = hci_memory_new(m->count, sizeof *waves);
    float *memory = hci_memory_new(hci_loop_floats(&m->set->loop, HCI_LOOP_FEEDFORWARD), sizeof *memory);
    m->set->voltage_rad_per_s = m->voltage_end / m->machine.table.pole_pairs;
    if (waves && memory && isfinite(m->voltage_end)) {
        const hci_loop_f32 loop = level_of(m, level, waves);
        const hci_machine_model *known =
            m->task->drive->decoupling == HCI_DECOUPLING_CONSTANT ? &m->own : &m->machine;
        const hci_sampled_drive drive = {m->task->drive, &m->plant, known, &loop, memory};
        hci_voltage_fade(&drive, m->voltage_end, fmin(fmax(LOOK * m->voltage_end, LOOK), sampled),
                         drives_backward(m->task) ? -1 : 1, m->set->ranges);
    }
    const hci_status status = waves && memory ? HCI_OK : hci_note_memory(m->note, NULL, "the voltage");
    hci_memory_free(waves);
    hci_memory_free(memory);
    return status;
}

/* Electrical speed at which an order is the highest that the sampling does for. */
static double sampled_end(const maker *m, size_t k)
{
    const double order = (double)m->order[k] / (double)m->level[0].turns;
    return hci_drive_highest_rad_per_s(m->task->drive) / order;
}

/* Where half the sampling is near, or no more speed is asked for. */
static void limit_range(const maker *m, size_t k, hci_loop_range *range)
{
    const double p = m->machine.table.pole_pairs, end = sampled_end(m, k);
    const double whole =
        m->task->speed_rad_per_s > 0.0 ? fmin(0.9 * end, m->task->speed_rad_per_s * p) : 0.9 * end;
    *range = (hci_loop_range){(float)whole, (float)(whole / 0.9)};
}

/* Electrical speed at which the highest order is that of the last frequency that was measured. */
static double measured_end(const maker *m)
{
    const hci_drive_data *d = m->task->drive;
    if (d->response_count == 0 || m->count < 2) return HUGE_VAL;
    const double order = (double)m->order[m->count - 1] / (double)m->level[0].turns;
    return 2.0 * HCI_PI * d->response[d->response_count - 1].frequency_Hz / order;
}

/* What the sampling leaves. */
static hci_status fill_ranges(maker *m)
{
    const double p = m->machine.table.pole_pairs;
    hci_loop_set *set = m->set;
    set->ranges = hci_memory_new(m->count, sizeof *set->ranges);
    if (!set->ranges) return hci_note_memory(m->note, NULL, "%zu orders", m->count);
    set->ranges[0] = (hci_loop_range){FLT_MAX, FLT_MAX};
    for (size_t k = 1; k < m->count; ++k)
        limit_range(m, k, &set->ranges[k]);
    set->sampled_rad_per_s = m->count > 1 ? 0.9 * sampled_end(m, m->count - 1) / p : HUGE_VAL;
    set->measured_rad_per_s = measured_end(m) / p;
    set->loop.ranges = set->ranges;
    return HCI_OK;
}

static void find_whole(hci_loop_set *set)
{
    set->loop.whole_rad_per_s = FLT_MAX;
    for (uint32_t k = 0; k < set->loop.order_count; ++k)
        set->loop.whole_rad_per_s = fminf(set->loop.whole_rad_per_s, set->ranges[k].whole_rad_per_s);
}

/* ---- points ---- */

/* Largest error of the splines at the level's own torque, as the controller computes them. */
static double error_of(const maker *m, const hci_loop_tables *tables)
{
    double most = 0.0;
    for (size_t l = 0; l < m->task->level_count; ++l) {
        const hci_turn_samples *x = &m->level[l];
        for (size_t k = 0; k < x->samples; ++k) {
            const uint32_t angle = (uint32_t)(((uint64_t)k << 32) / x->samples);
            const hci_loop_reference r =
                hci_loop_at(tables, angle, (float)m->task->levels[l].torque_Nm, 0.0f);
            most = fmax(most, hypot((double)r.id_A - x->value[HCI_TURN_CURRENT][k],
                                    (double)r.iq_A - x->value[HCI_TURN_CURRENT + 1][k]));
        }
    }
    return most;
}

static double try_points(maker *m, size_t points, float *memory)
{
    hci_loop_tables tables;
    m->set->loop.points = (uint32_t)points;
    hci_loop_start(&tables, &m->set->loop, HCI_LOOP_TABLE, memory);
    hci_loop_make(&tables, 0.0f);
    return error_of(m, &tables);
}

/* Four points to the period of the highest order, and more until the error is small enough or does not fall.
 */
static hci_status choose_points(maker *m)
{
    hci_loop_f32 *loop = &m->set->loop;
    const double limit_A = m->task->max_error_A > 0.0 ? m->task->max_error_A : ERROR_SHARE * m->set->peak_A;
    const size_t top = loop->orders[loop->order_count - 1];
    float *memory;
    loop->points = HCI_LOOP_MOST_POINTS;
    memory = hci_memory_new(hci_loop_floats(loop, HCI_LOOP_TABLE), sizeof *memory);
    if (!memory) return hci_note_memory(m->note, NULL, "a table");
    for (size_t points = top > 1 ? 4 * top : 4;; points += points / 8 + 1) {
        const size_t now = points < HCI_LOOP_MOST_POINTS ? points : HCI_LOOP_MOST_POINTS;
        m->set->max_error_A = try_points(m, now, memory);
        if (m->set->max_error_A <= limit_A || now == HCI_LOOP_MOST_POINTS || now > 24 * top + 64) break;
    }
    hci_memory_free(memory);
    return HCI_OK;
}

/* ---- all of it ---- */

static hci_status make(maker *m)
{
    hci_status status = check_levels(m);
    if (!status) status = make_samples(m);
    if (!status) status = choose_orders(m);
    if (!status) status = fill_waves(m);
    if (!status) status = fill_responses(m);
    if (!status) status = fill_loop(m);
    if (!status) status = fill_ranges(m);
    if (!status) status = choose_points(m);
    if (!status) status = end_by_voltage(m);
    if (!status) find_whole(m->set);
    if (!status) m->set->loop.crc32 = hci_loop_crc32(&m->set->loop);
    return status;
}

hci_status hci_loop_set_make(const hci_loop_task *task, hci_loop_set *set, hci_note *note)
{
    maker *m = hci_memory_new(1, sizeof *m);
    memset(set, 0, sizeof *set);
    if (!m) return hci_note_memory(note, NULL, "the references");
    m->task = task;
    m->set = set;
    m->note = note;
    const hci_status status = make(m);
    for (size_t k = 0; k < HCI_LOOP_MOST_LEVELS; ++k)
        hci_turn_samples_release(&m->level[k]);
    hci_machine_model_release(&m->machine);
    hci_machine_model_release(&m->own);
    hci_machine_model_release(&m->plant);
    hci_memory_free(m);
    return status;
}

double hci_loop_set_highest_order(const hci_loop_set *set)
{
    return (double)set->loop.orders[set->loop.order_count - 1] * (double)set->loop.base_order;
}

double hci_loop_set_coarse_mean_Nm(const hci_loop_set *set, const hci_loop_task *task, double torque_Nm)
{
    const hci_machine *machine = &task->machine->model;
    const double counts = task->drive->encoder_counts;
    if (!hci_angle_is_coarse(counts, machine->pole_pairs, hci_loop_set_highest_order(set)))
        return (double)NAN;
    return hci_coarse_mean_Nm(&set->loop, machine, task->effects, counts, torque_Nm);
}

double hci_loop_set_response_error(const hci_loop_set *set)
{
    return fmax(set->response_error[0], set->response_error[1]);
}

double hci_loop_set_response_percent(const hci_loop_set *set, const hci_loop_task *task, size_t level,
                                     double speed_rad_per_s)
{
    const double torque_Nm = task->levels[level].torque_Nm;
    const hci_machine *machine = &task->machine->model;
    const double swing_Nm = hci_measured_loop_swing_Nm(
        &set->loop, machine, set->response_error, (uint32_t)level, speed_rad_per_s * machine->pole_pairs);
    return fabs(torque_Nm) > 0.0 ? 100.0 * swing_Nm / fabs(torque_Nm) : (double)NAN;
}

void hci_loop_set_release(hci_loop_set *set)
{
    hci_memory_free(set->waves);
    hci_memory_free(set->orders);
    hci_memory_free(set->ranges);
    hci_memory_free(set->responses);
    memset(set, 0, sizeof *set);
}
