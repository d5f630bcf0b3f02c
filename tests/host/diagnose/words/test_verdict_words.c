/* What the words say of what is left: causes only where they were looked for and found. */
#include <math.h>
#include <string.h>

#include "hci/host/diagnose/diagnose.h"
#include "unity.h"

static hci_diagnosis d;
static char text[2048];

void setUp(void)
{
    memset(&d, 0, sizeof d);
    d.verdict = HCI_DIAGNOSIS_UNKNOWN;
    d.means_open = d.means_alone = true;
    d.holdout_after_Nm = NAN;
}

void tearDown(void)
{
}

static bool says(const char *words)
{
    hci_diagnosis_words(&d, text, sizeof text);
    return strstr(text, words) != NULL;
}

static void test_means_that_are_off_alone(void)
{
    TEST_ASSERT_TRUE(says("the zero of a sensor is another one each time"));
    TEST_ASSERT_TRUE(says("No known effect explains"));
}

/* A ripple is left too: what the means are off by may be the same. */
static void test_means_beside_a_ripple(void)
{
    d.means_alone = false;
    TEST_ASSERT_FALSE(says("the zero of a sensor"));
    TEST_ASSERT_TRUE(says("says nothing of a run left out"));
}

static void test_an_unfinished_search_gives_no_causes(void)
{
    d.search = HCI_WORK_LIMITED;
    d.further_work = 16.0;
    d.wanders = d.contradicted = true;
    d.disbelieved = "back_emf";
    TEST_ASSERT_TRUE(says("is not known yet"));
    TEST_ASSERT_TRUE(says("it gets further with --work 16"));
    TEST_ASSERT_FALSE(says("No known effect"));
    TEST_ASSERT_FALSE(says("The mean of each run"));
    TEST_ASSERT_FALSE(says("does not repeat"));
    TEST_ASSERT_FALSE(says("not plausible"));
}

static void test_what_runs_without_a_current_show(void)
{
    d.verdict = HCI_DIAGNOSIS_PARTLY;
    d.finding[0] = (hci_finding){.effect = "friction", .verdict = HCI_FINDING_ADDED};
    d.findings = 1;
    TEST_ASSERT_FALSE(says("without a current"));
    d.no_load_alone = true;
    TEST_ASSERT_TRUE(
        says("the model lacked friction, which the runs without a current show by themselves; what else"));
    TEST_ASSERT_FALSE(says("Under load"));
    d.holdout_before_Nm = 0.03;
    d.holdout_after_Nm = 0.04;
    TEST_ASSERT_TRUE(says("Under load that does not hold by itself"));
    d.holdout_after_Nm = 0.0301;
    TEST_ASSERT_FALSE(says("Under load"));
}

/* Terms of the iron that were chosen with others and that no recording misses are not what the model lacked.
 */
static void test_parts_of_a_whole(void)
{
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    d.finding[0] = (hci_finding){"saturation", HCI_FINDING_ADDED, 1900.0, 9, 9, 0.9, ""};
    d.finding[1] = (hci_finding){"back_emf", HCI_FINDING_ADDED, -77.0, 0, 9, 0.01, ""};
    d.finding[2] = (hci_finding){"reluctance", HCI_FINDING_ADDED, -105.0, 0, 9, 0.01, ""};
    d.findings = 3;
    TEST_ASSERT_TRUE(says(
        "The model lacked saturation. Terms of back-EMF and reluctance torque stand in the machine too"));
    TEST_ASSERT_FALSE(says("0 of 9"));
    d.finding[1].stays = 6; /* enough */
    TEST_ASSERT_TRUE(says("The model lacked saturation and back-EMF. Terms of reluctance torque stand"));
    d.finding[2].delta_bic = 400.0; /* on evidence of its own */
    TEST_ASSERT_TRUE(says("The model lacked saturation, back-EMF and reluctance torque."));
    TEST_ASSERT_TRUE(says("reluctance torque is found in 0 of 9"));
}

/* Nothing else is there that it is a part of. */
static void test_a_part_of_nothing(void)
{
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    d.finding[0] = (hci_finding){"saturation", HCI_FINDING_ADDED, -131.0, 0, 8, 0.9, ""};
    d.findings = 1;
    TEST_ASSERT_TRUE(says("The model lacked saturation."));
    TEST_ASSERT_TRUE(says("saturation is found in 0 of 8"));
}

static void test_zeros_of_sensors(void)
{
    hci_run_errors run[7] = {{0}};
    d.run = run;
    d.runs = 7;
    TEST_ASSERT_FALSE(says("zeros of the sensors"));
    d.zeros_read = 3;
    d.zeros_read_A = 0.123;
    TEST_ASSERT_TRUE(says("In 3 of 7 runs what was read as current, up to 0.12 A, stands still"));
}

static void test_what_was_not_looked_for(void)
{
    TEST_ASSERT_FALSE(says("Direct current"));
    d.magnetic_only = true;
    TEST_ASSERT_TRUE(says("these were not looked for"));
}

/* What is decisive and was not taken is said, in the order of its evidence; nothing else is. */
static void test_what_is_decisive_and_not_taken(void)
{
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    d.finding[0] = (hci_finding){.effect = "friction", .verdict = HCI_FINDING_ADDED, .delta_bic = 4e5};
    d.finding[1] = (hci_finding){.effect = "unknown", .verdict = HCI_FINDING_REJECTED, .delta_bic = 3e4};
    d.finding[2] =
        (hci_finding){.effect = "mechanical_order", .verdict = HCI_FINDING_REJECTED, .delta_bic = 13602.0};
    d.finding[3] = (hci_finding){.effect = "cogging", .verdict = HCI_FINDING_REJECTED, .delta_bic = 20.0};
    d.findings = 4;
    TEST_ASSERT_TRUE(
        says("Decisive by ΔBIC and not taken: orders of the mechanical turn (1.36e+04); what each"));
    d.finding[2].delta_bic = 30.0;
    TEST_ASSERT_FALSE(says("Decisive"));
}

/* Where the means of the runs are most of an error, no sign or unit is suspected. */
static void test_zeros_that_differ_are_no_units(void)
{
    hci_run_errors run[2] = {
        {.source = HCI_TORQUE_MEASURED, .rms_before_Nm = 0.1, .error_mean_before_Nm = 0.02},
        {.source = HCI_TORQUE_MEASURED, .rms_before_Nm = 0.1, .error_mean_before_Nm = -0.02}};
    d.run = run;
    d.runs = 2;
    d.disbelieved = "friction";
    d.disbelieved_share = 1.0;
    TEST_ASSERT_TRUE(says("signs, units, angle and motor"));
    run[0].error_mean_before_Nm = -0.09;
    run[1].error_mean_before_Nm = 0.09;
    TEST_ASSERT_FALSE(says("signs, units, angle and motor"));
    TEST_ASSERT_TRUE(says("zero of the torque sensor or the friction is another one from run to run"));
}

/* No zero of a torque sensor where none was read, nor any where what is left grows with the torque. */
static void test_what_makes_the_means_differ(void)
{
    hci_run_errors run[4] = {
        {.rms_before_Nm = 0.1}, {.rms_before_Nm = 0.1}, {.rms_before_Nm = 0.1}, {.rms_before_Nm = 0.1}};
    d.run = run;
    d.runs = 4;
    for (int k = 0; k < 4; ++k) {
        run[k].source = HCI_TORQUE_INERTIA;
        run[k].mean_torque_Nm = 0.2 * k;
        run[k].error_mean_after_Nm = k % 2 ? 0.03 : -0.03;
    }
    TEST_ASSERT_TRUE(says("a load or the friction is another one each time"));
    for (int k = 0; k < 4; ++k)
        run[k].error_mean_after_Nm = 0.02 * k + (k % 2 ? 1e-3 : -1e-3);
    TEST_ASSERT_TRUE(says("grows with the torque"));
    TEST_ASSERT_FALSE(says("zero of"));
}

/* Runs without a torque whose means are right have the zeros that the others have. */
static void test_means_that_are_right_without_a_torque(void)
{
    static const double LEFT_NM[] = {1e-4, -1e-4, 0.03, -0.005, 0.002, -0.04};
    hci_run_errors run[6];
    d.run = run;
    d.runs = 6;
    for (int k = 0; k < 6; ++k)
        run[k] = (hci_run_errors){.source = HCI_TORQUE_MEASURED,
                                  .rms_before_Nm = 0.1,
                                  .mean_torque_Nm = k < 2   ? 1e-3
                                                    : k % 2 ? -1.0
                                                            : 1.0,
                                  .error_mean_after_Nm = LEFT_NM[k]};
    TEST_ASSERT_TRUE(says("magnets whose temperature was not recorded"));
    TEST_ASSERT_FALSE(says("zero of a sensor is another one"));
    run[0].error_mean_after_Nm = 0.02;
    TEST_ASSERT_FALSE(says("magnets whose temperature"));
    TEST_ASSERT_TRUE(says("zero of a sensor is another one"));
}

static void test_a_limit_with_nothing_left(void)
{
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    d.search = HCI_WORK_LIMITED;
    d.further_work = 16.0;
    d.noise_Nm = 0.01;
    d.rms_after_Nm = 0.0105;
    TEST_ASSERT_TRUE(says("limit of its work: nothing but noise is left"));
    d.rms_after_Nm = 0.02;
    TEST_ASSERT_FALSE(says("nothing but noise is left"));
}

static void test_noise_as_large_as_the_torque(void)
{
    d.noise_Nm = d.rms_after_Nm = 3.2;
    d.drowned_Nm = 5.0;
    TEST_ASSERT_TRUE(says("Whether something is missing is not known"));
    TEST_ASSERT_TRUE(says("0.64 of the torque that matters (5 N·m)"));
    TEST_ASSERT_TRUE(says("only where it makes more than 0.16 N·m rms"));
    TEST_ASSERT_FALSE(says("No known effect"));
    hci_run_errors run[1] = {{.source = HCI_TORQUE_INERTIA}};
    d.run = run;
    d.runs = 1; /* of a slope, whose noise is fast */
    TEST_ASSERT_FALSE(says("only where it makes more than"));
    TEST_ASSERT_TRUE(says("nor one that varies more slowly than this noise of a slope"));
}

/* The recording that disagrees comes before all else. */
static void test_the_recording_that_disagrees(void)
{
    d.verdict = HCI_DIAGNOSIS_COMPLETE;
    d.odd = (hci_odd_run){.file = "runs/a.csv", .rms_Nm = 5.99, .others_Nm = 0.0205};
    TEST_ASSERT_TRUE(
        says("Only runs/a.csv disagrees with the others: its error is 5.99 N·m rms, theirs 0.0205"));
    TEST_ASSERT_EQUAL_PTR(text, strstr(text, "Only runs/a.csv"));
    TEST_ASSERT_TRUE(says("Of the others: Nothing is missing"));
    strcpy(d.odd.slip, "phases b and c are swapped in its file");
    d.odd.mended = true;
    d.odd.mended_Nm = 0.02;
    TEST_ASSERT_TRUE(says("it is as if phases b and c are swapped in its file: with that mended"));
}

/* A resolution that was asked for may lie far above the noise, which what is left is then not. */
static void test_what_the_resolution_leaves_is_no_noise(void)
{
    d.verdict = HCI_DIAGNOSIS_COMPLETE;
    d.means_open = d.means_alone = false;
    d.resolution_Nm = 0.05;
    d.noise_Nm = 0.006;
    d.rms_after_Nm = 0.0252;
    TEST_ASSERT_TRUE(
        says("Nothing is missing that matters at the resolution of 0.05 N·m: what the model leaves is "
             "0.0252 N·m rms, 4.2 times the noise of the recordings (0.006 N·m)."));
    d.rms_after_Nm = 0.0061;
    TEST_ASSERT_TRUE(says("is the noise of the recordings (0.006 N·m)."));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_means_that_are_off_alone);
    RUN_TEST(test_means_beside_a_ripple);
    RUN_TEST(test_an_unfinished_search_gives_no_causes);
    RUN_TEST(test_what_runs_without_a_current_show);
    RUN_TEST(test_parts_of_a_whole);
    RUN_TEST(test_a_part_of_nothing);
    RUN_TEST(test_zeros_of_sensors);
    RUN_TEST(test_what_was_not_looked_for);
    RUN_TEST(test_what_is_decisive_and_not_taken);
    RUN_TEST(test_zeros_that_differ_are_no_units);
    RUN_TEST(test_what_makes_the_means_differ);
    RUN_TEST(test_means_that_are_right_without_a_torque);
    RUN_TEST(test_a_limit_with_nothing_left);
    RUN_TEST(test_noise_as_large_as_the_torque);
    RUN_TEST(test_the_recording_that_disagrees);
    RUN_TEST(test_what_the_resolution_leaves_is_no_noise);
    return UNITY_END();
}
