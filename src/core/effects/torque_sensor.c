/* A torque sensor that is slow, that swings, or whose zero is off:
 *
 *     y'' + 2ζω_n y' + ω_n² y = ω_n² T      τ z' + z = y      T_read = z + offset
 *
 * By the trapezoidal rule with the torque linear over a step; each derivative by a parameter is the same
 * filter with another input, exactly so in discrete time. */
#include "core/effects/type.h"

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

/* A resonance with omega > 0, else a lag. */
typedef struct {
    double omega, damping, tau_s;
} stage;

typedef struct {
    double input, y, v; /* v = dy/dt of a resonance */
} stage_state;

static double stage_step(const stage *s, stage_state *m, double step_s, double input)
{
    const double g = 0.5 * step_s, both = m->input + input;
    if (s->omega > 0.0) {
        const double square = s->omega * s->omega, loss = 2.0 * s->damping * s->omega * g + square * g * g;
        const double v = (m->v * (1.0 - loss) + g * square * (both - 2.0 * m->y)) / (1.0 + loss);
        m->y += g * (m->v + v);
        m->v = v;
    } else {
        m->y = (m->y * (s->tau_s - g) + g * both) / (s->tau_s + g);
    }
    m->input = input;
    return m->y;
}

/* Resonance, then lag; those that there are. */
static size_t stages_of(const hci_effect *effect, stage stages[2])
{
    const double frequency = hci_effect_value(effect, NATURAL_FREQUENCY);
    const double tau = hci_effect_value(effect, TIME_CONSTANT);
    size_t count = 0;
    if (frequency > 0.0)
        stages[count++] = (stage){2.0 * HCI_PI * frequency, hci_effect_value(effect, DAMPING), 0.0};
    if (tau > 0.0) stages[count++] = (stage){0.0, 0.0, tau};
    return count;
}

/* ---- along a run ---- */

/* The input that makes the stage answer with ∂y/∂parameter. */
static double input_for(const stage *s, const stage_state *m, size_t parameter)
{
    const double error = m->input - m->y;
    if (s->omega > 0.0) {
        if (parameter == DAMPING) return -2.0 * m->v / s->omega;
        if (parameter == NATURAL_FREQUENCY)
            return 4.0 * HCI_PI * (error * s->omega - s->damping * m->v) / (s->omega * s->omega);
    } else if (parameter == TIME_CONSTANT) {
        return -error / s->tau_s;
    }
    return 0.0;
}

/* Sample k, in place; the first one, and one after a step back in time, finds the stage settled. */
static void answer(const stage *s, const double *time_s, size_t k, stage_state *m, double *x)
{
    const double step_s = k > 0 ? time_s[k] - time_s[k - 1] : -1.0;
    if (step_s >= 0.0)
        *x = stage_step(s, m, step_s, *x);
    else
        *m = (stage_state){*x, *x, 0.0};
}

static void filter_column(const stage *s, const double *time_s, size_t n, double *column, size_t stride)
{
    stage_state m = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < n; ++k)
        answer(s, time_s, k, &m, &column[k * stride]);
}

static void filter_stage(const hci_effect *effect, const stage *s, const hci_effect_run *run)
{
    stage_state m = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < run->count; ++k) {
        answer(s, run->time_s, k, &m, &run->torque_Nm[k]);
        for (size_t j = 0; run->by_value && j < effect->count; ++j)
            run->by_value[k * run->columns + run->own_column + j] +=
                input_for(s, &m, effect->term[j].parameter);
    }
    for (size_t c = 0; run->by_value && c < run->columns; ++c)
        filter_column(s, run->time_s, run->count, run->by_value + c, run->columns);
}

/* The offset comes behind the lag, but a constant passes both unchanged. */
static void filter(const hci_effect *effect, const hci_effect_run *run)
{
    stage stages[2];
    const size_t count = stages_of(effect, stages);
    for (size_t k = 0; k < count; ++k)
        filter_stage(effect, &stages[k], run);
}

/* ---- on a simulated drive ---- */

/* memory: 1 once started, then three for each stage. */
static double modify(const hci_effect *effect, const hci_plant_state *plant, double step_s, double *memory,
                     double value, double theta_m_rad)
{
    stage stages[2];
    const size_t count = stages_of(effect, stages);
    (void)plant;
    (void)theta_m_rad;
    for (size_t k = 0; k < count; ++k) {
        double *at = memory + 1 + 3 * k;
        stage_state m = {at[0], at[1], at[2]};
        if (memory[0] > 0.0)
            value = stage_step(&stages[k], &m, step_s, value);
        else
            m = (stage_state){value, value, 0.0};
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
    const hci_effect_link link = {modify, effect, {0.0}};
    (void)pole_pairs;
    sensors[HCI_SENSE_TORQUE].offset += hci_effect_value(effect, OFFSET);
    hci_effect_link_add(&channels[HCI_SENSE_TORQUE], &link);
}

static const size_t RESONANCE[] = {NATURAL_FREQUENCY, DAMPING}, LAG[] = {TIME_CONSTANT};

#define EXPECTED 0.1 /* offset, of the largest torque */

static void propose(const hci_effect_survey *survey, const hci_effect_proposals *to)
{
    hci_effect_propose(to, OFFSET, 1, 0.0, 1.0, EXPECTED * survey->torque_Nm);
    if (survey->timed) hci_effect_propose(to, TIME_CONSTANT, 1, 0.0, 1.0, 0.0);
}

const hci_effect_type hci_effect_torque_sensor = {
    .name = "torque_sensor",
    .equation = "T_read = G(s) T + offset, G = 1/(1 + τs) · 1/(1 + 2ζs/ω_n + s²/ω_n²)",
    .signature = "all orders; amplitude and phase follow order × speed",
    HCI_EFFECT_PARAMETERS(PARAMETER),
    .needs = HCI_EFFECT_NEEDS_TIME,
    .without = "without time the torque sensor's lag is left out",
    .told_by = "the other direction of rotation",
    .resonance = RESONANCE,
    .lag = LAG,
    .propose = propose,
    .torque = torque,
    .simulate = simulate,
    .filter = filter,
};
