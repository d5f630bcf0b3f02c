/* A torque sensor that is slow, that swings, or whose zero is off:
 *
 *     y'' + 2ζω_n y' + ω_n² y = ω_n² T      τ z' + z = y      T_read = z + offset
 *
 * By the trapezoidal rule with the torque linear between samples, in steps that are short beside the
 * resonance; each derivative by a parameter is the same filter with another input, exactly so in discrete
 * time. */
#include "core/effects/sensor_stage.h"
#include "core/effects/type.h"

#include <string.h>

enum { TIME_CONSTANT, NATURAL_FREQUENCY, DAMPING, OFFSET };

static const hci_effect_parameter PARAMETER[] = {
    HCI_PLAIN("time_constant", "s", "of a first-order lag; 0: none", 0.0, 0.0,
              HCI_PARAMETER_OF_TRANSDUCER | HCI_PARAMETER_ALONG_TIME | HCI_PARAMETER_LAG),
    HCI_PLAIN("natural_frequency", "Hz", "of the resonance; 0: none", 0.0, 0.0,
              HCI_PARAMETER_OF_TRANSDUCER | HCI_PARAMETER_ALONG_TIME),
    HCI_PLAIN("damping", "1", "damping ratio of the resonance", 0.05, 0.0,
              HCI_PARAMETER_OF_TRANSDUCER | HCI_PARAMETER_ALONG_TIME),
    HCI_PLAIN("offset", "Nm", "read too much", 0.0, -DBL_MAX,
              HCI_PARAMETER_OF_TRANSDUCER | HCI_PARAMETER_LINEAR),
};

static double torque(const hci_effect *effect, const hci_effect_term *term, const hci_machine *machine,
                     const hci_sample *truth, hci_effect_torque *sum)
{
    (void)effect;
    (void)machine;
    (void)truth;
    if (term->parameter != OFFSET) return 0.0;
    sum->torque_Nm += term->value;
    return 1.0;
}

/* ---- stages ---- */

/* Resonance, then lag; those that there are. */
static size_t stages_of(const hci_effect *effect, hci_sensor_stage stages[2])
{
    const double frequency = hci_effect_value(effect, NATURAL_FREQUENCY);
    const double tau = hci_effect_value(effect, TIME_CONSTANT);
    size_t count = 0;
    if (frequency > 0.0)
        stages[count++] =
            (hci_sensor_stage){2.0 * HCI_PI * frequency, hci_effect_value(effect, DAMPING), 0.0};
    if (tau > 0.0) stages[count++] = (hci_sensor_stage){0.0, 0.0, tau};
    return count;
}

/* ---- along a run ---- */

/* The input that makes the stage answer with ∂y/∂parameter, of one that it has. */
static double input_for(const hci_sensor_stage *s, const hci_stage_state *m, size_t parameter)
{
    const double error = m->input - m->y;
    if (parameter == TIME_CONSTANT) return -error / s->tau_s;
    if (parameter == DAMPING) return -2.0 * m->v / s->omega;
    return 4.0 * HCI_PI * (error * s->omega - s->damping * m->v) / (s->omega * s->omega);
}

/* ---- the torque, with the derivatives by what the stage does ---- */

enum { OWN = sizeof PARAMETER / sizeof *PARAMETER };

/* What the stage answers with to its own parameters: the same filter with another input, step by step. */
typedef struct {
    size_t count;
    size_t term[OWN], parameter[OWN];
    hci_stage_state state[OWN];
} own_answers;

/* Those that the stage has. */
static void answers_find(const hci_effect *effect, const hci_sensor_stage *s, own_answers *own)
{
    *own = (own_answers){.count = 0};
    for (size_t j = 0; j < effect->count; ++j) {
        const size_t parameter = effect->term[j].parameter;
        const bool has = s->omega > 0.0 ? parameter == DAMPING || parameter == NATURAL_FREQUENCY
                                        : parameter == TIME_CONSTANT;
        if (!has) continue;
        own->term[own->count] = j;
        own->parameter[own->count++] = parameter;
    }
}

static void go_on(const hci_sensor_stage *s, const hci_stage_part *part, double input, hci_stage_state *m,
                  own_answers *own)
{
    hci_stage_go_on(part, m, input);
    for (size_t j = 0; j < own->count; ++j)
        hci_stage_go_on(part, &own->state[j], input_for(s, m, own->parameter[j]));
}

/* Sample k. before: in and out, the input of the sample before the last one. */
static void answer(const hci_sensor_stage *s, const hci_effect_run *run, size_t k, double *before,
                   hci_stage_state *m, own_answers *own)
{
    const double step_s = k > 0 ? run->time_s[k] - run->time_s[k - 1] : -1.0, to = run->torque_Nm[k];
    const bool even = hci_stage_is_even(run->time_s, run->count, k);
    const hci_stage_inputs x = {*before, m->input, to, even ? run->torque_Nm[k + 1] : 0.0};
    const size_t parts = step_s >= 0.0 ? hci_stage_parts(s, step_s) : 0;
    *before = x.from;
    if (parts == 0) {
        *m = (hci_stage_state){to, to, 0.0};
        memset(own->state, 0, sizeof own->state);
        return;
    }
    const hci_stage_part part = hci_stage_part_of(s, step_s / (double)parts);
    for (size_t j = 1; j <= parts; ++j)
        go_on(s, &part, j < parts ? hci_stage_input_at(even, &x, (double)j / (double)parts) : to, m, own);
}

/* The torque stays as it is. */
static void derivatives_add(const hci_effect *effect, const hci_sensor_stage *s, const hci_effect_run *run)
{
    hci_stage_state m = {0.0, 0.0, 0.0};
    own_answers own;
    double before = 0.0;
    answers_find(effect, s, &own);
    for (size_t k = 0; k < run->count; ++k) {
        answer(s, run, k, &before, &m, &own);
        for (size_t j = 0; j < own.count; ++j)
            run->by_value[k * run->columns + run->own_column + own.term[j]] += own.state[j].y;
    }
}

static void filter_stage(const hci_effect *effect, const hci_sensor_stage *s, const hci_effect_run *run)
{
    if (run->by_value) {
        hci_stage_filter(s, run, run->by_value, run->columns, run->columns);
        derivatives_add(effect, s, run);
    }
    hci_stage_filter(s, run, run->torque_Nm, 1, 1);
}

/* The offset comes behind the lag, but a constant passes both unchanged. */
static void filter(const hci_effect *effect, const hci_effect_run *run)
{
    hci_sensor_stage stages[2];
    const size_t count = stages_of(effect, stages);
    for (size_t k = 0; k < count; ++k)
        filter_stage(effect, &stages[k], run);
}

/* The last one in place of those that there are not. */
static void filter_many(const hci_effect *effects, size_t count, const hci_effect_run *run,
                        double *reading_Nm)
{
    hci_sensor_stage one[HCI_EFFECT_SENSORS], stages[2];
    for (size_t k = 0; k < HCI_EFFECT_SENSORS; ++k) {
        stages_of(&effects[k < count ? k : count - 1], stages);
        one[k] = stages[0];
    }
    hci_stage_filter_many(one, run, reading_Nm);
}

/* ---- on a simulated drive ---- */

/* memory: 1 once started, then three for each stage. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    hci_sensor_stage stages[2];
    const size_t count = stages_of(effect, stages);
    (void)plant;
    (void)theta_m_rad;
    for (size_t k = 0; k < count; ++k) {
        double *at = memory + 1 + 3 * k;
        hci_stage_state m = {at[0], at[1], at[2]};
        if (memory[0] > 0.0)
            value = hci_stage_step(&stages[k], &m, step_s, value);
        else
            m = (hci_stage_state){value, value, 0.0};
        at[0] = m.input;
        at[1] = m.y;
        at[2] = m.v;
    }
    memory[0] = 1.0;
    return value;
}

static void simulate(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                     hci_effect_channel *channels)
{
    (void)pole_pairs;
    (void)channels;
    sensors[HCI_SENSE_TORQUE].offset += hci_effect_value(effect, OFFSET);
}

static const size_t RESONANCE[] = {NATURAL_FREQUENCY, DAMPING}, LAG[] = {TIME_CONSTANT};

#define EXPECTED 0.1 /* offset, of the largest torque */

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    hci_effect_propose(to, OFFSET, 1, 0.0, 1.0, EXPECTED * survey->torque_Nm);
    if (survey->timed) hci_effect_propose(to, TIME_CONSTANT, 1, 0.0, 1.0, 0.0);
}

static void propose_alike(const hci_machine *machine, double slots, const hci_effect_proposals *to)
{
    (void)machine;
    (void)slots;
    hci_effect_propose(to, OFFSET, 1, 0.0, 1.0, 0.0);
}

const hci_effect_type hci_effect_torque_sensor = {
    .name = "torque_sensor",
    .title = "errors of the torque sensor",
    .equation = "T_read = G(s) T + offset, G = 1/(1 + τs) · 1/(1 + 2ζs/ω_n + s²/ω_n²)",
    .signature = "all orders; amplitude and phase follow order × speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TIME,
    .without = "without time the torque sensor's lag is left out",
    .told_by = "the other direction of rotation",
    .resonance = RESONANCE,
    .lag = LAG,
    .propose = propose,
    .propose_alike = propose_alike,
    .torque = torque,
    .simulate = simulate,
    .modify_torque = modify,
    .filter = filter,
    .filter_many = filter_many,
};
