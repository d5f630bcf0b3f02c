/* What an effect must explain beside others, from what those get wrong. */
#include "host/diagnose/search/companions.h"

#include "support/searching.h"

static hci_attribution attribution;

void setUp(void)
{
    dataset_start();
    memset(&attribution, 0, sizeof attribution);
}

void tearDown(void)
{
    hci_fitted_model_release(&attribution.model);
    search_end();
    dataset_end();
}

/* Two short runs. source: of their torque. */
static void record_two(hci_torque_source source)
{
    record(150, &(point){60.0, 2.0, 0.0, 0.0, 0.0});
    record(150, &(point){-60.0, 5.0, 0.0, 0.0, 0.0});
    run[0].torque_source = run[1].torque_source = source;
    search_start();
    for (size_t k = 0; k < dataset.samples.segment_count; ++k)
        dataset.regression.noise[k] = hci_noise_white(NOISE_NM);
}

static const hci_verdict *add(const char *effect, double gain)
{
    hci_verdict *v = &attribution.verdict[attribution.types++];
    *v = (hci_verdict){.type = hci_effect_type_find(effect), .in = true, .gain = gain};
    return v;
}

static void add_term(const char *effect, const char *parameter, double value)
{
    hci_candidate x = candidate_of(effect, parameter, NULL, 0.0);
    x.term[0].value = value;
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&attribution.model.candidates, &x, &note));
}

static double least(const hci_verdict *v)
{
    return hci_companion_least(&dataset.regression, &attribution, v);
}

/* Beside 100 000 the twenty of a friction may be noise of another size; forty is not, nor is twenty alone. */
static void test_what_is_faint_beside_much(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *faint = add("friction", 20.0);
    TEST_ASSERT_TRUE(least(faint) <= 0.0);
    add("cogging", 1e5);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 30.0, least(faint));
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.006, least(&attribution.verdict[1]));
    attribution.verdict[1].gain = 1e9;
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 40.0, least(faint));
}

/* A lag is right to some per cent of its amplitude, and a delay is, beside which effects of the iron are
 * asked for more; friction, which a lag leaves as it is, is not, nor does the zero of the sensor ask for
 * anything. */
static void test_the_iron_beside_lags_and_delays(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *iron = add("saturation", 400.0), *friction = add("friction", 400.0);
    add("torque_sensor", 1e5);
    add_term("torque_sensor", "offset", 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 30.0, least(iron));
    add_term("torque_sensor", "time_constant", 1e-3);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 500.0, least(iron));
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 30.0, least(friction));
    add("channel_delay", 2e5);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 1000.0, least(iron));
}

/* An acceleration is a slope of readings: what its error makes at the corners of a ramp is no delay and no
 * back-EMF, but friction is none of it. */
static void test_beside_an_acceleration(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *delay = add("channel_delay", 900.0), *emf = add("back_emf", 600.0);
    const hci_verdict *friction = add("friction", 1000.0), *inertia = add("rotor_inertia", 3e5);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 1500.0, least(delay));
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 1500.0, least(emf));
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 40.0, least(friction));
    TEST_ASSERT_TRUE(least(inertia) < 1.0);
}

/* A delay that is another one at each sample shows in the noise of the runs, and what it takes from high
 * orders is iron no more; a run that is a mean over four samples each has half of their noise. */
static void test_the_iron_beside_jitter(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *iron = add("saturation", 1e4);
    add("channel_delay", 1e5);
    dataset.regression.noise[1] = hci_noise_white(2.0 * NOISE_NM);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 25000.0, least(iron));
    for (size_t k = 0; k < 150; ++k)
        dataset.samples.sample[k].count = 4.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 500.0, least(iron));
}

/* A series is not what iron does: other effects of the iron are a part of its error, but not of themselves.
 */
static void test_the_iron_beside_a_series(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *series = add("saturation", 1e6), *emf = add("back_emf", 400.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 2000.0, least(emf));
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 0.1, least(series));
}

/* However little a series explains, an effect of the iron beside it has to be decisive, and no other has. */
static void test_the_iron_beside_a_faint_series(void)
{
    record_two(HCI_TORQUE_MEASURED);
    add("saturation", 20.0);
    const hci_verdict *emf = add("back_emf", 5.0), *friction = add("friction", 5.0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 10.0, least(emf));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3e-4 * 20.0, least(friction));
    attribution.verdict[0].in = false;
    TEST_ASSERT_TRUE(least(emf) < 0.01);
}

static void add_order(const char *effect, const char *parameter, double order)
{
    const hci_candidate x = candidate_of(effect, parameter, NULL, order);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&attribution.model.candidates, &x, &note));
}

/* Up to the knee of its curve a power of the current misses what a linear part of a tenth takes, at its own
 * orders; an order that it has not, and phases that differ, are no part of it. */
static void test_a_linear_part_beside_a_series(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *emf = add("back_emf", 400.0);
    add("saturation", 4000.0);
    add("reluctance", 1000.0);
    add("cogging", 1e5);
    add_order("back_emf", "sine", 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
    add_order("saturation", "d1q2_cosine", 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 500.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
    TEST_ASSERT_EQUAL_DOUBLE(
        0.0, hci_companion_of_series(&dataset.regression, &attribution, &attribution.verdict[1]));
    add_order("back_emf", "sine", 5.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
    add_order("saturation", "d0q3_sine", 6.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 500.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
    add("iron_drag", 10.0);
    TEST_ASSERT_EQUAL_DOUBLE(
        0.0, hci_companion_of_series(&dataset.regression, &attribution, emf)); /* it would stand in for it */
    attribution.types -= 1;
    add_order("back_emf", "neg_sine", 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
}

/* With direct current, and without any, powers of it miss something at each order, which phases that differ
 * take as well; currents that turn with the rotor tell them. */
static void test_unlike_phases_beside_a_series(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *emf = add("back_emf", 300.0);
    add("saturation", 4000.0);
    add_order("cogging", "sine", 6.0);
    add_order("back_emf", "pos_sine", 3.0);
    add_order("saturation", "d1q2_cosine", 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
    dataset.samples.statistics[0].is_direct = dataset.samples.statistics[1].is_direct = true;
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 400.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
    dataset.samples.statistics[0].is_direct = false;
    dataset.samples.statistics[0].current_A = 0.002 * dataset.samples.statistics[1].current_A;
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 400.0, hci_companion_of_series(&dataset.regression, &attribution, emf));
}

/* What runs without a current show is as it was read: through a sensor that swings forty may be its error. */
static void test_what_a_sensor_that_swings_read(void)
{
    record_two(HCI_TORQUE_MEASURED);
    const hci_verdict *cogging = add("cogging", 38.0);
    add("torque_sensor", 3e5);
    add_term("torque_sensor", "offset", 0.1);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_companion_of_sensor(&attribution, cogging));
    add_term("torque_sensor", "natural_frequency", 800.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 40.0, hci_companion_of_sensor(&attribution, cogging));
    add("saturation", 1e6);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 40.0, hci_companion_of_sensor(&attribution, cogging));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_companion_of_sensor(&attribution, &attribution.verdict[1]));
}

/* A slope of the angle is not known to be at a time better than a sample; what a sensor reads is. */
static void test_delays_within_a_slope(void)
{
    record_two(HCI_TORQUE_INERTIA);
    const double step_s = run[0].time_s[1] - run[0].time_s[0];
    const hci_verdict *delay = add("channel_delay", 1e3);
    add_term("channel_delay", "current", 0.5 * step_s);
    TEST_ASSERT_TRUE(isinf(least(delay)));
    attribution.model.candidates.candidate[0].term[0].value = -2.0 * step_s;
    TEST_ASSERT_TRUE(least(delay) <= 0.0);
    attribution.model.candidates.candidate[0].term[0].value = 0.5 * step_s;
    run[0].torque_source = run[1].torque_source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_TRUE(least(delay) <= 0.0);
}

/* On a shaft that hardly accelerates cogging torque is right to a hundredth, beside which a drag of the iron
 * and a series in the currents are asked for more; friction is not. */
static void test_the_iron_beside_cogging_of_a_crawl(void)
{
    record_two(HCI_TORQUE_INERTIA);
    const hci_verdict *drag = add("iron_drag", 900.0), *iron = add("saturation", 900.0);
    const hci_verdict *friction = add("friction", 900.0);
    add("cogging", 2e5);
    TEST_ASSERT_TRUE(least(drag) < 900.0 && least(iron) < 900.0);
    run[0].hardly_accelerates = true;
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 2000.0, least(drag));
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 2000.0, least(iron));
    TEST_ASSERT_TRUE(least(friction) < 900.0);
    run[0].hardly_accelerates = false;
}

/* ---- in whichever order ---- */

enum { EFFECTS = 5 };

static const struct {
    const char *effect;
    double gain;
} GAIN[EFFECTS] = {{"saturation", 3e4},
                   {"rotor_inertia", 4e5},
                   {"torque_sensor", 2e4},
                   {"back_emf", 300.0},
                   {"friction", 50.0}};

/* Verdicts from one on, around and around, and the terms of the model likewise: what each has to explain, in
 * the order of GAIN, and for the back-EMF beside the series. */
static void least_from(size_t from, double out[EFFECTS + 2])
{
    static const struct {
        const char *effect, *parameter;
        double order, value;
    } TERM[] = {{"saturation", "d1q2_cosine", 0.0, 1.0},       {"torque_sensor", "offset", 0.0, 0.1},
                {"torque_sensor", "time_constant", 0.0, 1e-3}, {"back_emf", "sine", 1.0, 0.1},
                {"saturation", "d0q3_sine", 6.0, 1.0},         {"back_emf", "sine", 5.0, 0.1}};
    const size_t terms = sizeof TERM / sizeof *TERM;
    const hci_verdict *v[EFFECTS];
    hci_fitted_model_release(&attribution.model);
    memset(&attribution, 0, sizeof attribution);
    for (size_t k = 0; k < EFFECTS; ++k)
        v[(from + k) % EFFECTS] = add(GAIN[(from + k) % EFFECTS].effect, GAIN[(from + k) % EFFECTS].gain);
    for (size_t k = 0; k < terms; ++k) {
        hci_candidate x = candidate_of(TERM[(from + k) % terms].effect, TERM[(from + k) % terms].parameter,
                                       NULL, TERM[(from + k) % terms].order);
        x.term[0].value = TERM[(from + k) % terms].value;
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_candidates_add(&attribution.model.candidates, &x, &note));
    }
    for (size_t k = 0; k < EFFECTS; ++k)
        out[k] = least(v[k]);
    attribution.types = EFFECTS;
    out[EFFECTS] = hci_companion_of_sensor(&attribution, v[4]);
    for (size_t k = 0; k < EFFECTS; ++k) /* an inertia and a lag would stand in for the linear part */
        attribution.verdict[k].in = attribution.verdict[k].type->is_series || &attribution.verdict[k] == v[3];
    out[EFFECTS + 1] = hci_companion_of_series(&dataset.regression, &attribution, v[3]);
}

static void test_the_order_of_effects_does_not_matter(void)
{
    double first[EFFECTS + 2], other[EFFECTS + 2];
    record_two(HCI_TORQUE_MEASURED);
    least_from(0, first);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 2000.0, first[3]); /* half a per cent of what the inertia explains */
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 40.0, first[EFFECTS]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3000.0, first[EFFECTS + 1]);
    for (size_t from = 1; from < 30; ++from) {
        least_from(from, other);
        for (size_t k = 0; k < EFFECTS + 2; ++k)
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, first[k], other[k]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_faint_beside_much);
    RUN_TEST(test_the_iron_beside_lags_and_delays);
    RUN_TEST(test_beside_an_acceleration);
    RUN_TEST(test_the_iron_beside_jitter);
    RUN_TEST(test_the_iron_beside_a_series);
    RUN_TEST(test_the_iron_beside_a_faint_series);
    RUN_TEST(test_a_linear_part_beside_a_series);
    RUN_TEST(test_unlike_phases_beside_a_series);
    RUN_TEST(test_what_a_sensor_that_swings_read);
    RUN_TEST(test_delays_within_a_slope);
    RUN_TEST(test_the_iron_beside_cogging_of_a_crawl);
    RUN_TEST(test_the_order_of_effects_does_not_matter);
    return UNITY_END();
}
