/* What recordings leave open, by parts: turns, misfits of runs, values of alternatives. */
#include "host/diagnose/uncertainty/uncertainty.c"

#include "support/recording.h"
#include "unity.h"

enum { RUNS = 3, SAMPLES = 50, PARTS = 5 };

static const hci_machine MACHINE = {.pole_pairs = 4};

static hci_binned_sample sample[RUNS * SAMPLES];
static hci_segment segment[RUNS];
static hci_binned_samples samples;
static hci_run run[RUNS];
static bool use[RUNS];
static hci_regression regression;
static hci_candidate list[3], other[3];
static hci_candidates fitted, alternative;
static hci_alternatives alternatives;
static hci_left_out_group left[PARTS];
static size_t of_run[PARTS], group[PARTS];
static finding f;

/* Turns of half a mechanical one in each run: two electrical. Parts of runs 0, 0, 1, 2, 2. */
void setUp(void)
{
    static const size_t OF_RUN[] = {0, 0, 1, 2, 2};
    memset(sample, 0, sizeof sample);
    memset(list, 0, sizeof list);
    memset(other, 0, sizeof other);
    memset(&f, 0, sizeof f);
    for (size_t r = 0; r < RUNS; ++r) {
        segment[r] = (hci_segment){.run = r, .first = r * SAMPLES, .count = SAMPLES};
        use[r] = true;
        for (size_t k = 0; k < SAMPLES; ++k) {
            hci_sample *x = &sample[r * SAMPLES + k].reading;
            x->theta_m_rad = (r == 1 ? -REF_PI : REF_PI) * (double)k / (SAMPLES - 1);
            x->speed_rad_per_s = 10.0 * (double)r + (double)k;
            rec_phases(0.1 * (double)r, 2.0 + 0.01 * (double)k, 4.0 * x->theta_m_rad, x->i_abc);
        }
    }
    samples = (hci_binned_samples){.sample = sample,
                                   .count = RUNS * SAMPLES,
                                   .segment = segment,
                                   .segment_count = RUNS,
                                   .run_count = RUNS};
    regression = (hci_regression){.machine = &MACHINE, .samples = &samples, .runs = run, .use = use};
    fitted = (hci_candidates){.candidate = list, .count = 0};
    alternative = (hci_candidates){.candidate = other, .count = 0};
    alternatives = (hci_alternatives){.machine = {&alternative}, .count = 1};
    for (size_t k = 0; k < PARTS; ++k)
        of_run[k] = OF_RUN[k], group[k] = k, left[k].misfit = 1.0 + (double)k;
    f.regression = &regression, f.fitted = &fitted, f.alternatives = &alternatives;
    f.run = of_run, f.group = group, f.parts.count = f.runs.count = PARTS;
    f.terms.largest_current_A = 10.0;
}

void tearDown(void)
{
}

static void put(hci_candidates *of, const char *name, size_t parameter, double order, double value,
                double declared)
{
    hci_candidate *x = &of->candidate[of->count++];
    *x = (hci_candidate){.type = hci_effect_type_find(name), .count = 1, .in = true, .declared = {declared}};
    x->term[0] = (hci_effect_term){parameter, order, value, NAN};
}

/* ---- recordings ---- */

static void test_electrical_turns(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, turns_of(&regression, r));
    segment[2].run = 0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.0, turns_of(&regression, 0));
}

/* What remains without one of n parts is a turn or more. */
static void test_runs_that_span_enough(void)
{
    TEST_ASSERT_TRUE(spans_enough(&regression, 1) && spans_enough(&regression, 2) &&
                     spans_enough(&regression, 3));
    for (size_t k = 0; k < SAMPLES; ++k)
        sample[SAMPLES + k].reading.theta_m_rad *= 0.76; /* 1.52 turns: 1.013 of three parts, 0.76 of two */
    TEST_ASSERT_TRUE(spans_enough(&regression, 3) && !spans_enough(&regression, 2) &&
                     spans_enough(&regression, 1));
    use[1] = false;
    TEST_ASSERT_TRUE(spans_enough(&regression, 2));
}

/* A hundredth of the largest current. */
static void test_direct_currents_that_sensors_make(void)
{
    TEST_ASSERT_TRUE(direct_is_error(&f, &regression, 0) && direct_is_error(&f, &regression, 1) &&
                     !direct_is_error(&f, &regression, 2));
    f.terms.largest_current_A = 9.9;
    TEST_ASSERT_FALSE(direct_is_error(&f, &regression, 1));
    f.terms.largest_current_A = 20.1;
    TEST_ASSERT_TRUE(direct_is_error(&f, &regression, 2));
}

static void test_terms_of_a_direct_current_leave(void)
{
    double gram[9] = {1.0, 2.0, 3.0, 2.0, 5.0, 6.0, 3.0, 6.0, 9.0}, moment[3] = {1.0, 2.0, 3.0};
    bool direct[3] = {false, true, false};
    hci_normal_equations normal = {3, gram, moment, 1.0, 1.0};
    f.terms.by_direct = direct;
    direct_leave(&f.terms, &normal);
    const double expected[9] = {1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 3.0, 0.0, 9.0};
    TEST_ASSERT_EQUAL_MEMORY(expected, gram, sizeof gram);
    TEST_ASSERT_TRUE(moment[0] == 1.0 && moment[1] == 0.0 && moment[2] == 3.0);
}

/* Beside means that tell nothing no row tells the torque per ampere, and no alternative has another one. */
static void test_a_torque_per_ampere_that_is_not_told(void)
{
    double gram[4] = {1.0, 2.0, 2.0, 5.0}, moment[2] = {1.0, 2.0}, departure[2] = {0.0, 0.0};
    size_t parameter;
    const char *name = hci_torque_per_ampere(&parameter)->name;
    hci_normal_equations normal = {2, gram, moment, 1.0, 1.0};
    put(&fitted, name, parameter, 5.0, 0.01, 0.0);
    put(&fitted, name, parameter, 1.0, 0.0, 0.0);
    put(&alternative, name, parameter, 1.0, 0.3, 0.0);
    f.terms.candidates = fitted;
    untold_leave(&f, &normal);
    TEST_ASSERT_TRUE(gram[3] == 5.0 && moment[1] == 2.0);
    alternatives.constant_share = 0.1;
    untold_leave(&f, &normal);
    const double expected[4] = {1.0, 0.0, 0.0, 0.0};
    TEST_ASSERT_EQUAL_MEMORY(expected, gram, sizeof gram);
    TEST_ASSERT_TRUE(moment[0] == 1.0 && moment[1] == 0.0);
    hci_model_column column = {&list[1], 0, 0};
    const hci_model model = {.column = &column, .columns = 1};
    hci_uncertainty u = {.departure = departure, .machines = 2};
    alternatives_take(&f, &model, &u);
    TEST_ASSERT_TRUE(departure[0] == 0.0 && departure[1] == 0.0);
    alternatives.constant_share = 0.0;
    alternatives_take(&f, &model, &u);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, departure[0]);
}

static void test_what_was_measured_in_a_run(void)
{
    static const hci_effects none = {NULL, 0};
    static char name[] = "r.csv";
    hci_measured_run out;
    hci_note note = {{0}};
    double speed[1] = {0.0};
    run[2] = (hci_run){.name = name, .speed_rad_per_s = speed};
    TEST_ASSERT_EQUAL_INT(HCI_OK, measured_fill(&f, &none, 2, &out, &note));
    TEST_ASSERT_EQUAL_STRING("r.csv", out.file);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2, out.id_A.least);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.2, out.id_A.most);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, out.iq_A.least);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.49, out.iq_A.most);
    TEST_ASSERT_TRUE(out.speed_rad_per_s.least == 20.0 && out.speed_rad_per_s.most == 69.0);
    hci_memory_free(out.file);
    run[2].speed_rad_per_s = NULL;
    TEST_ASSERT_EQUAL_INT(HCI_OK, measured_fill(&f, &none, 2, &out, &note));
    TEST_ASSERT_TRUE(isnan(out.speed_rad_per_s.least) && isnan(out.misfit));
    hci_memory_free(out.file);
}

/* ---- what leaving out tells ---- */

static void test_misfits_of_runs(void)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.5, misfit_of_run(&f, left, 0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 4.5, misfit_of_run(&f, left, 2));
    left[3].misfit = NAN;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 5.0, misfit_of_run(&f, left, 2));
    group[2] = 3; /* joined to what tells nothing */
    TEST_ASSERT_TRUE(isnan(misfit_of_run(&f, left, 1)));
    TEST_ASSERT_TRUE(is_first(&f, 0) && !is_first(&f, 1) && is_first(&f, 2) && is_first(&f, 3) &&
                     !is_first(&f, 4));
    TEST_ASSERT_EQUAL_UINT64(3, runs_told(&f));
}

static void test_how_many_groups_tell(void)
{
    const hci_width_trial x = {.left = left};
    TEST_ASSERT_EQUAL_UINT64(PARTS, told_by(&f, &x));
    left[1].misfit = INFINITY;
    TEST_ASSERT_EQUAL_UINT64(PARTS - 1, told_by(&f, &x));
    for (size_t k = 0; k < PARTS; ++k)
        left[k].misfit = 0.0;
    TEST_ASSERT_EQUAL_UINT64(0, told_by(&f, &x));
}

static void test_sizes_go_around(void)
{
    const double size[PARTS] = {1.0, 2.0, 3.0, NAN, NAN};
    size_t at = 0;
    TEST_ASSERT_EQUAL_DOUBLE(2.0, next_size(&f, size, &at));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, next_size(&f, size, &at));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, next_size(&f, size, &at));
    TEST_ASSERT_EQUAL_UINT64(0, at);
}

/* ---- other effects ---- */

/* The fitted value, or where there is none that which is declared, in the alternative as well. */
static void test_values_of_alternatives(void)
{
    put(&fitted, "cogging", 0, 6.0, 0.3, 0.1);
    put(&alternative, "cogging", 0, 6.0, 0.5, 0.1);
    put(&alternative, "back_emf", 0, 5.0, 0.04, 0.01);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, value_in(&fitted, &other[0], 0));
    TEST_ASSERT_TRUE(isnan(value_in(&fitted, &other[1], 0)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.2, alternative_more(&f, &alternative, &list[0], 0));
    hci_candidate held = other[1];
    held.term[0].value = 0.01;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.03, alternative_more(&f, &alternative, &held, 0));
    other[0].in = false; /* the alternative has the declared one */
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 - 0.3, alternative_more(&f, &alternative, &list[0], 0));
    other[1].in = false;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, alternative_more(&f, &alternative, &held, 0));
    other[0].in = true, other[0].term[0].order = 12.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.2, alternative_more(&f, &alternative, &list[0], 0));
}

/* Of one alternative every second machine is that. */
static void test_machines_of_alternatives(void)
{
    enum { MACHINES_HERE = 6 };
    double departure[2 * MACHINES_HERE];
    hci_model_column column[2];
    put(&fitted, "cogging", 0, 6.0, 0.3, 0.1);
    put(&fitted, "torque_sensor", 0, 0.0, 0.3, 0.0); /* not of the machine */
    put(&alternative, "cogging", 0, 6.0, 0.5, 0.1);
    column[0] = (hci_model_column){&list[0], 0, 1}, column[1] = (hci_model_column){&list[1], 0, 0};
    const hci_model model = {.column = column, .columns = 2};
    hci_uncertainty u = {.departure = departure, .machines = MACHINES_HERE};
    for (size_t k = 0; k < 2 * MACHINES_HERE; ++k)
        departure[k] = 1.0;
    alternatives_take(&f, &model, &u);
    for (size_t m = 0; m < MACHINES_HERE; ++m) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, m % 2 ? 1.0 : 1.2, departure[MACHINES_HERE + m]);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, departure[m]);
    }
}

/* What an alternative has of the machine besides is held where it is declared; what the bench has is not. */
static void test_terms_of_alternatives_join(void)
{
    hci_candidates all = {0};
    hci_note note = {{0}};
    put(&fitted, "friction", 0, 0.0, 0.3, 0.0);
    put(&alternative, "friction", 0, 0.0, 0.5, 0.0);
    put(&alternative, "magnet_temperature", 0, 0.0, 0.5, 0.2);
    put(&alternative, "torque_sensor", 0, 0.0, 0.5, 0.0);
    TEST_ASSERT_EQUAL_INT(HCI_OK, with_alternatives(&fitted, &alternatives, &all, &note));
    TEST_ASSERT_EQUAL_UINT64(2, all.count);
    for (size_t k = 0; k < all.count; ++k)
        if (all.candidate[k].type == hci_effect_type_find("magnet_temperature")) {
            TEST_ASSERT_EQUAL_DOUBLE(0.2, all.candidate[k].term[0].value);
            TEST_ASSERT_EQUAL_DOUBLE(1e-6, all.candidate[k].deviation);
        } else
            TEST_ASSERT_EQUAL_DOUBLE(0.3, all.candidate[k].term[0].value);
    hci_candidates_release(&all);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_electrical_turns);
    RUN_TEST(test_runs_that_span_enough);
    RUN_TEST(test_direct_currents_that_sensors_make);
    RUN_TEST(test_terms_of_a_direct_current_leave);
    RUN_TEST(test_a_torque_per_ampere_that_is_not_told);
    RUN_TEST(test_what_was_measured_in_a_run);
    RUN_TEST(test_misfits_of_runs);
    RUN_TEST(test_how_many_groups_tell);
    RUN_TEST(test_sizes_go_around);
    RUN_TEST(test_values_of_alternatives);
    RUN_TEST(test_machines_of_alternatives);
    RUN_TEST(test_terms_of_alternatives_join);
    return UNITY_END();
}
