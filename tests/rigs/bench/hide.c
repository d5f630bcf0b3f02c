/* What is hidden, and how large. */
#include "rig.h"

#include <math.h>
#include <string.h>

/* ---- what ---- */

static rig_wave wave(double order, double amplitude, double phase_rad)
{
    return (rig_wave){order, amplitude * cos(phase_rad), amplitude * sin(phase_rad)};
}

static double any_phase(rig_random *r)
{
    return rig_uniform(r, -RIG_PI, RIG_PI);
}

typedef struct {
    double from, to;
} range;

/* Draws stand in statements of their own: in what order arguments are taken is the compiler's. */
static rig_wave any_wave(double order, double unit, range amplitude, rig_random *r)
{
    const double phase_rad = any_phase(r);
    return wave(order, unit * rig_uniform(r, amplitude.from, amplitude.to), phase_rad);
}

/* Whole orders that no machine here declares. */
static void draw_cogging(rig_hidden *h, rig_random *r)
{
    static const double ORDER[] = {2.0, 4.0, 8.0, 10.0, 18.0, 24.0};
    const int first = rig_pick(r, 0, 5), second = (first + rig_pick(r, 1, 5)) % 6;
    h->cogging[0] = wave(ORDER[first], 1.0, any_phase(r));
    if (rig_chance(r, 0.5)) h->cogging[1] = any_wave(ORDER[second], 1.0, (range){0.4, 1.0}, r);
}

/* The size of the fundamental, or a harmonic that is wrong or not declared at all. */
static void draw_back_emf(rig_case *c, bool fundamental, rig_random *r)
{
    static const double ORDER[] = {5.0, 7.0, 11.0};
    const double order = ORDER[rig_pick(r, 0, 2)];
    rig_machine *m = &c->machine;
    if (fundamental) {
        c->hidden.emf[0] = wave(1.0, 1.0, rig_chance(r, 0.5) ? 0.0 : RIG_PI);
        c->hidden.emf[0].cosine = 0.0;
        return;
    }
    c->hidden.emf[0] = wave(order, 1.0, any_phase(r));
    if (rig_chance(r, 0.5)) return;
    for (int k = 0; k < m->emf_count; ++k)
        if (fabs(m->emf[k].order - order) < 0.5) m->emf[k] = m->emf[--m->emf_count];
}

/* One phase, or two with unequal values. */
static void draw_phases(double value[3], bool two, rig_random *r)
{
    const int first = rig_pick(r, 0, 2);
    value[first] = rig_chance(r, 0.5) ? 1.0 : -1.0;
    if (!two) return;
    const double sign = rig_chance(r, 0.5) ? 1.0 : -1.0, size = rig_uniform(r, 0.4, 0.9);
    value[(first + rig_pick(r, 1, 2)) % 3] = sign * size;
}

static void draw_friction(const rig_case *c, rig_hidden *h, rig_random *r)
{
    const double fast = c->machine.rated_speed_rad_per_s;
    h->coulomb = 1.0;
    h->viscous = rig_uniform(r, 0.4, 1.5) / fast;
    h->quadratic = rig_chance(r, 0.35) ? rig_uniform(r, 0.4, 1.2) / (fast * fast) : 0.0;
}

/* Once or twice a turn, or a wheel's teeth; no multiple of the pole pairs, which would be cogging. */
static void draw_turn(const rig_case *c, rig_hidden *h, rig_random *r)
{
    const int p = c->machine.pole_pairs;
    int k = rig_chance(r, 0.6) ? rig_pick(r, 1, 2) : rig_pick(r, 11, 37);
    if (k % p == 0) ++k;
    if (k == 3 && p != 3) k = 1;
    h->turn[0] = wave(k, 1.0, any_phase(r));
    if (rig_chance(r, 0.5))
        h->turn_iq[0] = any_wave(k, 1.0 / c->machine.rated_current_A, (range){0.5, 2.0}, r);
}

static void draw_eccentricity(rig_hidden *h, rig_random *r)
{
    h->eccentricity[0] = wave(1.0, 1e-3, any_phase(r));
    if (rig_chance(r, 0.4)) h->eccentricity[1] = any_wave(2.0, 1e-3, (range){0.3, 0.8}, r);
}

static void draw_saturation(rig_hidden *h, rig_random *r)
{
    h->d1q2_cosine_0 = -1.0;
    if (rig_chance(r, 0.5)) return;
    if (rig_chance(r, 0.5)) {
        const double size = rig_uniform(r, 0.03, 0.1);
        h->d0q3_sine_6 = rig_chance(r, 0.5) ? size : -size;
    } else {
        h->d3q0_cosine_0 = rig_uniform(r, -0.8, -0.3);
    }
}

static void draw_torque_sensor(const rig_case *c, rig_hidden *h, rig_random *r)
{
    const double fast_Hz = c->machine.rated_speed_rad_per_s * c->machine.pole_pairs / (2.0 * RIG_PI);
    switch (rig_pick(r, 0, 2)) {
    case 0:
        h->time_constant_s = 0.02 / (6.0 * 2.0 * RIG_PI * fast_Hz);
        break;
    case 1:
        h->natural_frequency_Hz = 6.0 * fast_Hz; /* see fit_resonance */
        h->damping = 0.1;
        break;
    default:
        h->torque_offset_Nm = rig_chance(r, 0.5) ? 1.0 : -1.0;
        break;
    }
}

static void draw_magnets(rig_case *c, rig_random *r)
{
    c->hidden.emf_per_kelvin = -rig_uniform(r, 0.001, 0.002);
    for (int k = 0; k < c->run_count; ++k)
        c->run[k].has_temperature = true;
}

static void draw_reluctance(rig_hidden *h, rig_random *r)
{
    h->dd_cosine_0 = rig_chance(r, 0.5) ? 1.0 : -1.0;
    if (rig_chance(r, 0.4)) h->qq_cosine_6 = rig_uniform(r, 0.05, 0.2);
}

static void draw_in_machine(rig_case *c, rig_effect effect, bool fundamental, rig_random *r)
{
    rig_hidden *h = &c->hidden;
    switch (effect) {
    case RIG_COGGING:
        draw_cogging(h, r);
        break;
    case RIG_BACK_EMF:
        draw_back_emf(c, fundamental, r);
        break;
    case RIG_PHASE_IMBALANCE:
        h->imbalance[rig_pick(r, 0, 2)] = -1.0;
        break;
    case RIG_RELUCTANCE:
        draw_reluctance(h, r);
        break;
    case RIG_SATURATION:
        draw_saturation(h, r);
        break;
    case RIG_MAGNET_TEMPERATURE:
        draw_magnets(c, r);
        break;
    case RIG_MECHANICAL_ORDER:
        draw_turn(c, h, r);
        break;
    case RIG_FRICTION:
        draw_friction(c, h, r);
        break;
    default:
        break;
    }
}

static void draw_on_bench(rig_case *c, rig_effect effect, rig_random *r)
{
    rig_hidden *h = &c->hidden;
    switch (effect) {
    case RIG_CURRENT_OFFSET:
        draw_phases(h->current_offset_A, rig_chance(r, 0.5), r);
        break;
    case RIG_CURRENT_GAIN:
        draw_phases(h->current_gain, rig_chance(r, 0.5), r);
        break;
    case RIG_POSITION_OFFSET:
        h->position_offset_rad = rig_chance(r, 0.5) ? 0.01 : -0.01;
        break;
    case RIG_POSITION_ECCENTRICITY:
        draw_eccentricity(h, r);
        break;
    case RIG_CHANNEL_DELAY:
        *(rig_chance(r, 0.5) ? &h->current_delay_s : &h->angle_delay_s) = 1e-5;
        break;
    case RIG_TORQUE_SENSOR:
        draw_torque_sensor(c, h, r);
        break;
    default:
        break;
    }
}

/* Of any size. other: what else is hidden, which a part of this one could not be told from. */
static void draw_effect(rig_case *c, rig_effect effect, rig_effect other, rig_random *r)
{
    const bool crowded = other == RIG_PHASE_IMBALANCE || other == RIG_CURRENT_GAIN;
    draw_in_machine(c, effect, !crowded && rig_chance(r, 0.35), r);
    draw_on_bench(c, effect, r);
}

/* What the files must show for the effect to be seen in them. */
static void adapt_form(rig_case *c, rig_effect effect)
{
    rig_form *f = &c->form;
    if (effect == RIG_MECHANICAL_ORDER || effect == RIG_POSITION_ECCENTRICITY) {
        if (f->electrical) f->wrapped = false;
    }
    if (effect == RIG_CURRENT_GAIN || effect == RIG_CURRENT_OFFSET || effect == RIG_PHASE_IMBALANCE)
        f->dq = false;
}

/* ---- how large ---- */

static void scale_three(double value[3], double by)
{
    for (int s = 0; s < 3; ++s)
        value[s] *= by;
}

static void scale_wave(rig_wave *w, double by)
{
    w->sine *= by;
    w->cosine *= by;
}

static void scale_warmth(rig_case *c, double by)
{
    double rise = 0.0;
    for (int k = 0; k < c->run_count; ++k)
        rise = fmax(rise, c->run[k].temperature_C - 20.0);
    by = fmin(70.0 / rise, fmax(8.0 / rise, by));
    for (int k = 0; k < c->run_count; ++k) {
        c->run[k].temperature_C = 20.0 + by * (c->run[k].temperature_C - 20.0);
        c->run[k].warming_C_per_s *= by;
    }
}

static void scale_coenergy(rig_hidden *h, double by)
{
    h->dd_cosine_0 *= by;
    h->qq_cosine_6 *= by;
    h->d1q2_cosine_0 *= by;
    h->d0q3_sine_6 *= by;
    h->d3q0_cosine_0 *= by;
}

/* Only one effect or invention is there at a time, so all is scaled; but not a resonance. */
static void scale(rig_case *c, double by)
{
    rig_hidden *h = &c->hidden;
    for (int k = 0; k < 2; ++k) {
        scale_wave(&h->cogging[k], by);
        scale_wave(&h->eccentricity[k], by);
    }
    scale_wave(&h->emf[0], by);
    scale_wave(&h->turn[0], by);
    scale_wave(&h->turn_iq[0], by);
    scale_three(h->imbalance, by);
    scale_three(h->current_offset_A, by);
    scale_three(h->current_gain, by);
    scale_coenergy(h, by);
    h->position_offset_rad *= by;
    h->current_delay_s *= by;
    h->angle_delay_s *= by;
    h->coulomb *= by;
    h->viscous *= by;
    h->quadratic *= by;
    h->time_constant_s *= by;
    h->torque_offset_Nm *= by;
    c->invented.amplitude_Nm *= by;
    if (h->emf_per_kelvin < 0.0) scale_warmth(c, by);
}

/* At even steps. A sensor with a memory has to be followed: one electrical turn. */
static double square_of_run(const rig_case *c, const rig_run *run, int samples)
{
    const bool ideal = rig_sensor_is_ideal(&c->hidden);
    const double span_s =
        ideal ? run->duration_s : 2.0 * RIG_PI / fabs(run->omega_rad_per_s) / c->machine.pole_pairs;
    rig_sensor sensor = rig_sensor_settled(c, run, 0.0);
    double sum = 0.0, before_s = 0.0;
    for (int k = 1; k <= samples; ++k) {
        const double t_s = span_s * k / samples;
        double i_A[3];
        rig_sensor_follow(c, run, before_s, t_s, &sensor);
        rig_currents_shown(c, run, t_s, i_A);
        const double residual = sensor.resonator_Nm + c->hidden.torque_offset_Nm -
                                rig_torque_declared(&c->machine, rig_angle_shown(c, run, t_s), i_A);
        sum += residual * residual / samples;
        before_s = t_s;
    }
    return sum;
}

double rig_hidden_rms(const rig_case *c)
{
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < c->run_count; ++k)
        if (!c->run[k].holdout) {
            sum += square_of_run(c, &c->run[k], 397);
            ++count;
        }
    return sqrt(sum / count);
}

double rig_noise_rms(const rig_case *c)
{
    rig_random r = rig_random_of("noise", c->seed);
    const double count_rad = 2.0 * RIG_PI / c->counts_per_turn;
    double sum = 0.0;
    int count = 0;
    for (int k = 0; k < c->run_count; ++k)
        for (int j = 0; j < 200 && !c->run[k].holdout; ++j, ++count) {
            rig_instant x = rig_run_at(c, &c->run[k], rig_uniform(&r, 0.0, c->run[k].duration_s));
            const double truth = rig_torque_declared(&c->machine, x.theta_m_rad, x.i_A);
            x.theta_m_rad += rig_uniform(&r, -0.5, 0.5) * count_rad;
            for (int s = 0; s < 3; ++s)
                x.i_A[s] += c->current_noise_A * rig_normal(&r);
            const double error = rig_torque_declared(&c->machine, x.theta_m_rad, x.i_A) - truth;
            sum += error * error;
        }
    return sqrt(sum / count + c->torque_noise_Nm * c->torque_noise_Nm);
}

/* Nearly in proportion, so a few corrections suffice. */
static void fit_size(rig_case *c, double wanted_Nm)
{
    for (int k = 0; k < 12; ++k) {
        const double rms = rig_hidden_rms(c);
        if (fabs(rms / wanted_Nm - 1.0) < 0.01) return;
        scale(c, fmin(100.0, fmax(0.01, wanted_Nm / rms)));
    }
}

/* A resonance cannot be scaled: frequencies and dampings are tried, in the band that is excited and then
 * above it, until one has the size. */
static void fit_resonance(rig_case *c, double wanted_Nm, rig_random *r)
{
    const double fast_Hz = c->machine.rated_speed_rad_per_s * c->machine.pole_pairs / (2.0 * RIG_PI);
    double best = HUGE_VAL, frequency = 0.0, damping = 0.0;
    for (int k = 0; k < 60 && best > 0.2; ++k) {
        c->hidden.natural_frequency_Hz = fast_Hz * rig_log_uniform(r, 3.0, 14.0);
        c->hidden.damping = rig_log_uniform(r, 0.04, 0.5);
        const double miss = fabs(log(rig_hidden_rms(c) / wanted_Nm));
        if (miss > best) continue;
        best = miss;
        frequency = c->hidden.natural_frequency_Hz;
        damping = c->hidden.damping;
    }
    c->hidden.natural_frequency_Hz = frequency;
    c->hidden.damping = damping;
}

/* ---- a case ---- */

/* Pairs that one of the catalogue's effects alone, or a third set, explains as well; see README.md. */
static bool can_be_told_apart(rig_effect a, rig_effect b)
{
    const bool imbalance = a == RIG_PHASE_IMBALANCE || b == RIG_PHASE_IMBALANCE;
    const bool gain = a == RIG_CURRENT_GAIN || b == RIG_CURRENT_GAIN;
    const bool delay = a == RIG_CHANNEL_DELAY || b == RIG_CHANNEL_DELAY;
    const bool sensor = a == RIG_TORQUE_SENSOR || b == RIG_TORQUE_SENSOR;
    return a != b && !(imbalance && gain) && !(delay && sensor);
}

static int find(const char *const *name, int from, int count, const char *wanted)
{
    for (int k = from; k < count; ++k)
        if (strcmp(name[k], wanted) == 0) return k;
    return -1;
}

static bool choose(const char *kind, rig_case *c, rig_random *r)
{
    const int effect = find(RIG_EFFECT_NAME, 0, RIG_EFFECTS, kind);
    const int invention = find(RIG_INVENTION_NAME, 1, RIG_INVENTIONS, kind);
    c->effect[0] = c->effect[1] = RIG_NOTHING;
    if (effect >= 0) c->effect[c->effect_count++] = (rig_effect)effect;
    if (invention > 0) c->invented.kind = (rig_invention)invention;
    if (strcmp(kind, "two") == 0) {
        do {
            c->effect[0] = (rig_effect)rig_pick(r, 0, RIG_EFFECTS - 1);
            c->effect[1] = (rig_effect)rig_pick(r, 0, RIG_EFFECTS - 1);
        } while (!can_be_told_apart(c->effect[0], c->effect[1]));
        c->effect_count = 2;
    }
    return effect >= 0 || invention > 0 || c->effect_count == 2 || strcmp(kind, "none") == 0;
}

/* A law in |i| shows itself only where the currents are many. */
static void add_small_currents(rig_case *c, rig_random *r)
{
    static const double LEVEL[] = {0.06, 0.12, 0.03};
    int next = 0;
    for (int k = 2; k < c->run_count && next < 3; ++k) {
        const double level = hypot(c->run[k].id_A, c->run[k].iq_A) / c->machine.rated_current_A;
        if (c->run[k].holdout || c->run[k].i5_A > 0.0 || level < 0.15 || level > 0.6) continue;
        const double by = LEVEL[next++] * rig_uniform(r, 0.9, 1.1) / level;
        c->run[k].id_A *= by;
        c->run[k].iq_A *= by;
    }
}

static void draw_invention(rig_case *c, rig_random *r)
{
    rig_invented *h = &c->invented;
    const rig_wave *tooth = &c->machine.cogging[1]; /* order 12 */
    h->amplitude_Nm = c->machine.rated_torque_Nm * 0.01;
    h->phase_rad = any_phase(r);
    h->order = 6.0;
    switch (h->kind) {
    case RIG_SPEED_ORDER: /* in phase: what stands across is like a delay */
        h->order = 12.0;
        h->phase_rad = atan2(tooth->cosine, tooth->sine);
        break;
    case RIG_LOOSE_PART:
        h->order = rig_pick(r, 3, 20);
        h->scale = rig_pick(r, 12, 30);
        break;
    case RIG_BELT:
        h->order = 0.937 * rig_pick(r, 1, 3);
        break;
    case RIG_TANH_CURRENT:
        h->scale = rig_uniform(r, 0.08, 0.15);
        break;
    case RIG_BURST:
        h->scale = rig_pick(r, 2, 3);
        break;
    default:
        break;
    }
    if (h->kind == RIG_SQRT_CURRENT || h->kind == RIG_TANH_CURRENT) add_small_currents(c, r);
    if (c->form.electrical) c->form.wrapped = false;
}

/* The effects one after the other, each measured on the declared machine alone. */
static void draw_sized_effect(rig_case *c, int which, rig_random *r)
{
    rig_case alone = *c;
    const rig_effect other = c->effect_count == 2 ? c->effect[1 - which] : RIG_NOTHING;
    memset(&alone.hidden, 0, sizeof alone.hidden);
    draw_effect(&alone, c->effect[which], other, r);
    const bool resonates = alone.hidden.natural_frequency_Hz > 0.0; /* which is hardly ever small */
    const double wanted_Nm = rig_noise_rms(&alone) * rig_log_uniform(r, resonates ? 2.0 : 0.5, 4.0);
    if (resonates)
        fit_resonance(&alone, wanted_Nm, r);
    else
        fit_size(&alone, wanted_Nm);
    *c = alone;
}

/* Each effect has numbers of its own, and those of the other are 0. */
static void join(rig_hidden *into, const rig_hidden *other)
{
    double a[sizeof *into / sizeof(double)], b[sizeof *into / sizeof(double)];
    memcpy(a, into, sizeof a);
    memcpy(b, other, sizeof b);
    for (size_t k = 0; k < sizeof a / sizeof *a; ++k)
        a[k] += b[k];
    memcpy(into, a, sizeof a);
}

bool rig_case_draw(const char *kind, uint64_t seed, rig_case *c)
{
    rig_random r = rig_random_of(kind, seed);
    memset(c, 0, sizeof *c);
    if (!choose(kind, c, &r)) return false;
    c->seed = r.state;
    c->machine = rig_machine_draw(rig_case_has(c, RIG_TORQUE_SENSOR) ? 3 : 7, &r);
    rig_bench_draw(c, &r);
    if (c->invented.kind != RIG_KNOWN) {
        draw_invention(c, &r);
        fit_size(c, rig_noise_rms(c) * rig_log_uniform(&r, 1.0, 4.0));
    }
    rig_hidden first = {0};
    for (int k = 0; k < c->effect_count; ++k) {
        adapt_form(c, c->effect[k]);
        draw_sized_effect(c, k, &r);
        if (k == 0) first = c->hidden;
    }
    if (c->effect_count == 2) join(&c->hidden, &first);
    return true;
}
