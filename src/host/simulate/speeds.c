/* The grid: for each speed and remedy one run of the sampled drive at a constant speed. */
#include "hci/host/simulate/speeds.h"

#include <math.h>
#include <string.h>

#include "core/drive/table_code.h"
#include "hci/host/simulate/simulate.h"
#include "host/base/memory.h"
#include "host/currents/plain_sine.h"
#include "host/drive/level_mix.h"
#include "host/drive/loop_set.h"
#include "host/drive/turn_samples.h"

#define NAME_OF(value, word) [value] = word,
static const char *const NAMES[] = {HCI_REMEDY_NAMES(NAME_OF)};
#undef NAME_OF

const char *hci_remedy_name(hci_remedy remedy)
{
    return NAMES[remedy];
}

typedef struct {
    const hci_speeds_request *request;
    hci_speeds *result;
    hci_note *note;
    hci_machine_data machine; /* fitted */
    hci_machine_model known;  /* as the decoupling knows it */
    hci_loop_set set;
    float *memory; /* for tables */
    double sine_A;
    size_t runs, done;
} grid;

/* ---- one run ---- */

enum { STEPS_OF_A_SAMPLE = 10 };

/* Time constants of the winding, and of the slowest pole of the closed loop, until the start is forgotten,
 * and seconds that are evaluated at least. */
static const double SETTLE = 12.0, LEAST_s = 0.2;

static const double TURNS = 2.02;       /* of the shaft, that are evaluated at least */
static const double MOST_SAMPLES = 3e8; /* in them: hours */

static void fill_scenario(const grid *g, double speed_rad_per_s, hci_scenario *s)
{
    const hci_drive_data *d = g->request->drive;
    const hci_loop_model loop = hci_drive_loop(d, &g->known, speed_rad_per_s * g->machine.model.pole_pairs);
    const double winding_s =
        fmax(g->known.inductance_H[0], g->known.inductance_H[1]) / g->known.resistance_ohm;
    const double slow_s = fmax(winding_s, hci_loop_slowest_s(&loop));
    hci_scenario_init(s);
    s->step_s = d->sample_s / STEPS_OF_A_SAMPLE;
    s->settle_s = SETTLE * slow_s + 200.0 * d->sample_s;
    s->duration_s = s->settle_s + fmax(LEAST_s, TURNS * 2.0 * HCI_PI / fabs(speed_rad_per_s));
    s->prescribed_speed_rad_per_s = speed_rad_per_s;
    s->torque_reference_Nm = g->request->torque_Nm;
    s->current_control = HCI_CURRENT_PI;
    s->current_sample_time_s = d->sample_s;
    s->current_kp_ohm = d->kp_ohm;
    s->current_ki_V_per_As = d->ki_ohm_per_s;
    s->current_kp_q_ohm = d->kp_q_ohm;
    s->current_ki_q_V_per_As = d->ki_q_ohm_per_s;
    s->current_filter_s = d->filter_s;
    s->computing_delay_s = s->step_s * floor(d->computing_delay_s / s->step_s + 0.5);
    s->decoupling = d->decoupling != HCI_DECOUPLING_NONE;
    s->dc_link_voltage_V = d->dc_link_voltage_V;
    s->dead_time_s = hci_drive_dead_share(d) * d->sample_s; /* in each sample */
    s->dead_time_crossing_A = d->dead_time_crossing_A;
    s->dead_time_compensation = d->dead_time_compensation;
    s->current_quantum_A = d->current_quantum_A;
    s->encoder_counts = d->encoder_counts;
}

typedef struct {
    const grid *grid;
    double settle_s, duration_s, told_s; /* told_s: when progress was told last */
    double line_V;
} voltage_watch;

static hci_status watch_from(void *context, const hci_simulation_plan *plan, hci_note *note)
{
    voltage_watch *w = context;
    (void)note;
    w->settle_s = plan->settle_s;
    return HCI_OK;
}

/* share: of the run that is going on. */
static void tell(const grid *g, double share)
{
    const hci_speeds_request *q = g->request;
    if (q->progress)
        q->progress(q->progress_context, "simulating", ((double)g->done + share) / (double)g->runs);
}

/* So that the slowest speeds are told of too: some tens of milliseconds of a processor. */
static const double TOLD_SAMPLES = 5000.0;

static void tell_time(voltage_watch *w, double time_s)
{
    const double every_s = fmin(0.01 * w->duration_s, TOLD_SAMPLES * w->grid->request->drive->sample_s);
    if (time_s - w->told_s < every_s) return;
    w->told_s = time_s;
    tell(w->grid, time_s / w->duration_s);
}

static void watch_voltage(void *context, const hci_simulation_step *step)
{
    voltage_watch *w = context;
    double abc[3];
    tell_time(w, step->time_s);
    if (step->time_s < w->settle_s) return;
    hci_plane_to_abc(step->v_V, abc);
    w->line_V = fmax(w->line_V, fmax(abc[0], fmax(abc[1], abc[2])) - fmin(abc[0], fmin(abc[1], abc[2])));
}

static void start_code(const grid *g, hci_remedy remedy, double speed_rad_per_s, hci_table_code *code)
{
    memset(code, 0, sizeof *code);
    code->pole_pairs = (uint32_t)g->machine.model.pole_pairs;
    code->counts = (uint32_t)g->request->drive->encoder_counts;
    code->sine_A = (float)g->sine_A;
    if (remedy == HCI_REMEDY_SINE) return;
    hci_loop_start(&code->tables, &g->set.loop, (hci_loop_remedy)(remedy - HCI_REMEDY_TABLE), g->memory);
    hci_loop_make(&code->tables, (float)(speed_rad_per_s * g->machine.model.pole_pairs));
}

/* machine: the one that is driven; that of the grid, or one that is not as it is believed. */
static hci_status run(grid *g, const hci_machine_data *machine, hci_remedy remedy, double speed_rad_per_s,
                      hci_speed_result *result)
{
    hci_table_code code;
    voltage_watch watch = {.grid = g};
    hci_scenario scenario;
    hci_simulation s;
    const hci_simulation_observer observer = {watch_from, watch_voltage, &watch};
    fill_scenario(g, speed_rad_per_s, &scenario);
    watch.duration_s = scenario.duration_s;
    start_code(g, remedy, speed_rad_per_s, &code);
    const hci_simulate_loop loop = {
        {hci_table_code_at, &code}, &g->known.table, g->request->drive->modulation};
    const hci_effects none = {NULL, 0};
    const hci_simulate_options options = {
        .effects = g->request->effects ? g->request->effects : &none, .loop = &loop, .observer = &observer};
    const hci_status status = hci_simulate(machine, &scenario, &options, &s, g->note);
    if (status) return status;
    *result = (hci_speed_result){.mean_Nm = s.torque_Nm.mean,
                                 .T_ripple_percent = s.T_ripple_percent,
                                 .F_ripple_percent = s.F_ripple_percent,
                                 .ripple_Nm = s.torque_Nm.most - s.torque_Nm.least,
                                 .peak_A = s.peak_phase_A,
                                 .line_V = watch.line_V,
                                 .limited_share = (double)s.voltage_limited / (double)s.samples,
                                 .worst_T_ripple_percent = (double)NAN};
    hci_simulation_release(&s);
    ++g->done;
    tell(g, 0.0);
    return HCI_OK;
}

/* ---- a machine that is not as it is believed ---- */

enum { CORNERS = 8 };

typedef struct {
    hci_machine_data machine;
    hci_wave *back_emf;
    hci_inductance *inductance;
} other_machine;

static void release_other(other_machine *o)
{
    hci_memory_free(o->back_emf);
    hci_memory_free(o->inductance);
}

/* R, L and flux by factors 1 ± error, as the bits of the corner say. */
static hci_status make_other(const hci_machine_data *machine, double error, int corner, other_machine *o)
{
    const double r = 1.0 + (corner & 1 ? error : -error), l = 1.0 + (corner & 2 ? error : -error),
                 flux = 1.0 + (corner & 4 ? error : -error);
    const size_t waves = machine->model.back_emf_count, terms = machine->inductance_count;
    o->machine = *machine;
    o->back_emf = hci_memory_new(waves, sizeof *o->back_emf);
    o->inductance = hci_memory_new(terms, sizeof *o->inductance);
    if (!o->back_emf || !o->inductance) return HCI_ERROR_MEMORY;
    for (size_t k = 0; k < waves; ++k) {
        o->back_emf[k] = machine->model.back_emf[k];
        o->back_emf[k].sine *= flux;
        o->back_emf[k].cosine *= flux;
    }
    for (size_t k = 0; k < terms; ++k) {
        o->inductance[k] = machine->inductance[k];
        for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
            o->inductance[k].sine[q] *= l;
            o->inductance[k].cosine[q] *= l;
        }
    }
    o->machine.resistance_ohm *= r;
    o->machine.inductance_d_H *= l;
    o->machine.inductance_q_H *= l;
    o->machine.model.back_emf = o->back_emf;
    o->machine.inductance = terms > 0 ? o->inductance : NULL;
    return HCI_OK;
}

static hci_status run_corners(grid *g, hci_remedy remedy, double speed_rad_per_s, hci_speed_result *result)
{
    hci_status status = HCI_OK;
    double worst = 0.0;
    for (int corner = 0; corner < CORNERS && !status; ++corner) {
        other_machine o = {.back_emf = NULL};
        hci_speed_result r;
        status = make_other(&g->machine, g->request->model_error, corner, &o);
        if (status) status = hci_note_memory(g->note, NULL, "the machine");
        if (!status) status = run(g, &o.machine, remedy, speed_rad_per_s, &r);
        if (!status) worst = fmax(worst, r.T_ripple_percent);
        release_other(&o);
    }
    result->worst_T_ripple_percent = worst;
    return status;
}

/* ---- the grid ---- */

static hci_status run_speed(grid *g, hci_speed_row *row)
{
    hci_status status = HCI_OK;
    for (int k = 0; k < HCI_REMEDIES && !status; ++k) {
        status = run(g, &g->machine, (hci_remedy)k, row->speed_rad_per_s, &row->remedy[k]);
        if (!status && g->request->model_error > 0.0)
            status = run_corners(g, (hci_remedy)k, row->speed_rad_per_s, &row->remedy[k]);
    }
    const hci_loop_f32 *loop = &g->set.loop;
    const double p = g->machine.model.pole_pairs;
    for (uint32_t k = 0; k < loop->order_count; ++k)
        row->orders_short += (double)loop->ranges[k].whole_rad_per_s < p * fabs(row->speed_rad_per_s);
    return status;
}

/* Of the plain sine's ripple: less is what single precision and the sampling of a turn make of two equal
 * ones. */
static const double WORSE = 1e-3;

/* Of the torque that is asked for. */
static const double SAME_TORQUE = 0.1, LEAST_TORQUE = 0.5;

bool hci_speeds_is_comparable(const hci_speeds *s, size_t row, hci_remedy remedy)
{
    const hci_speed_result *of = s->row[row].remedy, *sine = &of[HCI_REMEDY_SINE];
    return sine->mean_Nm * s->torque_Nm >= LEAST_TORQUE * s->torque_Nm * s->torque_Nm &&
           fabs(of[remedy].mean_Nm - sine->mean_Nm) <= SAME_TORQUE * fabs(s->torque_Nm);
}

bool hci_speeds_is_worse(const hci_speeds *s, size_t row, hci_remedy remedy)
{
    const hci_speed_result *of = s->row[row].remedy;
    return hci_speeds_is_comparable(s, row, remedy) &&
           of[remedy].T_ripple_percent > (1.0 + WORSE) * of[HCI_REMEDY_SINE].T_ripple_percent;
}

/* Where the remedy's ripple passes that of the plain sine, straight between the speeds. */
static double harmful_from(const hci_speeds *s, int remedy)
{
    double before = -1.0, speed_before = 0.0;
    for (size_t k = 0; k < s->count; ++k) {
        const hci_speed_row *row = &s->row[k];
        const double more =
            row->remedy[remedy].T_ripple_percent - row->remedy[HCI_REMEDY_SINE].T_ripple_percent;
        const bool is_worse = hci_speeds_is_worse(s, k, (hci_remedy)remedy);
        if (is_worse && k == 0) return row->speed_rad_per_s;
        if (is_worse) return speed_before + (row->speed_rad_per_s - speed_before) * before / (before - more);
        before = fmin(more, 0.0);
        speed_before = row->speed_rad_per_s;
    }
    return HUGE_VAL;
}

static hci_loop_task task_of(const grid *g)
{
    const hci_speeds_request *q = g->request;
    return (hci_loop_task){&g->machine, q->drive, q->levels, q->level_count, 0.0, 0.0, q->effects};
}

/* The level nearest to the torque. */
static size_t level_of(const hci_speeds_request *q)
{
    size_t level = 0;
    for (size_t k = 1; k < q->level_count; ++k)
        if (fabs(q->levels[k].torque_Nm - q->torque_Nm) < fabs(q->levels[level].torque_Nm - q->torque_Nm))
            level = k;
    return level;
}

/* What the points of loop.csv do not tell. */
static void fill_response(grid *g)
{
    const hci_loop_task task = task_of(g);
    g->result->response_error = hci_loop_set_response_error(&g->set);
    for (size_t k = 0; k < g->result->count; ++k)
        g->result->row[k].response_ripple_percent = hci_loop_set_response_percent(
            &g->set, &task, level_of(g->request), g->result->row[k].speed_rad_per_s);
}

/* The dc link that currents need at each speed. */
static hci_status find_links(const grid *g, const hci_machine_model *model, const hci_loop_level *level,
                             double *(*of_row)(hci_speed_row *))
{
    hci_turn_samples samples;
    const hci_status status = hci_turn_samples_make(model, NULL, level, &samples, g->note);
    for (size_t k = 0; k < g->result->count && !status; ++k)
        *of_row(&g->result->row[k]) =
            hci_turn_samples_dc_link_V(&samples, model->resistance_ohm, g->request->drive->modulation,
                                       g->result->row[k].speed_rad_per_s * g->machine.model.pole_pairs);
    hci_turn_samples_release(&samples);
    return status;
}

static double *needed_of(hci_speed_row *row)
{
    return &row->needed_V;
}

static double *back_emf_of(hci_speed_row *row)
{
    return &row->back_emf_V;
}

/* Of the currents at the torque, and of no current. */
static hci_status fill_needed(grid *g)
{
    const hci_loop_level none = {0.0, NULL, 0};
    const hci_speeds_request *q = g->request;
    hci_level_mix asked;
    hci_machine_model model;
    hci_status status = hci_machine_model_make_whole(&g->machine, q->effects, &model, g->note);
    if (status) return status;
    status = hci_level_mix_make(&g->set.loop, q->levels, q->torque_Nm, &asked, g->note);
    if (!status) status = find_links(g, &model, &asked.level, needed_of);
    if (!status) status = find_links(g, &model, &none, back_emf_of);
    hci_level_mix_release(&asked);
    hci_machine_model_release(&model);
    return status;
}

static hci_status check_torque(const hci_speeds_request *q, hci_note *note)
{
    const double low = q->levels[0].torque_Nm, high = q->levels[q->level_count - 1].torque_Nm;
    const double margin = 1e-9 * fmax(fabs(low), fabs(high));
    if (q->torque_Nm >= low - margin && q->torque_Nm <= high + margin) return HCI_OK;
    if (q->level_count == 1)
        return hci_note_set(
            note, HCI_ERROR_ARGUMENT,
            "a torque of %.8g N·m is asked of a table of one level, which makes %.8g N·m whatever is "
            "asked for; with surface magnets --per-torque makes levels from -T to T of it, else give "
            "the folders of several levels",
            q->torque_Nm, low);
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "a torque of %.8g N·m is not within the levels of the table, %.8g to %.8g N·m; give the folder of "
        "another one",
        q->torque_Nm, low, high);
}

/* Whether the turns that are evaluated end. */
static hci_status check_slow(const hci_drive_data *d, double speed_rad_per_s, hci_note *note)
{
    const double least_rad_per_s = TURNS * 2.0 * HCI_PI / (MOST_SAMPLES * d->sample_s);
    if (fabs(speed_rad_per_s) >= least_rad_per_s) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "a speed of %g rpm has more samples in two turns of the shaft than are simulated, %g; "
        "expected at least %.2g rpm with a `current_sample_time` of %g s",
        speed_rad_per_s * 30.0 / HCI_PI, MOST_SAMPLES, least_rad_per_s * 30.0 / HCI_PI, d->sample_s);
}

static hci_status prepare(grid *g)
{
    const hci_speeds_request *q = g->request;
    const hci_loop_task task = task_of(g);
    hci_status status = check_torque(q, g->note);
    if (!status) status = hci_drive_fit(q->drive, q->machine, &g->machine, g->note);
    for (size_t k = 0; k < q->speed_count && !status; ++k)
        status = hci_drive_check_speed(q->drive, &g->machine, q->speeds_rad_per_s[k], g->note);
    for (size_t k = 0; k < q->speed_count && !status; ++k)
        status = check_slow(q->drive, q->speeds_rad_per_s[k], g->note);
    if (!status)
        status = q->drive->decoupling == HCI_DECOUPLING_TABLE
                     ? hci_machine_model_make(&g->machine, &g->known, g->note)
                     : hci_machine_model_make_constant(&g->machine, &g->known, g->note);
    if (!status) status = hci_loop_set_make(&task, &g->set, g->note);
    if (status) return status;
    g->memory = hci_memory_new(hci_loop_floats(&g->set.loop, HCI_LOOP_FEEDFORWARD), sizeof *g->memory);
    g->result->row = hci_memory_new(q->speed_count, sizeof *g->result->row);
    if (!g->memory || !g->result->row) return hci_note_memory(g->note, NULL, "the speeds");
    const hci_wave sine = hci_plain_sine(&g->machine.model, q->torque_Nm);
    g->sine_A = (q->torque_Nm < 0.0 ? -1.0 : 1.0) * hci_amplitude(sine.sine, sine.cosine);
    g->runs = q->speed_count * HCI_REMEDIES * (q->model_error > 0.0 ? 1 + CORNERS : 1);
    return HCI_OK;
}

static hci_status fill(grid *g)
{
    const hci_speeds_request *q = g->request;
    hci_speeds *r = g->result;
    hci_status status = HCI_OK;
    r->count = q->speed_count;
    for (size_t k = 0; k < r->count; ++k)
        r->row[k].speed_rad_per_s = q->speeds_rad_per_s[k];
    status = fill_needed(g);
    fill_response(g);
    for (size_t k = 0; k < r->count && !status; ++k)
        status = run_speed(g, &r->row[k]);
    r->torque_Nm = q->torque_Nm;
    r->model_error = q->model_error;
    r->dc_link_V = q->drive->dc_link_voltage_V;
    r->reached_V = r->dc_link_V * (1.0 - 2.0 * hci_drive_dead_share(q->drive));
    r->lead_s = (double)g->set.loop.lead_s;
    const hci_loop_task task = task_of(g);
    r->highest_order = hci_loop_set_highest_order(&g->set);
    r->coarse_mean_Nm = hci_loop_set_coarse_mean_Nm(&g->set, &task, q->torque_Nm);
    r->voltage_rad_per_s = g->set.voltage_rad_per_s;
    r->sampled_rad_per_s = g->set.sampled_rad_per_s;
    r->measured_rad_per_s = g->set.measured_rad_per_s;
    for (int k = 0; k < HCI_REMEDIES && !status; ++k)
        r->harmful_rad_per_s[k] = k == HCI_REMEDY_SINE ? HUGE_VAL : harmful_from(r, k);
    return status;
}

hci_status hci_simulate_speeds(const hci_speeds_request *request, hci_speeds *speeds, hci_note *note)
{
    grid g;
    memset(&g, 0, sizeof g);
    memset(speeds, 0, sizeof *speeds);
    g.request = request;
    g.result = speeds;
    g.note = note;
    hci_status status = prepare(&g);
    if (!status) status = fill(&g);
    if (status) hci_speeds_release(speeds);
    hci_loop_set_release(&g.set);
    hci_machine_model_release(&g.known);
    hci_memory_free(g.memory);
    return status;
}

void hci_speeds_release(hci_speeds *speeds)
{
    hci_memory_free(speeds->row);
    memset(speeds, 0, sizeof *speeds);
}
