#include "cli/tune/words/tune_found.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_line.h"
#include "cli/tune/words/tune_advice.h"
#include "cli/tune/words/tune_effects.h"
#include "cli/tune/words/tune_found_cogging.h"
#include "cli/tune/words/tune_found_zero.h"

/* ---- effects ---- */

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
        const char *meaning = "";
        char name[2 * CLI_TUNE_ORDER];
        for (size_t k = 0; k < e->count; ++k) {
            double std_error = 0.0;
            const double amplitude = cli_tune_amplitude_of(e, k, &std_error);
            if (amplitude < above && amplitude > most)
                most = amplitude, error = std_error, order = e->term[k].order,
                meaning = e->type->parameter[e->term[k].parameter].meaning;
        }
        if (!(most > 0.0) || (shown > 0 && most <= error))
            return; /* an order within its error is none to say */
        const bool is_of_sequence = strstr(meaning, " sequence") != NULL;
        name_order(t, order, in_pairs && !is_of_sequence, name);
        hci_tuning_say(&t->tuning, part, "  order %s%s%.*s: %.4g ± %.1g %s", name, is_of_sequence ? ", " : "",
                       is_of_sequence ? (int)strcspn(meaning, ",") : 0, meaning, most, error,
                       unit_for_people(e->type->parameter[0].unit));
        above = most;
    }
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
    return e && cli_tune_is_friction(e) && one_way(t) != 0
               ? "; less the zero of the torque sensor, which one "
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
    const hci_effect *effect = cli_tune_effect_of(t, f);
    const bool is_known = f->verdict == HCI_FINDING_ADDED && strcmp(f->effect, "unknown") != 0;
    const hci_tuning_part part = is_known ? HCI_TUNING_FOUND : HCI_TUNING_UNKNOWN;
    char words[HCI_DETAIL_SIZE];
    if (is_known && t->cogging.kept > 0 && cli_tune_is_of_angle(effect))
        return; /* with what the holding test shows */
    if (effect && cli_tune_has_orders(effect)) {
        hci_tuning_say(&t->tuning, part, "%s (%s), the largest orders:", hci_finding_title(f->effect),
                       hci_finding_verdict_name(f->verdict));
        const bool in_pairs = cli_tune_is_of_emf(effect) && !t->has_emf && cli_tune_currents_are_in_line(t);
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
    cli_tune_say_found_cogging(t);
    say_words(t);
    for (size_t k = 0; k < d->findings; ++k)
        if (d->finding[k].verdict != HCI_FINDING_REJECTED) say_finding(t, &d->finding[k]);
    cli_tune_say_found_zero(t);
    cli_tune_say_advice(t);
}
