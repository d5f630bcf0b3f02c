/* By how much waves are turned, and how late a channel is, from values by hand. */
#include "host/diagnose/search/few_values.c"

#include <string.h>

#include "unity.h"

static hci_wave wave[4];
static hci_machine machine;
static hci_regression regression;
static hci_search search;
static hci_candidate list[4];
static hci_candidates model;

static const hci_effect_type *type(const char *name)
{
    return hci_effect_type_find(name);
}

static size_t parameter(const hci_effect_type *of, const char *name)
{
    size_t k = 0;
    while (strcmp(of->parameter[k].name, name) != 0)
        ++k;
    return k;
}

void setUp(void)
{
    memset(list, 0, sizeof list);
    wave[0] = (hci_wave){.order = 5.0, .sequence = 1, .sine = 9.0, .cosine = 8.0};
    wave[1] = (hci_wave){.order = 1.0, .sequence = 1, .sine = 0.15, .cosine = 0.02};
    wave[2] = (hci_wave){.order = 1.0, .sequence = 1, .sine = 0.05, .cosine = 0.08};
    machine = (hci_machine){.pole_pairs = 3, .back_emf = wave, .back_emf_count = 3};
    regression = (hci_regression){.machine = &machine};
    search = (hci_search){.regression = &regression};
    model = (hci_candidates){.candidate = list, .count = 0};
}

void tearDown(void)
{
}

static hci_candidate *add(const char *effect, const char *name, double order, double value)
{
    hci_candidate *x = &list[model.count++];
    *x = (hci_candidate){.type = type(effect), .count = 1, .in = true};
    x->term[0] = (hci_effect_term){parameter(x->type, name), order, value, 0.0};
    return x;
}

static void test_the_declared_fundamental(void)
{
    double sum[2];
    declared_fundamental(&machine, sum);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.2, sum[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.1, sum[1]);
}

/* The angle from the declared vector to that with the values of the model. */
static void test_the_angle_of_turned_waves(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, turned_by_rad(&search, &model));
    for (double angle = -3.0; angle < 3.1; angle += 0.4) {
        setUp();
        const double sine = 1.3 * (0.2 * cos(angle) + 0.1 * sin(angle)),
                     cosine = 1.3 * (0.1 * cos(angle) - 0.2 * sin(angle));
        add("back_emf", "sine", 1.0, sine - 0.2);
        hci_candidate *x = add("back_emf", "cosine", 1.0, cosine - 0.1);
        add("back_emf", "sine", 5.0, 77.0);
        add("cogging", "sine", 1.0, 77.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, angle, turned_by_rad(&search, &model));
        x->in = false;
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, atan2(sine * 0.1 - 0.1 * 0.2, sine * 0.2 + 0.01),
                                  turned_by_rad(&search, &model));
    }
}

/* A load that leads the q axis by 0.4 rad and a back-EMF that is turned. */
static bool as_well(double turned_rad, double other_lead_rad)
{
    hci_run_statistics statistics[2] = {
        {.mean_id_A = -sin(0.4), .mean_iq_A = cos(0.4), .current_A = 1.0},
        {.mean_id_A = -sin(other_lead_rad), .mean_iq_A = cos(other_lead_rad), .current_A = 1.0}};
    bool use[2] = {true, true};
    hci_binned_samples samples = {.run_count = 2, .statistics = statistics};
    setUp();
    regression.samples = &samples;
    regression.use = use;
    add("back_emf", "sine", 1.0, 0.2 * cos(turned_rad) + 0.1 * sin(turned_rad) - 0.2);
    add("back_emf", "cosine", 1.0, 0.1 * cos(turned_rad) - 0.2 * sin(turned_rad) - 0.1);
    return is_saliency_as_well(&search, &model);
}

/* Not where the current lies along q by the zero that was found, as a drive has it, and not where it has more
 * directions than one. */
static void test_where_a_saliency_turns_as_well(void)
{
    TEST_ASSERT_TRUE(as_well(-0.2, 0.4));
    TEST_ASSERT_TRUE(as_well(0.2, 0.4));
    TEST_ASSERT_FALSE(as_well(-0.4, 0.4));
    TEST_ASSERT_FALSE(as_well(-0.2, -0.4));
}

static void test_what_magnets_make(void)
{
    TEST_ASSERT_TRUE(is_of_magnets(type("cogging")) && is_of_magnets(type("back_emf")));
    TEST_ASSERT_FALSE(is_of_magnets(type("reluctance")) || is_of_magnets(type("friction")) ||
                      is_of_magnets(type("saturation")));
    TEST_ASSERT_TRUE(angle_zero() == type("position_offset"));
    TEST_ASSERT_TRUE(torque_gain() == type("torque_gain"));
}

/* All other channels early by the same, within three errors or a hundredth of their sum. */
static double late_by(double current_s, double angle_s, double error_s)
{
    setUp();
    const hci_effect_type *delay = type("channel_delay");
    for (size_t k = 0; k < delay->parameter_count; ++k)
        if (k != delay->late[0]) {
            hci_candidate *x =
                add("channel_delay", delay->parameter[k].name, 0.0, k % 2 ? angle_s : current_s);
            x->term[0].std_error = error_s;
        }
    return later_s(&model, delay);
}

static void test_how_late_a_channel_is(void)
{
    const hci_effect_type *delay = type("channel_delay");
    const double mean = late_by(-1e-3, -1e-3, 1e-7);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1e-3, mean);
    TEST_ASSERT_TRUE(late_by(-1.0e-3, -1.29e-3, 1e-4) > 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, late_by(-1.0e-3, -1.31e-3, 1e-4));
    const double sum = (double)(delay->parameter_count - 1) * 1e-3;
    TEST_ASSERT_TRUE(late_by(-1.0e-3, -1.0e-3 - 0.0098 * sum, 0.0) > 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, late_by(-1.0e-3, -1.0e-3 - 0.0104 * sum, 0.0));
    late_by(-1e-3, -1e-3, 1e-7);
    list[0].in = false; /* not all are in */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, later_s(&model, delay));
    late_by(-1e-3, -1e-3, 1e-7);
    add("channel_delay", delay->parameter[delay->late[0]].name, 0.0, 1e-4);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, later_s(&model, delay)); /* it is late by itself */
}

static void test_prices_are_summed(void)
{
    add("cogging", "sine", 6.0, 0.1)->price = 3.0;
    add("cogging", "sine", 12.0, 0.1)->price = 4.0;
    add("friction", "coulomb", 0.0, 0.1)->price = 50.0;
    TEST_ASSERT_EQUAL_DOUBLE(7.0, price_of(&model, type("cogging")));
    list[1].in = false;
    TEST_ASSERT_EQUAL_DOUBLE(3.0, price_of(&model, type("cogging")));
}

/* The type without which the torque per ampere is another one by most; of a machine that has a quarter of
 * what it declares too. */
static void test_the_scale_of_a_model(void)
{
    static const hci_effects none = {NULL, 0};
    const hci_effect_type *scale = NULL;
    double gain = 9.0;
    hci_note note = {{0}};
    wave[1].sine = 0.25, wave[2].sine = 0.0;
    regression.declared = &none;
    for (double quarter = 1.0; quarter < 5.0; quarter += 3.0) {
        regression.declared_constant = 1.5 * 0.25 * quarter;
        model.count = 0;
        add("friction", "coulomb", 0.0, 0.1);
        TEST_ASSERT_EQUAL_INT(HCI_OK, scale_find(&search, &model, &scale, &gain, &note));
        TEST_ASSERT_TRUE(scale == NULL && gain == 0.0);
        add("back_emf", "sine", 1.0, -0.05);
        TEST_ASSERT_EQUAL_INT(HCI_OK, scale_find(&search, &model, &scale, &gain, &note));
        TEST_ASSERT_EQUAL_PTR(type("back_emf"), scale);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, -0.2, gain);
        hci_candidate *phase = add("phase_imbalance", "a", 0.0, 0.03); /* a hundredth of the torque of all */
        TEST_ASSERT_EQUAL_INT(HCI_OK, scale_find(&search, &model, &scale, &gain, &note));
        TEST_ASSERT_EQUAL_PTR(type("back_emf"), scale);
        phase->term[0].value = 1.5;
        TEST_ASSERT_EQUAL_INT(HCI_OK, scale_find(&search, &model, &scale, &gain, &note));
        TEST_ASSERT_EQUAL_PTR(type("phase_imbalance"), scale);
        TEST_ASSERT_TRUE(gain > 0.4);
    }
    wave[1].sine = 0.0, model.count = 0; /* without the type there would be none */
    add("back_emf", "sine", 1.0, 0.25);
    TEST_ASSERT_EQUAL_INT(HCI_OK, scale_find(&search, &model, &scale, &gain, &note));
    TEST_ASSERT_TRUE(scale == NULL && gain == 0.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_declared_fundamental);
    RUN_TEST(test_the_angle_of_turned_waves);
    RUN_TEST(test_where_a_saliency_turns_as_well);
    RUN_TEST(test_what_magnets_make);
    RUN_TEST(test_how_late_a_channel_is);
    RUN_TEST(test_prices_are_summed);
    RUN_TEST(test_the_scale_of_a_model);
    return UNITY_END();
}
