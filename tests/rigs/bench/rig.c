/* rig KIND SEED FOLDER: recordings of a machine that has an effect which its owner does not know of.
 * rig --list: the kinds. rig --self-test: whether the rig keeps the laws of physics and its own word. */
#include "rig.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int failures;

static void expect(bool held, const char *law, const char *kind, double found, double wanted)
{
    if (held) return;
    ++failures;
    printf("FAILED %s (%s): %.9g, expected %.9g\n", law, kind, found, wanted);
}

/* ---- laws ---- */

/* The coenergy by the inductance table: its slope at constant phase currents is the reluctance torque. */
static double table_coenergy(const rig_machine *m, double theta_m_rad, const double i[3])
{
    double l[6];
    rig_inductances(m, m->pole_pairs * theta_m_rad, l);
    return 0.5 * (l[0] * i[0] * i[0] + l[1] * i[1] * i[1] + l[2] * i[2] * i[2]) + l[3] * i[0] * i[1] +
           l[4] * i[1] * i[2] + l[5] * i[2] * i[0];
}

static void test_reluctance(void)
{
    rig_random r = rig_random_of("reluctance", 1);
    for (int k = 0; k < 50; ++k) {
        rig_machine m = rig_machine_draw(7, &r);
        const double h = 1e-5, theta = rig_uniform(&r, -3.0, 3.0);
        const double i[3] = {rig_normal(&r), rig_normal(&r), rig_normal(&r)};
        const double slope =
            (table_coenergy(&m, theta + h, i) - table_coenergy(&m, theta - h, i)) / (2.0 * h);
        m.emf_count = m.cogging_count = 0;
        const double torque = rig_torque_declared(&m, theta, i);
        expect(fabs(slope - torque) < 1e-6 * m.pole_pairs * m.lq_H * 10.0 + 1e-12, "T = dW/dθ of the table",
               "salient", torque, slope);
    }
}

/* What the magnets and currents take and give over a turn, by power: ∮T dθ_m of a co-energy at currents that
 * stand in the stator is 0. */
static void test_no_perpetual_motion(bool quick)
{
    for (int effect = 0; effect < RIG_EFFECTS; ++effect) {
        rig_case c;
        rig_instant x = {0.0, 10.0, {1.3, -0.4, -0.9}, 60.0};
        double work = 0.0, size = 0.0;
        if (effect == RIG_FRICTION) continue;
        if (quick && effect == RIG_TORQUE_SENSOR) continue; /* to draw it a second is integrated */
        rig_case_draw(RIG_EFFECT_NAME[effect], 7, &c);
        for (int k = 0; k < 1000; ++k) {
            x.theta_m_rad = 2.0 * RIG_PI * k / 1000.0;
            const double torque = rig_torque_true(&c, &x);
            work += torque / 1000.0;
            size += fabs(torque) / 1000.0;
        }
        if (fabs(c.hidden.turn_iq[0].order) > 0.0) continue; /* its i_q holds its own mean */
        expect(fabs(work) < 1e-9 * size, "no work over a turn at standing currents", RIG_EFFECT_NAME[effect],
               work, 0.0);
    }
}

/* Each coenergy term against ∂W'/∂θ_m by differences of W' as docs/effects.md writes it. */
static double coenergy(const rig_case *c, double theta_m_rad, const double i[3])
{
    const rig_hidden *h = &c->hidden;
    const double theta = c->machine.pole_pairs * theta_m_rad, i0 = c->machine.rated_current_A;
    double d, q;
    rig_dq_of(theta, i, &d, &q);
    return 1.5 * 0.5 * (h->dd_cosine_0 * d * d + h->qq_cosine_6 * cos(6.0 * theta) * q * q) +
           h->d1q2_cosine_0 * (d / i0) * pow(q / i0, 2.0) +
           h->d0q3_sine_6 * sin(6.0 * theta) * pow(q / i0, 3.0) + h->d3q0_cosine_0 * pow(d / i0, 3.0);
}

static void test_coenergy(uint64_t cases)
{
    for (uint64_t seed = 0; seed < cases; ++seed) {
        rig_case c;
        const char *kind = RIG_EFFECT_NAME[seed % 2 ? RIG_RELUCTANCE : RIG_SATURATION];
        rig_case_draw(kind, seed, &c);
        const double h = 1e-5, a = c.machine.rated_current_A;
        rig_instant x = {0.1 * (double)seed, 10.0, {0.7 * a, -0.1 * a, -0.6 * a}, 20.0};
        const double slope =
            (coenergy(&c, x.theta_m_rad + h, x.i_A) - coenergy(&c, x.theta_m_rad - h, x.i_A)) / (2.0 * h);
        const double torque = rig_torque_true(&c, &x) - rig_torque_declared(&c.machine, x.theta_m_rad, x.i_A);
        expect(fabs(slope - torque) < 1e-6 * c.machine.rated_torque_Nm, "T = dW/dθ", kind, torque, slope);
    }
}

/* i_q makes 3/2 e_1 i_q in the mean, and i_d makes L_d > L_q pull. */
static void test_frame(void)
{
    double i[3], d, q;
    rig_abc_of(0.7, -2.0, 3.0, i);
    rig_dq_of(0.7, i, &d, &q);
    expect(fabs(d + 2.0) < 1e-12 && fabs(q - 3.0) < 1e-12, "dq of abc of dq", "frame", d, -2.0);
    rig_abc_of(RIG_PI / 2.0, 0.0, 1.0, i);
    expect(fabs(i[0] - 1.0) < 1e-12, "i_a = i_q sin θ − i_d cos θ", "frame", i[0], 1.0);
}

/* The sensor's answer to a sine against |G| and arg G. */
static void test_sensor(void)
{
    rig_hidden h = {0};
    rig_sensor s = {0.0, 0.0, 0.0};
    const double omega = 2.0 * RIG_PI * 40.0, wn = 2.0 * RIG_PI * 60.0, step = 1e-5;
    double in_phase = 0.0, across = 0.0;
    h.time_constant_s = 3e-3;
    h.natural_frequency_Hz = 60.0;
    h.damping = 0.1;
    for (int k = 0; k < 60000; ++k) { /* the last 4 of 24 periods */
        const double t = k * step,
                     input[3] = {sin(omega * t), sin(omega * (t + 0.5 * step)), sin(omega * (t + step))};
        rig_sensor_step(&h, input, step, &s);
        if (k < 50000) continue;
        in_phase += 2.0 * s.resonator_Nm * sin(omega * (t + step)) / 10000.0;
        across += 2.0 * s.resonator_Nm * cos(omega * (t + step)) / 10000.0;
    }
    const double x = omega / wn, gain = 1.0 / hypot(1.0, omega * 3e-3) / hypot(1.0 - x * x, 0.2 * x);
    const double phase = -atan(omega * 3e-3) - atan2(0.2 * x, 1.0 - x * x);
    expect(fabs(hypot(in_phase, across) / gain - 1.0) < 1e-4, "|G|", "torque_sensor", hypot(in_phase, across),
           gain);
    expect(fabs(sin(atan2(across, in_phase) - phase)) < 1e-4, "arg G", "torque_sensor",
           atan2(across, in_phase), phase);
}

/* ---- the rig's word ---- */

/* Speed is the slope of the angle. */
static void test_kinematics(const char *kind, const rig_case *c)
{
    const rig_run *run = &c->run[4];
    const double h = 1e-6 * run->duration_s, t = 0.37 * run->duration_s;
    const double slope =
        (rig_run_at(c, run, t + h).theta_m_rad - rig_run_at(c, run, t - h).theta_m_rad) / (2.0 * h);
    const double speed = rig_run_at(c, run, t).omega_rad_per_s;
    expect(fabs(slope / speed - 1.0) < 1e-5, "ω = dθ/dt", kind, slope, speed);
}

/* The residual of the declared machine at the readings is noise and hidden effect, in squares. */
static void test_residual(const char *kind, const rig_case *c)
{
    double residual = 0.0, noise = 0.0;
    int count = 0, samples = 0;
    for (int k = 0; k < c->run_count; ++k) {
        const rig_run *run = &c->run[k];
        rig_reading *x = malloc((size_t)run->samples * sizeof *x);
        if (!x) abort();
        const int n = rig_run_read(c, run, x);
        samples += n;
        for (int j = 0; j < n && !run->holdout; ++j) {
            const double r = x[j].torque_Nm - rig_torque_declared(&c->machine, x[j].theta_m_rad, x[j].i_A);
            residual += r * r / n;
            noise += x[j].noise_Nm * x[j].noise_Nm / n;
        }
        count += !run->holdout;
        free(x);
    }
    const double hidden = rig_hidden_rms(c), expected = sqrt(noise / count + hidden * hidden);
    const double found = sqrt(residual / count), size = hidden / sqrt(noise / count);
    const bool some = c->effect_count > 0 || c->invented.kind != RIG_KNOWN;
    printf("%-24s p %d%s  %d runs %5d samples  hidden/noise %.2f  residual/expected %.3f\n", kind,
           c->machine.pole_pairs, c->machine.salient ? " salient" : "", c->run_count, samples, size,
           found / expected);
    expect(samples > 18000 && samples < 42000, "samples of a case", kind, samples, 30000.0);
    /* a resonance also rings with the noise of the readings */
    expect(fabs(found / expected - 1.0) < (rig_sensor_is_ideal(&c->hidden) ? 0.05 : 0.3),
           "residual² = noise² + hidden²", kind, found, expected);
    expect(some ? size > 0.35 && size < (c->hidden.natural_frequency_Hz > 0.0 ? 16.0 : 8.0) : size < 1e-9,
           "size of what is hidden", kind, size, some ? 2.0 : 0.0);
}

/* With its own truth the residual is the noise: the rounding and current noise are taken exactly here, not by
 * derivatives. Effects on the bench are undone by hand where that has a closed form. */
static void test_noise(const char *kind, const rig_case *c)
{
    const rig_hidden *h = &c->hidden;
    const rig_run *run = &c->run[7];
    if (!rig_sensor_is_ideal(h) || h->eccentricity[0].order > 0.0 || h->current_delay_s > 0.0 ||
        h->angle_delay_s > 0.0 || c->form.dq || c->invented.kind != RIG_KNOWN)
        return;
    rig_reading *x = malloc((size_t)run->samples * sizeof *x);
    if (!x) abort();
    const int n = rig_run_read(c, run, x);
    double worst = 0.0;
    for (int j = 0; j < n; ++j) {
        rig_instant truth = rig_run_at(c, run, x[j].time_s);
        truth.theta_m_rad = x[j].theta_m_rad - h->position_offset_rad / c->machine.pole_pairs;
        for (int s = 0; s < 3; ++s)
            truth.i_A[s] = (x[j].i_A[s] - h->current_offset_A[s]) / (1.0 + h->current_gain[s]);
        worst = fmax(worst,
                     fabs(x[j].torque_Nm - h->torque_offset_Nm - rig_torque_true(c, &truth) - x[j].noise_Nm));
    }
    free(x);
    expect(worst < 1e-9 * c->machine.rated_torque_Nm, "reading less exact model = noise", kind, worst, 0.0);
}

static void test_kind(const char *kind, uint64_t seeds)
{
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
        rig_case c;
        const bool drawn = rig_case_draw(kind, seed, &c);
        expect(drawn, "a kind of --list", kind, 0.0, 1.0);
        if (!drawn) return;
        test_kinematics(kind, &c);
        test_residual(kind, &c);
        test_noise(kind, &c);
    }
}

static void test_all_kinds(uint64_t seeds)
{
    test_kind("none", seeds);
    for (int k = 0; k < RIG_EFFECTS; ++k)
        test_kind(RIG_EFFECT_NAME[k], seeds);
    test_kind("two", seeds);
    for (int k = 1; k < RIG_INVENTIONS; ++k)
        test_kind(RIG_INVENTION_NAME[k], seeds);
}

/* The laws, and so many cases of each kind. kinds: ends with NULL; an empty list stands for all, and for more
 * cases of the laws. */
static int self_test(uint64_t seeds, char **kinds)
{
    test_frame();
    test_reluctance();
    test_coenergy(*kinds ? 6 : 40);
    test_no_perpetual_motion(*kinds != NULL);
    test_sensor();
    for (char **kind = kinds; *kind; ++kind)
        test_kind(*kind, seeds);
    if (!*kinds) test_all_kinds(seeds);
    printf("%d failures\n", failures);
    return failures != 0;
}

/* ---- command ---- */

static int list(void)
{
    puts("none");
    for (int k = 0; k < RIG_EFFECTS; ++k)
        puts(RIG_EFFECT_NAME[k]);
    puts("two");
    for (int k = 1; k < RIG_INVENTIONS; ++k)
        puts(RIG_INVENTION_NAME[k]);
    return 0;
}

int main(int argc, char **argv)
{
    char *end = NULL;
    rig_case c;
    if (argc == 2 && strcmp(argv[1], "--list") == 0) return list();
    if (argc >= 2 && strcmp(argv[1], "--self-test") == 0)
        return self_test(argc > 2 ? strtoull(argv[2], NULL, 10) : 2, argv + (argc > 2 ? 3 : 2));
    const uint64_t seed = argc == 4 ? strtoull(argv[2], &end, 10) : 0;
    if (argc != 4 || *end != '\0') {
        fputs("usage: rig KIND SEED FOLDER | rig --list | rig --self-test [SEEDS [KIND...]]\n", stderr);
        return 2;
    }
    if (!rig_case_draw(argv[1], seed, &c)) {
        fprintf(stderr, "rig: found kind `%s`, expected one of `rig --list`\n", argv[1]);
        return 2;
    }
    return rig_case_write(&c, argv[3]) ? 0 : 5;
}
