#include "cli/tune/words/tune_found_zero.h"

#include <math.h>
#include <string.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_known.h"
#include "cli/tune/tune_line.h"
#include "cli/tune/words/tune_effects.h"

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
    const hci_effect *e = cli_tune_effect_of(t, f);
    const int sine = e ? cli_tune_place_of(e, "sine", 1.0) : -1,
              cosine = e ? cli_tune_place_of(e, "cosine", 1.0) : -1;
    double s, c;
    if (f->verdict == HCI_FINDING_REJECTED || cosine < 0 || !cli_tune_is_of_emf(e)) return;
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
    for (size_t k = 0; e && !cli_tune_is_of_emf(e) && k < e->count; ++k) {
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
        const hci_effect *e = cli_tune_effect_of(t, &t->diagnosis.finding[k]);
        const hci_effect_term *x = mean_by_current(e);
        if (t->diagnosis.finding[k].verdict != HCI_FINDING_ADDED || !x) continue;
        say_two_readings(t, e, x, angle_deg);
        return;
    }
}

void cli_tune_say_found_zero(cli_tuning *t)
{
    forget_turn(t);
    say_zero_or_saliency(t);
    for (size_t k = 0; k < t->diagnosis.findings; ++k)
        say_turned(t, &t->diagnosis.finding[k]);
    say_saliency(t);
}
