/* What is left of long recordings, against the equations that they were made with. */
#include "host/diagnose/prepare/binned_samples.h"

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3 };

static const hci_machine MACHINE = {.pole_pairs = P};
static const double NOISE_NM = 0.05, TURN = 2.0 * REF_PI;

static uint64_t seed;
static hci_run run;
static hci_binned_samples binned;
static double once_Nm; /* what repeats with the mechanical turn only */

void setUp(void)
{
    seed = 4;
    once_Nm = 0.05;
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_binned_samples_release(&binned);
    rec_release(&run);
}

static void reduce_of(const hci_machine *machine)
{
    hci_note note = {{0}};
    hci_binned_samples_release(&binned);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_binned_samples_make(machine, NAN, &run, 1, &binned, &note),
                                  note.text);
}

static void reduce(void)
{
    reduce_of(&MACHINE);
}

static double torque_at(double theta_m)
{
    return 1.0 + 0.2 * sin(6.0 * P * theta_m) + once_Nm * cos(theta_m) + 0.03 * sin(2.0 * P * theta_m + 1.0);
}

/* At constant speed, i_d = −1 A, i_q = 3 A. samples: in a turn. */
static void turn_steadily(double turns, double samples, double speed)
{
    rec_release(&run);
    run = rec_make((size_t)(turns * samples + 0.5));
    for (size_t k = 0; k < run.count; ++k) {
        const double theta_m = 0.3 + (speed < 0.0 ? -2.0 : 2.0) * REF_PI * (double)k / samples;
        run.time_s[k] = 5.0 + (double)k * 2.0 * REF_PI / samples / fabs(speed);
        run.theta_m_rad[k] = theta_m;
        run.speed_rad_per_s[k] = speed;
        rec_phases(-1.0, 3.0, P * theta_m, run.i_A + 3 * k);
        run.torque_Nm[k] = torque_at(theta_m) + NOISE_NM * ref_normal(&seed);
    }
}

/* ---- means over turns ---- */

/* Each sample is the formula at its own angle, with noise that falls with the samples in it; time goes on as
 * the shaft turns. turn_rad: after which all repeats. width_rad: of a sample, whose mean is off by half the
 * second derivative times (width/2)² at most; it has four narrow bins, and the currents are off by the width
 * of one. */
static void is_mean_of_turns(double speed, double turns, double turn_rad, double width_rad)
{
    const hci_segment *s = binned.segment;
    const double off = width_rad * width_rad / 8.0;
    double square = 0.0, samples = 0.0;
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_EQUAL_UINT64(binned.count, s->count);
    TEST_ASSERT_DOUBLE_WITHIN(1.0 + 0.002 * turns, turns, (double)s->turns);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, turn_rad / fabs(speed), s->period_s);
    for (size_t k = 0; k < s->count; ++k) {
        const hci_binned_sample *c = &binned.sample[k];
        const double theta_m = c->raw.theta_m_rad, error = c->torque_Nm - torque_at(theta_m);
        double i_abc[3];
        samples += c->count;
        square += c->count * error * error;
        TEST_ASSERT_DOUBLE_WITHIN(5.0 * NOISE_NM / sqrt(c->count) + 70.0 * off, 0.0, error);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, (theta_m - binned.sample[0].raw.theta_m_rad) / speed, c->time_s);
        rec_phases(-1.0, 3.0, P * theta_m, i_abc);
        for (int p = 0; p < 3; ++p)
            TEST_ASSERT_DOUBLE_WITHIN(29.0 * off / 16.0 + 1e-9, i_abc[p], c->raw.i_abc[p]);
        TEST_ASSERT_DOUBLE_WITHIN(0.3 * width_rad * width_rad / 12.0 + 1e-15, width_rad * width_rad / 12.0,
                                  c->spread_rad2);
        if (k > 0) TEST_ASSERT_EQUAL(speed > 0.0, theta_m > c[-1].raw.theta_m_rad);
    }
    TEST_ASSERT_TRUE(samples >= (1.0 - 1.5 / turns) * (double)run.count);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 1.0, sqrt(square / (double)s->count) / NOISE_NM); /* 400 binned: ± 3.5 % */
}

static void test_turns_become_one_mean(void)
{
    for (int direction = -1; direction <= 1; direction += 2) {
        turn_steadily(200.0, 400.0, 50.0 * direction);
        reduce();
        is_mean_of_turns(50.0 * direction, 200.0, TURN, 0.0);
        TEST_ASSERT_EQUAL_UINT64(400, binned.count);
        turn_steadily(200.0, 401.618, 50.0 * direction); /* each turn at other angles */
        reduce();
        is_mean_of_turns(50.0 * direction, 200.0, TURN, TURN / 1024.0);
        TEST_ASSERT_EQUAL_UINT64(1024, binned.count);
        TEST_ASSERT_EQUAL_DOUBLE(4.0, binned.segment[0].joined);
    }
}

/* Nine slow turns are one mean, and the most of a tenth like them tells nothing else; at another current it
 * stays as it is. */
static void test_a_part_of_a_turn_like_the_others(void)
{
    turn_steadily(9.8, 6000.0, 0.5);
    reduce();
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_EQUAL_UINT64(9, binned.segment[0].turns);
    turn_steadily(9.8, 6000.0, 0.5);
    for (size_t k = 54000; k < run.count; ++k)
        for (size_t p = 0; p < 3; ++p)
            run.i_A[3 * k + p] *= 1.5;
    reduce();
    TEST_ASSERT_EQUAL_UINT64(2, binned.segment_count);
    TEST_ASSERT_EQUAL_UINT64(0, binned.segment[1].turns);
    TEST_ASSERT_EQUAL_DOUBLE(8.0, binned.segment[1].joined);
}

/* Two turns are no mean. Of 3000 samples in an electrical period eight that follow each other are one, of
 * some 540 three, and of fewer than twice 180 none; in none the torque is that of its own angle. */
static void test_fine_samples_along_time_are_joined(void)
{
    static const double SAMPLES[] = {9000.0, 3.0 * 541.0, 3.0 * 359.0}, JOINED[] = {8.0, 3.0, 1.0};
    for (int c = 0; c < 3; ++c) {
        const double turns = c > 0 ? 2.9 * 2.0 : 2.0; /* of another current in each half */
        turn_steadily(turns, SAMPLES[c], 5.0);
        for (size_t k = 0; k < run.count; ++k)
            rec_phases(-1.0, 3.0 + 0.2 * sin(run.theta_m_rad[k] / turns), P * run.theta_m_rad[k],
                       run.i_A + 3 * k);
        reduce();
        TEST_ASSERT_EQUAL_UINT64(0, binned.segment[0].turns);
        TEST_ASSERT_EQUAL_DOUBLE(JOINED[c], binned.segment[0].joined);
        for (size_t k = 0; k < binned.count; ++k) {
            const hci_binned_sample *x = &binned.sample[k];
            TEST_ASSERT_EQUAL_DOUBLE(JOINED[c], x->count);
            TEST_ASSERT_DOUBLE_WITHIN(6.0 * NOISE_NM / sqrt(x->count), torque_at(x->raw.theta_m_rad),
                                      x->torque_Nm);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, 5.0 + (x->raw.theta_m_rad - 0.3) / 5.0, x->time_s);
        }
    }
}

/* A shaft that turns ten times as fast in one half: its samples are as fine as they are there. */
static void test_the_fastest_part_says_how_many_are_joined(void)
{
    turn_steadily(2.0, 9000.0, 5.0);
    for (size_t k = 0; k < run.count; ++k) {
        const double way = (double)k / (double)run.count,
                     turn = way < 0.5 ? 0.2 * way : 0.1 + 2.0 * (way - 0.5);
        run.theta_m_rad[k] = 2.0 * TURN * turn;
        rec_phases(-1.0, 3.0, P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    reduce();
    for (size_t k = 0; k < binned.segment_count; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(8.0, binned.segment[k].joined);
    turn_steadily(2.0, 9000.0, 5.0);
    for (size_t k = 0; k < run.count; ++k) {
        const double way = (double)k / (double)run.count;
        run.theta_m_rad[k] = 2.0 * TURN * (way < 0.9 ? 0.05 * way : 0.045 + 10.0 * (way - 0.9));
        rec_phases(-1.0, 3.0, P * run.theta_m_rad[k], run.i_A + 3 * k);
    }
    reduce();
    for (size_t k = 0; k < binned.segment_count; ++k)
        TEST_ASSERT_TRUE(binned.segment[k].joined <= 2.0);
}

/* Short recordings stay as they are, unless a turn has too few samples for the declared cogging torque, 18
 * periods of it: then what is between them stands in other turns. */
static void test_sparse_turns_become_one_mean(void)
{
    hci_harmonic sixth = {6.0, 0.2, 0.0};
    const hci_machine cogs = {.pole_pairs = P, .cogging = &sixth, .cogging_count = 1};
    turn_steadily(20.0, 40.3, 50.0);
    reduce_of(&cogs);
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 20.0, (double)binned.segment[0].turns);
    TEST_ASSERT_TRUE(binned.count > 300);
    reduce(); /* no cogging torque */
    TEST_ASSERT_EQUAL_UINT64(0, binned.segment[0].turns);
    turn_steadily(20.0, 100.3, 50.0);
    reduce_of(&cogs);
    TEST_ASSERT_EQUAL_UINT64(0, binned.segment[0].turns);
    turn_steadily(5.0, 40.3, 50.0); /* too few turns to see it in */
    reduce_of(&cogs);
    TEST_ASSERT_EQUAL_UINT64(0, binned.segment[0].turns);
}

/* So many runs that are short, of twelve turns: as they are, or where they are many samples together as
 * means; five bins are one then. count: of the runs. */
static void reduce_many(size_t count)
{
    hci_run many[6];
    hci_note note = {{0}};
    for (size_t k = 0; k < count; ++k)
        many[k] = run;
    hci_binned_samples_release(&binned);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_binned_samples_make(&MACHINE, NAN, many, count, &binned, &note));
}

static void test_many_short_runs_become_means(void)
{
    turn_steadily(12.3, 325.2, 50.0);
    reduce_many(4);
    TEST_ASSERT_EQUAL_UINT64(4 * run.count, binned.count);
    reduce_many(6);
    TEST_ASSERT_EQUAL_UINT64(6, binned.segment_count);
    TEST_ASSERT_EQUAL_UINT64(12, binned.segment[5].turns);
    TEST_ASSERT_TRUE(binned.count <= 6 * 820);
    turn_steadily(3.0, 1000.0, 50.0); /* the last one ends with the run */
    reduce_many(6);
    TEST_ASSERT_EQUAL_UINT64(3, binned.segment[5].turns);
    turn_steadily(30.0, 100.0, 50.0); /* the means would be much finer than the samples */
    reduce_many(6);
    TEST_ASSERT_EQUAL_UINT64(6 * run.count, binned.count);
    turn_steadily(12.3, 325.2, 50.0);
    for (size_t k = 0; k < run.count; ++k) /* what does not repeat */
        run.torque_Nm[k] += 0.1 * sin(2000.0 * run.time_s[k] + 3.0 * sin(1.7 * run.time_s[k]));
    reduce_many(6);
    TEST_ASSERT_EQUAL_UINT64(6 * run.count, binned.count);
}

/* Noise that goes on for a tenth of a turn: a mean has it at a few orders, beside which nothing tells that it
 * is noise. A run stays in parts as it is, unless it is very long. Of noise that goes on for a few samples
 * the means stay. */
static void test_slow_noise_stays(void)
{
    static const double goes_on[] = {0.95, 0.95, 0.5};
    static const double turns[] = {12.3, 60.3, 12.3};
    for (int k = 0; k < 3; ++k) {
        double slow = 0.0;
        turn_steadily(turns[k], 400.0, 30.0);
        for (size_t j = 0; j < run.count; ++j)
            run.torque_Nm[j] += 0.3 * NOISE_NM * (slow = goes_on[k] * slow + ref_normal(&seed));
        reduce();
        TEST_ASSERT_EQUAL_UINT64(k == 0 ? 2 : 1, binned.segment_count);
        TEST_ASSERT_TRUE((binned.segment[0].turns == 0) == (k == 0));
    }
}

/* A steep ripple is no scatter of the samples that are at about the same angle. */
static void test_a_steep_torque_does_not_scatter(void)
{
    double square = 0.0, freedom = 0.0;
    turn_steadily(200.0, 401.618, 50.0);
    for (size_t k = 0; k < run.count; ++k)
        run.torque_Nm[k] += 2.0 * sin(24.0 * run.theta_m_rad[k]); /* 12 mN·m a milliradian */
    reduce();
    for (size_t k = 0; k < binned.count; ++k) {
        square += binned.sample[k].scatter_N2m2;
        freedom += binned.sample[k].count - 1.0;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * NOISE_NM, NOISE_NM, sqrt(square / freedom));
}

/* A wrapped electrical angle: which of the pole pairs it is about is not known, so electrical periods are the
 * turns. */
static void test_turns_of_a_wrapped_electrical_angle(void)
{
    once_Nm = 0.0;
    turn_steadily(200.0, 401.618, 50.0);
    run.turn_known = false;
    reduce();
    is_mean_of_turns(50.0, 600.0, TURN / P, TURN / P / 1024.0);
    turn_steadily(2.5, 2000.0, 50.0); /* seven electrical periods are enough for a mean */
    run.turn_known = false;
    reduce();
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_TRUE(binned.segment[0].turns > 0);
}

/* What a run may have or not: no time, a temperature that rises, currents that have a sum. */
static void test_other_columns_of_a_mean(void)
{
    turn_steadily(20.0, 400.0, 50.0);
    free(run.time_s);
    run.time_s = NULL;
    run.has_sum = true;
    run.temperature_C = calloc(run.count, sizeof *run.temperature_C);
    for (size_t k = 0; k < run.count; ++k) {
        run.i_A[3 * k] += 0.3;
        run.temperature_C[k] = 40.0 + 0.02 * (double)(k / 400);
    }
    reduce();
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_FALSE(binned.segment[0].timed);
    for (size_t k = 0; k < binned.count; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(0.0, binned.sample[k].time_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, binned.sample[k].reading.change_A_per_s[0]); /* slope of means */
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3, binned.sample[k].sum_A);
        TEST_ASSERT_DOUBLE_WITHIN(0.02, 40.19, binned.sample[k].reading.temperature_C);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 40.19, binned.statistics[0].temperature_C);
}

/* Where only noise of the currents was read, it is the same in all turns. */
static void test_turns_without_current(void)
{
    turn_steadily(20.0, 400.0, 50.0);
    for (size_t k = 0; k < 3 * run.count; ++k)
        run.i_A[k] = 0.01 * ref_normal(&seed);
    reduce();
    TEST_ASSERT_TRUE(binned.statistics[0].no_current);
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_TRUE(binned.segment[0].turns > 0);
    TEST_ASSERT_EQUAL_UINT64(400, binned.count);
    for (int s = 0; s < 3; ++s)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, binned.sample[7].raw.i_abc[s]);
}

/* A current sensor that is off by less than its noise: means of turns differ by chance and are still means.
 */
static void test_turns_of_a_current_that_is_noise_and_an_offset(void)
{
    turn_steadily(20.0, 400.0, 50.0);
    for (size_t k = 0; k < run.count; ++k)
        for (size_t s = 0; s < 3; ++s)
            run.i_A[3 * k + s] = (s == 0 ? 0.008 : -0.004) + 0.012 * ref_normal(&seed);
    reduce();
    TEST_ASSERT_FALSE(binned.statistics[0].no_current);
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_TRUE(binned.segment[0].turns > 0);
    TEST_ASSERT_EQUAL_UINT64(400, binned.count);
}

/* ---- holding maps: the current that holds the shaft, at rest, one way and the other ---- */

/* Five turns there and five back; friction holds with one sign or the other. */
static void hold(size_t samples, double friction_A)
{
    rec_release(&run);
    run = rec_make(10 * samples);
    run.torque_source = HCI_TORQUE_HOLDING;
    free(run.speed_rad_per_s);
    free(run.time_s);
    run.speed_rad_per_s = run.time_s = NULL;
    for (size_t k = 0; k < run.count; ++k) {
        const size_t at = k < run.count / 2 ? k : run.count - 1 - k;
        const double sign = k < run.count / 2 ? 1.0 : -1.0;
        run.theta_m_rad[k] = 2.0 * REF_PI * (double)at / (double)samples;
        rec_phases(0.0, 0.5 * sin(12.0 * run.theta_m_rad[k]) + friction_A * sign, P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
    }
}

/* Two means, each of one direction; about the turning point samples may stay as they are, or one in six be of
 * the other. */
static void is_held(double friction_A)
{
    size_t means = 0;
    hold(1000, friction_A);
    reduce();
    for (size_t k = 0; k < binned.segment_count; ++k) {
        const hci_segment *s = &binned.segment[k];
        const double sign = means == 0 ? 1.0 : -1.0;
        if (s->turns == 0) continue;
        TEST_ASSERT_DOUBLE_WITHIN(1.0, 5.0, (double)s->turns);
        TEST_ASSERT_TRUE(s->count >= 1000);
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            const hci_sample *x = &binned.sample[j].raw;
            double d, q;
            rec_rotor(x->i_abc, P * x->theta_m_rad, &d, &q);
            TEST_ASSERT_DOUBLE_WITHIN(0.4 * friction_A, 0.5 * sin(12.0 * x->theta_m_rad) + friction_A * sign,
                                      q);
            TEST_ASSERT_EQUAL_DOUBLE(0.0, binned.sample[j].torque_Nm);
            if (j > s->first)
                TEST_ASSERT_EQUAL(sign > 0.0, x->theta_m_rad > binned.sample[j - 1].raw.theta_m_rad);
        }
        ++means;
    }
    TEST_ASSERT_EQUAL_UINT64(2, means);
}

static void test_holding_there_and_back(void)
{
    is_held(0.3);
    is_held(1e-3);
}

/* ---- samples as they are ---- */

static bool is_sample(const hci_binned_sample *c, size_t k)
{
    return c->count == 1.0 && c->raw.theta_m_rad == run.theta_m_rad[k] && c->torque_Nm == run.torque_Nm[k] &&
           c->raw.i_abc[1] == run.i_A[3 * k + 1] && c->time_s == run.time_s[k];
}

/* The current swings so often in a turn. */
static void swing(double times)
{
    turn_steadily(20.0, 800.0, 50.0);
    for (size_t k = 0; k < run.count; ++k)
        rec_phases(-1.0, 3.0 + 0.3 * sin(times * run.theta_m_rad[k]), P * run.theta_m_rad[k],
                   run.i_A + 3 * k);
}

/* With the turn it is the same at each angle. */
static void test_a_current_that_swings_with_the_turn_has_a_mean(void)
{
    swing(2.0);
    reduce();
    TEST_ASSERT_EQUAL_UINT64(1, binned.segment_count);
    TEST_ASSERT_EQUAL_UINT64(19, binned.segment[0].turns); /* the last one is cut off */
}

/* Neither speed nor current change for a moment only, or the current swings beside the turn, nearly with it
 * too: nothing is averaged, and parts of it stand for all. */
/* A current that swings at a frequency of its own, as from the mains, with its torque: readings of means as
 * they are, and no more scatter than the sensor's noise. */
static void test_a_current_that_swings_beside_the_turn(void)
{
    const hci_wave back_emf = {1.0, 1, 0.2, 0.0}; /* 0.3 N·m/A of i_q */
    const hci_machine machine = {.pole_pairs = P, .back_emf = &back_emf, .back_emf_count = 1};
    double square = 0.0, scatter = 0.0;
    turn_steadily(12.3, 1000.0, 20.0);
    for (size_t k = 0; k < run.count; ++k) {
        const double wave_A = 0.15 * sin(2.0 * REF_PI * 61.3 * run.time_s[k]);
        rec_phases(0.0, 3.0 + wave_A, P * run.theta_m_rad[k], run.i_A + 3 * k);
        run.torque_Nm[k] += 0.3 * (3.0 + wave_A);
    }
    reduce_of(&machine);
    TEST_ASSERT_EQUAL_UINT64(12, binned.segment->turns);
    for (size_t k = 0; k < binned.count; ++k) {
        const hci_binned_sample *x = &binned.sample[k];
        const double error = x->torque_Nm - torque_at(x->reading.theta_m_rad) -
                             hci_torque_at(&machine, P * x->reading.theta_m_rad, x->reading.i_abc);
        square += error * error * x->count / (double)binned.count;
        scatter += x->scatter_N2m2 / (double)(run.count - binned.count);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * NOISE_NM, NOISE_NM, sqrt(square));
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * NOISE_NM, NOISE_NM, sqrt(scatter));
}

static void test_an_unsteady_run_stays(void)
{
    for (int what = 0; what < 4; ++what) {
        size_t at = 0;
        turn_steadily(100.0, 800.0, 50.0);
        for (size_t k = 0; k < run.count && what < 2; ++k) {
            const double share = (double)k / (double)run.count;
            if (what == 0) run.speed_rad_per_s[k] *= 1.0 + 4.0 * share;
            if (what == 1) rec_phases(-1.0, 3.0 + 12.0 * share, P * run.theta_m_rad[k], run.i_A + 3 * k);
        }
        if (what > 1) swing(what == 2 ? 0.37 : 1.01);
        reduce();
        TEST_ASSERT_TRUE(binned.segment_count > 1 && binned.count <= run.count);
        for (size_t s = 0; s < binned.segment_count; ++s) {
            TEST_ASSERT_EQUAL_UINT64(0, binned.segment[s].turns);
            TEST_ASSERT_TRUE(binned.segment[s].count <= HCI_LONGEST_SEGMENT);
            for (size_t j = 0; j < binned.segment[s].count; ++j, ++at) {
                const hci_binned_sample *c = &binned.sample[binned.segment[s].first + j];
                while (at < run.count && !is_sample(c, at))
                    ++at;
                TEST_ASSERT_TRUE(at < run.count);
            }
        }
        TEST_ASSERT_TRUE(at > run.count * 3 / 4); /* to the end of it */
    }
}

static void test_short_runs(void)
{
    for (size_t n = 0; n < 60; ++n) {
        turn_steadily((double)n / 400.0, 400.0, 50.0);
        reduce();
        TEST_ASSERT_EQUAL_UINT64(n, binned.count);
        TEST_ASSERT_EQUAL_UINT64(n > 0, binned.segment_count);
        for (size_t k = 0; k < n; ++k) {
            TEST_ASSERT_TRUE(is_sample(&binned.sample[k], k));
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, binned.sample[k].reading.change_A_per_s[0]);
        }
    }
    free(run.torque_Nm);
    run.torque_Nm = NULL;
    reduce();
    TEST_ASSERT_EQUAL_UINT64(0, binned.count);
    TEST_ASSERT_EQUAL_UINT64(1, binned.run_count);
}

/* A free shaft whose speed falls to a third within each turn: its accelerations are of time, which a mean
 * over turns spreads evenly. One at a steady speed is averaged. */
static void test_an_uneven_free_shaft_stays(void)
{
    for (int uneven = 0; uneven < 2; ++uneven) {
        turn_steadily(20.0, 400.0, 50.0);
        run.torque_source = HCI_TORQUE_INERTIA;
        for (size_t k = 0; k < run.count && uneven; ++k)
            run.speed_rad_per_s[k] = 50.0 + 25.0 * sin(run.theta_m_rad[k]);
        reduce();
        TEST_ASSERT_EQUAL(uneven == 0, binned.segment[0].turns > 0);
    }
}

static void test_memory_is_out(void)
{
    hci_note note;
    hci_status status = HCI_ERROR_MEMORY;
    long n = 0;
    turn_steadily(20.0, 1400.0, 50.0); /* enough for a series of the currents */
    for (; status == HCI_ERROR_MEMORY; ++n) {
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(n);
        status = hci_binned_samples_make(&MACHINE, NAN, &run, 1, &binned, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_EQUAL(status == HCI_OK, note.text[0] == '\0');
        TEST_ASSERT_EQUAL(status == HCI_OK, binned.sample != NULL);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, status);
    TEST_ASSERT_TRUE(n > 5);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_turns_become_one_mean);
    RUN_TEST(test_a_part_of_a_turn_like_the_others);
    RUN_TEST(test_fine_samples_along_time_are_joined);
    RUN_TEST(test_the_fastest_part_says_how_many_are_joined);
    RUN_TEST(test_sparse_turns_become_one_mean);
    RUN_TEST(test_many_short_runs_become_means);
    RUN_TEST(test_slow_noise_stays);
    RUN_TEST(test_a_steep_torque_does_not_scatter);
    RUN_TEST(test_turns_of_a_wrapped_electrical_angle);
    RUN_TEST(test_other_columns_of_a_mean);
    RUN_TEST(test_turns_without_current);
    RUN_TEST(test_turns_of_a_current_that_is_noise_and_an_offset);
    RUN_TEST(test_holding_there_and_back);
    RUN_TEST(test_a_current_that_swings_with_the_turn_has_a_mean);
    RUN_TEST(test_a_current_that_swings_beside_the_turn);
    RUN_TEST(test_an_unsteady_run_stays);
    RUN_TEST(test_short_runs);
    RUN_TEST(test_an_uneven_free_shaft_stays);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
