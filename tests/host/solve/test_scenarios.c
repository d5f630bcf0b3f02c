/* Machine A and the twelve published scenarios in data/: what the published sets can do, and what a free
 * choice of components does better. Torque, copper and the pointwise limit are sampled here; the library
 * gives the currents. */
#include "hci/host/solve/solve.h"

#include <stdio.h>
#include <string.h>

#include "support/sampled.h"
#include "unity.h"

/* 4096 samples of one electrical turn: orders up to 2047, far above any current order (asserted) plus 13. */
enum { SCENARIOS = 12, SAMPLES = 4096, BINS = 160, PLAIN_COPPER_A2 = 216 /* 1.5·12² */ };

/* The scenarios for which a choice of few components is tested, and in how many of them it has to be within 1
 * % of the mean; test_scenarios_at_length has all. */
#ifdef AT_LENGTH
enum { FIRST = 1, STRIDE = 1, WITHIN = 9 };
#else
enum { FIRST = 4, STRIDE = 5, WITHIN = 2 };
#endif

/* Machine A as printed (Tables 4 and 5): peak volts at 50 Hz electrical over ω_m = 2π·50/2 rad/s. */
static const ref_wave EMF_V[] = {{1.0, 0.0, 21.93, 0.0},
                                 {5.0, 0.0, -5.02, 0.0},
                                 {7.0, 0.0, 4.80, 0.0},
                                 {11.0, 0.0, -8.10, 0.0},
                                 {13.0, 0.0, -1.61, 0.0}};
static const ref_wave COGGING_NM[] = {{6.0, 0.0, 0.0021, 1.22},   {12.0, 0.0, 0.3102, 1.76},
                                      {18.0, 0.0, 0.0031, -1.57}, {24.0, 0.0, 0.3702, -1.19},
                                      {30.0, 0.0, 0.0011, 1.88},  {36.0, 0.0, 0.2470, 2.15}};
enum { EMF = sizeof EMF_V / sizeof EMF_V[0], COGGING = sizeof COGGING_NM / sizeof COGGING_NM[0] };

static hci_machine_data machine;
static hci_target target;
static hci_component_set published;
static size_t published_rows; /* of the file, repeats counted */
static hci_wave fundamental;  /* 12 A, 0.2 rad */
static double wanted[SAMPLED_MOST], mean_Nm;
static sampled samples;

void setUp(void)
{
}

void tearDown(void)
{
}

/* ---- a scenario
 * ------------------------------------------------------------------------------------------------ */

static void path_of(int scenario, const char *name, char path[64])
{
    snprintf(path, 64, "data/scenarios/%02d/%s.csv", scenario, name);
}

static size_t rows_of(const char *path)
{
    char line[256];
    size_t rows = 0;
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    while (fgets(line, sizeof line, file) != NULL)
        rows += line[0] != '#' && line[0] != '\n';
    fclose(file);
    return rows - 1;
}

static void sample_machine(void)
{
    ref_wave emf[EMF];
    for (size_t k = 0; k < EMF; ++k) {
        emf[k] = EMF_V[k];
        emf[k].amplitude /= 2.0 * REF_PI * 50.0 / 2.0;
    }
    sampled_machine(&samples, 1, SAMPLES, emf, EMF, COGGING_NM, COGGING);
}

static void load(int scenario)
{
    char path[64];
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read("data/machine_a", &machine, &note), note.text);
    path_of(scenario, "target", path);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read(path, &target, &note), note.text);
    path_of(scenario, "harmonics", path);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_component_set_read(path, false, &published, &note), note.text);
    published_rows = rows_of(path);
    fundamental = hci_wave_polar(1.0, 1, 12.0, 0.2);
    memset(wanted, 0, sizeof wanted);
    for (size_t k = 0; k < target.count; ++k)
        sampled_add(&samples, target.order[k].torque_Nm.order, target.order[k].torque_Nm.sine,
                    target.order[k].torque_Nm.cosine, 0.0, wanted);
    mean_Nm = target.order[0].torque_Nm.cosine;
}

static void unload(void)
{
    hci_machine_release(&machine);
    hci_target_release(&target);
    hci_component_set_release(&published);
}

static hci_status solve(const hci_component_set *set, const hci_wave *held, size_t at_most,
                        hci_solution *solution)
{
    hci_note note = {{0}};
    hci_solve_options options = {0};
    hci_status status;
    options.target = &target;
    options.set = set;
    options.held = held;
    options.choose_at_most = at_most;
    status = hci_solve(&machine, &options, solution, &note);
    TEST_ASSERT_TRUE_MESSAGE(status == HCI_OK || status == HCI_NOT_REACHED, note.text);
    return status;
}

/* ---- evaluated by samples
 * ----------------------------------------------------------------------------------------- */

/* Worst |torque − target| of any order as a share of the mean torque, and copper over that of the 12 A sine.
 */
typedef struct {
    double worst, worst_target, copper, top_order;
} sampled_result;

static bool is_wanted(size_t bin)
{
    for (size_t k = 0; k < target.count; ++k)
        if (sampled_bin(&samples, target.order[k].torque_Nm.order) == bin) return true;
    return false;
}

/* bins: how many orders are looked at one by one; what is above must be within `worst` by its energy. */
static sampled_result evaluate_by_samples(const hci_solution *s)
{
    sampled_result j = {0.0, 0.0, 0.0, 0.0};
    double energy = 0.0;
    for (size_t k = 0; k < s->current.count; ++k)
        j.top_order = fmax(j.top_order, s->current.wave[k].order);
    TEST_ASSERT_TRUE(j.top_order + 13.0 < SAMPLES / 2);
    sampled_currents(&samples, s->current.wave, s->current.count, 1);
    j.copper = sampled_mean_square(&samples) / PLAIN_COPPER_A2;
    for (size_t k = 0; k < samples.count; ++k) {
        samples.torque[k] -= wanted[k];
        energy += samples.torque[k] * samples.torque[k] / SAMPLES;
    }
    sampled_spectrum(&samples, BINS);
    for (size_t m = 0; m < BINS; ++m) {
        const double error = hypot(samples.sine[m], samples.cosine[m]);
        energy -= (m == 0 ? 1.0 : 0.5) * error * error;
        j.worst = ref_worse(j.worst, error / mean_Nm);
        if (is_wanted(m)) j.worst_target = ref_worse(j.worst_target, error / mean_Nm);
    }
    j.worst = ref_worse(j.worst, sqrt(fmax(0.0, 2.0 * energy)) / mean_Nm);
    return j;
}

static double limit(void)
{
    return sampled_limit(&samples, wanted, 0) / PLAIN_COPPER_A2;
}

/* ---- the published sets
 * ---------------------------------------------------------------------------------------- */

/* The spectrum is told as the samples show it, and at most orders that the set cannot reach are called so. */
static void test_published_sets(void)
{
    for (int k = 1; k <= SCENARIOS; ++k) {
        hci_solution s;
        load(k);
        solve(&published, &fundamental, 0, &s);
        const sampled_result j = evaluate_by_samples(&s);
        TEST_ASSERT_EQUAL_UINT64(2 * published.count, s.unknowns);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, j.worst, s.worst_error_Nm / mean_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, j.copper, s.loss_to_plain); /* the 12 A sine is what is held */
        for (size_t q = 0; q < s.order_count && k > 1; ++q)
            TEST_ASSERT_EQUAL_INT(k == 7 && s.order[q].torque_Nm.order == 5.0,
                                  s.order[q].verdict == HCI_ORDER_UNREACHABLE);
        hci_solution_release(&s);
        unload();
    }
}

/* An empty set: the machine as it is, every order but the mean out of reach. */
static void test_the_first_scenario_is_the_plain_sine(void)
{
    hci_solution s;
    size_t out_of_reach = 0;
    load(1);
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, solve(&published, &fundamental, 0, &s));
    TEST_ASSERT_EQUAL_UINT64(0, s.unknowns);
    TEST_ASSERT_EQUAL_UINT64(0, s.rank);
    TEST_ASSERT_EQUAL_UINT64(1, s.current.count);
    for (size_t q = 0; q < s.order_count; ++q)
        out_of_reach += s.order[q].verdict == HCI_ORDER_UNREACHABLE;
    TEST_ASSERT_EQUAL_UINT64(6, out_of_reach); /* 6, 12, … 36 */
    TEST_ASSERT_EQUAL_INT(HCI_ORDER_REACHED, s.order[0].verdict);
    hci_solution_release(&s);
    unload();
}

/* 24 unknowns: 21 independent with the mean among the equations, 20 without. */
static void test_rank_of_the_second_scenario(void)
{
    hci_solution s;
    load(2);
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&published, &fundamental, 0, &s));
    TEST_ASSERT_EQUAL_UINT64(24, s.unknowns);
    TEST_ASSERT_EQUAL_UINT64(21, s.rank);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.46, s.loss_to_plain); /* theory.md gives 1.46 */
    hci_solution_release(&s);
    target.order[0].weight = 0.0;
    TEST_ASSERT_EQUAL_INT(HCI_OK, solve(&published, &fundamental, 0, &s));
    TEST_ASSERT_EQUAL_UINT64(20, s.rank);
    hci_solution_release(&s);
    unload();
}

static void test_the_seventh_scenario_and_its_remedy(void)
{
    hci_solution s;
    hci_component component[16];
    hci_component_set more = {component, NULL, 0, {{0}}};
    hci_set set[16];
    load(7);
    solve(&published, &fundamental, 0, &s);
    for (size_t q = 0; q < s.order_count; ++q)
        if (s.order[q].verdict == HCI_ORDER_UNREACHABLE) component[published.count] = s.order[q].remedy;
    TEST_ASSERT_EQUAL_DOUBLE(4.0, component[published.count].order);
    TEST_ASSERT_EQUAL_INT(-1, component[published.count].sequence);
    hci_solution_release(&s);
    memcpy(component, published.component, published.count * sizeof *component);
    memcpy(set, published.set, published.count * sizeof *set);
    set[published.count] = HCI_SET_NEG;
    more.count = published.count + 1;
    more.set = set;
    solve(&more, &fundamental, 0, &s);
    for (size_t q = 0; q < s.order_count; ++q)
        TEST_ASSERT_TRUE(s.order[q].verdict != HCI_ORDER_UNREACHABLE);
    hci_solution_release(&s);
    unload();
}

/* ---- a free choice
 * --------------------------------------------------------------------------------------------- */

/* 1.303 is theory.md's figure, given to four digits. */
static void test_limit_of_the_second_scenario(void)
{
    hci_solution s;
    load(2);
    solve(&published, &fundamental, 0, &s);
    TEST_ASSERT_DOUBLE_WITHIN(0.0005, 1.303, limit());
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, limit(), s.limit_mean_square_A2 / PLAIN_COPPER_A2);
    hci_solution_release(&s);
    unload();
}

static void test_auto(void)
{
    for (int k = 1; k <= SCENARIOS; ++k) {
        hci_solution s;
        load(k);
        const double least = limit();
        TEST_ASSERT_EQUAL_INT(HCI_OK, solve(NULL, NULL, 0, &s));
        const sampled_result j = evaluate_by_samples(&s);
        TEST_ASSERT_TRUE(j.worst <= 1e-6);
        TEST_ASSERT_TRUE(j.copper <= 1.05 * least && j.copper >= (1.0 - 1e-4) * least);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, least, s.limit_mean_square_A2 / PLAIN_COPPER_A2);
        hci_solution_release(&s);
        unload();
    }
}

/* As many components as the published file has rows, and the fundamental, which it holds. Of all twelve at
 * least nine scenarios within 1 % of the mean at every order: 2 to 5 and 8 to 12 were so when this was
 * written; 1 has one component alone, 6 and 7 have 13 for two systems of orders. Where the published set
 * reaches its target orders (within 1 % of the mean), it does not pay less copper; its copper elsewhere is
 * that of another torque. */
static void test_auto_at_most(void)
{
    int within = 0;
    puts("scenario  K  worst order: published   ours     copper: published   ours  limit");
    for (int k = FIRST; k <= SCENARIOS; k += STRIDE) {
        hci_solution paper, ours;
        load(k);
        const double least = limit();
        const size_t most = published_rows + 1;
        solve(&published, &fundamental, 0, &paper);
        solve(NULL, NULL, most, &ours);
        const sampled_result p = evaluate_by_samples(&paper), o = evaluate_by_samples(&ours);
        printf("%8d %2zu %20.4f %% %8.4f %% %15.3f %8.3f %6.3f\n", k, most, 100.0 * p.worst, 100.0 * o.worst,
               p.copper, o.copper, least);
        within += o.worst <= 0.01;
        TEST_ASSERT_TRUE(ours.current.count <= most);
        TEST_ASSERT_TRUE(o.copper <= 1.1 * least); /* the allowance */
        TEST_ASSERT_TRUE(fabs(samples.cosine[0]) <=
                         0.1 * o.worst * mean_Nm + 1e-9); /* the mean is not traded away */
        TEST_ASSERT_TRUE(o.worst <= p.worst + 1e-6);
        if (p.worst_target <= 0.01) {
            TEST_ASSERT_TRUE(o.copper <= p.copper);
        }
        hci_solution_release(&paper);
        hci_solution_release(&ours);
        unload();
    }
    TEST_ASSERT_TRUE(within >= WITHIN);
}

int main(void)
{
    UNITY_BEGIN();
    sample_machine();
    RUN_TEST(test_published_sets);
    RUN_TEST(test_the_first_scenario_is_the_plain_sine);
    RUN_TEST(test_rank_of_the_second_scenario);
    RUN_TEST(test_the_seventh_scenario_and_its_remedy);
    RUN_TEST(test_limit_of_the_second_scenario);
    RUN_TEST(test_auto);
    RUN_TEST(test_auto_at_most);
    return UNITY_END();
}
