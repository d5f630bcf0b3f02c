/* A torque sensor that is slow, that swings, or whose zero is off:
 *
 *     y'' + 2ζω_n y' + ω_n² y = ω_n² T      τ z' + z = y      T_read = z + offset
 *
 * By the trapezoidal rule with the torque linear between samples, in steps that are short beside the
 * resonance; each derivative by a parameter is the same filter with another input, exactly so in discrete
 * time. */
#include "core/effects/type.h"

#include <string.h>

enum { TIME_CONSTANT, NATURAL_FREQUENCY, DAMPING, OFFSET };

enum { LEAST_PARTS = 4, MOST_PARTS = 8 }; /* of a step between samples */

#define LONGEST_STEP 0.125 /* of a part, in radians of the resonance: the frequency is 0.13 % off */
#define UNEVEN       0.1   /* of a step, that the next one may be longer or shorter */

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

/* In how many parts a step is taken: trapezoids swing (ω step)²/12 too slowly. */
static size_t parts_of(const stage *s, double step_s)
{
    const double rate = s->omega > 0.0 ? s->omega : 1.0 / s->tau_s,
                 parts = ceil(rate * step_s / LONGEST_STEP);
    return parts < LEAST_PARTS ? LEAST_PARTS : parts > MOST_PARTS ? MOST_PARTS : (size_t)parts;
}

/* A column of a run on its way through a stage, in place. before: the input of the sample before the last
 * one. */
typedef struct {
    const double *time_s;
    size_t count, stride;
    double *x, before;
} column;

static bool is_even(const double *time_s, size_t n, size_t k)
{
    if (k < 2 || k + 1 >= n) return false;
    const double step_s = time_s[k] - time_s[k - 1];
    return fabs(time_s[k - 1] - time_s[k - 2] - step_s) < UNEVEN * step_s &&
           fabs(time_s[k + 1] - time_s[k] - step_s) < UNEVEN * step_s;
}

/* The input between the sample before k and k, at a share of the way: on the cubic through four samples,
 * where they follow each other evenly, else on a line. A line through thirteen samples of a period is 2 % too
 * low. */
static double input_at(const column *c, size_t k, double from, double to, double u)
{
    if (!is_even(c->time_s, c->count, k)) return from + u * (to - from);
    const double a = c->before, d = c->x[(k + 1) * c->stride];
    const double first = to - a / 3.0 - from / 2.0 - d / 6.0, second = 0.5 * (a + to) - from;
    return from + u * (first + u * (second + u * ((d - a) / 6.0 + 0.5 * (from - to))));
}

/* What the stage answers with to its own parameters: the same filter with another input, step by step. */
typedef struct {
    const hci_effect *effect;
    stage_state state[sizeof PARAMETER / sizeof *PARAMETER]; /* of each term */
} own_answers;

static void part(const stage *s, double step_s, double input, stage_state *m, own_answers *own)
{
    stage_step(s, m, step_s, input);
    for (size_t j = 0; own && j < own->effect->count; ++j)
        stage_step(s, &own->state[j], step_s, input_for(s, m, own->effect->term[j].parameter));
}

/* Sample k, in place; the first one, and one after a step back in time, finds the stage settled. own: may be
 * NULL. */
static void answer(const stage *s, column *c, size_t k, stage_state *m, own_answers *own)
{
    const double step_s = k > 0 ? c->time_s[k] - c->time_s[k - 1] : -1.0, from = m->input;
    double *x = &c->x[k * c->stride];
    const double to = *x;
    if (step_s >= 0.0) {
        const size_t parts = parts_of(s, step_s);
        for (size_t j = 1; j <= parts; ++j) {
            const double share = (double)j / (double)parts;
            part(s, step_s / (double)parts, j < parts ? input_at(c, k, from, to, share) : to, m, own);
        }
        *x = m->y;
    } else {
        *m = (stage_state){to, to, 0.0};
        if (own) memset(own->state, 0, sizeof own->state);
    }
    c->before = from;
}

static void filter_column(const stage *s, column c)
{
    stage_state m = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < c.count; ++k)
        answer(s, &c, k, &m, NULL);
}

static void filter_stage(const hci_effect *effect, const stage *s, const hci_effect_run *run)
{
    stage_state m = {0.0, 0.0, 0.0};
    column torque = {run->time_s, run->count, 1, run->torque_Nm, 0.0};
    own_answers own = {effect, {{0.0, 0.0, 0.0}}};
    for (size_t c = 0; run->by_value && c < run->columns; ++c)
        filter_column(s, (column){run->time_s, run->count, run->columns, run->by_value + c, 0.0});
    for (size_t k = 0; k < run->count; ++k) {
        answer(s, &torque, k, &m, run->by_value ? &own : NULL);
        for (size_t j = 0; run->by_value && j < effect->count; ++j)
            run->by_value[k * run->columns + run->own_column + j] += own.state[j].y;
    }
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
