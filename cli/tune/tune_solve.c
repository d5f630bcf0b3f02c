#include "cli/tune/tune_steps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command/parse.h"
#include "cli/terminal/progress.h"
#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_cover.h"
#include "cli/tune/tune_facts.h"
#include "cli/tune/tune_line.h"
#include "cli/tune/tune_options.h"
#include "cli/tune/tune_recorded.h"
#include "cli/tune/tune_waveforms.h"
#include "hci/host/base/number.h"
#include "hci/host/currents/target.h"
#include "hci/host/recording/predict.h"
#include "hci/host/report/write.h"
#include "hci/math/harmonic.h"

/* ---- what the model lacks ---- */

hci_status cli_tune_diagnose(cli_tuning *t, hci_note *note)
{
    const cli_arguments *a = t->arguments;
    const char *work = a->given[TUNE_WORK] ? a->value[TUNE_WORK] : CLI_TUNE_WORK;
    const hci_diagnose_options options = {.progress = cli_progress,
                                          .work = cli_number_or(a, TUNE_WORK, strtod(CLI_TUNE_WORK, NULL))};
    char folder[CLI_TUNE_PATH];
    cli_tune_line c = {{"diagnose", t->machine, "--runs", t->list}, 4};
    if (cli_tune_is_blocked(t)) return HCI_OK;
    cli_tune_path(t, "diagnose", folder);
    if (a->given[TUNE_HOLDING]) cli_tune_add_option(&c, "holding", NULL);
    cli_tune_add_option(&c, "work", work);
    cli_tune_add_reading(&c, t);
    cli_tune_add(&c, "-o");
    cli_tune_add(&c, folder);
    cli_tune_note_line(t, &c, true);
    t->diagnosed = hci_diagnose(&t->declared, &t->effects.list, &t->runs, &options, &t->diagnosis, note);
    cli_progress_end();
    if (t->diagnosed > HCI_NOT_REACHED) return t->diagnosed;
    t->has_diagnosis = true;
    return hci_diagnosis_write(&t->diagnosis, NULL, &t->runs, t->machine, folder, note);
}

/* ---- currents ---- */

bool cli_tune_can_solve(const cli_tuning *t)
{
    return !cli_tune_is_blocked(t) &&
           (t->has_emf || t->has_cogging || (!t->diagnosis.nothing_measured && t->diagnosis.runs > 0));
}

/* Torques that the recordings show, the largest: the mean of a sensor, what the mean size of i_q makes
 * against a brake without one, and what the largest current makes. */
typedef struct {
    double mean_Nm, brake_Nm, current_Nm;
    double zero_Nm; /* of the sensor, which is not in mean_Nm */
} recorded;

/* Against a brake the phase currents of a run are those of its load. */
static double mean_length_A(const hci_run *r)
{
    double square = 0.0;
    for (size_t n = 0; n < 3 * r->count; ++n)
        square += r->i_A[n] * r->i_A[n];
    return sqrt(2.0 / 3.0 * square / (double)r->count);
}

/* What the sensor of the torque reads of none, by what was found or declared. */
static double sensor_zero_Nm(const cli_tuning *t)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    double zero_Nm = 0.0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; j < list->effect[k].count; ++j) {
            const hci_effect_term *term = &list->effect[k].term[j];
            const hci_effect_parameter *of = &list->effect[k].type->parameter[term->parameter];
            if ((of->traits & HCI_PARAMETER_OF_TRANSDUCER) && strcmp(of->unit, "Nm") == 0 && !of->ordered)
                zero_Nm += term->value;
        }
    return zero_Nm;
}

/* The largest of the torques of a map, whose rows are means each; 0 of any other recording. */
static double most_of_map(const hci_run *r, double zero_Nm)
{
    double most_Nm = 0.0;
    for (size_t n = 0; r->only_mean && r->torque_source == HCI_TORQUE_MEASURED && n < r->count; ++n)
        most_Nm = fmax(most_Nm, fabs(r->torque_Nm[n] - zero_Nm));
    return most_Nm;
}

static recorded recorded_of(const cli_tuning *t)
{
    const double Nm_per_A = t->reading.run.torque_constant_Nm_per_A;
    recorded x = {0.0, 0.0, 0.0, sensor_zero_Nm(t)};
    for (size_t k = 0; k < t->diagnosis.runs; ++k)
        if (t->diagnosis.run[k].source == HCI_TORQUE_MEASURED)
            x.mean_Nm = fmax(x.mean_Nm, fabs(t->diagnosis.run[k].mean_torque_Nm - x.zero_Nm));
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const size_t count = cli_tune_has_no_current(t, r) ? 0 : 3 * r->count;
        x.mean_Nm = fmax(x.mean_Nm, most_of_map(r, x.zero_Nm));
        for (size_t n = 0; n < count; ++n)
            x.current_Nm = fmax(x.current_Nm, fabs(r->i_A[n]) * Nm_per_A);
        if (count > 0 && r->torque_source == HCI_TORQUE_HOLDING && hci_run_is_loaded(r, r->pole_pairs))
            x.brake_Nm = fmax(x.brake_Nm, mean_length_A(r) * Nm_per_A);
    }
    return x;
}

/* Three digits are enough of a torque that nobody asked for. */
static double rounded(double x)
{
    char text[32];
    double value = 0.0;
    snprintf(text, sizeof text, "%.2g", x);
    sscanf(text, "%lf", &value);
    return value;
}

static double rounded_down(double x)
{
    const double digit = pow(10.0, floor(log10(x)) - 1.0);
    return rounded(digit * floor(x / digit));
}

/* The most that is taken of the torque that a sine of the rated current makes, where nobody asked for one. */
static const double OF_RATED = 0.9;

/* A mean torque below this share of what the currents could make is friction or the zero of the sensor. */
static const double LEAST_LOAD = 0.02;

/* A torque that nobody asked for, in percent of the one that was meant: in what steps it is less, and at
 * least. */
enum { STEP_PERCENT = 5, LEAST_PERCENT = 70 };

#define LITTLE_OUTSIDE 0.05 /* of the largest recorded current, by which currents go beyond it */

/* A mean torque, and why it is that. */
typedef struct {
    double mean_Nm;
    const char *why;
} wanted_torque;

static bool is_measured(const recorded *x)
{
    return x->mean_Nm > LEAST_LOAD * x->current_Nm && x->current_Nm > 0.0;
}

/* Of recordings with a load. */
static wanted_torque of_load(const recorded *x)
{
    if (!is_measured(x))
        return (wanted_torque){rounded(x->brake_Nm), "what the recorded current makes against its load"};
    return (wanted_torque){
        rounded(x->mean_Nm),
        fabs(x->zero_Nm) > 0.0
            ? "the largest mean torque of the recordings, less the zero of its sensor; up to there they tell "
              "what to expect"
            : "the largest mean torque of the recordings; up to there they tell what to expect"};
}

/* Of recordings without a load. rated_Nm, of_1_A_Nm: what the rated current and 1 A make. */
static wanted_torque without_load(const recorded *x, double rated_Nm, double of_1_A_Nm)
{
    if (rated_Nm > 0.0)
        return (wanted_torque){rounded(rated_Nm / 3.0),
                               "what a third of the rated current makes; no recording has a load"};
    if (x->current_Nm > 0.0)
        return (wanted_torque){
            rounded(x->current_Nm),
            "what the largest recorded current makes; nothing is rated, and no recording has a load"};
    return (wanted_torque){rounded(of_1_A_Nm),
                           "what 1 A makes; nothing is rated, and no recording has a load"};
}

static wanted_torque wanted_of(const cli_tuning *t, const recorded *x, double rated_Nm)
{
    const double sheet_Nm = t->declared.rated_torque_Nm, load_Nm = is_measured(x) ? x->mean_Nm : x->brake_Nm;
    if (t->arguments->given[TUNE_TORQUE])
        return (wanted_torque){t->arguments->number[TUNE_TORQUE], "as asked for by --torque"};
    if (sheet_Nm > 0.0 && !(load_Nm > 0.0 && load_Nm < sheet_Nm))
        return (wanted_torque){sheet_Nm, "the rated torque"};
    return load_Nm > 0.0 ? of_load(x) : without_load(x, rated_Nm, t->reading.run.torque_constant_Nm_per_A);
}

/* Whether nobody asked for a torque. */
static bool is_chosen(const cli_tuning *t)
{
    return !t->arguments->given[TUNE_TORQUE] && !(t->declared.rated_torque_Nm > 0.0);
}

static wanted_torque choose_torque(cli_tuning *t)
{
    const double rated_Nm = t->declared.rated_current_A * t->reading.run.torque_constant_Nm_per_A;
    const recorded x = recorded_of(t);
    wanted_torque wanted = wanted_of(t, &x, rated_Nm);
    t->has_load = is_measured(&x);
    if (is_chosen(t) && rated_Nm > 0.0 && wanted.mean_Nm > OF_RATED * rated_Nm)
        wanted = (wanted_torque){
            rounded_down(OF_RATED * rated_Nm),
            "nine tenths of what a sine of the rated current makes; what takes the ripple away heats, too"};
    return wanted;
}

static hci_status read_corrected(cli_tuning *t, hci_note *note)
{
    char machine[CLI_TUNE_PATH];
    cli_tune_path(t, "diagnose/machine", machine);
    hci_status status = hci_machine_read(machine, &t->corrected, note);
    if (!status) status = hci_effects_read_machine(machine, &t->found, note);
    if (!status) status = hci_uncertainty_read_machine(machine, &t->uncertainty, note);
    return status;
}

static hci_status target_set(cli_tuning *t, const wanted_torque *wanted, hci_note *note)
{
    char path[CLI_TUNE_PATH];
    cli_tune_path(t, "target.csv", path);
    t->mean_Nm = wanted->mean_Nm;
    hci_tuning_say(&t->tuning, HCI_TUNING_WANTED, "a torque without ripple of %.4g N·m: %s", t->mean_Nm,
                   wanted->why);
    const hci_status status = hci_tuning_write_target(t->out, t->mean_Nm, note);
    hci_target_release(&t->target);
    return status ? status : hci_target_read(path, &t->target, note);
}

/* A sine of the rated current heats as much as is allowed: so much rms in each phase. */
static void limit_heat(cli_tuning *t, hci_solve_options *o, char text[32], cli_tune_line *c)
{
    if (!(t->corrected.rated_current_A > 0.0)) return;
    double rms_A = 0.0;
    snprintf(text, 32, "%.5g", t->corrected.rated_current_A / sqrt(2.0));
    sscanf(text, "%lf", &rms_A);
    for (int s = 0; s < 3; ++s)
        o->limits.rms_A[s] = rms_A;
    cli_tune_add_option(c, "limit-rms", text);
    hci_tuning_say(&t->tuning, HCI_TUNING_WANTED,
                   "within %s A rms in each phase, the heat of a sine of the rated current", text);
}

/* The current loop that is to make the currents. */
static void take_loop(const cli_tuning *t, hci_solve_options *o, cli_tune_line *c)
{
    const cli_arguments *a = t->arguments;
    if (!a->given[TUNE_BANDWIDTH]) return;
    o->loop_bandwidth_Hz = a->number[TUNE_BANDWIDTH];
    cli_tune_add_option(c, "bandwidth", a->value[TUNE_BANDWIDTH]);
    if (!a->given[TUNE_SPEED]) return;
    o->speed_rad_per_s = a->number[TUNE_SPEED] * HCI_PI / 30.0;
    cli_tune_add_option(c, "speed", a->value[TUNE_SPEED]);
}

static size_t with_current(const hci_effects *list)
{
    size_t count = 0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; j < list->effect[k].count && list->effect[k].type->in_machine; ++j)
            count += (list->effect[k].type->parameter[list->effect[k].term[j].parameter].traits &
                      HCI_PARAMETER_WITH_CURRENT) != 0;
    return count;
}

static void say_angle(cli_tuning *t, const char *angle_deg)
{
    if (fabs(t->current_angle_rad) > 0.0)
        hci_tuning_say(
            &t->tuning, HCI_TUNING_WANTED,
            "with the current at %s degrees in the rotor frame, as in the recordings: what another "
            "direction does at this torque they do not tell",
            angle_deg);
    else
        hci_tuning_say(&t->tuning, HCI_TUNING_WANTED,
                       "with i_q alone, as in the recordings: what an i_d does they do not tell");
}

/* By how much the logs read the electrical angle too much, as was found or declared: the angle of the
 * machine, in which the table is solved, is as much less. */
static double read_too_much_deg(const hci_effects *list)
{
    double angle_rad = 0.0;
    for (size_t k = 0; k < list->count; ++k)
        for (size_t j = 0; list->effect[k].type->is_angle_zero && j < list->effect[k].count; ++j)
            angle_rad += list->effect[k].term[j].value;
    return angle_rad * 180.0 / HCI_PI;
}

static bool inductances_are_declared(const hci_machine_data *m)
{
    return m->inductance_count > 0 || (m->inductance_d_H > 0.0 && m->inductance_q_H > 0.0);
}

/* Where all currents lie on one line or curve, what an effect that acts with the current makes off that line,
 * or a saliency that nobody declared, is supposed and not measured: the table keeps to it. */
static void keep_angle(cli_tuning *t, hci_solve_options *o, char text[32], cli_tune_line *c)
{
    double angle_deg;
    const bool is_open = with_current(&t->found.list) > with_current(&t->effects.list) ||
                         !inductances_are_declared(&t->corrected);
    t->keeps_angle = is_open && cli_tune_curve_is_kept(t, t->mean_Nm, &angle_deg);
    cli_tune_add_option(c, t->keeps_angle ? "method" : "auto", t->keeps_angle ? "pointwise" : NULL);
    if (!t->keeps_angle) return;
    angle_deg += read_too_much_deg(&t->found.list);
    if (fabs(angle_deg) < CLI_TUNE_LEAST_ANGLE_DEG) angle_deg = 0.0;
    snprintf(text, 32, "%.3g", angle_deg);
    sscanf(text, "%lf", &angle_deg);
    t->current_angle_rad = angle_deg * HCI_PI / 180.0;
    o->method = HCI_METHOD_POINTWISE;
    o->current_angle_rad = &t->current_angle_rad;
    cli_tune_add_option(c, "current-angle", text);
    say_angle(t, text);
}

static void note_target(cli_tuning *t)
{
    char mean[32];
    hci_number_text(t->mean_Nm, mean);
    cli_tune_note(t, "printf 'order,amplitude_Nm,phase_rad\\n0,%s,0\\n' >\"$OUT\"/target.csv\n", mean);
}

/* A torque of the angle alone has no mean: what there is of it is the zero of a torque sensor. */
static void take_mean_out(double open_Nm[HCI_TUNING_POINTS])
{
    double mean_Nm = 0.0;
    for (size_t k = 1; k < HCI_TUNING_POINTS; ++k)
        mean_Nm += open_Nm[k] / (HCI_TUNING_POINTS - 1);
    for (size_t k = 0; k < HCI_TUNING_POINTS; ++k)
        open_Nm[k] -= mean_Nm;
}

/* What the corrected machine makes without current, over the period of the currents. */
static hci_status open_torque(cli_tuning *t, hci_note *note)
{
    static double theta_m_rad[HCI_TUNING_POINTS], i_A[3 * HCI_TUNING_POINTS], still[HCI_TUNING_POINTS];
    hci_run run = {.count = HCI_TUNING_POINTS,
                   .pole_pairs = t->corrected.model.pole_pairs,
                   .theta_m_rad = theta_m_rad,
                   .speed_rad_per_s = still,
                   .i_A = i_A,
                   .turn_known = true};
    const double turns = fmax(1.0, (double)t->solution.period_turns) / run.pole_pairs;
    for (size_t k = 0; k < HCI_TUNING_POINTS; ++k)
        theta_m_rad[k] = 2.0 * HCI_PI * turns * (double)k / (HCI_TUNING_POINTS - 1);
    const hci_status status = hci_predict(&t->corrected, &t->found.list, &run, t->open_Nm, note);
    if (!status) take_mean_out(t->open_Nm);
    if (!status) t->tuning.open_Nm = t->open_Nm;
    return status;
}

static void leave_bound_out(hci_expected_ripple *e, hci_ripple_state why)
{
    if (e->state != HCI_RIPPLE_KNOWN) return;
    e->state = why;
    e->peak_to_peak_Nm = e->T_ripple_percent = e->middle_percent = e->error_peak_to_peak_Nm = NAN;
    e->worst_order = e->worst_order_Nm = e->mean_Nm = e->mean_error_Nm = e->outside_share = e->outside_A =
        NAN;
    e->recordings = 0;
}

/* Whether a recording shows a torque under load: by a torque sensor, or by the current of a slow turn. */
static bool shows_load(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source == HCI_TORQUE_MEASURED) return true;
        if (r->torque_source == HCI_TORQUE_HOLDING && hci_run_is_loaded(r, r->pole_pairs)) return true;
    }
    return false;
}

/* What was found stays, and no currents with it. */
static void note_out_of_reach(cli_tuning *t, hci_note *note)
{
    snprintf(t->out_of_reach, sizeof t->out_of_reach, "%s", note->text);
    *note = (hci_note){{0}};
    t->tuning.solved = HCI_OK;
}

/* Solves for a torque; out of reach: the model makes it with no current of the direction that is kept. */
static hci_status solve_for(cli_tuning *t, const wanted_torque *wanted, hci_note *note)
{
    char machine[CLI_TUNE_PATH], target[CLI_TUNE_PATH], folder[CLI_TUNE_PATH], rms[32], angle[32];
    cli_tune_path(t, "diagnose/machine", machine);
    cli_tune_path(t, "target.csv", target);
    cli_tune_path(t, "currents", folder);
    cli_tune_line c = {{"solve", machine, "--target", target, "--report", "-o", folder}, 7};
    hci_solve_options options = {.target = &t->target,
                                 .effects = &t->found.list,
                                 .uncertainty = &t->uncertainty,
                                 .progress = cli_progress};
    const hci_status status = target_set(t, wanted, note);
    if (status) return status;
    take_loop(t, &options, &c);
    keep_angle(t, &options, angle, &c);
    limit_heat(t, &options, rms, &c);
    note_target(t);
    cli_tune_note_line(t, &c, true);
    t->tuning.solved = hci_solve(&t->corrected, &options, &t->solution, note);
    cli_progress_end();
    return HCI_OK;
}

static bool is_out_of_reach(const cli_tuning *t)
{
    return t->tuning.solved == HCI_ERROR_NUMERIC && t->keeps_angle;
}

static bool has_higher_powers(const hci_effects *list)
{
    for (size_t k = 0; k < list->count; ++k)
        if (list->effect[k].type->beyond_quadratic) return true;
    return false;
}

/* The share of a torque at which its currents, which grow about as it does, lie within what was recorded,
 * where the iron saturates: beyond that its powers of the current say little. 1: they lie there. */
static double recorded_share(const cli_tuning *t)
{
    const hci_expected_ripple *e = &t->solution.expected;
    const double most_A = fmax(fmax(fabs(e->measured_id_A.least), fabs(e->measured_id_A.most)),
                               fmax(fabs(e->measured_iq_A.least), fabs(e->measured_iq_A.most)));
    if (e->state != HCI_RIPPLE_KNOWN || !has_higher_powers(&t->found.list)) return 1.0;
    return e->outside_A > LITTLE_OUTSIDE * most_A ? most_A / (most_A + e->outside_A) : 1.0;
}

/* The percent of the chosen torque to be solved for next; the same: it was the last. */
static int next_percent(const cli_tuning *t, int percent)
{
    const int within = (int)floor(percent * recorded_share(t) / STEP_PERCENT) * STEP_PERCENT;
    const int next = is_out_of_reach(t) ? percent - STEP_PERCENT : within;
    return !is_chosen(t) ? percent : next > LEAST_PERCENT ? next : LEAST_PERCENT;
}

/* Why a torque is less than the chosen one. */
static void say_less(const wanted_torque *chosen, int percent, bool is_reached, char *why, size_t size)
{
    const int what = (int)strcspn(chosen->why, ";");
    snprintf(why, size, "%d %% of the %.4g N·m that is %.*s: %s", percent, chosen->mean_Nm, what, chosen->why,
             is_reached ? "at more the ripple takes currents to where none were recorded"
                        : "more the model does not make at every angle, since beyond what was recorded its "
                          "torque falls with more current");
}

/* A torque that nobody asked for is less where the model does not reach it or currents of a saturating
 * machine go beyond what was recorded. */
static hci_status solve_within_reach(cli_tuning *t, hci_note *note)
{
    const wanted_torque chosen = choose_torque(t);
    char *said = t->tuning.part[HCI_TUNING_WANTED] + strlen(t->tuning.part[HCI_TUNING_WANTED]);
    char *noted = t->tuning.commands + strlen(t->tuning.commands);
    char why[512];
    if (!(chosen.mean_Nm > 0.0) && !t->arguments->given[TUNE_TORQUE]) return HCI_OK;
    t->has_torque = true;
    hci_status status = solve_for(t, &chosen, note);
    int percent = 100;
    for (int next; !status && (next = next_percent(t, percent)) < percent; percent = next) {
        say_less(&chosen, next, !is_out_of_reach(t), why, sizeof why);
        *said = *noted = '\0';
        *note = (hci_note){{0}};
        hci_solution_release(&t->solution);
        status = solve_for(t, &(wanted_torque){rounded(0.01 * next * chosen.mean_Nm), why}, note);
    }
    return status;
}

/* Of recordings that show no torque under load, a bound that is more than the torque says no more than none,
 * however many they are. */
static void leave_void_bound_out(cli_tuning *t)
{
    if (!shows_load(t) && cli_tune_is_boundless(t))
        leave_bound_out(&t->solution.expected, HCI_RIPPLE_UNLOADED);
}

/* The currents that were solved, for the report. */
static hci_status write_solved(cli_tuning *t, hci_note *note)
{
    char machine[CLI_TUNE_PATH], target[CLI_TUNE_PATH], folder[CLI_TUNE_PATH];
    cli_tune_path(t, "diagnose/machine", machine);
    cli_tune_path(t, "target.csv", target);
    cli_tune_path(t, "currents", folder);
    t->is_solved = true;
    leave_void_bound_out(t);
    t->solution.expected.if_in_time = cli_tune_hangs_on_lag(t);
    t->tuning.solution = &t->solution;
    return hci_solution_write_with_report(&t->corrected, &t->solution, t->tuning.solved,
                                          &(hci_report_sources){.machine = machine, .target = target}, folder,
                                          note);
}

hci_status cli_tune_solve(cli_tuning *t, hci_note *note)
{
    if (!cli_tune_can_solve(t)) return HCI_OK;
    hci_status status = read_corrected(t, note);
    if (!status) status = solve_within_reach(t, note);
    if (status || !t->has_torque) return status;
    if (cli_tune_is_coarse(t)) leave_bound_out(&t->solution.expected, HCI_RIPPLE_UNTOLD);
    const bool without = is_out_of_reach(t);
    if (t->tuning.solved > HCI_NOT_REACHED && !without) return t->tuning.solved;
    if (without) note_out_of_reach(t, note);
    status = open_torque(t, note);
    return status || without ? status : write_solved(t, note);
}
