#include "cli/tune/tune_steps.h"

#include <math.h>

#include "cli/tune/tune_read.h"
#include "cli/tune/tune_suspect.h"
#include "hci/math/harmonic.h"

/* A table over an angle whose zero is unknown cannot be played. */
static bool has_no_angle(const hci_run *r)
{
    return r->zero_is_unknown;
}

static bool is_useless(const hci_run *r)
{
    return has_no_angle(r) || r->is_unsteady;
}

static bool is_useful(const hci_run *r)
{
    return !is_useless(r) && r->theta_m_rad && (r->torque_source != HCI_TORQUE_NONE || r->v_V);
}

static void say_left_out(cli_tuning *t, size_t k)
{
    const hci_run *r = &t->runs.run[k];
    const char *name = cli_tune_name_of(t, k);
    if (!has_no_angle(r))
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "What of the current in %s answers cogging torque, and what answers the shaft's "
                       "sticking and slipping: it is left out.",
                       name);
    else if (r->angle_like[0])
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "Where the shaft was in %s, which has no angle and is left out; --column '%s' may "
                       "read one.",
                       name, r->angle_like);
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_UNKNOWN,
                       "Where the shaft was in %s, which has no angle and is left out.", name);
}

/* The list and the recordings without them. */
static hci_status read_others(cli_tuning *t, hci_note *note)
{
    const size_t all = t->arguments->words;
    t->kept = *t->arguments;
    t->kept.words = 0;
    for (size_t k = 0; k < t->runs.count; ++k)
        if (!is_useless(&t->runs.run[k]) && !hci_runs_is_further_point(&t->runs, k))
            t->kept.word[t->kept.words++] = cli_tune_log_of(t, k);
    t->left_out = all - t->kept.words;
    t->arguments = &t->kept;
    const hci_status status = cli_tune_list_logs(t, note);
    return status ? status : cli_tune_read_inputs(t, note);
}

/* The one that is shown: what sticks, or else the first that tells where the shaft is. */
static void choose_log(cli_tuning *t)
{
    size_t shown = 0;
    for (size_t k = t->runs.count; k-- > 0;)
        if (t->runs.run[k].theta_m_rad || t->runs.run[k].speed_rad_per_s) shown = k;
    for (size_t k = t->runs.count; k-- > 0;)
        if (t->runs.run[k].is_unsteady) shown = k;
    t->shown = shown;
    t->tuning.log_name = cli_tune_name_of(t, shown);
}

/* Electrical degrees: less is the noise of an encoder. */
#define STANDS_DEG 1.0

static bool stands(const hci_run *r)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k) {
        least = fmin(least, r->theta_m_rad[k]);
        most = fmax(most, r->theta_m_rad[k]);
    }
    return r->theta_m_rad && r->pole_pairs * (most - least) < STANDS_DEG * HCI_PI / 180.0;
}

/* Several recordings, of one angle each, may be a holding test in steps. */
static bool all_stand_at_one(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (!stands(&t->runs.run[k])) return false;
    return t->runs.count == 1;
}

/* Times what the current makes: so much an inertia does not answer in a shaft that control turns slowly. */
#define NOT_BELIEVABLE 30.0

static void judge_inertia(cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && t->declared.inertia_kgm2 > 0.0; ++k)
        if (t->runs.run[k].inertia_share > NOT_BELIEVABLE)
            t->inertia_share = fmax(t->inertia_share, t->runs.run[k].inertia_share);
}

/* Why nothing can be done with what is there. */
static void judge_runs(cli_tuning *t)
{
    judge_inertia(t);
    cli_tune_suspect(t);
    t->has_standstill = all_stand_at_one(t);
    for (size_t k = 0; k < t->runs.count; ++k) {
        t->has_unsteady = t->has_unsteady || t->runs.run[k].is_unsteady;
        t->has_no_angle = t->has_no_angle || has_no_angle(&t->runs.run[k]);
        t->needs_inertia = t->needs_inertia || t->runs.run[k].needs_inertia;
    }
}

hci_status cli_tune_leave_out(cli_tuning *t, hci_note *note)
{
    size_t useless = 0, useful = 0;
    hci_status status = HCI_OK;
    for (size_t k = 0; k < t->runs.count; ++k) {
        useless += is_useless(&t->runs.run[k]);
        useful += is_useful(&t->runs.run[k]);
    }
    if (useless > 0 && useful > 0 && t->is_own && !t->has_slip && !t->has_misfit) {
        for (size_t k = 0; k < t->runs.count; ++k)
            if (is_useless(&t->runs.run[k])) say_left_out(t, k);
        status = read_others(t, note);
    }
    if (!status && t->runs.count > 0) choose_log(t);
    if (!status) judge_runs(t);
    return status;
}
