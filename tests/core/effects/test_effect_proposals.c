/* Which terms effects name for recordings, and for motors of one make. */
#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "hci/status.h"
#include "unity.h"

enum { MOST = 1024 };

static hci_effect_candidate taken[MOST];
static size_t count;

void setUp(void)
{
    count = 0;
}

void tearDown(void)
{
}

static void take(void *context, const hci_effect_candidate *candidate)
{
    TEST_ASSERT_EQUAL_PTR(&count, context);
    TEST_ASSERT_TRUE(count < MOST);
    taken[count++] = *candidate;
}

static const hci_effect_proposals TO = {take, &count};

/* The three largest; of two that are equal the first; none that is a mean. */
static void test_cogging_of_one_make(void)
{
    const hci_harmonic cogging[] = {
        {6.0, 0.3, 0.4}, {12.0, 0.5, 0.0}, {18.0, 0.1, 0.0}, {24.0, 0.0, 2.0}, {30.0, 0.7, 0.0}};
    const hci_harmonic mean[] = {{0.0, 0.0, 1.0}, {6.0, 0.3, 0.4}};
    const hci_machine machine = {.pole_pairs = 1, .cogging = cogging, .cogging_count = 5};
    const hci_machine with_mean = {.pole_pairs = 1, .cogging = mean, .cogging_count = 2};
    static const double EXPECTED[] = {6.0, 24.0, 30.0, 6.0};
    hci_effect_type_find("cogging")->propose_alike(&machine, NAN, &TO);
    hci_effect_type_find("cogging")->propose_alike(&with_mean, NAN, &TO);
    TEST_ASSERT_EQUAL_UINT64(4, count);
    for (size_t k = 0; k < count; ++k) {
        TEST_ASSERT_EQUAL_UINT64(2, taken[k].count);
        TEST_ASSERT_EQUAL_DOUBLE(EXPECTED[k], taken[k].order);
    }
}

static void test_magnets_of_one_make(void)
{
    const hci_machine one = {.pole_pairs = 1}, three = {.pole_pairs = 3}, five = {.pole_pairs = 5},
                      many = {.pole_pairs = 40};
    const hci_effect_type *magnets = hci_effect_type_find("unequal_magnets");
    magnets->propose_alike(&one, NAN, &TO);
    TEST_ASSERT_EQUAL_UINT64(0, count);
    magnets->propose_alike(&three, NAN, &TO);
    TEST_ASSERT_EQUAL_UINT64(2, count);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 / 3.0, taken[0].order);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 / 3.0, taken[1].order);
    magnets->propose_alike(&many, NAN, &TO);
    TEST_ASSERT_TRUE(count > 2 && count < 2 + 39);
    count = 0;
    magnets->propose_alike(&three, 9.0, &TO); /* whole */
    TEST_ASSERT_EQUAL_UINT64(2, count);
    magnets->propose_alike(&five, 12.0, &TO);
    TEST_ASSERT_EQUAL_UINT64(5, count);
    TEST_ASSERT_EQUAL_DOUBLE(12.0 / 5.0, taken[4].order);
    for (size_t k = 0; k < 5; ++k)
        TEST_ASSERT_EQUAL_UINT64(2, taken[k].count); /* sine and cosine */
}

/* Orders in which load and cogging vary alike; a drift where a run is long enough to tell; a gain where both
 * are off alike. */
static void test_what_recordings_ask_for(void)
{
    const double flux_order[2] = {1.0 / 3.0, 2.0 / 3.0};
    const hci_machine machine = {.pole_pairs = 3};
    hci_effect_survey survey = {.machine = &machine, .torque_Nm = 4.0, .flux_order = flux_order};
    static const char *const NAME[] = {"unequal_magnets", "torque_drift", "torque_gain", "rotor_inertia"};
    for (int k = 0; k < 4; ++k)
        hci_effect_type_find(NAME[k])->propose(&survey, &TO);
    survey.creeps = true;
    hci_effect_type_find("torque_drift")->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_UINT64(0, count);
    survey.flux_orders = 2;
    survey.one_gain = true;
    survey.duration_s = 10.0;
    survey.acceleration_rad_per_s2 = 3.0;
    for (int k = 0; k < 4; ++k)
        hci_effect_type_find(NAME[k])->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_UINT64(5, count);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 / 3.0, taken[0].order);
    TEST_ASSERT_EQUAL_DOUBLE(2.0 / 3.0, taken[1].order);
    TEST_ASSERT_TRUE(taken[0].count == 2 && taken[1].count == 2); /* sine and cosine */
    TEST_ASSERT_TRUE(taken[2].expected > 0.0 && taken[2].expected < 0.4 && taken[3].expected > 0.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, taken[4].expected); /* any inertia */
    TEST_ASSERT_EQUAL_DOUBLE(1e5,
                             taken[4].alternatives); /* 2 ln of it is two values of a friction at 1e5 rows */
}

/* Orders at which the angle may be off, but for those of a resolver and of an eccentric encoder, which are
 * named whatever stands out. */
static void test_an_encoder_between_its_lines(void)
{
    const double angle_order[5] = {8.0, 2.0, 1.0 / 3.0, 2.0 / 3.0, 16.0 / 3.0};
    const hci_machine machine = {.pole_pairs = 3};
    const hci_effect_survey survey = {
        .machine = &machine, .orders = 90.0, .angle_order = angle_order, .angle_orders = 5};
    hci_effect_type_find("position_harmonics")->propose(&survey, &TO);
    TEST_ASSERT_EQUAL_UINT64(5, count);
    TEST_ASSERT_EQUAL_DOUBLE(8.0, taken[3].order);
    TEST_ASSERT_EQUAL_DOUBLE(90.0, taken[3].alternatives);
    TEST_ASSERT_EQUAL_DOUBLE(16.0 / 3.0, taken[4].order);
}

/* ---- what each effect names ---- */

typedef struct {
    const char *parameter; /* the first one */
    size_t count;
    double order, alternatives, expected;
} named;

static void takes(const char *type, size_t at, named x)
{
    const hci_effect_candidate *c = &taken[at];
    TEST_ASSERT_TRUE_MESSAGE(at < count, type);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(x.parameter, hci_effect_type_find(type)->parameter[c->parameter].name,
                                     type);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(x.count, c->count, x.parameter);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, x.order, c->order);
    TEST_ASSERT_EQUAL_DOUBLE(x.alternatives, c->alternatives);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * x.expected, x.expected, c->expected);
}

static void proposes(const char *type, const hci_effect_survey *survey, size_t rows, const named *x)
{
    count = 0;
    hci_effect_type_find(type)->propose(survey, &TO);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(rows, count, type);
    for (size_t k = 0; k < rows; ++k)
        takes(type, k, x[k]);
}

static const hci_wave EMF[] = {{1.0, 1, 0.3, 0.4}, {5.0, -1, 0.1, 0.0}};
static const hci_machine MACHINE = {.pole_pairs = 2, .back_emf = EMF, .back_emf_count = 2};
static const double SLOTS[] = {12.0, 9.0}, TURNS[] = {0.5, 1.5}, LOADS[] = {2.5};

static hci_effect_survey recordings(void)
{
    return (hci_effect_survey){.machine = &MACHINE,
                               .timed = true,
                               .moving = true,
                               .loaded_both_ways = true,
                               .has_temperature = true,
                               .has_turn = true,
                               .duration_s = 8.0,
                               .speeds = 3,
                               .torque_Nm = 4.0,
                               .current_A = 10.0,
                               .reference_current_A = 20.0,
                               .slot_order = SLOTS,
                               .slot_orders = 2,
                               .turn_order = TURNS,
                               .turn_orders = 2,
                               .load_order = LOADS,
                               .load_orders = 1,
                               .orders = 36.0};
}

/* From how many each is chosen, and how large it usually is. */
static void test_what_each_effect_names(void)
{
    hci_effect_survey s = recordings();
    proposes("cogging", &s, 2, (named[]){{"sine", 2, 12.0, 6.0, 1.2}, {"sine", 2, 9.0, 36.0, 1.2}});
    proposes("mechanical_order", &s, 8,
             (named[]){{"sine", 2, 0.5, 36.0, 0.0},
                       {"iq_sine", 2, 0.5, 36.0, 0.0},
                       {"id_sine", 2, 0.5, 36.0, 0.0},
                       {"sine", 2, 1.5, 36.0, 0.0},
                       {"iq_sine", 2, 1.5, 36.0, 0.0},
                       {"id_sine", 2, 1.5, 36.0, 0.0},
                       {"iq_sine", 2, 2.5, 36.0, 0.0},
                       {"id_sine", 2, 2.5, 36.0, 0.0}});
    proposes("magnet_temperature", &s, 1, (named[]){{"emf_per_kelvin", 1, 0.0, 1.0, 0.003}});
    proposes("friction", &s, 1, (named[]){{"coulomb", 3, 0.0, 1.0, 0.0}});
    proposes("iron_drag", &s, 2,
             (named[]){{"hysteresis", 1, 0.0, 2.0, 0.05 * 4.0 / 100.0}, {"eddy", 1, 0.0, 2.0, 0.0}});
    proposes("channel_delay", &s, 2, (named[]){{"current", 1, 0.0, 2.0, 1e-3}, {"angle", 1, 0.0, 2.0, 1e-3}});
    proposes("current_filter", &s, 1, (named[]){{"time_constant", 1, 0.0, 2.0, 1e-3}});
    proposes("phase_imbalance", &s, 3,
             (named[]){{"a", 1, 0.0, 3.0, 0.2}, {"b", 1, 0.0, 3.0, 0.2}, {"c", 1, 0.0, 3.0, 0.2}});
    proposes("current_gain", &s, 3,
             (named[]){{"a", 1, 0.0, 3.0, 0.1}, {"b", 1, 0.0, 3.0, 0.1}, {"c", 1, 0.0, 3.0, 0.1}});
    proposes("current_offset", &s, 3,
             (named[]){{"a", 1, 0.0, 3.0, 0.5}, {"b", 1, 0.0, 3.0, 0.5}, {"c", 1, 0.0, 3.0, 0.5}});
    proposes("position_offset", &s, 1, (named[]){{"angle", 1, 0.0, 1.0, 0.1}});
    proposes("position_load", &s, 1, (named[]){{"per_ampere", 1, 0.0, 2.0, 0.01}});
    s.current_A = 0.1; /* of a small motor */
    proposes("position_load", &s, 1, (named[]){{"per_ampere", 1, 0.0, 2.0, 1.0}});
    s.current_A = 10.0;
    proposes("position_eccentricity", &s, 2,
             (named[]){{"mech_sine", 2, 1.0, 2.0, 0.03}, {"mech_sine", 2, 2.0, 2.0, 0.03}});
    proposes(
        "position_harmonics", &s, 3,
        (named[]){{"sine", 2, 1.0, 3.0, 0.05}, {"sine", 2, 2.0, 3.0, 0.05}, {"sine", 2, 4.0, 3.0, 0.05}});
    proposes("torque_sensor", &s, 2,
             (named[]){{"offset", 1, 0.0, 1.0, 0.4}, {"time_constant", 1, 0.0, 1.0, 0.0}});
    s.creeps = s.one_gain = true;
    proposes("torque_drift", &s, 1, (named[]){{"rate", 1, 0.0, 1.0, 0.05 * 4.0 / 8.0}});
    proposes("torque_gain", &s, 1, (named[]){{"gain", 1, 0.0, 1.0, 0.1}});
}

/* What recordings do not show is not named. */
static void test_what_cannot_be_seen(void)
{
    const hci_machine one = {.pole_pairs = 1};
    hci_effect_survey s = recordings();
    s.speeds = 1;
    proposes("iron_drag", &s, 1, (named[]){{"hysteresis", 1, 0.0, 2.0, 0.002}});
    proposes("current_filter", &s, 0, NULL);
    s.timed = false;
    proposes("friction", &s, 1, (named[]){{"coulomb", 1, 0.0, 1.0, 0.0}});
    proposes("channel_delay", &s, 0, NULL);
    proposes("torque_sensor", &s, 1, (named[]){{"offset", 1, 0.0, 1.0, 0.4}});
    s.speeds = 2;
    proposes("current_filter", &s, 0, NULL);
    s.timed = true;
    s.moving = false;
    proposes("friction", &s, 1, (named[]){{"coulomb", 2, 0.0, 1.0, 0.0}});
    s.timed = s.loaded_both_ways = s.has_temperature = s.has_turn = false;
    proposes("friction", &s, 0, NULL);
    proposes("iron_drag", &s, 0, NULL);
    proposes("magnet_temperature", &s, 0, NULL);
    proposes("position_eccentricity", &s, 0, NULL);
    s.loaded_both_ways = true;
    s.current_A = 0.0;
    proposes("iron_drag", &s, 0, NULL);
    proposes("position_load", &s, 0, NULL);
    s.machine = &one;
    proposes("position_harmonics", &s, 1, (named[]){{"sine", 2, 4.0, 3.0, 0.05}});
}

/* Odd harmonics to 25, even ones where the declared back-EMF has some; of another sequence those to 7. What
 * is the same in all phases takes a neutral. */
static void harmonics_of_the_back_emf(bool has_neutral)
{
    const hci_wave even[] = {{1.0, 1, 0.0, 0.5}, {2.0, -1, 0.05, 0.0}};
    const hci_machine uneven = {.pole_pairs = 2, .back_emf = even, .back_emf_count = 2};
    hci_effect_survey s = recordings();
    s.has_neutral = has_neutral;
    for (int step = 2; step >= 1; --step) {
        size_t k = 0;
        s.machine = step == 1 ? &uneven : &MACHINE;
        count = 0;
        hci_effect_type_find("back_emf")->propose(&s, &TO);
        takes("back_emf", k++, (named){"sine", 1, 1.0, 2.0, 0.15});
        takes("back_emf", k++, (named){"cosine", 1, 1.0, 2.0, 0.15});
        for (int n = 1 + step; n <= 25; n += step)
            if (has_neutral || n % 3 != 0)
                takes("back_emf", k++, (named){"sine", 2, n, n % 6 == 1 || n % 6 == 5 ? 8.0 : 40.0, 0.15});
        for (int n = 1; n <= 7; n += step) {
            if (n % 3 != 1) takes("back_emf", k++, (named){"pos_sine", 2, n, 40.0, 0.025});
            if (n % 3 != 2) takes("back_emf", k++, (named){"neg_sine", 2, n, 40.0, 0.025});
        }
        TEST_ASSERT_EQUAL_UINT64(k, count);
    }
}

static void test_harmonics_of_the_back_emf(void)
{
    harmonics_of_the_back_emf(false);
    harmonics_of_the_back_emf(true);
}

/* The mean, order 2 of unequal phases, and 6k; cosines of dd and qq with the sine of dq are usual. */
static void test_orders_of_reluctance(void)
{
    hci_effect_survey s = recordings();
    s.along_d_A = s.flows_d_A = s.current_A;
    for (s.richness = 0; s.richness < 2; ++s.richness) {
        size_t k = 0;
        count = 0;
        hci_effect_type_find("reluctance")->propose(&s, &TO);
        takes("reluctance", k++, (named){"dd_cosine", 1, 0.0, 1.0, 0.0});
        takes("reluctance", k++, (named){"dq_cosine", 1, 0.0, 4.0, 0.0});
        for (int n = 2; n <= (s.richness ? 60 : 24); n = n == 2 ? 6 : n + 6) {
            const double usual = n == 2 ? 60.0 : 12.0;
            takes("reluctance", k++, (named){"dd_cosine", 1, n, usual, 0.0});
            takes("reluctance", k++, (named){"dd_sine", 1, n, 60.0, 0.0});
            takes("reluctance", k++, (named){"qq_cosine", 1, n, usual, 0.0});
            takes("reluctance", k++, (named){"qq_sine", 1, n, 60.0, 0.0});
            takes("reluctance", k++, (named){"dq_sine", 1, n, usual, 0.0});
            takes("reluctance", k++, (named){"dq_cosine", 1, n, 60.0, 0.0});
        }
        TEST_ASSERT_EQUAL_UINT64(k, count);
    }
}

/* Where no run had an i_d worth the name, what noise makes of it takes no saliency of many times the magnets'
 * flux: three of them are expected at I_0. With an i_d any is. */
static void test_a_saliency_without_an_i_d(void)
{
    hci_effect_survey s = recordings();
    double fundamental = 0.0;
    for (size_t k = 0; k < MACHINE.back_emf_count; ++k)
        if (MACHINE.back_emf[k].order == 1.0)
            fundamental = hypot(MACHINE.back_emf[k].sine, MACHINE.back_emf[k].cosine);
    s.along_d_A = 0.01 * s.current_A;
    s.flows_d_A = 0.05 * s.current_A;
    count = 0;
    hci_effect_type_find("reluctance")->propose(&s, &TO);
    const double expected_H = 3.0 * fundamental / (MACHINE.pole_pairs * s.reference_current_A);
    takes("reluctance", 0, (named){"dd_cosine", 1, 0.0, 1.0, expected_H});
    takes("reluctance", 1, (named){"dq_cosine", 1, 0.0, 4.0, expected_H});
    takes("reluctance", 2, (named){"dd_cosine", 1, 2.0, 60.0, 0.0});
}

/* T = n p L_qq' i_q² and p L_dq i_q² are the same wave, and what i_d² makes nobody sees: beside the mean, of
 * the product and of i_d nothing is looked for. */
static void test_inductances_without_an_i_d(void)
{
    hci_effect_survey s = recordings();
    s.flows_d_A = 0.049 * s.current_A;
    count = 0;
    hci_effect_type_find("reluctance")->propose(&s, &TO);
    takes("reluctance", 2, (named){"qq_cosine", 1, 2.0, 60.0, 0.0});
    takes("reluctance", 3, (named){"qq_sine", 1, 2.0, 60.0, 0.0});
    takes("reluctance", 4, (named){"qq_cosine", 1, 6.0, 12.0, 0.0});
    TEST_ASSERT_EQUAL_UINT64(2 + 2 * 5, count);
    hci_machine salient = *s.machine;
    const hci_inductance_slope declared = {0};
    salient.slope = &declared;
    salient.slope_count = 1;
    s.machine = &salient;
    count = 0;
    hci_effect_type_find("reluctance")->propose(&s, &TO); /* no saliency beside the declared one */
    TEST_ASSERT_EQUAL_STRING("dq_cosine",
                             hci_effect_type_find("reluctance")->parameter[taken[0].parameter].name);
    TEST_ASSERT_EQUAL_UINT64(1 + 2 * 5, count);
}

/* Powers d^a q^b and their waves in the order of the list: degree by degree, b rising. */
static const char *power(char text[16], int a, int b, bool cosine)
{
    const char *wave = cosine ? "_cosine" : "_sine";
    text[0] = 'd';
    text[1] = (char)('0' + a);
    text[2] = 'q';
    text[3] = (char)('0' + b);
    strcpy(text + 4, wave);
    return text;
}

/* At half the reference current a power of the third degree makes an eighth of the torque. */
static void test_powers_of_saturation(void)
{
    hci_effect_survey s = recordings();
    s.flows_d_A = 0.05 * s.current_A;
    char name[16];
    for (s.richness = 0; s.richness < 3; ++s.richness) {
        size_t k = 0;
        count = 0;
        hci_effect_type_find("saturation")->propose(&s, &TO);
        for (int degree = 3; degree <= (s.richness > 1 ? 6 : 4); ++degree)
            for (int b = 0; b <= degree; ++b)
                for (int n = 0; n <= (s.richness > 0 ? 60 : 12); n += 6) {
                    const double most = 4.0 * pow(2.0, degree) / 2.0;
                    const double mean = most / 3.0 * (degree > 4 ? pow(0.25, degree - 4) : 1.0);
                    const double ripple = n == 0 ? mean : 0.2 * most * pow(0.25, degree - 3) / n;
                    const bool even = b % 2 == 0;
                    if (even || n > 0)
                        takes("saturation", k++,
                              (named){power(name, degree - b, b, even), 1, n, n == 0 ? 6.0 : 30.0, ripple});
                    if (s.richness == 0 && (!even || n > 0))
                        takes("saturation", k++,
                              (named){power(name, degree - b, b, !even), 1, n, 60.0, ripple});
                }
        TEST_ASSERT_EQUAL_UINT64(k, count);
    }
    s.reference_current_A = 0.0;
    proposes("saturation", &s, 0, NULL);
}

/* Of loads of one sign the mean has i_d i_q² alone, beside saturation that is known i_d i_q⁴. */
static void test_a_mean_of_one_sign(void)
{
    static const char *const MEANS[] = {"d1q2_cosine", "d1q4_cosine"};
    const hci_effect_type *type = hci_effect_type_find("saturation");
    hci_effect_survey s = recordings();
    s.one_sided = true;
    for (s.richness = 0; s.richness < 3; ++s.richness) {
        size_t means = 0;
        count = 0;
        type->propose(&s, &TO);
        for (size_t k = 0; k < count; ++k)
            if (taken[k].order == 0.0)
                TEST_ASSERT_EQUAL_STRING(MEANS[means++], type->parameter[taken[k].parameter].name);
        TEST_ASSERT_EQUAL_UINT64(s.richness == 0 ? 1 : 2, means);
    }
}

/* Of the means, d0q3 and the like make a torque of i_d alone: where it only ripples they are not looked for,
 * and the loss of torque with load (d1q2) is. Of the ripple, d1q2 makes the same wave as d0q3. */
static void test_means_without_an_i_d(void)
{
    hci_effect_survey s = recordings();
    s.flows_d_A = 0.049 * s.current_A;
    count = 0;
    const hci_effect_type *type = hci_effect_type_find("saturation");
    type->propose(&s, &TO);
    size_t means = 0, ripples = 0;
    for (size_t k = 0; k < count; ++k) {
        const char *name = type->parameter[taken[k].parameter].name;
        means += taken[k].order == 0.0;
        ripples += taken[k].order == 6.0;
        TEST_ASSERT_EQUAL_STRING_LEN_MESSAGE(taken[k].order > 0.0 ? "d0q" : "d1q", name, 3, name);
    }
    TEST_ASSERT_EQUAL_UINT64(2, means);
    TEST_ASSERT_EQUAL_UINT64(4, ripples); /* sine and cosine of i_q³ and i_q⁴ */
}

/* ---- the series of the co-energy ---- */

/* Coefficients fall by 0.35 with each power above 2 and by 0.67 with each multiple of six, of cogging by 0.9.
 */
static double faded(int of_power, int n)
{
    return pow(of_power == 0 ? 0.9 : 0.67, (n + 1) / 6) * pow(0.35, of_power > 2 ? of_power - 2 : 0);
}

static void series(const char *type, bool unlike)
{
    const hci_effect_coenergy_series x = {2, 4, 18, 20.0, unlike, 0};
    count = 0;
    hci_effect_type_find(type)->propose_coenergy(&x, &TO);
}

static void takes_power(const char *type, size_t at, int of_power, named x)
{
    takes(type, at, x);
    TEST_ASSERT_EQUAL_INT(of_power, taken[at].power);
}

/* W' = 1 N·m at I_0 = 20 A: T = p n W' without current, W' = 3/2 E i/(p n) of a back-EMF, 3/4 L i² and 3/2 L
 * i_d i_q of inductances; each with its sine where the rotor looks alike both ways round, or the other. */
static void test_series_of_the_coenergy(void)
{
    for (int unlike = 0; unlike <= 1; ++unlike) {
        const char *const wave[] = {unlike ? "cosine" : "sine", unlike ? "dd_sine" : "dd_cosine",
                                    unlike ? "dq_cosine" : "dq_sine", unlike ? "qq_sine" : "qq_cosine"};
        size_t k = 0;
        char name[16];
        series("cogging", unlike);
        for (int n = 6; n <= 18; n += 6)
            takes_power("cogging", k++, 0, (named){wave[0], 1, n, 1.0, 2.0 * n * faded(0, n)});
        TEST_ASSERT_EQUAL_UINT64(3, count);
        series("back_emf", unlike);
        static const int ODD[] = {1, 5, 7, 11, 13, 17};
        for (k = 0; k < 6; ++k)
            takes_power("back_emf", k, 1,
                        (named){wave[0], 1, ODD[k], 1.0, 2.0 * ODD[k] / 30.0 * faded(1, ODD[k])});
        TEST_ASSERT_EQUAL_UINT64(6, count);
        series("reluctance", unlike);
        k = 0;
        for (int n = 0; n <= 18; n += 6) {
            const double unit = faded(2, n) / (0.75 * 400.0);
            if (n > 0 || !unlike) takes_power("reluctance", k++, 2, (named){wave[1], 1, n, 1.0, unit});
            if (n > 0 || unlike) takes_power("reluctance", k++, 2, (named){wave[2], 1, n, 1.0, 0.5 * unit});
            if (n > 0) takes_power("reluctance", k++, 2, (named){wave[3], 1, n, 1.0, unit});
        }
        TEST_ASSERT_EQUAL_UINT64(k, count);
        series("saturation", unlike);
        k = 0;
        for (int degree = 3; degree <= 4; ++degree)
            for (int b = 0; b <= degree; ++b) {
                const bool cosine = (b % 2 == 0) != unlike;
                for (int n = cosine ? 0 : 6; n <= 18; n += 6)
                    takes_power("saturation", k++, degree,
                                (named){power(name, degree - b, b, cosine), 1, n, 1.0, faded(degree, n)});
            }
        TEST_ASSERT_EQUAL_UINT64(k, count);
    }
}

/* Above the power of a series only what is the same at every angle. */
static void test_higher_powers_of_the_mean(void)
{
    char name[16];
    const hci_effect_coenergy_series plain = {2, 4, 18, 20.0, false, 0}, mean = {2, 4, 18, 20.0, false, 6};
    count = 0;
    hci_effect_type_find("saturation")->propose_coenergy(&plain, &TO);
    size_t k = count;
    count = 0;
    hci_effect_type_find("saturation")->propose_coenergy(&mean, &TO);
    for (int degree = 5; degree <= 6; ++degree)
        for (int b = 0; b <= degree; b += 2)
            takes_power("saturation", k++, degree,
                        (named){power(name, degree - b, b, true), 1, 0, 1.0, faded(degree, 0)});
    TEST_ASSERT_EQUAL_UINT64(k, count);
}

/* The highest order of a series is in it. */
static void test_ends_of_the_series(void)
{
    static const struct {
        const char *type;
        int order;
        size_t terms; /* up to it, and one order below */
        size_t terms_below;
    } END[] = {{"back_emf", 17, 6, 5}, {"back_emf", 7, 3, 2}, {"back_emf", 1, 1, 0}, {"cogging", 12, 2, 1}};
    for (size_t k = 0; k < sizeof END / sizeof *END; ++k)
        for (int below = 0; below < 2; ++below) {
            const hci_effect_coenergy_series x = {2, 4, END[k].order - below, 20.0, false, 0};
            count = 0;
            hci_effect_type_find(END[k].type)->propose_coenergy(&x, &TO);
            TEST_ASSERT_EQUAL_UINT64(below ? END[k].terms_below : END[k].terms, count);
        }
}

/* ---- friction at low speed ---- */

enum { MEANS = 12 };

/* Residuals by the speed, of friction with an excess that fades, and what is named of it. */
static void stribeck(double excess_Nm, double of, double last, const hci_effect_candidate **named_first)
{
    hci_effect_speed_mean mean[MEANS];
    hci_effect_survey s = recordings();
    for (int k = 0; k < MEANS; ++k) {
        const double w = (k % 2 ? -1.0 : 1.0) * pow(last, (k / 2) / 5.0), sign = w > 0.0 ? 1.0 : -1.0;
        mean[k] = (hci_effect_speed_mean){
            w, 0.02 - sign * (0.1 + excess_Nm * exp(-w * w / (of * of))) - 2e-3 * w, 1e8};
    }
    s.of_speed = mean;
    s.of_speeds = MEANS;
    count = 0;
    hci_effect_type_find("stribeck_friction")->propose(&s, &TO);
    *named_first = count == 1 ? &taken[0] : NULL;
}

/* What grows with the square of the speed is no excess that fades, beside some hundredths of one that noise
 * makes. */
static void test_a_fan_does_not_fade(void)
{
    hci_effect_speed_mean mean[MEANS];
    hci_effect_survey s = recordings();
    for (int k = 0; k < MEANS; ++k) {
        const double w = (k % 2 ? -1.0 : 1.0) * pow(100.0, (k / 2) / 5.0), sign = w > 0.0 ? 1.0 : -1.0;
        mean[k] = (hci_effect_speed_mean){w, -sign * (0.1 + 2e-6 * w * w + 2e-5 * exp(-w * w / 64.0)), 1e8};
    }
    s.of_speed = mean;
    s.of_speeds = MEANS;
    proposes("stribeck_friction", &s, 0, NULL);
}

static double start[2];

static void take_start(void *context, const hci_effect_candidate *candidate)
{
    take(context, candidate);
    memcpy(start, candidate->start, sizeof start); /* of no use after this call */
}

static void test_friction_that_fades(void)
{
    const hci_effect_proposals with_start = {take_start, &count};
    hci_effect_speed_mean mean[MEANS];
    const hci_effect_candidate *one;
    stribeck(0.05, 8.0, 100.0, &one);
    TEST_ASSERT_NOT_NULL(one);
    takes("stribeck_friction", 0, (named){"excess", 2, 0.0, 16.0, 0.0});
    stribeck(0.0, 8.0, 100.0, &one); /* none */
    TEST_ASSERT_NULL(one);
    stribeck(0.05, 8.0, 3.0, &one); /* a range of less than four */
    TEST_ASSERT_NULL(one);
    stribeck(2e-5, 8.0, 100.0, &one); /* some hundredths of what is known */
    TEST_ASSERT_NULL(one);
    /* of a row of 16 speeds, a factor of 1.36 apart, the nearest */
    hci_effect_survey s = recordings();
    for (int k = 0; k < MEANS; ++k) {
        const double w = (k % 2 ? -1.0 : 1.0) * pow(100.0, (k / 2) / 5.0), sign = w > 0.0 ? 1.0 : -1.0;
        mean[k] = (hci_effect_speed_mean){w, -sign * 0.05 * exp(-w * w / 64.0), 1e8};
    }
    s.of_speed = mean;
    s.of_speeds = MEANS;
    count = 0;
    hci_effect_type_find("stribeck_friction")->propose(&s, &with_start);
    TEST_ASSERT_EQUAL_UINT64(1, count);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, start[0]);
    TEST_ASSERT_TRUE(fabs(log(start[1] / 8.0)) <= 0.5 * log(100.0) / 15.0 + 0.02);
    /* the row goes from 0.7 times the slowest speed to 0.7 times the fastest one */
    for (int fast = 0; fast < 2; ++fast) {
        const double of = fast ? 66.0 : 0.6;
        for (int k = 0; k < MEANS; ++k) {
            const double w = mean[k].speed_rad_per_s, sign = w > 0.0 ? 1.0 : -1.0;
            mean[k].residual_Nm = -sign * 0.05 * exp(-w * w / (of * of));
        }
        count = 0;
        hci_effect_type_find("stribeck_friction")->propose(&s, &with_start);
        TEST_ASSERT_EQUAL_UINT64(1, count);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, fast ? 70.0 : 0.7, start[1]);
    }
    static const double ALIKE[MEANS] = {2.0,  -2.0,  2.1,  -2.1,  20.0, -20.0,
                                        21.0, -21.0, 60.0, -60.0, 62.0, -62.0};
    for (int last = 0; last < 2; ++last) { /* three speeds within 10 %; with another one four */
        for (int k = 0; k < MEANS; ++k) {
            const double w = last && k > 9 ? 1.5 * ALIKE[k] : ALIKE[k], sign = w > 0.0 ? 1.0 : -1.0;
            mean[k] = (hci_effect_speed_mean){w, -sign * 0.05 * exp(-w * w / 64.0), 1e8};
        }
        count = 0;
        hci_effect_type_find("stribeck_friction")->propose(&s, &with_start);
        TEST_ASSERT_EQUAL_UINT64((size_t)last, count);
    }
    s.of_speeds = 6; /* three speeds only */
    count = 0;
    hci_effect_type_find("stribeck_friction")->propose(&s, &with_start);
    TEST_ASSERT_EQUAL_UINT64(0, count);
}

/* Of a shaft that turns one way only the zero of the sensor and the Coulomb friction are one and the same. */
static void test_friction_that_fades_seen_from_one_side(void)
{
    hci_effect_speed_mean mean[MEANS];
    hci_effect_survey s = recordings();
    for (int k = 0; k < MEANS; ++k) {
        const double w = pow(100.0, k / 11.0);
        mean[k] = (hci_effect_speed_mean){w, -0.05 * exp(-w * w / 64.0), 1e8};
    }
    s.of_speed = mean;
    s.of_speeds = MEANS;
    proposes("stribeck_friction", &s, 1, (named[]){{"excess", 2, 0.0, 16.0, 0.0}});
}

/* ---- motors of one make ---- */

static void alike(const char *type, named x)
{
    count = 0;
    hci_effect_type_find(type)->propose_alike(&MACHINE, NAN, &TO);
    takes(type, 0, x);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(strcmp(type, "phase_imbalance") ? 1 : 3, count, type);
}

static void test_what_motors_of_one_make_differ_in(void)
{
    alike("friction", (named){"coulomb", 2, 0.0, 1.0, 0.0});
    alike("position_offset", (named){"angle", 1, 0.0, 1.0, 0.1});
    alike("current_offset", (named){"a", 2, 0.0, 1.0, 0.0});
    alike("torque_sensor", (named){"offset", 1, 0.0, 1.0, 0.0});
    alike("phase_imbalance", (named){"a", 1, 0.0, 3.0, 0.2});
}

static void test_words_of_a_status(void)
{
    TEST_ASSERT_EQUAL(0, hci_status_exit_code(HCI_OK));
    TEST_ASSERT_TRUE(strlen(hci_status_text(HCI_ERROR_MEMORY)) > 0);
    TEST_ASSERT_EQUAL_STRING("unknown status", hci_status_text((hci_status)99));
    TEST_ASSERT_EQUAL(4, hci_status_exit_code((hci_status)99));
}

/* The speed that is named for an excess that fades with `of`, at speeds up to 100 times the unit, forward and
 * back; 0: none. */
static double stribeck_speed(double of, double unit)
{
    const hci_effect_proposals with_start = {take_start, &count};
    hci_effect_speed_mean mean[MEANS + 1] = {{0.0, 0.0, 1e8}}; /* a run at rest tells nothing of it */
    hci_effect_survey s = recordings();
    for (int k = 0; k < MEANS; ++k) {
        const double w = (k % 2 ? -unit : unit) * pow(100.0, (k / 2) / 5.0), sign = w > 0.0 ? 1.0 : -1.0;
        mean[k + 1] = (hci_effect_speed_mean){w, -sign * 0.05 * exp(-w * w / (of * of)), 1e8};
    }
    s.of_speed = mean;
    s.of_speeds = MEANS + 1;
    count = 0;
    hci_effect_type_find("stribeck_friction")->propose(&s, &with_start);
    return count == 1 ? start[1] : 0.0;
}

/* Whatever speeds are counted in, and up to next to the fastest. */
static void test_the_speed_at_which_friction_fades(void)
{
    const double half_a_step = 0.5 * log(100.0) / 15.0 + 0.02;
    for (double of = 2.0; of < 71.0; of *= 1.6)
        TEST_ASSERT_DOUBLE_WITHIN(half_a_step, log(of), log(stribeck_speed(of, 1.0)));
    TEST_ASSERT_DOUBLE_WITHIN(half_a_step, log(70.0), log(stribeck_speed(70.0, 1.0)));
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * 8e-5, 1e-5 * stribeck_speed(8.0, 1.0), stribeck_speed(8e-5, 1e-5));
}

/* Poles that are not alike show in the declared back-EMF, wherever the even order stands. */
static void test_even_orders_of_a_back_emf(void)
{
    const hci_wave wave[] = {{1.0, 1, 0.5, 0.0}, {2.0, -1, 0.01, 0.0}, {1.0, 1, 0.5, 0.0}};
    size_t proposed[3];
    for (int k = 0; k < 3; ++k) { /* none, behind, before */
        const hci_machine machine = {
            .pole_pairs = 3, .back_emf = wave + (k == 2), .back_emf_count = k ? 2 : 1};
        hci_effect_survey s = recordings();
        s.machine = &machine;
        count = 0;
        hci_effect_type_find("back_emf")->propose(&s, &TO);
        proposed[k] = count;
    }
    TEST_ASSERT_TRUE(proposed[1] > proposed[0]);
    TEST_ASSERT_EQUAL_UINT64(proposed[1], proposed[2]);
}

/* A motor of a hundredth of the flux has harmonics of a hundredth. */
static void test_a_back_emf_is_expected_in_proportion(void)
{
    static double usual[MOST];
    hci_wave wave = {1.0, 1, 0.5, 0.0};
    const hci_machine machine = {.pole_pairs = 3, .back_emf = &wave, .back_emf_count = 1};
    hci_effect_survey s = recordings();
    s.machine = &machine;
    hci_effect_type_find("back_emf")->propose(&s, &TO);
    const size_t proposed = count;
    TEST_ASSERT_TRUE(proposed > 10);
    for (size_t k = 0; k < proposed; ++k)
        usual[k] = taken[k].expected;
    wave.sine = 0.005;
    count = 0;
    hci_effect_type_find("back_emf")->propose(&s, &TO);
    TEST_ASSERT_EQUAL_UINT64(proposed, count);
    for (size_t k = 0; k < count; ++k)
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.01 * usual[k], taken[k].expected);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_cogging_of_one_make);
    RUN_TEST(test_magnets_of_one_make);
    RUN_TEST(test_what_recordings_ask_for);
    RUN_TEST(test_an_encoder_between_its_lines);
    RUN_TEST(test_what_each_effect_names);
    RUN_TEST(test_what_cannot_be_seen);
    RUN_TEST(test_harmonics_of_the_back_emf);
    RUN_TEST(test_orders_of_reluctance);
    RUN_TEST(test_a_saliency_without_an_i_d);
    RUN_TEST(test_powers_of_saturation);
    RUN_TEST(test_means_without_an_i_d);
    RUN_TEST(test_inductances_without_an_i_d);
    RUN_TEST(test_a_mean_of_one_sign);
    RUN_TEST(test_series_of_the_coenergy);
    RUN_TEST(test_higher_powers_of_the_mean);
    RUN_TEST(test_ends_of_the_series);
    RUN_TEST(test_a_fan_does_not_fade);
    RUN_TEST(test_friction_that_fades);
    RUN_TEST(test_friction_that_fades_seen_from_one_side);
    RUN_TEST(test_the_speed_at_which_friction_fades);
    RUN_TEST(test_even_orders_of_a_back_emf);
    RUN_TEST(test_a_back_emf_is_expected_in_proportion);
    RUN_TEST(test_what_motors_of_one_make_differ_in);
    RUN_TEST(test_words_of_a_status);
    return UNITY_END();
}
