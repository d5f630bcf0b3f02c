#include "cli/tune/tune_size.h"

#include <math.h>
#include <stdio.h>

#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_waveforms.h"

/* Cogging torque, peak to peak, to the rated torque: motors have some percent. */
#define LARGE_COGGING 0.33
#define EXCESS_RATED  1.0

/* Times the largest current that is rated, wanted or recorded under load. */
#define EXCESS_CURRENT 10.0

/* Times the ripple of a plain sine: a bound that is more says nothing. */
#define BOUNDLESS 10.0

/* Where nothing is rated and no load recorded; what is solved for then, too. */
#define LEAST_A 1.0

double cli_tune_rated_Nm(const cli_tuning *t)
{
    if (t->declared.rated_torque_Nm > 0.0) return t->declared.rated_torque_Nm;
    return fmax(t->declared.rated_current_A * t->reading.run.torque_constant_Nm_per_A, 0.0);
}

/* The currents of a slow turn are those of the cogging torque, and tell no load. */
static double load_A(const cli_tuning *t)
{
    double most_A = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED || cli_tune_has_no_current(t, r)) continue;
        for (size_t n = 0; n < 3 * r->count; ++n)
            most_A = fmax(most_A, fabs(r->i_A[n]));
    }
    return most_A;
}

static double usual_A(const cli_tuning *t)
{
    const double rated_Nm = cli_tune_rated_Nm(t), wanted_A = t->solution.plain_amplitude_A;
    const double rated_A = t->declared.rated_current_A > 0.0
                               ? t->declared.rated_current_A
                               : rated_Nm / t->reading.run.torque_constant_Nm_per_A;
    if (rated_A > 0.0) return fmax(rated_A, load_A(t)); /* whatever torque is wanted */
    return fmax(fmax(LEAST_A, load_A(t)), wanted_A);
}

/* Whether the fundamental of the currents has the sign against the torque that it was solved for: a root of
 * the model far away from what was recorded, and no current of a motor. */
static bool is_against(const hci_solution *s)
{
    double along = 0.0;
    for (size_t k = 0; k < s->current.count; ++k) {
        const hci_wave *w = &s->current.wave[k];
        if (w->sequence == 1 && fabs(w->order - 1.0) < HCI_ORDER_TOLERANCE)
            along += w->sine * s->plain.sine + w->cosine * s->plain.cosine;
    }
    return along < 0.0;
}

static double open_swing_Nm(const cli_tuning *t)
{
    double least_Nm = t->open_Nm[0], most_Nm = least_Nm;
    for (size_t k = 1; k < HCI_TUNING_POINTS; ++k)
        least_Nm = fmin(least_Nm, t->open_Nm[k]), most_Nm = fmax(most_Nm, t->open_Nm[k]);
    return most_Nm - least_Nm;
}

/* ---- reasons to write no table: each says itself, and false where it does not hold ---- */

typedef bool say_reason(const cli_tuning *tune, char *text, size_t size);

static const char *units_of(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source != HCI_TORQUE_MEASURED) return "currents and Kv";
    return load_A(t) > 0.0 || t->runs.count == 0 ? "torque, currents and Kv" : "torque and Kv";
}

static bool say_large_cogging(const cli_tuning *t, char *text, size_t size)
{
    const double rated_Nm = cli_tune_rated_Nm(t);
    if (!(rated_Nm > 0.0 && t->open_swing_Nm > EXCESS_RATED * rated_Nm)) return false;
    snprintf(text, size,
             "A torque without current of %.3g N·m from peak to peak is %.3g times the rated torque of "
             "%.3g N·m, which no motor has: are %s in the unit that they were read in (N·m, not N·cm, "
             "lbf·in or N·mm; A, not mA; rpm/V)? No table was written",
             t->open_swing_Nm, t->open_swing_Nm / rated_Nm, rated_Nm, units_of(t));
    return true;
}

static bool say_against(const cli_tuning *t, char *text, size_t size)
{
    if (!is_against(&t->solution)) return false;
    snprintf(text, size,
             "The currents of the model for %.4g N·m have the sign that makes the other torque, which is "
             "none of a motor: the model does not hold so far from what was recorded. No table was "
             "written: --torque with less, or logs at several loads up to that torque",
             t->mean_Nm);
    return true;
}

/* Times the most ripple of a recording, for the square of the current where the sine is larger than all of
 * them: a model that does not explain the recordings and makes more is worse than none. */
#define UNLIKE 2.0

static bool say_unlike(const cli_tuning *t, char *text, size_t size)
{
    const hci_solution *s = &t->solution;
    double before_Nm, after_Nm;
    if (!hci_expected_ripple_is_doubtful(&s->expected) || !hci_tuning_knows_ripple(s)) return false;
    const cli_tune_ripple x = cli_tune_recorded_ripple(t);
    cli_tune_swing_of(t, &before_Nm, &after_Nm);
    const double most_A = cli_tune_turning_A(t);
    if (x.run == t->runs.count || !(x.current_A > 0.0 && most_A > 0.0)) return false;
    const double larger = fmax(s->plain_amplitude_A / most_A, 1.0);
    if (!(before_Nm > UNLIKE * larger * larger * x.peak_to_peak_Nm)) return false;
    snprintf(
        text, size,
        "The model does not explain the recordings: a plain sine of %.3g A makes a ripple of %.2g N·m from "
        "peak to peak in it, and %.120s, which has most, shows %.2g N·m at %.3g A. No table was written: "
        "begin with the logs "
        "of one load and those without a current",
        s->plain_amplitude_A, before_Nm, cli_tune_name_of(t, x.run), x.peak_to_peak_Nm, x.current_A);
    return true;
}

#define LEAVES 2.0 /* times what a plain sine has in the model */

/* A model that does not explain the recordings, and leaves twice as much of their ripple as a plain sine has
 * in it. */
static bool say_little(const cli_tuning *t, char *text, size_t size)
{
    const hci_solution *s = &t->solution;
    double before_Nm, after_Nm;
    if (!hci_expected_ripple_is_doubtful(&s->expected) || !hci_tuning_knows_ripple(s)) return false;
    const double left_Nm = cli_tune_unexplained_Nm(t);
    cli_tune_swing_of(t, &before_Nm, &after_Nm);
    if (!(CLI_TUNE_SWING_OF_RMS * left_Nm > LEAVES * before_Nm)) return false;
    snprintf(
        text, size,
        "The model does not explain the recordings: up to %.2g N·m rms of their ripple is not in it, and a "
        "plain sine of %.3g A makes %.2g N·m from peak to peak in it, so that a table by it would take away "
        "less than half of what it leaves. No table was written: what to record next stands below",
        left_Nm, s->plain_amplitude_A, before_Nm);
    return true;
}

#define MISSES                                                                                               \
    0.25 /* of the mean torques of the recordings, rms, which a model of the machine does not miss */

/* rms of the measured mean torques under load, and of what the model makes less of them. */
static void means_under_load(const cli_tuning *t, double *mean_Nm, double *missed_Nm)
{
    double squares = 0.0, missed = 0.0, count = 0.0;
    for (size_t k = 0; k < t->diagnosis.runs && k < t->runs.count; ++k) {
        const hci_run_errors *r = &t->diagnosis.run[k];
        if (r->source != HCI_TORQUE_MEASURED || cli_tune_has_no_current(t, &t->runs.run[k])) continue;
        squares += r->mean_torque_Nm * r->mean_torque_Nm;
        missed += r->error_mean_after_Nm * r->error_mean_after_Nm;
        count += 1.0;
    }
    *mean_Nm = sqrt(squares / fmax(count, 1.0));
    *missed_Nm = sqrt(missed / fmax(count, 1.0));
}

/* A model that does not explain the recordings, and makes other mean torques than they have. */
static bool say_other_means(const cli_tuning *t, char *text, size_t size)
{
    double mean_Nm, missed_Nm;
    if (!hci_expected_ripple_is_doubtful(&t->solution.expected)) return false;
    means_under_load(t, &mean_Nm, &missed_Nm);
    if (!(missed_Nm > MISSES * mean_Nm)) return false;
    snprintf(
        text, size,
        "The model does not explain the recordings: their mean torques under load are %.3g N·m rms, and it "
        "misses them by %.2g N·m, so that a table by it would make another torque than %.4g N·m and another "
        "ripple. No table was written: what to record next stands below%s",
        mean_Nm, missed_Nm, t->mean_Nm,
        t->arguments->given[TUNE_INDUCTANCE_D]
            ? ""
            : "; for a rotor whose L_d and L_q differ, --inductance-d and --inductance-q come first");
    return true;
}

static bool is_much_current(const cli_tuning *t)
{
    return t->solution.peak_phase_current_A > EXCESS_CURRENT * t->usual_A;
}

static bool say_much_torque(const cli_tuning *t, char *text, size_t size)
{
    const double sine_A = t->solution.plain_amplitude_A;
    if (!is_much_current(t) || !t->arguments->given[TUNE_TORQUE] || !(sine_A > EXCESS_CURRENT * t->usual_A))
        return false;
    snprintf(text, size,
             "A torque of %.4g N·m would take a sine of %.3g A, %.3g times the %.3g A that %s: is "
             "--torque in N·m, and is %s right? No table was written",
             t->mean_Nm, sine_A, sine_A / t->usual_A, t->usual_A,
             cli_tune_rated_Nm(t) > 0.0 ? "are rated or recorded" : "were taken for its load",
             cli_tune_constant_option(t));
    return true;
}

static bool say_much_current(const cli_tuning *t, char *text, size_t size)
{
    const double peak_A = t->solution.peak_phase_current_A;
    if (!is_much_current(t)) return false;
    snprintf(text, size,
             "The table would take a peak current of %.3g A for a torque without current of %.3g N·m from "
             "peak to peak, %.3g times the %.3g A that %s: are %s in the unit that they were read in "
             "(N·m, not N·cm, lbf·in or N·mm; A, not mA; rpm/V)? If they are, give --rated-current. No table "
             "was written",
             peak_A, t->open_swing_Nm, peak_A / t->usual_A, t->usual_A,
             cli_tune_rated_Nm(t) > 0.0 ? "are rated" : "were taken for its load", units_of(t));
    return true;
}

/* The first that holds is said. */
static say_reason *const REASON[] = {say_large_cogging, say_against,     say_unlike,      say_little,
                                     say_other_means,   say_much_torque, say_much_current};

static say_reason *reason_of(const cli_tuning *t, char *text, size_t size)
{
    for (size_t k = 0; k < sizeof REASON / sizeof *REASON; ++k)
        if (REASON[k](t, text, size)) return REASON[k];
    return NULL;
}

bool cli_tune_say_excess(const cli_tuning *t, char *text, size_t size)
{
    return reason_of(t, text, size) != NULL;
}

bool cli_tune_is_unexplained(const cli_tuning *t)
{
    char text[1024];
    say_reason *reason = t->size == CLI_TUNE_EXCESS ? reason_of(t, text, sizeof text) : NULL;
    return reason == say_unlike || reason == say_little || reason == say_other_means;
}

void cli_tune_judge_size(cli_tuning *t)
{
    const double rated_Nm = cli_tune_rated_Nm(t);
    char text[1024];
    if (!t->is_solved) return;
    t->open_swing_Nm = open_swing_Nm(t);
    t->usual_A = usual_A(t);
    if (cli_tune_say_excess(t, text, sizeof text))
        t->size = CLI_TUNE_EXCESS;
    else if (rated_Nm > 0.0 && t->open_swing_Nm > LARGE_COGGING * rated_Nm)
        t->size = CLI_TUNE_LARGE;
}

bool cli_tune_is_unpromised(const cli_tuning *t)
{
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    if (!t->is_solved || e->state != HCI_RIPPLE_KNOWN || !hci_tuning_knows_ripple(&t->solution)) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return before_Nm >= t->solution.tolerance_Nm && e->peak_to_peak_Nm > BOUNDLESS * before_Nm;
}

/* ---- recordings whose torques are in different units ---- */

/* Of the mean torque to what the phase currents could make: from there to CLI_TUNE_ANOTHER_TORQUE it is one
 * of N·m. */
#define LIKELY 0.1

/* Times what another recording shows of mean torque or ripple: less is friction, a zero of the sensor, or a
 * ripple that its noise or its filter hides. No less than any current makes, either. */
#define ANOTHER_UNIT 30.0

/* A ratio is that of a unit within this factor: friction and ripple are in it. */
#define NEAR_UNIT 1.5

typedef struct {
    double mean_Nm, ripple_Nm; /* of the torque; rms about the mean */
    double share;              /* mean to that of the currents; 0: there is none */
} torque_size;

static torque_size torque_size_of(const cli_tuning *t, const hci_run *r)
{
    torque_size x = {0.0, 0.0, 0.0};
    for (size_t n = 0; n < r->count; ++n)
        x.mean_Nm += r->torque_Nm[n] / (double)r->count;
    for (size_t n = 0; n < r->count; ++n)
        x.ripple_Nm += (r->torque_Nm[n] - x.mean_Nm) * (r->torque_Nm[n] - x.mean_Nm) / (double)r->count;
    x.ripple_Nm = sqrt(x.ripple_Nm);
    if (!cli_tune_has_no_current(t, r))
        x.share = fabs(x.mean_Nm) / (sqrt(2.0) * cli_tune_rms_A(r) * t->reading.run.torque_constant_Nm_per_A);
    return x;
}

/* How many times another recording shows what one of a torque in N·m does; 0: nothing to be said. */
static double times_of(const torque_size *other, const torque_size *good)
{
    const double times = other->share > 0.0 ? other->share / good->share : other->ripple_Nm / good->ripple_Nm;
    return times > ANOTHER_UNIT ? times : 0.0;
}

const char *cli_tune_torque_unit(double times)
{
    if (fabs(log(times / 1000.0)) < log(NEAR_UNIT)) return "torque_mNm";
    return fabs(log(times / 100.0)) < log(NEAR_UNIT) ? "torque_Ncm" : "";
}

/* The recording under load with a torque of N·m; t->runs.count: none. */
static size_t good_torque(const cli_tuning *t, torque_size *size)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (t->runs.run[k].torque_source != HCI_TORQUE_MEASURED) continue;
        *size = torque_size_of(t, &t->runs.run[k]);
        if (size->share > LIKELY && size->share < CLI_TUNE_ANOTHER_TORQUE) return k;
    }
    return t->runs.count;
}

bool cli_tune_say_mixed_torque(const cli_tuning *t, char *text, size_t size)
{
    torque_size good = {0.0, 0.0, 0.0};
    const size_t by = good_torque(t, &good);
    const double most_Nm =
        CLI_TUNE_ANOTHER_TORQUE * t->reading.run.torque_constant_Nm_per_A * cli_tune_largest_recorded_A(t);
    for (size_t k = 0; by < t->runs.count && k < t->runs.count; ++k) {
        if (k == by || t->runs.run[k].torque_source != HCI_TORQUE_MEASURED) continue;
        const torque_size other = torque_size_of(t, &t->runs.run[k]);
        const double times = times_of(&other, &good);
        if (!(times > 0.0) || fabs(other.mean_Nm) + other.ripple_Nm < most_Nm) continue;
        const char *column = cli_tune_torque_unit(times);
        snprintf(
            text, size,
            "The torque in %.120s %s %.0f times that in %.120s, which is in N·m by its currents: it is in "
            "another unit there; name its column %s in that log, so nothing was solved",
            cli_tune_name_of(t, k), other.share > 0.0 ? "is by its currents" : "swings without a current",
            times, cli_tune_name_of(t, by), column[0] ? column : "with its unit, as torque_lbfin is");
        return true;
    }
    return false;
}
