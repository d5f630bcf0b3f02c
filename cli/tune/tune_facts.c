#include "cli/tune/tune_facts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/tune/tune_options.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_suspect.h"
#include "cli/tune/tune_waveforms.h"
#include "hci/math/harmonic.h"

/* Of the data sheet, that a measured back-EMF may be off and not be a contradiction. */
#define OFF_SHEET 0.15

bool cli_tune_is_off_sheet(const cli_tuning *t)
{
    return t->has_emf && fabs(t->emf_to_sheet - 1.0) > OFF_SHEET;
}

bool cli_tune_misses_slots(const cli_tuning *t)
{
    return t->cogging_reach > 0.0 && cli_tune_order_of_slots(t) > t->cogging_reach + HCI_ORDER_TOLERANCE;
}

double cli_tune_reach_of_slopes(const cli_tuning *t)
{
    double reach = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        if (t->runs.run[k].torque_source == HCI_TORQUE_NONE) continue;
        if (!(t->runs.run[k].torque_reach > 0.0)) return 0.0;
        reach = fmax(reach, t->runs.run[k].torque_reach);
    }
    const double slots = cli_tune_order_of_slots(t);
    return reach < (slots > 0.0 ? slots : HCI_USUAL_ORDER) ? reach : 0.0;
}

bool cli_tune_lacks_sign(const cli_tuning *t)
{
    bool lacks = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source == HCI_TORQUE_MEASURED || r->current_way != 0) return false;
        lacks = lacks || r->torque_source == HCI_TORQUE_HOLDING ||
                (r->torque_source == HCI_TORQUE_INERTIA && !cli_tune_has_no_current(t, r));
    }
    return lacks;
}

bool cli_tune_is_electrical_alone(const cli_tuning *t)
{
    bool any = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source == HCI_TORQUE_NONE || !r->theta_m_rad) continue;
        if (r->turn_known) return false;
        any = true;
    }
    return any && t->declared.model.pole_pairs > 1;
}

bool cli_tune_is_without_angle(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].theta_m_rad) return false;
    return t->is_own && t->has_emf && t->runs.count > 0;
}

bool cli_tune_off_iq(const cli_tuning *t, double *offset_deg)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!(fabs(r->off_iq_rad) > 0.0)) continue;
        const double given_rad = r->zero_is_given ? r->zero_offset_rad : 0.0;
        *offset_deg = round(180.0 / HCI_PI * (r->off_iq_rad + given_rad)) + 0.0; /* no -0 */
        return true;
    }
    return false;
}

bool cli_tune_is_uncounted(const cli_tuning *t)
{
    return t->is_solved && t->is_own && !t->counts_pole_pairs;
}

const char *cli_tune_order_words(const cli_tuning *t, double order, char text[CLI_TUNE_ORDER])
{
    const int p = t->declared.model.pole_pairs;
    const double turns = order * p, whole = round(turns);
    const bool is_fraction = p > 1 && fabs(order - round(order)) > HCI_ORDER_TOLERANCE && whole >= 1.0 &&
                             whole < 1e6 && fabs(turns - whole) < p * HCI_ORDER_TOLERANCE;
    int above = (int)whole, below = p;
    for (int k = 2; is_fraction && k <= below; ++k)
        while (above % k == 0 && below % k == 0)
            above /= k, below /= k;
    if (is_fraction)
        snprintf(text, CLI_TUNE_ORDER, "%d/%d", above, below);
    else
        snprintf(text, CLI_TUNE_ORDER, "%.5g", order);
    return text;
}

/* Of two mean speeds, in one direction, that tell nothing that one does not. */
#define ONE_SPEED 1.2

/* A part of a recording, of several tests maybe, that is taken for one speed: it varies by less, rms. */
#define STEADY 0.15
enum { PARTS_OF_SPEEDS = 16 };

typedef struct {
    double least, most;      /* rad/s, mean speeds */
    double slowest, fastest; /* their sizes, either way round */
} range_of_speeds;

#define NO_SPEEDS                                                                                            \
    {                                                                                                        \
        HUGE_VAL, -HUGE_VAL, HUGE_VAL, 0.0                                                                   \
    }

/* Of samples from `from` up to `end`, where their speed is steady or does not have to be. */
static void add_speed(const hci_run *r, size_t from, size_t end, bool may_vary, range_of_speeds *s)
{
    double mean = 0.0, square = 0.0;
    for (size_t n = from; n < end; ++n)
        mean += r->speed_rad_per_s[n] / (double)(end - from);
    for (size_t n = from; n < end; ++n)
        square += pow(r->speed_rad_per_s[n] - mean, 2.0) / (double)(end - from);
    if (!may_vary && !(square < STEADY * STEADY * mean * mean)) return;
    s->least = fmin(s->least, mean);
    s->most = fmax(s->most, mean);
    s->slowest = fmin(s->slowest, fabs(mean));
    s->fastest = fmax(s->fastest, fabs(mean));
}

/* Of its steady parts, as of a file with several tests; of none, its mean. */
static void add_speeds(const hci_run *r, range_of_speeds *s)
{
    range_of_speeds own = NO_SPEEDS;
    for (size_t k = 0; k < PARTS_OF_SPEEDS && r->count >= PARTS_OF_SPEEDS; ++k)
        add_speed(r, k * r->count / PARTS_OF_SPEEDS, (k + 1) * r->count / PARTS_OF_SPEEDS, false, &own);
    if (own.least > own.most) add_speed(r, 0, r->count, true, &own);
    s->least = fmin(s->least, own.least);
    s->most = fmax(s->most, own.most);
    s->slowest = fmin(s->slowest, own.slowest);
    s->fastest = fmax(s->fastest, own.fastest);
}

/* Rows without a clock whose shaft was turned all the same: they have a speed, or go on beyond a turn, which
 * a computed table does not. */
static bool turns_untimed(const hci_run *r)
{
    if (r->time_s || !r->theta_m_rad || r->count == 0) return false;
    if (fabs(r->theta_m_rad[r->count - 1] - r->theta_m_rad[0]) > 2.0 * HCI_PI) return true;
    return r->speed_rad_per_s && r->speed_rad_per_s[0] != 0.0;
}

static bool is_one_speed(const range_of_speeds *s)
{
    if (s->least > s->most) return true;
    const double slow = fmin(fabs(s->least), fabs(s->most)), fast = fmax(fabs(s->least), fabs(s->most));
    return s->least * s->most > 0.0 && fast < ONE_SPEED * slow;
}

/* Whether all that a torque sensor has measured in time is of one speed, or none of what it measured has a
 * time: one that reads late turns the orders by an angle that is not told then. What is measured without a
 * current at one speed and with one at another has no order in common but those of the cogging torque, which
 * the load has beside others. */
static bool has_one_speed(const cli_tuning *t)
{
    range_of_speeds s[2] = {NO_SPEEDS, NO_SPEEDS};
    bool untimed = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED) continue;
        if (r->time_s && r->speed_rad_per_s) add_speeds(r, &s[cli_tune_has_no_current(t, r)]);
        untimed = untimed || turns_untimed(r);
    }
    if (s[0].least > s[0].most && s[1].least > s[1].most) return untimed;
    return is_one_speed(&s[0]) && is_one_speed(&s[1]);
}

/* Of steady parts that a torque sensor has measured in time. */
static range_of_speeds measured_speeds(const cli_tuning *t)
{
    range_of_speeds s = NO_SPEEDS;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source == HCI_TORQUE_MEASURED && r->time_s && r->speed_rad_per_s) add_speeds(r, &s);
    }
    return s;
}

static double fastest_rad_per_s(const cli_tuning *t)
{
    return t->declared.model.pole_pairs * measured_speeds(t).fastest;
}

double cli_tune_early_s(const cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    for (size_t k = 0; k < list->count; ++k) {
        const hci_effect *e = &list->effect[k];
        for (size_t j = 0; e->type->late && j < e->count; ++j)
            if (e->type->correction[e->term[j].parameter] == HCI_CORRECT_ANGLE_DELAY &&
                e->term[j].value < 0.0)
                return -e->term[j].value;
    }
    return 0.0;
}

bool cli_tune_is_late_at_one_pace(const cli_tuning *t)
{
    const range_of_speeds s = measured_speeds(t);
    return cli_tune_early_s(t) > 0.0 && s.fastest < ONE_SPEED * s.slowest;
}

double cli_tune_late_Nm_per_s(const cli_tuning *t)
{
    const double speed_rad_per_s = fastest_rad_per_s(t);
    double square = 0.0;
    for (size_t k = 0; k < t->solution.order_count; ++k) {
        const hci_harmonic *x = &t->solution.order[k].before_Nm;
        square += pow(x->order * speed_rad_per_s * hci_amplitude(x->sine, x->cosine), 2.0);
    }
    return 2.0 * sqrt(square);
}

bool cli_tune_lacks_times(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source == HCI_TORQUE_MEASURED && t->runs.run[k].time_s) return false;
    return true;
}

bool cli_tune_hangs_on_lag(const cli_tuning *t)
{
    return t->is_solved && t->solution.expected.state == HCI_RIPPLE_KNOWN &&
           (has_one_speed(t) || cli_tune_is_late_at_one_pace(t));
}

bool cli_tune_lacks_torque(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_source != HCI_TORQUE_NONE || t->runs.run[k].needs_inertia) return false;
    return t->runs.count > 0;
}

const char *cli_tune_torque_like(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].torque_like[0]) return t->runs.run[k].torque_like;
    return NULL;
}

const char *cli_tune_force_like(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].force_like[0]) return t->runs.run[k].force_like;
    return NULL;
}

const char *cli_tune_current_like(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].current_like[0]) return t->runs.run[k].current_like;
    return NULL;
}

const hci_run *cli_tune_lacks_time(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count && cli_tune_lacks_torque(t); ++k)
        if (!t->runs.run[k].time_column[0] && t->runs.run[k].theta_m_rad &&
            cli_tune_rms_A(&t->runs.run[k]) > 0.0)
            return &t->runs.run[k];
    return NULL;
}

void cli_tune_column_of(const char *like, char text[HCI_RUN_NAME])
{
    snprintf(text, HCI_RUN_NAME, "%s", strchr(like, '=') + 1);
    char *digits = strstr(text, HCI_RUN_DIGITS_PER_A);
    if (digits) *digits = '\0';
}

/* Times the noise that a ripple may have without being looked at. */
#define NEAR_NOISE 1.5

double cli_tune_unexplained_Nm(const cli_tuning *t)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < t->diagnosis.runs; ++k) {
        const hci_run_errors *r = &t->diagnosis.run[k];
        if (k < t->runs.count && t->runs.run[k].only_mean)
            continue; /* its torques are means: none is a ripple */
        if (r->ripple_after_Nm > NEAR_NOISE * r->noise_floor_Nm) most_Nm = fmax(most_Nm, r->ripple_after_Nm);
    }
    return most_Nm;
}

void cli_tune_swing_of(const cli_tuning *t, double *before_Nm, double *after_Nm)
{
    hci_tuning_swing(&t->solution, before_Nm, after_Nm);
    if (t->tuning.table_Nm > 0.0) *after_Nm = t->tuning.table_Nm;
}

double cli_tune_largest_recorded_Nm(const cli_tuning *t)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        for (size_t n = 0; n < r->count && r->torque_Nm; ++n)
            most_Nm = fmax(most_Nm, fabs(r->torque_Nm[n]));
        for (size_t n = 0; n < 3 * r->count; ++n)
            most_Nm = fmax(most_Nm, fabs(r->i_A[n]) * t->reading.run.torque_constant_Nm_per_A);
    }
    return most_Nm;
}

/* Times what was recorded and what is wanted, beyond which a ripple was not seen but made by the model. */
#define NEVER_SEEN 10.0

bool cli_tune_is_never_seen(const cli_tuning *t)
{
    double before_Nm, after_Nm;
    if (!t->is_solved || t->runs.count == 0) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return before_Nm > NEVER_SEEN * (cli_tune_largest_recorded_Nm(t) + t->mean_Nm);
}

double cli_tune_made_Nm(const cli_tuning *t)
{
    return t->solution.order_count > 0 ? t->solution.order[0].torque_Nm.cosine : t->mean_Nm;
}

double cli_tune_offset_to_give(const cli_tuning *t, double turned_deg)
{
    const double so_far_rad = t->runs.count > 0 ? t->runs.run[0].zero_offset_rad : 0.0;
    return remainder(so_far_rad * 180.0 / HCI_PI + turned_deg, 360.0);
}

/* Of the wanted mean torque, that may be missing and not be spoken of. */
#define NEAR_WANTED 0.005

bool cli_tune_misses_torque(const cli_tuning *t)
{
    const double much_Nm = t->mean_Nm > 0.0 ? NEAR_WANTED * t->mean_Nm : t->solution.tolerance_Nm;
    return t->is_solved && fabs(cli_tune_made_Nm(t) - t->mean_Nm) > much_Nm;
}

bool cli_tune_is_missed(const cli_tuning *t)
{
    double before_Nm, after_Nm;
    if (!t->is_solved || !t->tuning.solved) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return !(after_Nm < t->cut_Nm) || cli_tune_misses_torque(t);
}

double cli_tune_largest_recorded_A(const cli_tuning *t)
{
    double most_A = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        for (size_t n = 0; n < 3 * t->runs.run[k].count; ++n)
            most_A = fmax(most_A, fabs(t->runs.run[k].i_A[n]));
    return most_A;
}

/* Times the largest recorded current, beyond which a wrong unit is more likely than a load that was not
 * recorded. */
#define FAR_BEYOND 100.0

/* Noise and zeros of sensors are no current that a rating could be held against. */
static bool no_current_flowed(const cli_tuning *t)
{
    return t->diagnosis.zeros_read + t->diagnosis.only_noise == t->runs.count;
}

bool cli_tune_is_far_beyond(const cli_tuning *t)
{
    const double most_A = cli_tune_largest_recorded_A(t);
    return t->is_solved && most_A > 0.0 && !no_current_flowed(t) &&
           t->solution.peak_phase_current_A > FAR_BEYOND * most_A;
}

bool cli_tune_is_below_idle(const cli_tuning *t)
{
    bool is_idle = t->runs.count > 0 && !(t->once_a_turn_Nm > 0.0); /* a load that turns is one */
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        is_idle = is_idle && r->torque_source == HCI_TORQUE_HOLDING && !hci_run_is_loaded(r, r->pole_pairs);
    }
    return t->is_solved && is_idle && t->arguments->given[TUNE_TORQUE] && t->mean_Nm > 0.0 &&
           t->solution.plain_amplitude_A < cli_tune_largest_recorded_A(t);
}

const char *cli_tune_constant_option(const cli_tuning *t)
{
    static const struct {
        int key;
        const char *name;
    } OPTIONS[] = {{TUNE_KV, "--kv"},
                   {TUNE_VOLT, "--volt-per-krpm"},
                   {TUNE_CONSTANT, "--torque-constant"},
                   {TUNE_FLUX, "--flux"}};
    for (size_t k = 0; k < sizeof OPTIONS / sizeof *OPTIONS && t->is_own; ++k)
        if (t->arguments->given[OPTIONS[k].key]) return OPTIONS[k].name;
    return "the back-EMF of the machine";
}

/* What the inertia took out of the torque that the current of a recording makes, rms. */
static double taken_Nm(const cli_tuning *t, const hci_run *r)
{
    return r->inertia_share * sqrt(2.0) * cli_tune_rms_A(r) * t->reading.run.torque_constant_Nm_per_A;
}

double cli_tune_taken_by_inertia_Nm(const cli_tuning *t, const hci_run **of)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < t->runs.count && !(t->declared.inertia_kgm2 > 0.0); ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!(r->turns_inertia_kgm2 > 0.0) || !(taken_Nm(t, r) > most_Nm)) continue;
        most_Nm = taken_Nm(t, r);
        *of = r;
    }
    return most_Nm;
}

/* ---- an inertia that is declared ---- */

const hci_run *cli_tune_untold_inertia(const cli_tuning *t)
{
    const hci_run *of = NULL;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->inertia_limit_kgm2 > 0.0 && (of == NULL || r->inertia_limit_kgm2 < of->inertia_limit_kgm2))
            of = r;
    }
    return of;
}

const hci_run *cli_tune_denied_inertia(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (t->runs.run[k].denies_inertia) return &t->runs.run[k];
    return NULL;
}

static bool has_current(const hci_run *r)
{
    return cli_tune_rms_A(r) > 0.0;
}

bool cli_tune_is_scaled_by_inertia(const cli_tuning *t)
{
    bool any = false;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const bool is_other =
            r->torque_source == HCI_TORQUE_MEASURED || r->torque_source == HCI_TORQUE_HOLDING;
        if (is_other || (r->torque_source == HCI_TORQUE_INERTIA && has_current(r))) return false;
        any = any || r->torque_source == HCI_TORQUE_INERTIA;
    }
    return any && t->declared.inertia_kgm2 > 0.0;
}

#define NARROW 3.0 /* times the least inertia, up to which the turns tell one */

double cli_tune_hangs_on_inertia_Nm(const cli_tuning *t)
{
    double most_Nm = 0.0;
    for (size_t k = 0; k < t->runs.count && t->declared.inertia_kgm2 > 0.0; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_HOLDING) continue;
        if (r->least_inertia_kgm2 > 0.0 && r->most_inertia_kgm2 < NARROW * r->least_inertia_kgm2) return 0.0;
        most_Nm = fmax(most_Nm, taken_Nm(t, r));
    }
    return most_Nm;
}

#define LONG_s 1200.0 /* few turn a motor on the bench for so long … */
#define RARE_s 0.05   /* … with rows so far apart */

bool cli_tune_say_long(const cli_tuning *t, char *text, size_t size)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (!r->time_s || r->count < 2 || r->speed_window == 0)
            continue; /* a speed that was recorded tells it */
        const double span_s = r->time_s[r->count - 1] - r->time_s[0],
                     step_s = span_s / (double)(r->count - 1);
        if (span_s < LONG_s || step_s < RARE_s) continue;
        char column[CLI_TUNE_COLUMN_WORDS];
        cli_tune_say_column("time_ms", r->time_column, column);
        snprintf(text, size,
                 "the rows of %.80s are %.3g s apart, so that it took %.3g hours: are these milliseconds? "
                 "%.120s reads them so",
                 cli_tune_name_of(t, k), step_s, span_s / 3600.0, column);
        return true;
    }
    return false;
}

#define MOST_rpm 1e5

double cli_tune_strange_rpm(const cli_tuning *t)
{
    const hci_machine_data *m = &t->declared;
    const double Vs_per_rad = t->reading.run.torque_constant_Nm_per_A / 1.5;
    if (!(m->resistance_ohm > 0.0) || !(m->rated_current_A > 0.0) || !(Vs_per_rad > 0.0)) return 0.0;
    const double rpm = m->resistance_ohm * m->rated_current_A / Vs_per_rad * 30.0 / HCI_PI;
    return rpm > MOST_rpm ? rpm : 0.0;
}

bool cli_tune_is_boundless(const cli_tuning *t)
{
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    if (!t->is_solved || e->state != HCI_RIPPLE_KNOWN || !(t->mean_Nm > 0.0)) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return e->peak_to_peak_Nm > fmax(t->mean_Nm, before_Nm);
}

bool cli_tune_promises_nothing(const cli_tuning *t)
{
    const hci_expected_ripple *e = &t->solution.expected;
    double before_Nm, after_Nm;
    if (!t->is_solved || e->state != HCI_RIPPLE_KNOWN || !hci_tuning_knows_ripple(&t->solution)) return false;
    hci_tuning_swing(&t->solution, &before_Nm, &after_Nm);
    return before_Nm >= t->solution.tolerance_Nm && !(e->peak_to_peak_Nm < before_Nm);
}

bool cli_tune_is_of_no_use(const cli_tuning *t)
{
    double before_Nm, after_Nm;
    if (!t->is_solved) return false;
    if (!hci_tuning_knows_ripple(&t->solution)) return !t->has_emf;
    cli_tune_swing_of(t, &before_Nm, &after_Nm);
    if (before_Nm < t->solution.tolerance_Nm) return !(t->mean_Nm > 0.0);
    return after_Nm >= before_Nm;
}

size_t cli_tune_calculated_beside(const cli_tuning *t)
{
    size_t tabulated = 0, measured = 0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        tabulated += r->is_tabulated;
        measured += r->time_s && r->torque_source == HCI_TORQUE_MEASURED;
    }
    return measured > 0 ? tabulated : 0;
}

bool cli_tune_is_calculated(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k)
        if (!t->runs.run[k].is_tabulated) return false;
    return t->runs.count > 0;
}
