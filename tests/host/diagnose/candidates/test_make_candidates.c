/* Which terms are offered for which recordings. */
#include "host/diagnose/candidates/make_candidates.h"

#include <string.h>

#include "host/diagnose/candidates/residual_by_speed.h"

#include "host/base/memory.h"
#include "support/recording.h"
#include "unity.h"

enum { P = 3, RUNS = 3, SAMPLES = 180 };

static const double NOISE_NM = 0.01;

static uint64_t seed;
static hci_wave back_emf[2];
static hci_machine machine;
static const hci_effects NO_EFFECTS = {NULL, 0};
static hci_effects declared; /* of the machine */
static hci_run run[RUNS];
static bool use[RUNS];
static double residual_Nm[RUNS * SAMPLES], variance[RUNS * SAMPLES];
static hci_binned_samples samples;
static hci_candidates list;
static int richness;
static bool known_only, magnetic_only, has_neutral;

/* One turn each at three speeds and currents, with noise for a residual. */
void setUp(void)
{
    seed = 77;
    declared = NO_EFFECTS;
    richness = 0;
    known_only = magnetic_only = has_neutral = false;
    back_emf[0] = (hci_wave){1.0, 1, 0.2, 0.0};
    back_emf[1] = (hci_wave){2.0, -1, 0.001, 0.0};
    machine = (hci_machine){.pole_pairs = P, .back_emf = back_emf, .back_emf_count = 1};
    for (size_t r = 0; r < RUNS; ++r) {
        run[r] = rec_make(SAMPLES);
        use[r] = true;
        for (size_t k = 0; k < SAMPLES; ++k) {
            run[r].theta_m_rad[k] = 2.0 * REF_PI * (double)k / SAMPLES;
            run[r].speed_rad_per_s[k] = 20.0 * (double)(r + 1);
            run[r].time_s[k] = run[r].theta_m_rad[k] / run[r].speed_rad_per_s[k];
            rec_phases(0.0, (double)r, P * run[r].theta_m_rad[k], run[r].i_A + 3 * k);
            residual_Nm[r * SAMPLES + k] = NOISE_NM * ref_normal(&seed);
            variance[r * SAMPLES + k] = NOISE_NM * NOISE_NM;
        }
    }
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_candidates_release(&list);
    hci_binned_samples_release(&samples);
    for (size_t r = 0; r < RUNS; ++r)
        rec_release(&run[r]);
}

static void hide(double periods, double amplitude_Nm)
{
    for (size_t k = 0; k < RUNS * SAMPLES; ++k)
        residual_Nm[k] += amplitude_Nm * cos(periods * run[0].theta_m_rad[k % SAMPLES]);
}

static hci_status make_from(const hci_candidates *known)
{
    const hci_candidates_source source = {.machine = &machine,
                                          .declared = &declared,
                                          .samples = &samples,
                                          .runs = run,
                                          .use = use,
                                          .residual_Nm = residual_Nm,
                                          .variance = variance,
                                          .reference_current_A = NAN,
                                          .richness = richness,
                                          .known_only = known_only,
                                          .magnetic_only = magnetic_only,
                                          .has_neutral = has_neutral};
    hci_note note = {{0}};
    hci_candidates_release(&list);
    return hci_candidates_make(&source, known, &list, &note);
}

static void make(void)
{
    hci_note note = {{0}};
    hci_binned_samples_release(&samples);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_binned_samples_make(&machine, NAN, run, RUNS, &samples, &note));
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_from(NULL));
}

/* Candidates of order 0 with that parameter. */
static int mean_terms_of(const char *effect, const char *name)
{
    int count = 0;
    for (size_t k = 0; k < list.count; ++k) {
        const hci_candidate *x = &list.candidate[k];
        count += x->term[0].order == 0.0 && strcmp(x->type->name, effect) == 0 &&
                 strcmp(x->type->parameter[x->term[0].parameter].name, name) == 0;
    }
    return count;
}

/* Weighted means at each speed and direction, weights 1/variance; nothing of a run that is not used. */
static void test_what_is_left_at_each_speed(void)
{
    const hci_candidates_source source = {
        .samples = &samples, .runs = run, .use = use, .residual_Nm = residual_Nm, .variance = variance};
    hci_effect_speed_mean mean[HCI_SPEED_MEANS];
    double sum[2] = {0.0, 0.0}, weight[2] = {0.0, 0.0};
    for (size_t k = 0; k < SAMPLES; ++k) {
        run[2].speed_rad_per_s[k] *= -1.0;
        run[2].theta_m_rad[k] *= -1.0;
    }
    use[1] = false;
    for (size_t k = 0; k < RUNS * SAMPLES; ++k) {
        const size_t r = k / SAMPLES;
        residual_Nm[k] += 0.1 * (double)(r + 1);
        variance[k] = r == 0 || k % 2 == 0 ? 4.0 : 1.0;
        sum[r == 2] += r == 1 ? 0.0 : residual_Nm[k] / variance[k];
        weight[r == 2] += r == 1 ? 0.0 : 1.0 / variance[k];
    }
    make();
    TEST_ASSERT_EQUAL_UINT64(RUNS * SAMPLES, samples.count);
    TEST_ASSERT_EQUAL_UINT64(2, hci_residual_by_speed(&source, mean));
    for (int j = 0; j < 2; ++j) { /* forward first */
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, j == 0 ? 20.0 : -60.0, mean[j].speed_rad_per_s);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, sum[j] / weight[j], mean[j].residual_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, weight[j], mean[j].weight);
    }
}

static void free_column(double **column)
{
    free(*column);
    *column = NULL;
}

/* The terms of an effect whose names begin so, and the largest order among them. */
static size_t terms_of(const char *effect, const char *name, double *most_order)
{
    size_t count = 0;
    if (most_order) *most_order = 0.0;
    for (size_t k = 0; k < list.count; ++k)
        for (size_t j = 0; j < list.candidate[k].count; ++j) {
            const hci_candidate *x = &list.candidate[k];
            if (strcmp(x->type->name, effect) != 0 ||
                strncmp(x->type->parameter[x->term[j].parameter].name, name, strlen(name)) != 0)
                continue;
            ++count;
            if (most_order) *most_order = fmax(*most_order, x->term[j].order);
        }
    return count;
}

static bool is_offered(const char *effect, const char *name, double order)
{
    for (size_t k = 0; k < list.count; ++k)
        for (size_t j = 0; j < list.candidate[k].count; ++j) {
            const hci_candidate *x = &list.candidate[k];
            if (strcmp(x->type->name, effect) == 0 &&
                strcmp(x->type->parameter[x->term[j].parameter].name, name) == 0 &&
                fabs(x->term[j].order - order) < 1e-9)
                return true;
        }
    return false;
}

/* ---- what the recordings contain ---- */

/* All candidates of an effect stand together, out of the model and with nothing to start from. */
static void test_the_list_is_in_order(void)
{
    make();
    for (size_t k = 1; k < list.count; ++k) {
        const hci_effect_type *before = list.candidate[k - 1].type;
        for (size_t j = k + 1; j < list.count && list.candidate[k].type != before; ++j)
            TEST_ASSERT_FALSE(list.candidate[j].type == before);
    }
    for (size_t k = 0; k < list.count; ++k) {
        TEST_ASSERT_FALSE(list.candidate[k].in);
        TEST_ASSERT_TRUE(list.candidate[k].price >= 0.0 && list.candidate[k].deviation >= 0.0);
        for (size_t j = 0; j < list.candidate[k].count; ++j)
            TEST_ASSERT_EQUAL_DOUBLE(0.0, list.candidate[k].term[j].value);
    }
}

/* What the machine has declared is where a candidate begins, or the declared value would count as missing. */
static void test_declared_values_are_where_to_begin(void)
{
    const hci_effect_type *type = hci_effect_type_find("friction");
    const hci_effect_term term = {0, 0.0, 0.03, NAN};
    const hci_effect effect = {type, &term, 1};
    declared = (hci_effects){&effect, 1};
    make();
    for (size_t k = 0; k < list.count; ++k)
        for (size_t j = 0; j < list.candidate[k].count; ++j) {
            const bool is_declared =
                list.candidate[k].type == type && list.candidate[k].term[j].parameter == 0;
            TEST_ASSERT_EQUAL_DOUBLE(is_declared ? 0.03 : 0.0, list.candidate[k].term[j].value);
            TEST_ASSERT_EQUAL_DOUBLE(is_declared ? 0.03 : 0.0, list.candidate[k].declared[j]);
        }
}

/* Currents that are nothing but the noise of their sensors. */
static void test_noise_is_no_current(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (size_t k = 0; k < 3 * SAMPLES; ++k)
            run[r].i_A[k] = 0.3 * ref_normal(&seed);
    make();
    for (size_t r = 0; r < RUNS; ++r)
        TEST_ASSERT_TRUE(samples.statistics[r].no_current && samples.statistics[r].current_A == 0.0);
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("current_gain", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("current_offset", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("back_emf", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("saturation", "", NULL));
    TEST_ASSERT_TRUE(terms_of("friction", "", NULL) > 0);
}

/* A current is one in spite of noise; where none flows it is none. */
static void test_a_small_current_is_one(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (size_t k = 0; k < 3 * SAMPLES; ++k)
            run[r].i_A[k] += 0.3 * ref_normal(&seed);
    make();
    TEST_ASSERT_TRUE(samples.statistics[0].no_current);
    TEST_ASSERT_FALSE(samples.statistics[1].no_current || samples.statistics[2].no_current);
    TEST_ASSERT_TRUE(terms_of("back_emf", "", NULL) > 0);
}

static void test_without_time_no_delay_and_no_lag(void)
{
    make();
    TEST_ASSERT_EQUAL_UINT64(2, terms_of("channel_delay", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("torque_sensor", "time_constant", NULL));
    for (size_t r = 0; r < RUNS; ++r)
        free_column(&run[r].time_s);
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("channel_delay", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("torque_sensor", "time_constant", NULL));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("torque_sensor", "offset", NULL));
}

/* The offset of the sensor does not need another speed. */
static void test_no_lag_at_one_speed(void)
{
    for (size_t k = 0; k < RUNS * SAMPLES; ++k) {
        run[k / SAMPLES].speed_rad_per_s[k % SAMPLES] = 20.0;
        run[k / SAMPLES].time_s[k % SAMPLES] = run[0].theta_m_rad[k % SAMPLES] / 20.0;
    }
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("torque_sensor", "time_constant", NULL));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("torque_sensor", "offset", NULL));
    machine.back_emf_count = 2; /* a ripple that is declared */
    make();
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("torque_sensor", "time_constant", NULL));
}

/* As many parts of the law of friction as speeds that differ, of runs in use. */
static void test_friction_has_as_many_parts_as_speeds(void)
{
    make();
    TEST_ASSERT_EQUAL_UINT64(3, terms_of("friction", "", NULL));
    use[2] = false;
    make();
    TEST_ASSERT_EQUAL_UINT64(2, terms_of("friction", "", NULL));
    for (size_t k = 0; k < SAMPLES; ++k)
        run[1].speed_rad_per_s[k] = -20.5; /* the same but for the direction */
    make();
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("friction", "coulomb", NULL));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("friction", "", NULL));
    for (size_t k = 0; k < SAMPLES; ++k) /* one run that runs up */
        run[1].speed_rad_per_s[k] = 20.0 * (double)k / SAMPLES;
    use[0] = false;
    make();
    TEST_ASSERT_EQUAL_UINT64(2, terms_of("friction", "", NULL));
    for (size_t r = 0; r < RUNS; ++r) {
        free_column(&run[r].speed_rad_per_s);
        free_column(&run[r].time_s);
    }
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("friction", "", NULL));
}

static void test_the_magnets_need_a_temperature(void)
{
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("magnet_temperature", "", NULL));
    run[1].temperature_C = calloc(SAMPLES, sizeof *run[1].temperature_C);
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("magnet_temperature", "", NULL)); /* it does not change */
    for (size_t k = 0; k < SAMPLES; ++k)
        run[1].temperature_C[k] = 20.0 + 30.0 * (double)k / SAMPLES;
    make();
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("magnet_temperature", "", NULL));
}

/* Nothing is relative to a current of 0. */
static void test_without_current_no_saturation(void)
{
    make();
    TEST_ASSERT_TRUE(terms_of("saturation", "", NULL) > 0);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, list.reference_current_A);
    for (size_t r = 0; r < RUNS; ++r)
        memset(run[r].i_A, 0, 3 * SAMPLES * sizeof *run[r].i_A);
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("saturation", "", NULL));
    for (size_t k = 0; k < list.count; ++k)
        TEST_ASSERT_TRUE(isfinite(list.candidate[k].deviation));
}

/* An even harmonic takes poles that differ, which the declared back-EMF would show. */
/* A mean torque that keeps its sign with the load is told by loads of both signs: of a run each, or of one
 * whose current changes its sign. Where all loads have one it is a part of what turns its sign, with an i_d
 * or without. Of a power of i_q alone, and of those of i_d, the mean is a torque of i_d: without one it is
 * not looked for. */
static void test_a_mean_that_keeps_its_sign(void)
{
    for (int k = 0; k < 6; ++k) {
        const double id_A = k < 3 ? -0.8 : 0.0;
        for (size_t j = 0; j < SAMPLES; ++j) /* zeros of the sensors are no load of both signs */
            for (int phase = 0; phase < 3; ++phase)
                run[0].i_A[3 * j + (size_t)phase] = 0.1 * (phase - 1);
        for (size_t j = 0; j < SAMPLES; ++j)
            rec_phases(id_A, k % 3 == 1 || (k % 3 == 2 && j < SAMPLES / 2) ? -1.0 : 1.0,
                       P * run[1].theta_m_rad[j], run[1].i_A + 3 * j);
        make();
        TEST_ASSERT_EQUAL(k % 3 > 0 && id_A < 0.0, mean_terms_of("saturation", "d0q3_cosine"));
        TEST_ASSERT_EQUAL(k % 3 > 0 && id_A < 0.0, mean_terms_of("saturation", "d2q1_cosine"));
        TEST_ASSERT_EQUAL(k % 3 > 0, mean_terms_of("reluctance", "dq_cosine"));
        TEST_ASSERT_EQUAL(1, mean_terms_of("saturation", "d1q2_cosine"));
        TEST_ASSERT_EQUAL(1, mean_terms_of("reluctance", "dd_cosine"));
    }
}

static void test_even_harmonics_only_beside_even_ones(void)
{
    make();
    TEST_ASSERT_TRUE(is_offered("back_emf", "sine", 5.0) && !is_offered("back_emf", "sine", 4.0));
    machine.back_emf_count = 2;
    make();
    TEST_ASSERT_TRUE(is_offered("back_emf", "sine", 5.0) && is_offered("back_emf", "sine", 4.0));
}

/* In a star no current is the same in all three phases, which orders of multiples of three take. */
static void test_zero_sequences_need_a_neutral(void)
{
    make();
    TEST_ASSERT_TRUE(is_offered("back_emf", "sine", 5.0) && !is_offered("back_emf", "sine", 15.0));
    has_neutral = true;
    make();
    TEST_ASSERT_TRUE(is_offered("back_emf", "sine", 5.0) && is_offered("back_emf", "sine", 15.0));
}

/* ---- orders ---- */

/* Orders of cogging and of the turn are those that stand out: of pure noise next to none. */
static void test_orders_stand_out_of_the_residual(void)
{
    make();
    TEST_ASSERT_TRUE(terms_of("cogging", "", NULL) + terms_of("mechanical_order", "", NULL) <= 4);
    hide(6.0 * P, 0.02);
    hide(7.0, 0.02);
    make();
    TEST_ASSERT_TRUE(is_offered("cogging", "sine", 6.0) && is_offered("cogging", "cosine", 6.0));
    TEST_ASSERT_TRUE(is_offered("mechanical_order", "sine", 7.0 / P));
    TEST_ASSERT_TRUE(is_offered("mechanical_order", "iq_cosine", 7.0 / P));
    TEST_ASSERT_FALSE(is_offered("cogging", "sine", 7.0 / P));
    TEST_ASSERT_FALSE(is_offered("mechanical_order", "sine", 6.0));
}

/* What no effect explains may be kept from competing. */
static void test_known_effects_alone(void)
{
    for (int alone = 0; alone < 2; ++alone) {
        known_only = alone;
        for (size_t r = 0; r < RUNS; ++r) /* grows with the current and the speed */
            for (size_t k = 0; k < SAMPLES; ++k)
                residual_Nm[r * SAMPLES + k] = 0.1 * (double)(r * r) * cos(5.0 * run[r].theta_m_rad[k]);
        make();
        TEST_ASSERT_EQUAL(alone == 0, terms_of("unknown", "", NULL) > 0);
    }
}

/* 180 samples in a turn tell orders up to 90 periods: 30 electrical ones. */
static void test_orders_above_half_the_samples_are_none(void)
{
    double most;
    hide(180.0 - 48.0, 0.05);
    make();
    TEST_ASSERT_TRUE(terms_of("cogging", "", &most) > 0 && most < 30.0);
    TEST_ASSERT_TRUE(is_offered("cogging", "sine", 16.0)); /* what it looks like */
}

/* A wrapped electrical angle does not tell which pole pair it is. */
static void test_without_a_known_turn_no_orders_of_the_turn(void)
{
    hide(7.0, 0.02);
    hide(6.0 * P, 0.02);
    for (size_t r = 0; r < RUNS; ++r)
        run[r].turn_known = false;
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("mechanical_order", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("position_eccentricity", "", NULL));
    TEST_ASSERT_TRUE(is_offered("cogging", "sine", 6.0));
}

/* Half a turn does not tell order 7 from 6 or 8: whole electrical orders are all that is looked for. */
static void test_in_half_a_turn_no_orders_of_the_turn(void)
{
    for (size_t r = 0; r < RUNS; ++r)
        for (size_t k = 0; k < SAMPLES; ++k) {
            run[r].theta_m_rad[k] *= 0.5;
            run[r].time_s[k] *= 0.5;
        }
    hide(7.0, 0.02);
    hide(6.0 * P, 0.02);
    make();
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("mechanical_order", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(0, terms_of("position_eccentricity", "", NULL));
    TEST_ASSERT_TRUE(is_offered("cogging", "sine", 6.0));
}

/* ---- high powers, and what is known ---- */

static void test_more_is_offered_where_the_iron_saturates(void)
{
    size_t powers[3], reluctance[3];
    double order[3];
    machine.pole_pairs = 1; /* 180 samples in an electrical turn */
    for (richness = 0; richness < 3; ++richness) {
        make();
        powers[richness] = terms_of("saturation", "", &order[richness]);
        reluctance[richness] = terms_of("reluctance", "", NULL);
    }
    TEST_ASSERT_TRUE(order[0] == 12.0 && order[1] == 60.0 && order[2] == 60.0);
    TEST_ASSERT_TRUE(powers[2] > powers[1] && reluctance[1] > reluctance[0] &&
                     reluctance[2] == reluctance[1]);
    TEST_ASSERT_TRUE(is_offered("saturation", "d0q6_cosine", 0.0));
    richness = 1;
    make();
    TEST_ASSERT_FALSE(is_offered("saturation", "d0q6_cosine", 0.0));
}

/* 60 samples in an electrical turn tell orders up to 29, of any effect, and 180 up to 86. */
static void test_orders_of_iron_end_at_half_the_samples(void)
{
    static const double MOST[2][2] = {{24.0, 24.0}, {60.0, 60.0}};
    for (int fine = 0; fine < 2; ++fine) {
        double saturation = 0.0, reluctance = 0.0;
        richness = 1;
        machine.pole_pairs = fine ? 1 : P;
        make();
        TEST_ASSERT_TRUE(terms_of("saturation", "", &saturation) > 0 &&
                         terms_of("reluctance", "", &reluctance) > 0);
        TEST_ASSERT_EQUAL_DOUBLE(MOST[fine][0], saturation);
        TEST_ASSERT_EQUAL_DOUBLE(MOST[fine][1], reluctance);
    }
}

/* Where the magnetic circuit alone is looked for, nothing else is offered, and a torque that no current makes
 * only where next to none flows. */
static void test_the_magnetic_circuit_alone(void)
{
    static const char *const OTHER[] = {"friction",      "position_offset", "current_offset", "current_gain",
                                        "torque_sensor", "channel_delay",   "phase_imbalance"};
    hide(6.0 * P, 0.02);
    magnetic_only = true;
    make();
    for (size_t k = 0; k < sizeof OTHER / sizeof *OTHER; ++k)
        TEST_ASSERT_EQUAL_UINT64(0, terms_of(OTHER[k], "", NULL));
    TEST_ASSERT_TRUE(terms_of("reluctance", "", NULL) > 0 && terms_of("back_emf", "", NULL) > 0);
    TEST_ASSERT_TRUE(is_offered("cogging", "sine", 6.0)); /* the first run has no current */
    use[0] = false;
    make();
    TEST_ASSERT_FALSE(is_offered("cogging", "sine", 6.0));
}

/* What is in the model stays with its value, also where it would not be offered anew. */
static void test_the_model_stays_in_the_list(void)
{
    hci_candidate in[2] = {{.type = hci_effect_type_find("position_offset"), .count = 1, .in = true},
                           {.type = hci_effect_type_find("cogging"), .count = 2, .in = true}};
    const hci_candidates known = {in, 2, 1.0};
    size_t offered = 0;
    in[0].term[0] = (hci_effect_term){0, 0.0, 0.05, 0.001};
    in[1].term[0] = (hci_effect_term){0, 4.0, 0.5, 0.001};
    in[1].term[1] = (hci_effect_term){1, 4.0, 0.25, 0.001};
    make();
    offered = list.count;
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_from(&known));
    TEST_ASSERT_EQUAL_UINT64(offered + 1, list.count);
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_types_in(&list));
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_terms_in(&list));
    for (size_t k = 0; k < list.count; ++k)
        TEST_ASSERT_EQUAL_DOUBLE(list.candidate[k].in && list.candidate[k].type == in[0].type   ? 0.05
                                 : list.candidate[k].in && list.candidate[k].type == in[1].type ? 0.5
                                                                                                : 0.0,
                                 list.candidate[k].term[0].value);
    in[1].in = false;
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_from(&known));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_terms_in(&list));
}

/* The first candidate of a type. */
static const hci_candidate *law_of(const char *type)
{
    size_t k = 0;
    while (k < list.count && strcmp(list.candidate[k].type->name, type) != 0)
        ++k;
    TEST_ASSERT_TRUE(k < list.count);
    return &list.candidate[k];
}

/* Coulomb friction that runs of one speed tell, beside runs of three: no term of it is there twice, and the
 * longer law is in, from the value that is known. */
static void test_a_law_of_few_runs_gives_way_to_that_of_all(void)
{
    hci_candidate in = {.type = hci_effect_type_find("friction"), .count = 1, .in = true};
    const hci_candidates known = {&in, 1, 1.0};
    in.term[0] = (hci_effect_term){0, 0.0, 0.03, 0.001};
    make();
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_from(&known));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("friction", "coulomb", NULL));
    TEST_ASSERT_EQUAL_UINT64(3, terms_of("friction", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(3, hci_candidates_terms_in(&list));
    const hci_candidate *law = law_of("friction");
    TEST_ASSERT_EQUAL_UINT64(1, law->grown_from);
    TEST_ASSERT_EQUAL_DOUBLE(0.03, law->term[0].value);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, law->term[1].value);
    use[1] = use[2] = false; /* the other way round: what is in has more */
    in.count = 2;
    in.term[1] = (hci_effect_term){1, 0.0, 0.001, 0.0001};
    make();
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_from(&known));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("friction", "coulomb", NULL));
    TEST_ASSERT_EQUAL_UINT64(2, hci_candidates_terms_in(&list));
    TEST_ASSERT_EQUAL_UINT64(0, law_of("friction")->grown_from);
}

/* Of three parts one is in, the last two have left: they stand behind it and may come back. */
static void test_what_has_left_a_law_is_a_candidate(void)
{
    hci_candidate in = {.type = hci_effect_type_find("friction"), .count = 2, .in = true};
    const hci_candidates known = {&in, 1, 1.0};
    in.term[0] = (hci_effect_term){0, 0.0, 0.03, 0.001};
    in.term[1] = (hci_effect_term){1, 0.0, 0.01, 0.001};
    hci_candidate_shorten(&in);
    make();
    TEST_ASSERT_EQUAL_INT(HCI_OK, make_from(&known));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("friction", "coulomb", NULL));
    TEST_ASSERT_EQUAL_UINT64(1, terms_of("friction", "viscous", NULL));
    TEST_ASSERT_EQUAL_UINT64(3, terms_of("friction", "", NULL));
    TEST_ASSERT_EQUAL_UINT64(1, hci_candidates_terms_in(&list));
}

static void test_memory_is_out(void)
{
    make();
    for (long n = 0; n < 3; ++n) {
        hci_memory_fail_after(n);
        const hci_status status = make_from(NULL);
        hci_memory_fail_after(-1);
        TEST_ASSERT_EQUAL_INT(HCI_ERROR_MEMORY, status);
        TEST_ASSERT_NULL(list.candidate);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_left_at_each_speed);
    RUN_TEST(test_the_list_is_in_order);
    RUN_TEST(test_declared_values_are_where_to_begin);
    RUN_TEST(test_noise_is_no_current);
    RUN_TEST(test_a_small_current_is_one);
    RUN_TEST(test_without_time_no_delay_and_no_lag);
    RUN_TEST(test_no_lag_at_one_speed);
    RUN_TEST(test_friction_has_as_many_parts_as_speeds);
    RUN_TEST(test_the_magnets_need_a_temperature);
    RUN_TEST(test_without_current_no_saturation);
    RUN_TEST(test_a_mean_that_keeps_its_sign);
    RUN_TEST(test_even_harmonics_only_beside_even_ones);
    RUN_TEST(test_zero_sequences_need_a_neutral);
    RUN_TEST(test_orders_stand_out_of_the_residual);
    RUN_TEST(test_known_effects_alone);
    RUN_TEST(test_orders_above_half_the_samples_are_none);
    RUN_TEST(test_without_a_known_turn_no_orders_of_the_turn);
    RUN_TEST(test_in_half_a_turn_no_orders_of_the_turn);
    RUN_TEST(test_more_is_offered_where_the_iron_saturates);
    RUN_TEST(test_orders_of_iron_end_at_half_the_samples);
    RUN_TEST(test_the_magnetic_circuit_alone);
    RUN_TEST(test_the_model_stays_in_the_list);
    RUN_TEST(test_a_law_of_few_runs_gives_way_to_that_of_all);
    RUN_TEST(test_what_has_left_a_law_is_a_candidate);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
