/* What flows and turns, at which points it is measured, and what the instruments make of it. */
#include "rig.h"

#include <math.h>

/* ---- the program ---- */

/* level: of the rated current; speed: 0 slow, 1 middle, 2 fast, 3 + x: slow^(1−x) fast^x;
 * angle: of the current, in units of the largest, i_d < 0 for positive ones. */
typedef struct {
    double level, angle, speed;
    int direction;
    bool braking, injected, holdout;
} point;

static const point PROGRAM[] = {
    {0.0, 0.0, 0.0, 1, false, false, false},    {0.0, 0.0, 0.0, -1, false, false, false},
    {0.25, 0.0, 1.0, 1, false, false, false},   {0.5, 1.0, 1.0, -1, false, false, false},
    {1.0, -0.7, 0.0, 1, false, false, false},   {1.0, 0.1, 2.0, -1, false, false, false},
    {0.5, -1.0, 2.0, 1, true, false, false},    {1.0, 0.8, 1.0, -1, true, true, false},
    {0.4, 0.5, 3.25, -1, false, false, true},   {0.75, -0.4, 3.75, 1, false, true, true},
    {0.85, 0.3, 3.35, 1, true, false, true},    {0.5, 0.0, 2.0, 1, false, true, false},
    {0.25, -0.6, 0.0, -1, false, false, false}, {1.0, 0.6, 2.0, 1, false, false, false},
};
enum { POINTS = sizeof PROGRAM / sizeof *PROGRAM, LEAST_POINTS = 11 };

/* Speeds of a case, slow to fast in a ratio of at least 4. */
static double speed_of(const rig_case *c, double code, double slow_share)
{
    const double fast = c->machine.rated_speed_rad_per_s, slow = fast * slow_share;
    if (code < 0.5) return slow;
    if (code < 1.5) return sqrt(slow * fast);
    if (code < 2.5) return fast;
    return slow * pow(fast / slow, code - 3.0);
}

static void draw_ripple(rig_run *run, int pole_pairs, double total, rig_random *r)
{
    const int order[RIG_RIPPLES] = {1, 2, pole_pairs, 6 * pole_pairs};
    double share[RIG_RIPPLES], sum = 0.0;
    for (int k = 0; k < RIG_RIPPLES; ++k)
        sum += share[k] = rig_uniform(r, 0.1, 1.0);
    for (int k = 0; k < RIG_RIPPLES; ++k) {
        run->ripple_order[k] = order[k];
        run->ripple[k] = total * share[k] / sum;
        run->ripple_phase[k] = rig_uniform(r, 0.0, 2.0 * RIG_PI);
    }
}

static void draw_currents(const rig_case *c, const point *p, double most_angle, rig_run *run, rig_random *r)
{
    const double level = p->level * rig_uniform(r, 0.9, p->level > 0.8 ? 1.0 : 1.1);
    const double current = level * c->machine.rated_current_A;
    const double about = p->angle * rig_uniform(r, 0.85, 1.0);
    const double angle = most_angle * (about + rig_uniform(r, -0.05, 0.05));
    /* with salient poles mostly where the reluctance helps */
    const double lean = c->machine.salient ? (angle > 0.0 ? 1.0 : 0.5) * angle + 0.15 * most_angle : angle;
    run->id_A = -current * sin(lean);
    run->iq_A = current * cos(lean) * p->direction * (p->braking ? -1.0 : 1.0);
    if (!p->injected) return;
    run->i5_A = current * rig_uniform(r, 0.03, 0.08);
    run->i7_A = current * rig_uniform(r, 0.02, 0.06);
    run->phase5_rad = rig_uniform(r, -RIG_PI, RIG_PI);
    run->phase7_rad = rig_uniform(r, -RIG_PI, RIG_PI);
}

static void draw_form(rig_case *c, rig_random *r)
{
    rig_form *f = &c->form;
    f->electrical = rig_chance(r, 0.4);
    f->wrapped = rig_chance(r, 0.5);
    f->degrees = rig_chance(r, 0.3);
    f->dq = rig_chance(r, 0.3);
    f->speed = rig_chance(r, 0.6);
    f->rpm = rig_chance(r, 0.5);
    f->semicolon = rig_chance(r, 0.25);
}

bool rig_case_has(const rig_case *c, rig_effect effect)
{
    return (c->effect_count > 0 && c->effect[0] == effect) || (c->effect_count > 1 && c->effect[1] == effect);
}

/* Instruments first: what is hidden is measured by their noise. */
static void draw_instruments(rig_case *c, rig_random *r)
{
    static const int COUNTS[] = {4096, 8192, 10000, 16384, 20000, 65536};
    const double least = rig_case_has(c, RIG_TORQUE_SENSOR) ? 0.003 : 0.001; /* or a resonance is too plain */
    c->torque_noise_Nm = c->machine.rated_torque_Nm * rig_log_uniform(r, least, 0.005);
    c->coloured_share = rig_chance(r, 0.5) ? rig_uniform(r, 0.3, 0.8) : 0.0;
    c->correlation_samples = rig_uniform(r, 3.0, 10.0);
    c->current_noise_A = c->machine.rated_current_A * rig_log_uniform(r, 0.0005, 0.003);
    c->counts_per_turn = COUNTS[rig_pick(r, 0, 5)];
}

/* How many turns and how finely: 20 to 40 thousand samples, and enough of them per period of the tooth
 * ripple; most where the sensor filters along time. */
static void draw_sampling(rig_case *c, rig_random *r)
{
    const double least =
        rig_case_has(c, RIG_TORQUE_SENSOR) ? 390.0 : fmax(200.0, 48.0 * c->machine.pole_pairs);
    const double per_turn = rig_uniform(r, least, 400.0);
    const double wanted = rig_uniform(r, 22000.0, 36000.0);
    for (int k = 0; k < c->run_count; ++k) {
        rig_run *run = &c->run[k];
        const double share = rig_uniform(r, 0.85, 1.15);
        const double turns = fmin(15.0, fmax(6.0, share * wanted / per_turn / c->run_count));
        run->duration_s = turns * 2.0 * RIG_PI / fabs(run->omega_rad_per_s);
        run->samples = (int)(turns * per_turn);
        run->step_s = run->duration_s / run->samples;
    }
}

/* The magnets warm up with the load; some loggers note it. */
static void draw_temperature(rig_case *c, rig_random *r)
{
    const bool logged = rig_chance(r, 0.5), all = rig_chance(r, 0.5);
    const double room_C = rig_uniform(r, 20.0, 26.0), rise_C = rig_uniform(r, 8.0, 20.0);
    for (int k = 0; k < c->run_count; ++k) {
        rig_run *run = &c->run[k];
        run->warmth = rig_uniform(r, 0.0, 1.0);
        run->temperature_C = room_C + rise_C * run->warmth;
        run->warming_C_per_s = rig_uniform(r, 0.0, 0.5) / run->duration_s;
        run->has_temperature = logged && (all || rig_chance(r, 0.5));
    }
}

void rig_bench_draw(rig_case *c, rig_random *r)
{
    const int points = rig_pick(r, LEAST_POINTS, POINTS);
    const double slow_share = 1.0 / rig_uniform(r, 4.0, 10.0), ripple = rig_uniform(r, 0.002, 0.01);
    const double most_angle = rig_uniform(r, 0.4, 0.6);
    const int mirror = rig_chance(r, 0.5) ? -1 : 1;
    draw_instruments(c, r);
    draw_form(c, r);
    for (c->run_count = 0; c->run_count < points; ++c->run_count) {
        rig_run *run = &c->run[c->run_count];
        point p = PROGRAM[c->run_count];
        p.direction *= mirror;
        run->holdout = p.holdout;
        run->seed = c->seed * 64 + (uint64_t)c->run_count;
        run->theta_m_rad = rig_uniform(r, 0.0, 2.0 * RIG_PI);
        run->omega_rad_per_s = p.direction * speed_of(c, p.speed, slow_share) * rig_uniform(r, 0.95, 1.05);
        draw_ripple(run, c->machine.pole_pairs, ripple, r);
        draw_currents(c, &p, most_angle, run, r);
    }
    draw_sampling(c, r);
    draw_temperature(c, r);
}

/* ---- the truth along time ---- */

rig_instant rig_run_at(const rig_case *c, const rig_run *run, double t_s)
{
    rig_instant x;
    const double turned = run->omega_rad_per_s * t_s;
    double angle = 0.0, share = 1.0;
    for (int k = 0; k < RIG_RIPPLES; ++k) {
        const double phase = run->ripple_order[k] * turned + run->ripple_phase[k];
        angle += run->ripple[k] / run->ripple_order[k] * sin(phase);
        share += run->ripple[k] * cos(phase);
    }
    x.theta_m_rad = run->theta_m_rad + turned + angle;
    x.omega_rad_per_s = run->omega_rad_per_s * share;
    x.temperature_C = run->temperature_C + run->warming_C_per_s * t_s;
    const double theta_e_rad = c->machine.pole_pairs * x.theta_m_rad;
    rig_abc_of(theta_e_rad, run->id_A, run->iq_A, x.i_A);
    for (int s = 0; s < 3 && run->i5_A + run->i7_A > 0.0; ++s) /* sequences −1 and +1 */
        x.i_A[s] += run->i5_A * sin(5.0 * theta_e_rad + 2.0 * RIG_PI / 3.0 * s + run->phase5_rad) +
                    run->i7_A * sin(7.0 * theta_e_rad - 2.0 * RIG_PI / 3.0 * s + run->phase7_rad);
    return x;
}

double rig_angle_shown(const rig_case *c, const rig_run *run, double t_s)
{
    const rig_hidden *h = &c->hidden;
    const double theta = rig_run_at(c, run, t_s - h->angle_delay_s).theta_m_rad;
    return theta + rig_waves_at(h->eccentricity, 2, theta) + h->position_offset_rad / c->machine.pole_pairs;
}

void rig_currents_shown(const rig_case *c, const rig_run *run, double t_s, double i_A[3])
{
    const rig_hidden *h = &c->hidden;
    const rig_instant x = rig_run_at(c, run, t_s - h->current_delay_s);
    for (int s = 0; s < 3; ++s)
        i_A[s] = (1.0 + h->current_gain[s]) * x.i_A[s] + h->current_offset_A[s];
}

/* ---- readings ---- */

/* What the model cannot know of the readings, referred to the true state: noise of the currents, rounding of
 * the angle. A zero-sequence current is lost in d and q. */
static void blur(const rig_case *c, const rig_run *run, double t_s, rig_random *r, rig_reading *out,
                 rig_instant *x)
{
    const rig_hidden *h = &c->hidden;
    const double count_rad = 2.0 * RIG_PI / c->counts_per_turn, shown = rig_angle_shown(c, run, t_s);
    double noise_A[3], mean_A = 0.0, slope = 1.0;
    out->theta_m_rad = floor(shown / count_rad + 0.5) * count_rad;
    for (int k = 0; k < 2; ++k) {
        const rig_wave *w = &h->eccentricity[k];
        slope += w->order *
                 (w->sine * cos(w->order * x->theta_m_rad) - w->cosine * sin(w->order * x->theta_m_rad));
    }
    rig_currents_shown(c, run, t_s, out->i_A);
    for (int s = 0; s < 3; ++s)
        mean_A += (noise_A[s] = c->current_noise_A * rig_normal(r)) / 3.0;
    x->theta_m_rad += (out->theta_m_rad - shown) / slope;
    for (int s = 0; s < 3; ++s) {
        out->i_A[s] += noise_A[s];
        x->i_A[s] += (noise_A[s] - (c->form.dq ? mean_A : 0.0)) / (1.0 + h->current_gain[s]);
    }
}

/* White, and a part of first order. */
static double torque_noise(const rig_case *c, rig_random *r, double *memory)
{
    const double rho = exp(-1.0 / c->correlation_samples);
    *memory = rho * *memory + sqrt(1.0 - rho * rho) * rig_normal(r);
    return c->torque_noise_Nm *
           (sqrt(1.0 - c->coloured_share) * rig_normal(r) + sqrt(c->coloured_share) * *memory);
}

/* The error of the model's torque, through the sensor as well: between samples it goes straight. */
static double filtered_error(const rig_case *c, double before, double now, double span_s, rig_sensor *s)
{
    if (rig_sensor_is_ideal(&c->hidden)) return now;
    const int steps = rig_sensor_steps(&c->hidden, span_s, 0.0);
    for (int k = 0; k < steps; ++k) {
        const double slope = (now - before) / steps, from = before + slope * k;
        const double input[3] = {from, from + 0.5 * slope, from + slope};
        rig_sensor_step(&c->hidden, input, span_s / steps, s);
    }
    return s->resonator_Nm;
}

static bool is_lost(rig_random *r, int *gap)
{
    if (*gap == 0 && rig_chance(r, 0.0003)) *gap = rig_pick(r, 3, 8);
    if (*gap > 0) {
        --*gap;
        return true;
    }
    return rig_chance(r, 0.002);
}

typedef struct {
    rig_sensor sensor, error_sensor;
    double time_s, error_Nm, memory;
} instrument;

static void read_one(const rig_case *c, const rig_run *run, double t_s, rig_random *r, instrument *in,
                     rig_reading *out)
{
    const rig_instant truth = rig_run_at(c, run, t_s);
    rig_instant seen = truth;
    blur(c, run, t_s, r, out, &seen);
    const double error = rig_torque_true(c, &seen) - rig_torque_true(c, &truth);
    const double noise = torque_noise(c, r, &in->memory);
    rig_sensor_follow(c, run, in->time_s, t_s, &in->sensor);
    out->noise_Nm = noise - filtered_error(c, in->error_Nm, error, t_s - in->time_s, &in->error_sensor);
    out->torque_Nm = in->sensor.resonator_Nm + c->hidden.torque_offset_Nm + noise;
    out->time_s = t_s;
    out->omega_rad_per_s = truth.omega_rad_per_s + 5e-4 * run->omega_rad_per_s * rig_normal(r);
    out->temperature_C = floor(10.0 * truth.temperature_C + 0.5) / 10.0;
    in->time_s = t_s;
    in->error_Nm = error;
}

int rig_run_read(const rig_case *c, const rig_run *run, rig_reading *out)
{
    rig_random r = rig_random_of("readings", run->seed);
    instrument in = {rig_sensor_settled(c, run, 0.0), {0.0, 0.0, 0.0}, 0.0, 0.0, 0.0};
    int count = 0, gap = 0;
    for (int k = 0; k < 30; ++k)
        (void)torque_noise(c, &r, &in.memory);
    for (int k = 0; k < run->samples; ++k) {
        const double t_s = (k + 0.5 + rig_uniform(&r, -0.3, 0.3)) * run->step_s;
        if (!is_lost(&r, &gap)) read_one(c, run, t_s, &r, &in, &out[count++]);
    }
    return count;
}
