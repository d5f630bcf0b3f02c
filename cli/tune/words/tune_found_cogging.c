#include "cli/tune/words/tune_found_cogging.h"

#include <math.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_folded.h"
#include "cli/tune/words/tune_effects.h"
#include "hci/host/waveform/turning_load.h"

enum { MOST_ORDERS = 512 };

typedef struct {
    double order, sine_Nm, cosine_Nm, std_error_Nm;
} order_sum;

static size_t add_order(order_sum sum[MOST_ORDERS], size_t count, order_sum next)
{
    for (size_t k = 0; k < count; ++k)
        if (fabs(sum[k].order - next.order) < HCI_ORDER_TOLERANCE) {
            sum[k].sine_Nm += next.sine_Nm;
            sum[k].cosine_Nm += next.cosine_Nm;
            sum[k].std_error_Nm = hypot(sum[k].std_error_Nm, next.std_error_Nm);
            return count;
        }
    if (count < MOST_ORDERS) sum[count++] = next;
    return count;
}

static size_t sum_cogging(const cli_tuning *t, order_sum sum[MOST_ORDERS])
{
    size_t count = 0;
    for (size_t k = 0; k < t->cogging.count; ++k) {
        const hci_waveform_order *o = &t->cogging.order[k];
        const order_sum next = {o->order, o->amplitude * cos(o->phase_rad), o->amplitude * sin(o->phase_rad),
                                o->std_error};
        if (o->kept) count = add_order(sum, count, next);
    }
    size_t from = 0;
    for (const hci_effect *e; (e = cli_tune_next_found(t, cli_tune_is_of_angle, &from)) != NULL;)
        for (size_t k = 0; k < e->count; ++k) {
            const int sine = cli_tune_place_of(e, "sine", e->term[k].order),
                      cosine = cli_tune_place_of(e, "cosine", e->term[k].order);
            if (sine != (int)k || cosine < 0) continue;
            const order_sum next = {e->term[k].order, e->term[sine].value, e->term[cosine].value,
                                    fmax(e->term[sine].std_error, e->term[cosine].std_error)};
            count = add_order(sum, count, next);
        }
    return count;
}

/* Times its standard error, beyond which an order is more than chance. */
#define SURE 3.0

/* Order 1 of a current that balances the cogging torque may be the zero of its sensors. */
static void say_offset(cli_tuning *t, const order_sum *sum, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        const double amplitude_Nm = hypot(sum[k].sine_Nm, sum[k].cosine_Nm);
        if (fabs(sum[k].order - 1.0) > HCI_ORDER_TOLERANCE || amplitude_Nm < SURE * sum[k].std_error_Nm)
            continue;
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "Whether order 1 is of the machine: an offset of the current sensors, %.2g A of i_q, makes order "
            "1 whatever the load, and magnets or teeth that are not alike make it too; these logs do not "
            "tell "
            "which. The table takes it away as it is, with these sensors. Where they are nulled, or in "
            "another drive, it would add %.2g N·m that were the offset's: null them first and record again.",
            amplitude_Nm / t->reading.run.torque_constant_Nm_per_A, amplitude_Nm);
    }
}

/* Of the largest order, below which an order is no matter for the first line. */
#define MUCH 0.1

/* Whether a sensor of the torque tells what is of the motor and what hangs on its shaft. */
static bool has_sensor(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source == HCI_TORQUE_MEASURED) return true;
    return false;
}

/* Whether what is known of the torque is the current that balanced it. */
static bool is_of_current(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source == HCI_TORQUE_HOLDING) return !has_sensor(t);
    return false;
}

/* Once a mechanical turn: gravity on what is not balanced, as on an arm, is that, and a crank twice. No slots
 * and poles are. */
static void say_once_a_turn(cli_tuning *t, const order_sum *sum, size_t count)
{
    const int pole_pairs = t->declared.model.pole_pairs;
    t->once_a_turn_Nm = t->diagnosis.uncertainty.origin.turning_load_Nm;
    if (has_sensor(t)) return;
    for (size_t k = 0; k < count; ++k) {
        const double amplitude_Nm = hypot(sum[k].sine_Nm, sum[k].cosine_Nm);
        char words[CLI_TUNE_ORDER];
        if (!hci_is_turning_load_order(sum[k].order, pole_pairs) || amplitude_Nm < SURE * sum[k].std_error_Nm)
            continue;
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "Whether the %.3g N·m of order %s, %.3g times a mechanical turn, are of the motor: a "
            "weight on an arm, a crank, or what is out of balance on a shaft that does not stand "
            "upright, makes them as well. The table takes them away as they are; without that load "
            "it would add them. Record again with nothing on the shaft, or with the shaft upright.",
            amplitude_Nm, cli_tune_order_words(t, sum[k].order, words), sum[k].order * pole_pairs);
    }
}

static bool is_multiple(double order, double of)
{
    return order > 0.5 * of && fabs(remainder(order, of)) < HCI_ORDER_TOLERANCE;
}

/* Slots that are not those of the motor: no order that they make is among the larger ones, but such as the
 * largest order makes by itself, as those of other slots do. Teeth that are not alike make the slots of a
 * turn. */
static void judge_slots(cli_tuning *t, const order_sum *sum, size_t count)
{
    const double slots = cli_tune_order_of_slots(t),
                 a_turn = t->declared.slots / t->declared.model.pole_pairs;
    double most_Nm = 0.0, order = 0.0;
    if (!(slots > 0.0) || cli_tune_has_high_slots(t)) return;
    for (size_t k = 0; k < count; ++k)
        if (hypot(sum[k].sine_Nm, sum[k].cosine_Nm) > most_Nm)
            most_Nm = hypot(sum[k].sine_Nm, sum[k].cosine_Nm), order = sum[k].order;
    if (!(order > 2.0) || is_multiple(order, slots) || is_multiple(order, a_turn)) return;
    for (size_t k = 0; k < count; ++k)
        if (hypot(sum[k].sine_Nm, sum[k].cosine_Nm) > MUCH * most_Nm && is_multiple(sum[k].order, slots) &&
            !is_multiple(sum[k].order, order))
            return;
    t->stranger_order = order;
}

/* ---- what one speed does not tell from a ripple of the angle ---- */

#define SLOW_Hz       30.0 /* torque sensors and their filters follow what is slower */
#define ONE_SPEED     1.2  /* of two, that tell nothing that one does not */
#define LEAST_TOLD_Hz 0.2  /* a shorter log does not tell a frequency from that of the mains */
#define MAINS         1e-3 /* of their frequency, so much they are off, */

/* Turns a second on the way that a recording goes; 0: it has no time. cycle: out, half of one over its
 * length, that a frequency is uncertain by. */
static double turns_per_s(const hci_run *r, double *cycle_Hz)
{
    double path = 0.0;
    if (!r->time_s || !r->theta_m_rad || r->count < 2) return 0.0;
    const double time_s = r->time_s[r->count - 1] - r->time_s[0];
    for (size_t k = 1; k < r->count; ++k)
        path += fabs(r->theta_m_rad[k] - r->theta_m_rad[k - 1]) / (2.0 * HCI_PI);
    *cycle_Hz = time_s > 0.0 ? 0.5 / time_s : 0.0;
    return time_s > 0.0 ? path / time_s : 0.0;
}

/* A multiple of 50 or 60 Hz that a frequency is; 0: none. */
static double mains_of(double f_Hz, double cycle_Hz)
{
    static const double BASE_Hz[] = {50.0, 60.0};
    enum { MOST = 3 };
    if (cycle_Hz > LEAST_TOLD_Hz) return 0.0;
    for (size_t k = 0; k < 2; ++k)
        for (int m = 1; m <= MOST; ++m)
            if (fabs(f_Hz - m * BASE_Hz[k]) < m * BASE_Hz[k] * MAINS + cycle_Hz) return m * BASE_Hz[k];
    return 0.0;
}

/* The turns a second of all recordings with a torque sensor; 0: they have several speeds, or no time. */
static double one_speed(const cli_tuning *t, double *cycle_Hz)
{
    double least = HUGE_VAL, most = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (t->runs.run[k].torque_source != HCI_TORQUE_MEASURED) continue;
        const double turns = turns_per_s(&t->runs.run[k], cycle_Hz);
        least = fmin(least, turns);
        most = fmax(most, turns);
    }
    return least > 0.0 && most < ONE_SPEED * least ? most : 0.0;
}

static void judge_one_speed(cli_tuning *t, const order_sum *sum, size_t count)
{
    const double slots = cli_tune_order_of_slots(t), p = t->declared.model.pole_pairs;
    double cycle_Hz = 0.0, most_Nm = 0.0;
    const double turns = one_speed(t, &cycle_Hz);
    for (size_t k = 0; k < count; ++k)
        most_Nm = fmax(most_Nm, hypot(sum[k].sine_Nm, sum[k].cosine_Nm));
    for (size_t k = 0; k < count && turns > 0.0; ++k) {
        const double f_Hz = sum[k].order * p * turns, mains_Hz = mains_of(f_Hz, cycle_Hz);
        const bool is_of_slots = slots > 0.0 && fabs(remainder(sum[k].order, slots)) < HCI_ORDER_TOLERANCE;
        if (hypot(sum[k].sine_Nm, sum[k].cosine_Nm) < MUCH * most_Nm) continue;
        if (mains_Hz > 0.0 && !is_of_slots) t->mains_order = sum[k].order, t->mains_Hz = mains_Hz;
        if (f_Hz > fmax(SLOW_Hz, t->fast_Hz)) t->fast_Hz = f_Hz;
    }
}

/* Peak to peak of two standard errors of each order, which add up by chance. */
static double known_to_Nm(const order_sum *sum, size_t count)
{
    double square = 0.0;
    for (size_t k = 0; k < count; ++k)
        square += sum[k].std_error_Nm * sum[k].std_error_Nm;
    return isfinite(square) ? 2.0 * 2.0 * sqrt(square) : 0.0;
}

/* The largest order that the samples show alike with a higher one, which slots and poles make. */
static void judge_folded(cli_tuning *t, const order_sum *sum, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        const double size_Nm = hypot(sum[k].sine_Nm, sum[k].cosine_Nm);
        const double from = size_Nm > t->folded_Nm ? cli_tune_folded_from(t, sum[k].order) : 0.0;
        if (from > 0.0) t->folded_order = sum[k].order, t->folded_from = from, t->folded_Nm = size_Nm;
    }
}

/* Brings the largest orders to the front. */
static void say_largest(cli_tuning *t, order_sum *sum, size_t count)
{
    for (size_t shown = 0; shown < CLI_TUNE_ORDERS_SAID && shown < count; ++shown) {
        order_sum *most = &sum[shown];
        char words[CLI_TUNE_ORDER];
        for (size_t k = shown; k < count; ++k)
            if (hypot(sum[k].sine_Nm, sum[k].cosine_Nm) > hypot(most->sine_Nm, most->cosine_Nm))
                most = &sum[k];
        const order_sum o = *most;
        *most = sum[shown];
        sum[shown] = o;
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "  order %s: %.4g ± %.1g N·m",
                       cli_tune_order_words(t, o.order, words), hypot(o.sine_Nm, o.cosine_Nm),
                       o.std_error_Nm);
    }
}

void cli_tune_say_found_cogging(cli_tuning *t)
{
    static order_sum sum[MOST_ORDERS];
    const size_t count = sum_cogging(t, sum);
    t->cogging_known_Nm = known_to_Nm(sum, count);
    say_once_a_turn(t, sum, count);
    judge_slots(t, sum, count);
    judge_one_speed(t, sum, count);
    judge_folded(t, sum, count);
    if (is_of_current(t)) say_offset(t, sum, count);
    if (t->cogging.kept == 0) return;
    hci_tuning_say(&t->tuning, HCI_TUNING_FOUND,
                   "cogging torque and what else follows the angle alone, %zu order%s, the largest:", count,
                   count == 1 ? "" : "s");
    say_largest(t, sum, count);
    size_t from = 0;
    if (isfinite(t->cogging.friction_Nm) && !cli_tune_next_found(t, cli_tune_is_friction, &from))
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND,
                       "friction: %.4g ± %.1g N·m, half the difference of the directions",
                       t->cogging.friction_Nm, t->cogging.friction_error_Nm);
}
