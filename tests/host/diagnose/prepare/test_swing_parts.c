/* The parts of the search for swings by themselves: closed forms, plain sums, and each bound from both sides.
 */
#include "host/diagnose/prepare/swing.c"

#include "support/recording.h"
#include "unity.h"

enum { P = 3, N = 600, MEANS = 300 };

static const double TURN = 2.0 * REF_PI;

static uint64_t seed;
static hci_run run;
static hci_run_statistics statistics;
static hci_dq current[N];
static double left_Nm[N], numbers[3 * MEANS + 2 * 1024];
static question x;
static changes c;

/* 600 samples of 1 ms, 5 turns a second; changes of 300 means of 2 ms over a turn of 0.2 s. */
void setUp(void)
{
    seed = 4;
    run = rec_make(N);
    for (size_t k = 0; k < N; ++k) {
        run.time_s[k] = 1e-3 * (double)k;
        run.theta_m_rad[k] = 5.0 * TURN * run.time_s[k];
        run.speed_rad_per_s[k] = 5.0 * TURN;
        current[k] = (hci_dq){0.0, 3.0, 0.0};
        left_Nm[k] = 0.0;
    }
    statistics = (hci_run_statistics){.turns = 3.0, .current_A = 3.0, .mean_speed_rad_per_s = 5.0 * TURN};
    x = (question){&run, &statistics, 0.45, P, current, left_Nm};
    memset(numbers, 0, sizeof numbers);
    c = (changes){.change_Nm = numbers,
                  .time_s = numbers + MEANS,
                  .before_s = numbers + 2 * MEANS,
                  .re = numbers + 3 * MEANS,
                  .im = numbers + 3 * MEANS + 1024,
                  .count = MEANS,
                  .size = 1024,
                  .turn_s = 0.2,
                  .span_s = 0.598,
                  .mean_s = 0.002,
                  .most_Hz = 100.0};
    for (size_t k = 0; k < MEANS; ++k) {
        c.time_s[k] = 0.2 + 0.002 * (double)k;
        c.before_s[k] = c.time_s[k] - 0.2;
    }
}

void tearDown(void)
{
    rec_release(&run);
}

/* ---- one turn before ---- */

static void test_places_one_turn_before(void)
{
    place p = {0, 0.0};
    for (int way = -1; way <= 1; way += 2) {
        p = (place){0, 0.0};
        for (size_t k = 0; k < N; ++k) {
            run.theta_m_rad[k] = way * TURN * ((double)k + 0.3 * sin(0.02 * (double)k)) / 150.4;
            const bool found = place_find(&run, k, (double)way, &p);
            TEST_ASSERT_EQUAL(fabs(run.theta_m_rad[k]) >= TURN, found);
            if (!found) continue;
            const double then = between(&p, run.theta_m_rad[p.at], run.theta_m_rad[p.at + 1]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, run.theta_m_rad[k] - way * TURN, then);
            TEST_ASSERT_TRUE(p.share >= 0.0 && p.share <= 1.0);
        }
    }
}

/* A change of the torque, the times of both, and the square of what the current changes by. */
static void test_changes_by_hand(void)
{
    const place p = {40, 0.25};
    for (size_t k = 0; k < N; ++k) {
        left_Nm[k] = sin(0.1 * (double)k);
        current[k] = (hci_dq){cos(0.2 * (double)k), sin(0.3 * (double)k), 0.0};
    }
    memset(numbers, 0, sizeof numbers);
    const double square = change_add(&x, 240, &p, 0.5, &c, 7);
    const double then = 0.75 * left_Nm[40] + 0.25 * left_Nm[41];
    const double d = current[240].d - 0.75 * current[40].d - 0.25 * current[41].d,
                 q = current[240].q - 0.75 * current[40].q - 0.25 * current[41].q;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * (left_Nm[240] - then), c.change_Nm[7]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * 0.240, c.time_s[7]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 * 0.04025, c.before_s[7]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, d * d + q * q, square);
}

/* Means of two samples each; the current may change over a turn by a tenth of its rms. */
static bool fills(double step_A)
{
    for (size_t k = 0; k < N; ++k) {
        current[k].q = 3.0 + (k >= 400 ? step_A : 0.0);
        left_Nm[k] = 1e-3 * (double)k;
    }
    memset(numbers, 0, sizeof numbers);
    c.count = 100;
    return changes_fill(&x, 1.0, 200, 2, &c);
}

static void test_means_of_changes(void)
{
    TEST_ASSERT_TRUE(fills(0.29));
    for (size_t k = 0; k < 100; ++k) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2, c.change_Nm[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2005 + 0.002 * (double)k, c.time_s[k]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, c.time_s[k] - 0.2, c.before_s[k]);
    }
    c.count = 100;
    for (size_t k = 300; k < 400; ++k)
        current[k].q = 3.31; /* a half of what is looked at */
    TEST_ASSERT_TRUE(changes_fill(&x, 1.0, 200, 2, &c));
    for (size_t k = 200; k < 400; ++k)
        current[k].q = 3.31;
    TEST_ASSERT_FALSE(changes_fill(&x, 1.0, 200, 2, &c));
    statistics.no_current = true;
    TEST_ASSERT_TRUE(changes_fill(&x, 1.0, 200, 2, &c));
}

/* ---- lines ---- */

static void wave(double frequency_Hz, double cosine, double sine)
{
    for (size_t k = 0; k < MEANS; ++k) {
        const double w = TURN * frequency_Hz, t = c.time_s[k], b = c.before_s[k];
        c.change_Nm[k] += cosine * (cos(w * t) - cos(w * b)) + sine * (sin(w * t) - sin(w * b));
    }
}

static void test_a_line_is_fitted_and_taken_out(void)
{
    for (size_t k = 0; k < MEANS; ++k) {
        c.time_s[k] += ref_uniform(&seed, -0.0005, 0.0005);
        c.before_s[k] += ref_uniform(&seed, -0.0005, 0.0005);
    }
    wave(17.3, 0.3, -0.5);
    double square = 0.0;
    for (size_t k = 0; k < MEANS; ++k)
        square += c.change_Nm[k] * c.change_Nm[k];
    const line a = line_fit(&c, 17.3), near = line_refine(&c, 17.3 + 0.9);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.3, a.cosine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, -0.5, a.sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * square, square, a.square);
    TEST_ASSERT_DOUBLE_WITHIN(1e-4, 17.3, near.frequency_Hz);
    line_leave(&c, &a, 1.0);
    for (size_t k = 0; k < MEANS; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.0, c.change_Nm[k]);
    line_leave(&c, &a, -1.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.3, line_fit(&c, 17.3).cosine);
    const line none = line_fit(&c, 0.0); /* of which no change is left */
    TEST_ASSERT_TRUE(none.square == 0.0 && none.cosine == 0.0);
}

/* Two lines within the length of the run: each by itself is wrong, both are right after they have settled. */
static void test_lines_that_are_near(void)
{
    line lines[2];
    wave(17.0, 0.3, 0.1);
    wave(20.5, -0.1, 0.25);
    lines[0] = line_fit(&c, 17.2);
    line_leave(&c, &lines[0], 1.0);
    lines[1] = line_fit(&c, 20.2);
    line_leave(&c, &lines[1], 1.0);
    lines_settle(&c, lines, 2);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 17.0, lines[0].frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(0.05, 20.5, lines[1].frequency_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.3, lines[0].cosine);
    TEST_ASSERT_DOUBLE_WITHIN(0.02, 0.25, lines[1].sine);
}

static void test_what_of_a_swing_is_seen(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, seen(&c, 2.5));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, seen(&c, 15.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * sin(REF_PI * 0.06), seen(&c, 15.3));
    c.refused_Hz[1] = 30.0, c.refused = 2;
    TEST_ASSERT_TRUE(is_refused(&c, 30.0 + 1.99 / 0.598) && is_refused(&c, 30.0 - 1.99 / 0.598));
    TEST_ASSERT_FALSE(is_refused(&c, 30.0 + 2.01 / 0.598) || is_refused(&c, 30.0 - 2.01 / 0.598));
}

/* The power of the windowed changes about their mean, by a plain sum, over what is seen of it. */
static void test_the_spectrum_by_plain_sums(void)
{
    double mean = 0.0;
    for (size_t k = 0; k < MEANS; ++k)
        mean += (c.change_Nm[k] = 0.4 + ref_normal(&seed)) / MEANS;
    c.refused = 1, c.refused_Hz[0] = 63.0;
    spectrum_fill(&c);
    for (size_t m = 0; m < 512; ++m) {
        const double f = (double)m / 2.048, part = fabs(2.0 * sin(REF_PI * f * 0.2));
        const bool told = f * 0.798 > 2.0 && f < 100.0 && part > 0.4 && fabs(f - 63.0) >= 2.0 / 0.598;
        double re = 0.0, im = 0.0;
        for (size_t k = 0; k < MEANS && m % 13 == 0; ++k) {
            const double w = 1.0 - cos(TURN * ((double)k + 0.5) / MEANS),
                         angle = TURN * (double)(k * m % 1024) / 1024.0;
            re += w * (c.change_Nm[k] - mean) * cos(angle);
            im -= w * (c.change_Nm[k] - mean) * sin(angle);
        }
        TEST_ASSERT_EQUAL(told, c.re[m] >= 0.0);
        if (m % 13 == 0) TEST_ASSERT_DOUBLE_WITHIN(1e-8, re * re + im * im, c.im[m]);
        if (told) TEST_ASSERT_DOUBLE_WITHIN(1e-9 * c.re[m], c.im[m] / (part * part), c.re[m]);
    }
}

/* The median over ln 2, of 64 places on each side but what a line takes: 2·1024/300 + 1 = 7. */
static void test_noise_about_a_line(void)
{
    for (size_t k = 0; k < 512; ++k)
        c.re[k] = k >= 193 && k <= 207 ? 1e6 : k >= 136 && k <= 264 ? 2.0 : 1e6;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 / log(2.0), noise_about(&c, 200));
    for (size_t k = 0; k < 512; ++k)
        c.re[k] = k < 33 ? 3.0 : -1.0;
    TEST_ASSERT_TRUE(isfinite(noise_about(&c, 40)));
    TEST_ASSERT_FALSE(isfinite(noise_about(&c, 39))); /* 32 places but its own: too few */
}

/* Thirty times the noise, at a maximum, and a hundredth of the largest power. */
static double found_Hz(double power, double largest)
{
    for (size_t k = 0; k < 512; ++k)
        c.re[k] = c.im[k] = 1.0;
    c.im[400] = largest, c.re[400] = -1.0;
    c.re[100] = c.im[100] = power;
    return line_find(&c);
}

static void test_which_line_stands_out(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 / 2.048, found_Hz(30.5 / log(2.0), 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found_Hz(29.5 / log(2.0), 1.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 / 2.048, found_Hz(101.0, 1e4));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found_Hz(99.0, 1e4));
    found_Hz(500.0, 1.0);
    c.re[101] = 900.0, c.im[101] = 450.0; /* no maximum of the power itself */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100.0 / 2.048, line_find(&c));
    c.im[101] = 900.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 101.0 / 2.048, line_find(&c));
    c.re[510] = c.im[510] = 1e3; /* the last that has neighbours */
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 510.0 / 2.048, line_find(&c));
    c.re[511] = c.im[511] = 1e4;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 101.0 / 2.048, line_find(&c));
}

/* ---- what else it may be ---- */

static void test_amplitude_of_a_wave(void)
{
    wave_sums w = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < N; ++k) /* five whole periods */
        wave_add(&w, TURN * (double)k / 120.0, 7.0 + 0.3 * cos(TURN * (double)k / 120.0 - 1.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0.3, wave_amplitude(&w, N));
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, N * (49.0 + 0.045), w.square);
}

/* At 10 Hz, of 0.1 N·m: a current that makes three tenths, and a speed whose wave is five errors. */
static bool caused_by(double d_A, double q_A, double speed)
{
    const line a = {10.0, 0.06, 0.08, 0.0};
    for (size_t k = 0; k < N; ++k) {
        const double phase = TURN * 10.0 * run.time_s[k];
        current[k] = (hci_dq){d_A * sin(phase), 3.0 + q_A * cos(phase), 0.0};
        run.speed_rad_per_s[k] = 30.0 + speed * cos(phase) + (k / 50 % 2 ? 1.0 : -1.0) * (k % 2 ? 1.0 : -1.0);
    }
    return is_caused(&x, &a);
}

static void test_what_makes_a_swing(void)
{
    TEST_ASSERT_FALSE(caused_by(0.0, 0.029 / 0.45, 0.0));
    TEST_ASSERT_TRUE(caused_by(0.0, 0.031 / 0.45, 0.0));
    TEST_ASSERT_TRUE(caused_by(0.031 / 0.45, 0.0, 0.0));
    TEST_ASSERT_TRUE(caused_by(0.022 / 0.45, 0.022 / 0.45, 0.0));
    TEST_ASSERT_FALSE(caused_by(0.0, 0.0, 0.85 * 5.0 * sqrt(2.0 / N)));
    TEST_ASSERT_TRUE(caused_by(0.0, 0.0, 1.15 * 5.0 * sqrt(2.0 / N)));
}

/* 1 kHz and an electrical period of 1/15 s have 66.7 samples; with half of them, order 6 k less a sample
 * rate. */
static void test_orders_that_are_folded(void)
{
    TEST_ASSERT_FALSE(is_folded(&x, &c, 20.0));
    c.turn_s = 0.1; /* 30 Hz electrical: 33.3 samples a period */
    for (int k = -2; k <= 2; ++k)
        for (int n = 1; n <= 12 && k != 0; ++n) {
            const double order_Hz = 6.0 * n * 30.0 * (k < 0 ? -1.0 : 1.0), f = order_Hz - k * 1000.0;
            TEST_ASSERT_TRUE(is_folded(&x, &c, f) && is_folded(&x, &c, f + 0.028 * 30.0));
        }
    TEST_ASSERT_FALSE(is_folded(&x, &c, 180.0 * 6.0 - 1000.0 + 0.032 * 30.0)); /* beside order 36 */
    TEST_ASSERT_FALSE(is_folded(&x, &c, 180.0)); /* order 6 itself is not above half of the samples */
}

/* Half of what the changes show. */
static void test_a_line_in_the_torque_itself(void)
{
    const line a = {10.0, 0.3, -0.4, 0.0};
    for (int more = 0; more < 2; ++more) {
        for (size_t k = 0; k < N; ++k)
            left_Nm[k] = 5.0 + (more ? 0.51 : 0.49) * 0.5 * cos(TURN * 10.0 * run.time_s[k] + 0.3) +
                         0.3 * cos(TURN * 10.0 * run.time_s[k]) - 0.4 * sin(TURN * 10.0 * run.time_s[k]);
        TEST_ASSERT_EQUAL(!more, is_in_torque(&x, &a));
    }
    const line b = line_of_torque(&x, 10.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3 + 0.255 * cos(0.3), b.cosine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -0.4 - 0.255 * sin(0.3), b.sine);
}

/* ---- all ---- */

static void test_means_and_their_room(void)
{
    changes made = {.count = 0};
    size_t group;
    TEST_ASSERT_TRUE(changes_make(&made, 8192, &group));
    TEST_ASSERT_EQUAL_UINT64(1, group);
    TEST_ASSERT_EQUAL_UINT64(8192, made.count);
    TEST_ASSERT_EQUAL_UINT64(16384, made.size);
    hci_memory_free(made.change_Nm);
    TEST_ASSERT_TRUE(changes_make(&made, 8193, &group));
    TEST_ASSERT_EQUAL_UINT64(2, group);
    TEST_ASSERT_EQUAL_UINT64(4096, made.count);
    hci_memory_free(made.change_Nm);
}

static void test_times_of_the_means(void)
{
    times_set(&run, 1, &c);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.598, c.span_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.002, c.mean_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2, c.turn_s);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 125.0, c.most_Hz);
    for (size_t k = 0; k < MEANS; ++k)
        c.time_s[k] *= 2.0;
    times_set(&run, 2, &c);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.4 / 0.004, c.most_Hz);
}

static void test_error_of_a_frequency(void)
{
    const line a = {17.0, 0.3, 0.4, 0.0};
    for (size_t k = 0; k < MEANS; ++k)
        c.change_Nm[k] = 5.0 + (k % 2 ? 0.07 : -0.07);
    hci_swing s = swing_of(&c, &a);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(6.0) / REF_PI * 0.07 / (0.5 * seen(&c, 17.0) * sqrt(300.0) * 0.598),
                              s.error_Hz);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, s.turn_Hz);
    s = swing_of(&c, &(line){15.0, 0.3, 0.4, 0.0}); /* hardly seen, at the least of what is told */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, sqrt(6.0) / REF_PI * 0.07 / (0.5 * 0.4 * sqrt(300.0) * 0.598),
                              s.error_Hz);
    statistics.swings = 2;
    statistics.swing[0] = (hci_swing){10.0, 0.0, 0.0, 0.3, 0.4};
    statistics.swing[1] = (hci_swing){25.0, 0.0, 0.0, -0.1, 0.2};
    TEST_ASSERT_DOUBLE_WITHIN(1e-12,
                              0.3 * cos(TURN * 0.07) + 0.4 * sin(TURN * 0.07) - 0.1 * cos(TURN * 0.175) +
                                  0.2 * sin(TURN * 0.175),
                              hci_swings_at_Nm(&statistics, 0.007));
}

/* Two runs; a multiple within four errors, or as many times that of the part. */
static void test_swings_that_other_runs_show(void)
{
    hci_swing_groups known = {.count = 1, .group = {{false, 50.0, 0.01, 0.2, 2}}};
    const hci_swing_group near = {false, 100.079, 0.001, 0.2, 1}, far = {false, 100.081, 0.001, 0.2, 1},
                          wide = {false, 100.39, 0.1, 0.2, 1}, lower = {false, 24.0, 0.001, 0.2, 1};
    TEST_ASSERT_TRUE(is_known(&known, &near) && is_known(&known, &wide));
    TEST_ASSERT_FALSE(is_known(&known, &far) || is_known(&known, &lower));
    known.group[0].of_turn = true;
    TEST_ASSERT_FALSE(is_known(&known, &near));
    known.group[0].of_turn = false, known.group[0].runs = 1;
    TEST_ASSERT_FALSE(is_known(&known, &near));
}

static size_t taken_at(double amplitude_Nm, bool of_turn)
{
    line lines[HCI_MOST_SWINGS];
    const hci_swing_groups known = {.count = 1,
                                    .group = {{of_turn, of_turn ? 3.4 : 17.0, 1e-3, amplitude_Nm, 3}}};
    memset(c.change_Nm, 0, MEANS * sizeof *c.change_Nm);
    wave(17.0, 0.06, 0.08);
    return known_take(&x, &c, &known, lines, 0);
}

/* Half as large again or two thirds of it; in Hz or of the turn. */
static void test_known_swings_are_taken_where_they_are_as_large(void)
{
    for (int of_turn = 0; of_turn < 2; ++of_turn) {
        TEST_ASSERT_EQUAL_UINT64(1, taken_at(0.149, of_turn));
        TEST_ASSERT_EQUAL_UINT64(0, taken_at(0.151, of_turn));
        TEST_ASSERT_EQUAL_UINT64(1, taken_at(0.1 / 1.49, of_turn));
        TEST_ASSERT_EQUAL_UINT64(0, taken_at(0.1 / 1.51, of_turn));
    }
}

static bool asked(size_t count, double turns, double deviation)
{
    hci_run long_run = run;
    double time_s[2048];
    for (size_t k = 0; k < 2048; ++k)
        time_s[k] = (double)k;
    long_run.count = count, long_run.time_s = time_s;
    statistics.turns = turns, statistics.speed_deviation = deviation * 5.0 * TURN;
    return is_asked(&(hci_swing_question){&long_run, &statistics, NULL});
}

static void test_which_runs_are_looked_at(void)
{
    TEST_ASSERT_TRUE(asked(1024, 2.0, 0.049) && asked(1024, 1.3, 0.0) && asked(1025, 16.0, 0.0));
    TEST_ASSERT_FALSE(asked(1023, 2.0, 0.0) || asked(1024, 1.29, 0.0) || asked(1024, 16.0, 0.0) ||
                      asked(1024, 2.0, 0.051));
    run.torque_source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_FALSE(asked(1024, 2.0, 0.0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_places_one_turn_before);
    RUN_TEST(test_changes_by_hand);
    RUN_TEST(test_means_of_changes);
    RUN_TEST(test_a_line_is_fitted_and_taken_out);
    RUN_TEST(test_lines_that_are_near);
    RUN_TEST(test_what_of_a_swing_is_seen);
    RUN_TEST(test_the_spectrum_by_plain_sums);
    RUN_TEST(test_noise_about_a_line);
    RUN_TEST(test_which_line_stands_out);
    RUN_TEST(test_amplitude_of_a_wave);
    RUN_TEST(test_what_makes_a_swing);
    RUN_TEST(test_orders_that_are_folded);
    RUN_TEST(test_a_line_in_the_torque_itself);
    RUN_TEST(test_means_and_their_room);
    RUN_TEST(test_times_of_the_means);
    RUN_TEST(test_error_of_a_frequency);
    RUN_TEST(test_swings_that_other_runs_show);
    RUN_TEST(test_known_swings_are_taken_where_they_are_as_large);
    RUN_TEST(test_which_runs_are_looked_at);
    return UNITY_END();
}
