/* Results in memory, against the files of the same results; and work that is asked to stop. */
#include "hci/host/samples/samples.h"

#include "support/simulating.h"
#include "support/texts.h"

void setUp(void)
{
    drives_start();
}

void tearDown(void)
{
    drives_end();
}

/* Every column of a file that samples have too; returns how many. */
static size_t compare_with(const char *path, const hci_samples *samples)
{
    char names[HCI_SAMPLES_COLUMNS];
    size_t compared = 0, place = 0, rows;
    hci_csv *csv;
    hci_note note = {{0}};
    snprintf(names, sizeof names, "%s", samples->columns);
    for (char *name = strtok(names, ","); name; name = strtok(NULL, ","), ++place) {
        TEST_ASSERT_EQUAL(HCI_OK, hci_csv_read(files_path(path), &csv, &note));
        const bool there = hci_csv_has(csv, name);
        hci_csv_free(csv);
        if (!there) continue;
        double *value = column(path, name, &rows);
        TEST_ASSERT_EQUAL(rows, samples->rows);
        for (size_t k = 0; k < rows; ++k)
            TEST_ASSERT_EQUAL_MEMORY(&value[k], &samples->value[k * samples->width + place], sizeof *value);
        free(value);
        ++compared;
    }
    TEST_ASSERT_EQUAL(place, samples->width);
    return compared;
}

static void test_a_solution(void)
{
    hci_solution s = solve(&machine_a, "data/scenarios/02/target.csv", HCI_METHOD_AUTO, HCI_STRATEGY_MTPA);
    hci_samples samples;
    char words[1536];
    double before_Nm = 0.0, wanted_Nm = 0.0;
    TEST_ASSERT_EQUAL(HCI_OK, hci_solution_samples(&machine_a, &s, &samples, NULL));
    TEST_ASSERT_EQUAL(7, compare_with("solution/waveform.csv", &samples));
    text_has(",torque_before_Nm,torque_wanted_Nm,ia_plain_A", samples.columns);
    for (size_t k = 0; k < samples.rows; ++k) {
        before_Nm += samples.value[k * samples.width + 7] / (double)samples.rows;
        wanted_Nm += samples.value[k * samples.width + 8] / (double)samples.rows;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, s.wanted_mean_Nm, before_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, s.wanted_mean_Nm, wanted_Nm);
    hci_solution_words(&s, words, sizeof words);
    text_has("Reached: every torque order", words);
    text_has("\nmean torque 2.463 N·m", words);
    text_has("\nBefore: a plain sine of", words);
    hci_samples_release(&samples);
    hci_solution_release(&s);
}

#define DRIVE                                                                                                \
    "duration,0.02,s\nprescribed_speed,100,rad_per_s\ntorque_reference,2,Nm\ncurrent_control,pi,\n"          \
    "encoder_counts,4096,1\ntrajectory_every,7,\n"

static void test_a_simulation(void)
{
    const hci_scenario scenario = scenario_of(DRIVE);
    const hci_simulate_options options = {0};
    hci_simulation of_file = simulate_into(&machine_c, &scenario, files_path("drive")), of_memory;
    hci_samples trajectory;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_simulate_samples(&machine_c, &scenario, &options, &trajectory, &of_memory, &note),
        note.text);
    TEST_ASSERT_TRUE(compare_with("drive/trajectory.csv", &trajectory) > 15);
    TEST_ASSERT_EQUAL_MEMORY(&of_file.torque_Nm, &of_memory.torque_Nm, sizeof of_file.torque_Nm);
    hci_samples_release(&trajectory);
    hci_simulation_release(&of_file);
    hci_simulation_release(&of_memory);
}

/* ---- stopping ---- */

static bool stop_soon(void *context)
{
    int *left = context;
    return --*left < 0;
}

static void test_a_simulation_stops(void)
{
    const hci_scenario scenario = scenario_of(DRIVE);
    int left = 3;
    const hci_simulate_options options = {.stop = stop_soon, .stop_context = &left};
    hci_simulation s;
    hci_samples trajectory;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_ERROR_STOPPED,
                      hci_simulate_samples(&machine_c, &scenario, &options, &trajectory, &s, &note));
    TEST_ASSERT_EQUAL(-1, left);
    text_has("the simulation was stopped at 0.000", note.text);
    TEST_ASSERT_NULL(trajectory.value);
    TEST_ASSERT_NULL(s.spectrum_Nm);
}

/* Stops after `asked` answers; returns whether it was asked so often. */
static bool stops(const hci_machine_data *machine, hci_solve_options options, int asked)
{
    hci_target target;
    hci_solution s;
    hci_note note = {{0}};
    int left = asked;
    TEST_ASSERT_EQUAL(HCI_OK, hci_target_read("data/scenarios/02/target.csv", &target, &note));
    options.target = &target;
    options.stop = stop_soon;
    options.stop_context = &left;
    const hci_status status = hci_solve(machine, &options, &s, &note);
    if (left < 0) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_STOPPED, status, note.text);
        text_has("was stopped", note.text);
    }
    hci_target_release(&target);
    hci_solution_release(&s);
    return left < 0;
}

static void test_solving_stops_wherever_it_is(void)
{
    const hci_solve_options few = {.choose_at_most = 4}, all = {0},
                            pointwise = {.method = HCI_METHOD_POINTWISE}, limited = {.limit_current_A = 9.0};
    int asked = 0;
    while (stops(&machine_a, few, asked))
        asked += 1 + asked / 2;
    TEST_ASSERT_TRUE(asked > 4);
    TEST_ASSERT_TRUE(stops(&machine_a, all, 0));
    TEST_ASSERT_TRUE(stops(&machine_a, limited, 2));
    TEST_ASSERT_TRUE(stops(&machine_c, pointwise, 100));
    TEST_ASSERT_TRUE(stops(&machine_c, all, 2));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_solution);
    RUN_TEST(test_a_simulation);
    RUN_TEST(test_a_simulation_stops);
    RUN_TEST(test_solving_stops_wherever_it_is);
    return UNITY_END();
}
