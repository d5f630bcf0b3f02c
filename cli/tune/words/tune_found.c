#include "cli/tune/words/tune_found.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_folded.h"
#include "cli/tune/tune_known.h"
#include "cli/tune/tune_line.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/words/tune_advice.h"
#include "hci/host/waveform/turning_load.h"

/* ---- effects ---- */

/* The place of "sine" or "cosine" among the values of an effect, of an order; -1: none. */
static int place_of(const hci_effect *e, const char *name, double order)
{
    for (size_t k = 0; k < e->count; ++k)
        if (strcmp(e->type->parameter[e->term[k].parameter].name, name) == 0 &&
            fabs(e->term[k].order - order) < HCI_ORDER_TOLERANCE)
            return (int)k;
    return -1;
}

/* The amplitude of the order of a value, at its sine, or at a cosine that has none beside it; else 0. */
static double amplitude_of(const hci_effect *e, size_t k, double *std_error)
{
    const int place[] = {place_of(e, "sine", e->term[k].order), place_of(e, "cosine", e->term[k].order)};
    double amplitude = 0.0;
    if ((place[0] >= 0 ? place[0] : place[1]) != (int)k) return 0.0;
    *std_error = 0.0;
    for (int j = 0; j < 2; ++j) {
        if (place[j] < 0) continue;
        amplitude = hypot(amplitude, e->term[place[j]].value);
        *std_error = fmax(*std_error, e->term[place[j]].std_error);
    }
    return amplitude;
}

/* Whether an effect is a sum of sines with cosines. */
static bool has_orders(const hci_effect *e)
{
    double std_error;
    for (size_t k = 0; k < e->count; ++k)
        if (amplitude_of(e, k, &std_error) > 0.0) return true;
    return false;
}

/* The order of the balanced back-EMF that makes the same order of torque, beside i_q: 7 of 5; 0: none. */
static double other_order(double order)
{
    const double six = 6.0 * round(order / 6.0);
    if (fabs(fabs(order - six) - 1.0) > HCI_ORDER_TOLERANCE || six < 6.0) return 0.0;
    return 2.0 * six - order;
}

/* "5", or "5 or 7" where the currents do not tell these apart. */
static void name_order(const cli_tuning *t, double order, bool in_pairs, char name[2 * CLI_TUNE_ORDER])
{
    char one[CLI_TUNE_ORDER], other[CLI_TUNE_ORDER];
    const double partner = in_pairs ? other_order(order) : 0.0;
    cli_tune_order_words(t, fmin(order, partner > 0.0 ? partner : order), one);
    snprintf(name, 2 * CLI_TUNE_ORDER, "%s", one);
    if (partner > 0.0)
        snprintf(name, 2 * CLI_TUNE_ORDER, "%s or %s", one,
                 cli_tune_order_words(t, fmax(order, partner), other));
}

static const char *unit_for_people(const char *unit)
{
    return strcmp(unit, "Nm") == 0 ? "N·m" : strcmp(unit, "Nm_per_A") == 0 ? "N·m/A" : unit;
}

static void say_orders(cli_tuning *t, hci_tuning_part part, const hci_effect *e, bool in_pairs)
{
    double above = HUGE_VAL;
    for (size_t shown = 0; shown < CLI_TUNE_ORDERS_SAID; ++shown) {
        double most = 0.0, error = 0.0, order = 0.0;
        char name[2 * CLI_TUNE_ORDER];
        for (size_t k = 0; k < e->count; ++k) {
            double std_error = 0.0;
            const double amplitude = amplitude_of(e, k, &std_error);
            if (amplitude < above && amplitude > most)
                most = amplitude, error = std_error, order = e->term[k].order;
        }
        if (!(most > 0.0) || (shown > 0 && most <= error))
            return; /* an order within its error is none to say */
        name_order(t, order, in_pairs, name);
        hci_tuning_say(&t->tuning, part, "  order %s: %.4g ± %.1g %s", name, most, error,
                       unit_for_people(e->type->parameter[0].unit));
        above = most;
    }
}

/* The effect of a finding; NULL: not among those of the corrected machine. */
static const hci_effect *effect_of(const cli_tuning *t, const hci_finding *f)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    for (size_t k = 0; k < list->count; ++k)
        if (strcmp(list->effect[k].type->name, f->effect) == 0) return &list->effect[k];
    return NULL;
}

/* Whether an effect is a torque that follows the angle alone, as cogging torque is. */
static bool is_of_angle(const hci_effect *e)
{
    return e && has_orders(e) && strcmp(e->type->parameter[0].unit, "Nm") == 0;
}

static bool is_of_emf(const hci_effect *e)
{
    return strcmp(e->type->parameter[0].unit, "Nm_per_A") == 0;
}

static bool is_friction(const hci_effect *e)
{
    return e && e->type->coulomb_Nm;
}

/* An effect that the recordings show and that is of a kind, from number `from` of the findings on; NULL:
 * none. */
static const hci_effect *next_found(const cli_tuning *t, bool (*is_kind)(const hci_effect *), size_t *from)
{
    for (; *from < t->diagnosis.findings; ++*from) {
        const hci_finding *f = &t->diagnosis.finding[*from];
        const hci_effect *e = effect_of(t, f);
        if (f->verdict == HCI_FINDING_ADDED && is_kind(e)) return ++*from, e;
    }
    return NULL;
}

/* 1, -1: the one way in which all shafts with a torque sensor turned; 0: both, or none. */
static int one_way(const cli_tuning *t)
{
    size_t forward = 0, backward = 0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED || !r->speed_rad_per_s) continue;
        for (size_t n = 0; n < r->count; ++n)
            ++*(r->speed_rad_per_s[n] < 0.0 ? &backward : &forward);
    }
    return forward > 0 && backward == 0 ? 1 : backward > 0 && forward == 0 ? -1 : 0;
}

/* The zero of a torque sensor is a friction as long as the shaft turns one way. */
static const char *less_sensor_zero(const cli_tuning *t, const hci_effect *e)
{
    return e && is_friction(e) && one_way(t) != 0 ? "; less the zero of the torque sensor, which one "
                                                    "direction does not tell from it: ± has none of "
                                                    "that"
                                                  : "";
}

/* Which of them it is matters off the line of the recorded currents only. */
static void say_pairs(cli_tuning *t)
{
    double angle_deg;
    const bool is_kept = cli_tune_line_is_kept(t, &angle_deg);
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Which of two orders of the back-EMF makes a ripple, 5 or 7, 11 or 13: all currents have one "
        "direction in the rotor frame, as with i_d at 0, and the torque shows the sum of the two alone. %s",
        is_kept ? "The currents of the table have that direction too, along which the sum is all that counts."
                : "So much of the ripple as the table answers by another i_d may be answered wrongly.");
    if (!is_kept)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_NEXT,
            "The same load once more with an i_d beside i_q, or voltages of the open machine, driven by "
            "another: either tells orders 5 and 7 of the back-EMF apart.");
}

#define TERMS_SAID 4

/* "co-energy with i_d^1 i_q^2, of cos nθ, order 6" */
static void say_term(const hci_effect *e, const hci_effect_term *x, const cli_tuning *t, char *text,
                     size_t size)
{
    const hci_effect_parameter *p = &e->type->parameter[x->parameter];
    char order[CLI_TUNE_ORDER];
    if (!p->ordered)
        snprintf(text, size, "%s", p->meaning);
    else if (x->order > 0.0)
        snprintf(text, size, "%s, order %s", p->meaning, cli_tune_order_words(t, x->order, order));
    else
        snprintf(text, size, "%.*s, the same at every angle", (int)strcspn(p->meaning, ","), p->meaning);
}

/* The value of an effect that is the largest below `above`; NULL: there is none. */
static const hci_effect_term *largest_term(const hci_effect *e, double above)
{
    const hci_effect_term *most = NULL;
    for (size_t k = 0; k < e->count; ++k)
        if (fabs(e->term[k].value) < above && (!most || fabs(e->term[k].value) > fabs(most->value)))
            most = &e->term[k];
    return most;
}

/* The values of an effect in words, the largest ones of many. */
static void say_terms(cli_tuning *t, hci_tuning_part part, const hci_effect *e)
{
    double above = HUGE_VAL;
    for (size_t shown = 0; shown < TERMS_SAID; ++shown) {
        const hci_effect_term *x = largest_term(e, above);
        char words[160], error[40] = "";
        if (!x) return;
        say_term(e, x, t, words, sizeof words);
        if (isfinite(x->std_error)) snprintf(error, sizeof error, " ± %.1g", x->std_error);
        hci_tuning_say(&t->tuning, part, "  %.4g%s %s %s", x->value, error,
                       unit_for_people(e->type->parameter[x->parameter].unit), words);
        above = fabs(x->value);
    }
    if (e->count > TERMS_SAID)
        hci_tuning_say(&t->tuning, part, "  and %zu smaller ones, in diagnose/machine/effects.csv",
                       e->count - TERMS_SAID);
}

/* What several effects explain equally well is not found. */
static void say_finding(cli_tuning *t, const hci_finding *f)
{
    const hci_effect *effect = effect_of(t, f);
    const bool is_known = f->verdict == HCI_FINDING_ADDED && strcmp(f->effect, "unknown") != 0;
    const hci_tuning_part part = is_known ? HCI_TUNING_FOUND : HCI_TUNING_UNKNOWN;
    char words[HCI_DETAIL_SIZE];
    if (is_known && t->cogging.kept > 0 && is_of_angle(effect)) return; /* with what the holding test shows */
    if (effect && has_orders(effect)) {
        hci_tuning_say(&t->tuning, part, "%s (%s), the largest orders:", hci_finding_title(f->effect),
                       hci_finding_verdict_name(f->verdict));
        const bool in_pairs = is_of_emf(effect) && !t->has_emf && cli_tune_currents_are_in_line(t);
        say_orders(t, part, effect, in_pairs);
        if (in_pairs) say_pairs(t);
        return;
    }
    if (effect && effect->count > TERMS_SAID) {
        hci_tuning_say(&t->tuning, part, "%s (%s), the largest of %zu terms:", hci_finding_title(f->effect),
                       hci_finding_verdict_name(f->verdict), effect->count);
        say_terms(t, part, effect);
        return;
    }
    hci_finding_words(&t->diagnosis, f, words, sizeof words);
    hci_tuning_say(&t->tuning, part, "%s (%s): %s%s", hci_finding_title(f->effect),
                   is_known || strcmp(f->effect, "unknown") != 0 ? hci_finding_verdict_name(f->verdict)
                                                                 : "left",
                   words, less_sensor_zero(t, effect));
}

/* ---- the electrical zero, by the back-EMF that was found ---- */

/* Of the back-EMF, that is turned by no more: nothing to speak of. */
#define LEAST_TURN_DEG 2.0

/* S sin θ + C cos θ of the declared fundamental. */
static void fundamental_of(const hci_machine *m, double *sine, double *cosine)
{
    *sine = *cosine = 0.0;
    for (size_t k = 0; k < m->back_emf_count; ++k)
        if (m->back_emf[k].sequence == 1 && fabs(m->back_emf[k].order - 1.0) < HCI_ORDER_TOLERANCE)
            *sine += m->back_emf[k].sine, *cosine += m->back_emf[k].cosine;
}

/* Whether phase currents were recorded, which a zero of the angle turns; i_d and i_q it does not. */
static bool has_phases(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_Nm && (t->runs.run[k].has_sum || t->runs.run[k].computed_phase > 0))
            return true;
    return false;
}

/* Of check's zero, that is the same. */
#define SAME_DEG 5.0

/* Whether check finds the same zero, and no saliency in its place. */
static bool is_told(const cli_tuning *t, double turn_deg, double error_deg)
{
    const double apart_deg = fabs(remainder(turn_deg - t->zero_deg, 360.0));
    return has_phases(t) && t->zero_is_told &&
           apart_deg < fmax(SAME_DEG, 3.0 * hypot(error_deg, t->zero_error_deg));
}

#define LEAST_ERROR_DEG 0.1

/* A saliency that the model lacks turns the back-EMF as well. */
static void say_open_turn(cli_tuning *t, double turn_deg, double error_deg)
{
    t->open_turn_deg = turn_deg;
    t->open_turn_error_deg = fmax(LEAST_ERROR_DEG, error_deg);
    t->turn_is_of_dq = !has_phases(t);
    if (cli_tune_has_zero_of_voltages(t)) {
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "How large the saliency is: under load the whole back-EMF, order 1 with it, is found "
                       "turned by %.1f ± %.1f degrees (of the noise alone) against its voltages, which have "
                       "the zero. A saliency, or one that saturates, makes nearly the same torques of "
                       "currents near one direction: %s.",
                       turn_deg, t->open_turn_error_deg, cli_tune_turn_told_by(t));
        return;
    }
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Where the electrical zero is: the whole back-EMF, order 1 with it, is found turned by "
        "%.1f ± %.1f degrees (of the noise alone) against %s. A saliency, or one that saturates, "
        "makes of the same currents nearly the same torques as another zero does%s: %s.",
        turn_deg, t->open_turn_error_deg, t->turn_is_of_dq ? "i_d and i_q" : "the angle of the logs",
        t->turn_is_of_dq ? ", and --angle-offset turns the angle of the logs and not their i_d and "
                           "i_q: if a zero is off, it is that of the drive"
                         : "",
        cli_tune_turn_told_by(t));
}

/* A fundamental that is turned is no other back-EMF: the angle has another zero, if no saliency does as well.
 */
static void say_turned(cli_tuning *t, const hci_finding *f)
{
    const hci_effect *e = effect_of(t, f);
    const int sine = e ? place_of(e, "sine", 1.0) : -1, cosine = e ? place_of(e, "cosine", 1.0) : -1;
    double s, c;
    if (f->verdict == HCI_FINDING_REJECTED || cosine < 0 || !is_of_emf(e)) return;
    fundamental_of(&t->declared.model, &s, &c);
    const double declared_rad = atan2(c, s);
    s += sine < 0 ? 0.0 : e->term[sine].value;
    c += e->term[cosine].value;
    const double turn_deg = remainder(atan2(c, s) - declared_rad, 2.0 * HCI_PI) * 180.0 / HCI_PI;
    const double error_deg = e->term[cosine].std_error / hypot(s, c) * 180.0 / HCI_PI;
    if (!(fabs(turn_deg) > LEAST_TURN_DEG && fabs(turn_deg) > 3.0 * error_deg)) return;
    t->turned_deg = 0.0;
    if (!is_told(t, turn_deg, error_deg)) {
        say_open_turn(t, turn_deg, error_deg);
        return;
    }
    t->turned_deg = turn_deg;
    t->turned_error_deg = fmax(error_deg, fabs(remainder(turn_deg - t->zero_deg, 360.0)));
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Where the electrical zero is: the whole back-EMF, order 1 with it, is found turned by %.1f ± "
        "%.1f degrees against the angle of the logs. That is a zero of the angle that is off, and no "
        "other machine: --angle-offset %.1f takes it out (docs/tutorials/zero.md). What else is found "
        "under load may stand for it.",
        turn_deg, t->turned_error_deg, cli_tune_offset_to_give(t, t->turned_deg));
}

/* A model that explains the recordings at the angle as it is leaves no other zero to be asked for. */
static void forget_turn(cli_tuning *t)
{
    for (size_t k = 0; k < t->diagnosis.effects.list.count; ++k)
        if (t->diagnosis.effects.list.effect[k].type->is_angle_zero) return;
    if (t->diagnosis.runs > 0 && t->diagnosis.verdict <= HCI_DIAGNOSIS_EXPLAINED) t->turned_deg = 0.0;
}

/* A mean torque that grows otherwise than with i_q: of a saliency or of saturation. */
static const hci_effect_term *mean_by_current(const hci_effect *e)
{
    for (size_t k = 0; e && !is_of_emf(e) && k < e->count; ++k) {
        const hci_effect_parameter *p = &e->type->parameter[e->term[k].parameter];
        if (e->type->in_machine && p->ordered && (p->traits & HCI_PARAMETER_WITH_CURRENT) &&
            e->term[k].order == 0.0)
            return &e->term[k];
    }
    return NULL;
}

/* A reluctance torque that nobody declared is no certainty as long as a scale does as well; where the
 * machine has it by now and explains the recordings, nothing is left of that. */
static void say_saliency(cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    bool is_found = false;
    for (size_t k = 0; k < list->count; ++k)
        is_found = is_found || mean_by_current(&list->effect[k]) != NULL;
    if (!*t->saliency || (is_found && t->diagnosis.verdict <= HCI_DIAGNOSIS_EXPLAINED)) return;
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN, "%s; %s declare it", t->saliency,
                   t->is_own ? "--inductance-d and --inductance-q"
                             : "inductance_d and inductance_q of machine.csv");
}

/* Currents on one line that is not that of i_q: a drive that keeps its i_d at 0 beside a zero that is off, or
 * an i_d in a motor that answers it. */
static void say_two_readings(cli_tuning *t, const hci_effect *e, const hci_effect_term *x, double angle_deg)
{
    const hci_effect_parameter *p = &e->type->parameter[x->parameter];
    hci_tuning_say(
        &t->tuning, HCI_TUNING_UNKNOWN,
        "Whether it is %s, as found (%.4g %s %.*s, the same at every angle), or a zero of the angle that is "
        "%.3g degrees (electrical) off, from a drive that keeps its i_d at 0: all loaded recordings have "
        "their current in one direction, %.3g degrees from i_q of this angle, and do not tell the two apart, "
        "nor what part is of each. Along that direction the torque is as measured. Voltages of the open "
        "machine, or loads with another i_d, would tell (docs/tutorials/zero.md).",
        e->type->title, x->value, p->unit, (int)strcspn(p->meaning, ","), p->meaning, fabs(angle_deg),
        fabs(angle_deg));
}

static void say_zero_or_saliency(cli_tuning *t)
{
    double angle_deg;
    if (!cli_tune_currents_are_in_line(t)) return;
    if (!cli_tune_line_is_kept(t, &angle_deg))
        hci_tuning_say(
            &t->tuning, HCI_TUNING_UNKNOWN,
            "What i_q makes: all loaded recordings have their current %.3g degrees from it, and what "
            "another direction does was not measured. The mean torque of the table is that of the "
            "model alone.",
            fabs(angle_deg));
    if (cli_tune_has_zero_of_voltages(t)) return; /* the angle of the currents is what it is */
    for (size_t k = 0; k < t->diagnosis.findings && angle_deg != 0.0; ++k) {
        const hci_effect *e = effect_of(t, &t->diagnosis.finding[k]);
        const hci_effect_term *x = mean_by_current(e);
        if (t->diagnosis.finding[k].verdict != HCI_FINDING_ADDED || !x) continue;
        say_two_readings(t, e, x, angle_deg);
        return;
    }
}

/* ---- cogging torque of a holding test, with what diagnose has added to it ---- */

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
    for (const hci_effect *e; (e = next_found(t, is_of_angle, &from)) != NULL;)
        for (size_t k = 0; k < e->count; ++k) {
            const int sine = place_of(e, "sine", e->term[k].order),
                      cosine = place_of(e, "cosine", e->term[k].order);
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

static void say_cogging(cli_tuning *t)
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
    for (size_t shown = 0; shown < CLI_TUNE_ORDERS_SAID && shown < count; ++shown) {
        order_sum *most = &sum[shown];
        for (size_t k = shown; k < count; ++k)
            if (hypot(sum[k].sine_Nm, sum[k].cosine_Nm) > hypot(most->sine_Nm, most->cosine_Nm))
                most = &sum[k];
        const order_sum o = *most;
        *most = sum[shown];
        sum[shown] = o;
        char words[CLI_TUNE_ORDER];
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "  order %s: %.4g ± %.1g N·m",
                       cli_tune_order_words(t, o.order, words), hypot(o.sine_Nm, o.cosine_Nm),
                       o.std_error_Nm);
    }
    size_t from = 0;
    if (isfinite(t->cogging.friction_Nm) && !next_found(t, is_friction, &from))
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND,
                       "friction: %.4g ± %.1g N·m, half the difference of the directions",
                       t->cogging.friction_Nm, t->cogging.friction_error_Nm);
}

/* ---- the sentences of diagnose, each where it belongs ---- */

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

static void say_sentence(cli_tuning *t, const char *text)
{
    static const char *const FOUND[] = {"The model lacked ", "On the runs that were ", "No run was held out",
                                        "The torque of ",    "Nothing is missing",     "Decisive by "};
    static const char PARTLY[] = "Partly explained: t", ELSE[] = "; what else it lacks";
    bool found = !t->diagnosed && !begins(text, "Whether ");
    for (size_t k = 0; k < sizeof FOUND / sizeof *FOUND; ++k)
        found = found || begins(text, FOUND[k]);
    if (t->has_emf && begins(text, "No run tells the torque per ampere")) {
        hci_tuning_say(
            &t->tuning, HCI_TUNING_FOUND,
            "Torques are currents times %.4g N·m/A, 3/2 of the back-EMF that was measured; ± leaves "
            "the error of that out.",
            t->reading.run.torque_constant_Nm_per_A);
        return;
    }
    const char *rest = begins(text, PARTLY) ? strstr(text, ELSE) : NULL;
    if (!rest) {
        hci_tuning_say(&t->tuning, found ? HCI_TUNING_FOUND : HCI_TUNING_UNKNOWN, "%s", text);
        return;
    }
    hci_tuning_say(&t->tuning, HCI_TUNING_FOUND, "T%.*s.", (int)(rest - text - (long)sizeof PARTLY + 1),
                   text + sizeof PARTLY - 1);
    hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN, "What else the model lacks%s", rest + sizeof ELSE - 1);
}

static void say_words(cli_tuning *t)
{
    char words[2048];
    hci_diagnosis_words(&t->diagnosis, words, sizeof words);
    for (char *text = words, *end; *text; text = end) {
        end = strstr(text, ". ");
        if (end)
            end[1] = '\0', end += 2;
        else
            end = text + strlen(text);
        say_sentence(t, text);
    }
}

void cli_tune_say_diagnosis(cli_tuning *t)
{
    const hci_diagnosis *d = &t->diagnosis;
    say_cogging(t);
    say_words(t);
    for (size_t k = 0; k < d->findings; ++k)
        if (d->finding[k].verdict != HCI_FINDING_REJECTED) say_finding(t, &d->finding[k]);
    forget_turn(t);
    say_zero_or_saliency(t);
    for (size_t k = 0; k < d->findings; ++k)
        say_turned(t, &d->finding[k]);
    say_saliency(t);
    cli_tune_say_advice(t);
}
