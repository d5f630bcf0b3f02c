/* Steps of the simulated drive per second, on one core. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>

#include "hci/drive/control.h"
#include "support/plant_machine.h"
#include "timing.h"

/* Runs are short, so that the median is one without interruption. */
enum { POINTS = 1024, STEPS = 5000, PLAIN_STEPS = 1000 };

static const double STEP_s = 1e-6;
static const double VOLTAGE_V[2] = {20.0, 10.0}, LOAD_Nm = 0.5;

/* ---- the yardstick: the same machine with one sine and one cosine per order at every evaluation ---- */

typedef struct {
    double i[2], speed, angle;
} plain_state;

typedef struct {
    const pm_machine *machine;
    double resistance, inertia, viscous, v[2], load;
} plain_plant;

/* e of order n and sequence σ: sqrt(3/2) E (sin(nθ + φ), −σ cos(nθ + φ)). */
static void plain_emf(const pm_machine *m, double theta, double e[2])
{
    e[0] = e[1] = 0.0;
    for (size_t k = 0; k < m->emf_count; ++k) {
        const double n = m->emf[k].order, size = sqrt(1.5) * m->emf[k].amplitude,
                     x = n * theta + m->emf[k].phase;
        const int sequence = hci_sequence_of_order(n);
        if (sequence == 0) continue;
        e[0] += size * sin(x);
        e[1] -= sequence * size * cos(x);
    }
}

/* L of order m: (A − B) cos mθ on the diagonal when m is a multiple of 3, else (A/2 + B) (cos, −σ sin; −σ
 * sin, −cos). */
static void plain_inductance(const pm_machine *m, double theta, double l[3], double h[3])
{
    for (int k = 0; k < 3; ++k)
        l[k] = h[k] = 0.0;
    for (size_t k = 0; k < m->inductance_count; ++k) {
        const double n = m->order[k], s = sin(n * theta), c = cos(n * theta), w = m->pole_pairs * n;
        const int sequence = hci_sequence_of_order(n);
        const double g = sequence == 0 ? m->self[k] - m->mutual[k] : 0.5 * m->self[k] + m->mutual[k];
        const double last = sequence == 0 ? g : -g;
        l[0] += g * c;
        l[1] -= sequence * g * s;
        l[2] += last * c;
        h[0] -= w * g * s;
        h[1] -= w * sequence * g * c;
        h[2] -= w * last * s;
    }
}

static plain_state plain_rate(const plain_plant *p, const plain_state *y)
{
    const pm_machine *m = p->machine;
    const double theta = m->pole_pairs * y->angle;
    double e[2], l[3], h[3];
    plain_emf(m, theta, e);
    plain_inductance(m, theta, l, h);
    const double hi[2] = {h[0] * y->i[0] + h[1] * y->i[1], h[1] * y->i[0] + h[2] * y->i[1]};
    const double torque =
        (e[0] + 0.5 * hi[0]) * y->i[0] + (e[1] + 0.5 * hi[1]) * y->i[1] + pm_cogging(m, theta);
    const double a = p->v[0] - p->resistance * y->i[0] - y->speed * (e[0] + hi[0]);
    const double b = p->v[1] - p->resistance * y->i[1] - y->speed * (e[1] + hi[1]);
    const double det = l[0] * l[2] - l[1] * l[1];
    const plain_state rate = {{(l[2] * a - l[1] * b) / det, (l[0] * b - l[1] * a) / det},
                              (torque - p->load - p->viscous * y->speed) / p->inertia,
                              y->speed};
    return rate;
}

static plain_state plain_moved(const plain_state *y, const plain_state *k, double h)
{
    const plain_state z = {
        {y->i[0] + h * k->i[0], y->i[1] + h * k->i[1]}, y->speed + h * k->speed, y->angle + h * k->angle};
    return z;
}

static void plain_step(const plain_plant *p, plain_state *y, double h)
{
    const plain_state k1 = plain_rate(p, y), y2 = plain_moved(y, &k1, 0.5 * h);
    const plain_state k2 = plain_rate(p, &y2), y3 = plain_moved(y, &k2, 0.5 * h);
    const plain_state k3 = plain_rate(p, &y3), y4 = plain_moved(y, &k3, h);
    const plain_state k4 = plain_rate(p, &y4);
    plain_state z = plain_moved(y, &k1, h / 6.0);
    z = plain_moved(&z, &k2, h / 3.0);
    z = plain_moved(&z, &k3, h / 3.0);
    *y = plain_moved(&z, &k4, h / 6.0);
}

typedef struct {
    plain_plant plant;
    plain_state last;
} plain_run;

static void run_plain(void *context)
{
    plain_run *run = context;
    run->last = (plain_state){{0.0, 0.0}, 8.0, 0.0};
    for (int k = 0; k < PLAIN_STEPS; ++k)
        plain_step(&run->plant, &run->last, STEP_s);
}

/* ---- the library ---- */

typedef struct {
    hci_plant plant;
    int steps;
    hci_plant_state last;
} open_run;

typedef struct {
    hci_drive drive;
    hci_drive_state state;
    double set_point, load_Nm;
} closed_loop;

static void run_open(void *context)
{
    open_run *run = context;
    run->last = (hci_plant_state){{0.0, 0.0}, 8.0, 0.0, 0.0};
    for (int k = 0; k < run->steps; ++k)
        hci_plant_step(&run->plant, &run->last, VOLTAGE_V, LOAD_Nm, STEP_s);
}

static void run_closed(void *context)
{
    closed_loop *c = context;
    for (int k = 0; k < STEPS; ++k)
        hci_drive_step(&c->drive, &c->state, c->set_point, c->load_Nm);
    if (!isfinite(c->state.torque_Nm)) printf("not finite\n");
}

static void report(const char *what, double step_time_s, double plain_s)
{
    printf("  %-52s %8.1f ns %7.2f Msteps/s %6.1f x plain\n", what, 1e9 * step_time_s, 1e-6 / step_time_s,
           plain_s / step_time_s);
}

/* The yardstick and the plant alone, which must agree before their times mean anything. Returns the
 * yardstick's time of a step. */
static double bench_open(const hci_plant *plant, const pm_machine *machine)
{
    plain_run plain = {
        {machine, plant->resistance_ohm, plant->inertia_kgm2, plant->viscous_Nms, {0.0, 0.0}, LOAD_Nm},
        {{0.0, 0.0}, 0.0, 0.0}};
    open_run open = {*plant, PLAIN_STEPS, {{0.0, 0.0}, 0.0, 0.0, 0.0}};
    plain.plant.v[0] = VOLTAGE_V[0];
    plain.plant.v[1] = VOLTAGE_V[1];
    const double plain_s = bench_median_s(run_plain, &plain) / PLAIN_STEPS;
    run_open(&open);
    printf("  largest difference after %d steps: current %.1e A, speed %.1e rad/s\n", PLAIN_STEPS,
           fmax(fabs(open.last.i[0] - plain.last.i[0]), fabs(open.last.i[1] - plain.last.i[1])),
           fabs(open.last.speed_rad_per_s - plain.last.speed));
    open.steps = STEPS;
    report("plain Runge-Kutta with sines, voltage held", plain_s, plain_s);
    report("open loop, voltage held", bench_median_s(run_open, &open) / STEPS, plain_s);
    return plain_s;
}

static const double SPEED_rad_per_s = 8.377580409572781; /* 80 rpm */

static closed_loop loop_of(const hci_plant *plant, const hci_current_source *source, hci_current_loop loop,
                           double step_s, unsigned every)
{
    closed_loop c = {.set_point = SPEED_rad_per_s, .load_Nm = 8.0};
    c.drive.plant = *plant;
    c.drive.control = (hci_control){
        .table = &plant->table,
        .step_s = step_s,
        .dc_link_V = 311.0,
        .speed_controlled = 1,
        .speed = {20.0, 200.0},
        .speed_every = every,
        .torque_limit_Nm = 9.8,
        .sources = source,
        .source_count = 1,
        .current_every = every,
        .id_limit = 8.0,
        .iq_limit = 8.0,
        .peak_limit_A = INFINITY,
        .loop = loop,
        .hysteresis = {0.1, hci_hysteresis_hold(20e3, step_s)},
        .current = {.pi = {{50.0, 5000.0}, {50.0, 5000.0}}, .decoupled = true, .delay_steps = 1}};
    c.state.plant.speed_rad_per_s = SPEED_rad_per_s;
    return c;
}

static void bench_loops(const hci_plant *plant, unsigned every, double plain_s)
{
    static const hci_strategy strategies[] = {HCI_STRATEGY_ID0, HCI_STRATEGY_CANCEL, HCI_STRATEGY_MTPA};
    static const char *const strategy_name[] = {"i_d = 0", "cancel", "mtpa"};
    static const hci_current_loop loops[] = {HCI_CURRENT_HYSTERESIS, HCI_CURRENT_PI, HCI_CURRENT_IDEAL};
    static const char *const loop_name[] = {"hysteresis", "PI", "ideal currents"};
    for (int loop = 0; loop < 3; ++loop)
        for (int strategy = 0; strategy < 3; ++strategy) {
            const hci_current_source source = {.strategy = strategies[strategy]};
            closed_loop c = loop_of(plant, &source, loops[loop], STEP_s, every);
            char what[80];
            snprintf(what, sizeof what, "%s + speed loop, %s, sampled every %u", loop_name[loop],
                     strategy_name[strategy], every);
            report(what, bench_median_s(run_closed, &c) / STEPS, plain_s);
        }
}

/* Simulated time per time, with samples every 10 µs where the step allows. */
static void bench_steps(const hci_plant *plant)
{
    static const double steps_us[] = {0.5, 1.0, 2.0, 5.0, 10.0, 50.0};
    const hci_current_source source = {.strategy = HCI_STRATEGY_MTPA};
    for (size_t k = 0; k < sizeof steps_us / sizeof *steps_us; ++k) {
        const unsigned every = steps_us[k] < 10.0 ? (unsigned)(10.0 / steps_us[k] + 0.5) : 1;
        closed_loop c = loop_of(plant, &source, HCI_CURRENT_HYSTERESIS, 1e-6 * steps_us[k], every);
        const double each_s = bench_median_s(run_closed, &c) / STEPS;
        printf("  hysteresis + speed loop, mtpa, step %4.1f us, sampled every %2u: %7.2f Msteps/s, %6.1f s "
               "simulated per s\n",
               steps_us[k], every, 1e-6 / each_s, 1e-6 * steps_us[k] / each_s);
    }
}

static void bench_machine(const char *name, const pm_machine *machine)
{
    static double rows[12 * (POINTS + 1)];
    static pm_lists lists;
    hci_plant plant = {.resistance_ohm = 1.5, .inertia_kgm2 = 0.01, .viscous_Nms = 0.001};
    pm_list(machine, &lists);
    if (hci_plant_table_fill(&lists.machine, &lists.given, POINTS, rows, &plant.table) != HCI_OK) return;
    printf("%s: step %g s, table of %d points\n", name, STEP_s, POINTS);
    const double plain_s = bench_open(&plant, machine);
    bench_loops(&plant, 1, plain_s);
    bench_loops(&plant, 10, plain_s);
    bench_steps(&plant);
}

int main(void)
{
    bench_machine("interior magnets", &PM_INTERIOR);
    bench_machine("surface magnets", &PM_SINE);
    return 0;
}
