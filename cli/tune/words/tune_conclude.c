#include "cli/tune/words/tune_conclude.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_sheet.h"
#include "cli/tune/tune_size.h"
#include "cli/tune/tune_suspect.h"
#include "cli/tune/words/tune_go_on.h"
#include "cli/tune/words/tune_heading.h"
#include "cli/tune/words/tune_next.h"
#include "cli/tune/words/tune_unknown.h"

static const char *verdict_of(const cli_tuning *t)
{
    return t->tuning.good                        ? "tuned"
           : t->jump_rad > 0.0                   ? "not enough in the logs"
           : t->has_slip                         ? "a convention is broken"
           : t->has_misfit || t->is_not_followed ? "the conventions are not understood"
           : t->has_no_angle                     ? "not enough in the logs"
           : t->has_unsteady                     ? "the shaft sticks and slips"
           : cli_tune_all_torque_clipped(t)      ? "the torque is clipped"
           : cli_tune_has_gap(t)                 ? "not enough in the logs"
           : t->has_alias                        ? "the samples lie too far apart"
           : cli_tune_is_unexplained(t)          ? "no table: the recordings are not explained"
           : t->size == CLI_TUNE_EXCESS          ? "the size is not believable"
           : t->inertia_share > 0.0              ? "the inertia is not believable"
           : t->has_standstill                   ? "not enough in the logs"
           : t->out_of_reach[0]                  ? "the model does not reach the torque"
           : !t->is_emitted                      ? "not enough in the logs"
           : cli_tune_is_of_no_use(t) || cli_tune_is_never_seen(t) ? "a table of no use"
           : cli_tune_is_missed(t)                                 ? "tuned, but not as wanted"
           : t->diagnosis.verdict == HCI_DIAGNOSIS_UNKNOWN         ? "tuned with what is certain"
                                                                   : "tuned, with something left open";
}

static void say_errors(cli_tuning *t)
{
    if (strstr(t->tuning.part[HCI_TUNING_FOUND], "±") != NULL)
        hci_tuning_say(&t->tuning, HCI_TUNING_FOUND,
                       "± is a standard deviation of the noise alone; what the model lacks, and constants of "
                       "the sheet that are off, come on top.");
}

/* Whether what was recorded is as sound as it has to be for a table to be relied on. */
static bool is_sound(const cli_tuning *t)
{
    double offset_deg;
    char words[512];
    return !cli_tune_say_sheet(t, words, sizeof words) && !t->has_doubt && !cli_tune_off_iq(t, &offset_deg) &&
           !cli_tune_is_without_angle(t) && !(cli_tune_strange_rpm(t) > 0.0) && !cli_tune_denied_inertia(t) &&
           !cli_tune_is_short(t) && !(t->once_a_turn_Nm > 0.0) && !(t->folded_Nm > 0.0) &&
           cli_tune_clipped(t) == 0 && cli_tune_torque_clipped(t) == 0 && t->size == CLI_TUNE_USUAL &&
           !(t->drives_Nm > 0.0) && !(fabs(t->turned_deg) > 0.0) && !(fabs(t->open_turn_deg) > 0.0) &&
           cli_tune_calculated_beside(t) == 0 && !cli_tune_is_late_at_one_pace(t);
}

/* Whether the table is what was wanted, of a model that can be believed. */
static bool is_good(const cli_tuning *t)
{
    return t->is_emitted && !t->diagnosed && t->solution.within_limits && !cli_tune_is_missed(t) &&
           !cli_tune_is_of_no_use(t) && !cli_tune_is_far_beyond(t) && !cli_tune_is_never_seen(t) &&
           !t->diagnosis.means_alone && !cli_tune_misses_torque(t) && !cli_tune_promises_nothing(t) &&
           !cli_tune_is_boundless(t) &&
           !(t->is_solved && hci_expected_ripple_is_doubtful(&t->solution.expected));
}

void cli_tune_conclude(cli_tuning *t)
{
    hci_tuning *r = &t->tuning;
    r->log = t->runs.count > 0 ? &t->runs.run[t->shown] : NULL;
    cli_tune_say_unknown(t);
    cli_tune_say_next(t);
    cli_tune_say_go_on(t);
    say_errors(t);
    r->good = is_sound(t) && is_good(t);
    snprintf(r->verdict, sizeof r->verdict, "%s", verdict_of(t));
    cli_tune_set_heading(t);
}
