#include "cli/tune/words/tune_advice.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_facts.h"

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

static bool is_of_name(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

/* The effect that is named here as in effects.csv; NULL: none. */
static const char *effect_at(const hci_diagnosis *d, const char *text)
{
    for (size_t k = 0; k < d->findings; ++k) {
        const size_t length = strlen(d->finding[k].effect);
        if (strncmp(text, d->finding[k].effect, length) == 0 && !is_of_name(text[length]))
            return d->finding[k].effect;
    }
    return NULL;
}

/* Bytes of the advice that people are told otherwise, and how: effects and orders by the names that they use,
 * "order 7" for "sine_7", and not how much each run would tell, "(χ² 1.4e+03)", which measure_next.csv has.
 * 0: as they stand. */
static size_t taken_at(const hci_diagnosis *d, const char *at, bool is_start, const char **words)
{
    const char *effect = is_start ? effect_at(d, at) : NULL;
    *words = effect ? hci_finding_title(effect) : "";
    if (effect) return strlen(effect);
    if (begins(at, " (χ² ") && strchr(at, ')')) return strcspn(at, ")") + 1;
    if (!is_start || (!begins(at, "sine_") && !begins(at, "cosine_"))) return 0;
    *words = "order ";
    return strcspn(at, "_") + 1;
}

/* Bytes of the advice that say how a shaft turns, "10 turns at " or ", 23.9 rpm (2.5 rad/s)"; 0: others. */
static size_t turning_at(const char *at, bool is_start)
{
    static const char NUMBER[] = "0123456789.e+-", TURNS[] = " turns at ";
    const size_t digits = strspn(at, NUMBER);
    if (is_start && digits > 0 && begins(at + digits, TURNS)) return digits + sizeof TURNS - 1;
    if (!begins(at, ", ")) return 0;
    return begins(at + 2 + strspn(at + 2, NUMBER), " rpm (") ? strcspn(at, ")") + 1 : 0;
}

static void say_advice(cli_tuning *t)
{
    char text[2 * sizeof t->diagnosis.advice] = "";
    const char *advice = t->diagnosis.advice, *words;
    for (const char *at = advice; *at;) {
        const bool is_start = at == advice || !is_of_name(at[-1]);
        const size_t used = strlen(text), turning = cli_tune_is_calculated(t) ? turning_at(at, is_start) : 0,
                     taken = turning > 0 ? turning : taken_at(&t->diagnosis, at, is_start, &words);
        if (turning > 0) words = "";
        snprintf(text + used, sizeof text - used, "%.*s", taken > 0 ? (int)strlen(words) : 1,
                 taken > 0 ? words : at);
        at += taken > 0 ? taken : 1;
    }
    if (text[0]) hci_tuning_say(&t->tuning, HCI_TUNING_NEXT, "%s.", text);
}

static bool is_asked_before(const hci_diagnosis *d, size_t point)
{
    for (size_t k = 0; k < point; ++k)
        if (d->next[k].id_A == d->next[point].id_A && d->next[k].iq_A == d->next[point].iq_A) return true;
    return false;
}

/* Where nothing turns, speeds and directions are none. */
static void say_calculated_points(cli_tuning *t)
{
    const hci_diagnosis *d = &t->diagnosis;
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT,
                   "To be calculated, each over an electrical turn (currents of diagnose/measure_next.csv):");
    for (size_t k = 0; k < d->next_points; ++k)
        if (!is_asked_before(d, k))
            hci_tuning_say(&t->tuning, HCI_TUNING_NEXT, "  i_d %.3g A, i_q %.3g A", d->next[k].id_A,
                           d->next[k].iq_A);
}

/* A row of what is to be played: "  10 turns forward at 7.5 rpm: i_d 0 A, i_q 1.41 A". */
static void say_point(cli_tuning *t, const hci_next_point *p)
{
    char current[64] = "the current that control makes";
    if (isfinite(p->iq_A)) snprintf(current, sizeof current, "i_d %.3g A, i_q %.3g A", p->id_A, p->iq_A);
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT, "  %.3g turns %s at %.3g rpm: %s%s", p->turns,
                   p->speed_rad_per_s < 0.0 ? "back" : "forward", fabs(p->speed_rad_per_s) * 30.0 / HCI_PI,
                   current, p->source == HCI_TORQUE_INERTIA ? ", the shaft free" : "");
}

/* What all of that comes to on the bench. */
static void say_points(cli_tuning *t)
{
    const hci_diagnosis *d = &t->diagnosis;
    if (d->next_points == 0) return;
    if (cli_tune_is_calculated(t)) {
        say_calculated_points(t);
        return;
    }
    hci_tuning_say(&t->tuning, HCI_TUNING_NEXT, "On the bench, each steady (diagnose/measure_next.csv):");
    for (size_t k = 0; k < d->next_points; ++k)
        say_point(t, &d->next[k]);
}

void cli_tune_say_advice(cli_tuning *t)
{
    say_advice(t);
    say_points(t);
}
