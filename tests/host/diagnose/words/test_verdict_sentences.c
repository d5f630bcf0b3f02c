/* The sentences of a diagnosis as they stand, each threshold from both sides. */
#include <math.h>
#include <string.h>

#include "hci/host/diagnose/diagnose.h"
#include "unity.h"

enum { MOST_RUNS = 6 };

static hci_diagnosis d;
static hci_run_errors run[MOST_RUNS];
static char text[4096];

/* Friction was added; 0.5 N·m became 0.1 where noise is 0.02, and nothing was held out. */
void setUp(void)
{
    memset(&d, 0, sizeof d);
    memset(run, 0, sizeof run);
    d.run = run;
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    d.rms_before_Nm = 0.5;
    d.rms_after_Nm = 0.1;
    d.noise_Nm = 0.02;
    d.holdout_before_Nm = d.holdout_after_Nm = NAN;
    d.finding[0] = (hci_finding){.effect = "friction", .verdict = HCI_FINDING_ADDED, .delta_bic = 5000.0};
    d.findings = 1;
}

void tearDown(void)
{
}

static const char *words(void)
{
    hci_diagnosis_words(&d, text, sizeof text);
    return text;
}

static bool says(const char *part)
{
    return strstr(words(), part) != NULL;
}

static bool begins(const char *part)
{
    return strstr(words(), part) == text;
}

static void add(const char *effect, hci_finding_verdict verdict, double delta_bic)
{
    d.finding[d.findings++] = (hci_finding){.effect = effect, .verdict = verdict, .delta_bic = delta_bic};
}

/* ---- what was found, and what is left ---- */

static void test_one_effect(void)
{
    TEST_ASSERT_EQUAL_STRING(
        "The model lacked friction. On the runs that were fitted the error (rms of measured less "
        "modelled torque) falls from 0.5 to 0.1 N·m; their noise is 0.02 N·m. No run was held out, "
        "so this is not a test.",
        words());
}

/* What is not known is no effect; nor is what was rejected. */
static void test_several_effects(void)
{
    add("unknown", HCI_FINDING_ADDED, 4000.0);
    add("cogging", HCI_FINDING_ADDED, 3000.0);
    add("back_emf", HCI_FINDING_REJECTED, 90.0);
    TEST_ASSERT_TRUE(says("The model lacked friction and cogging torque. On"));
    add("reluctance", HCI_FINDING_ADDED, 1000.0);
    TEST_ASSERT_TRUE(says("The model lacked friction, cogging torque and reluctance torque. On"));
}

/* A change by a fiftieth is none. */
static void test_what_became_of_the_error(void)
{
    static const double AFTER_NM[4] = {0.489, 0.491, 0.509, 0.511};
    static const char *const SAID[4] = {"falls from 0.5 to 0.489 N·m;", "stays at 0.491 N·m;",
                                        "stays at 0.509 N·m;", "rises from 0.5 to 0.511 N·m;"};
    for (int k = 0; k < 4; ++k) {
        d.rms_after_Nm = AFTER_NM[k];
        TEST_ASSERT_TRUE_MESSAGE(says(SAID[k]), SAID[k]);
    }
}

/* Mean and ripple apart where more than one and a half times the noise is left of runs that were held out. */
static void test_runs_that_were_held_out(void)
{
    d.holdout_before_Nm = 0.7;
    d.holdout_noise_Nm = 0.1;
    d.holdout_mean_before_Nm = 0.6;
    d.holdout_mean_after_Nm = 0.06;
    d.holdout_ripple_before_Nm = 0.13;
    d.holdout_ripple_after_Nm = 0.1301;
    d.holdout_after_Nm = 0.149;
    TEST_ASSERT_EQUAL_STRING(
        "The model lacked friction. On the runs that were held out the error (rms of measured less "
        "modelled torque) falls from 0.7 to 0.149 N·m; their noise is 0.1 N·m.",
        words());
    d.holdout_after_Nm = 0.151;
    TEST_ASSERT_TRUE(
        says("their noise is 0.1 N·m. Of it the mean of each run falls from 0.6 to 0.06 N·m, the ripple "
             "about it stays at 0.13 N·m."));
}

static void test_effects_that_hang_on_a_run(void)
{
    add("cogging", HCI_FINDING_AMBIGUOUS, 300.0);
    add("back_emf", HCI_FINDING_REJECTED, 20.0);
    d.finding[0].stays = d.finding[0].left_out = 5;
    d.finding[1].stays = 3;
    d.finding[1].left_out = d.finding[2].left_out = 5;
    TEST_ASSERT_TRUE(
        says(" With one run, or part of one, left out cogging torque is found in 3 of 5 cases."));
    TEST_ASSERT_FALSE(says("left out friction"));
    TEST_ASSERT_FALSE(says("left out back-EMF"));
}

/* ---- nothing is missing ---- */

static void test_nothing_is_missing(void)
{
    d.verdict = HCI_DIAGNOSIS_COMPLETE;
    d.resolution_Nm = 0.04;
    d.rms_after_Nm = 0.0299;
    TEST_ASSERT_EQUAL_STRING(
        "Nothing is missing: what the model leaves, 0.0299 N·m rms, is the noise of the recordings "
        "(0.02 N·m).",
        words());
    d.rms_after_Nm = 0.0301;
    TEST_ASSERT_EQUAL_STRING(
        "Nothing is missing that matters at the resolution of 0.04 N·m: what the model leaves is "
        "0.0301 N·m rms, 1.5 times the noise of the recordings (0.02 N·m).",
        words());
    d.holdout_noise_Nm = 0.1;
    d.holdout_after_Nm = 0.149;
    TEST_ASSERT_FALSE(says(" But on"));
    d.holdout_after_Nm = 0.151;
    TEST_ASSERT_TRUE(
        says(" But on the runs that were held out it is 0.151 N·m, and their noise is 0.1 N·m."));
}

/* ---- what recordings do not tell apart ---- */

static void test_effects_that_explain_the_same(void)
{
    d.verdict = HCI_DIAGNOSIS_AMBIGUOUS;
    add("cogging", HCI_FINDING_AMBIGUOUS, 300.0);
    add("back_emf", HCI_FINDING_AMBIGUOUS, 200.0);
    TEST_ASSERT_TRUE(
        says("The model lacked friction. These recordings do not tell cogging torque and back-EMF apart: "
             "each explains them equally well. On"));
    d.inertia_as_well = true;
    TEST_ASSERT_TRUE(
        says("do not tell cogging torque, back-EMF and a wrong inertia apart: each explains them equally "
             "well. A free shaft shows torque per ampere and inertia as their ratio only. On"));
    d.inertia_as_well = false;
    d.sensors_as_well = true;
    d.finding[0].verdict = HCI_FINDING_REJECTED;
    TEST_ASSERT_TRUE(begins("These recordings do not tell cogging torque and back-EMF from current "
                            "sensors that read a part of each other's current: these explain them "
                            "equally well. On"));
}

/* ---- partly ---- */

static void test_a_part_is_explained(void)
{
    d.verdict = HCI_DIAGNOSIS_PARTLY;
    TEST_ASSERT_TRUE(
        says("Partly explained: the model lacked friction; what else it lacks is not known. On"));
    d.finding[0].verdict = HCI_FINDING_AMBIGUOUS;
    add("cogging", HCI_FINDING_AMBIGUOUS, 300.0);
    TEST_ASSERT_TRUE(
        says("Partly explained: the model lacked friction or cogging torque; what else it lacks is not "
             "known. On"));
    d.search = HCI_WORK_INTERRUPTED;
    TEST_ASSERT_TRUE(says("what else it lacks is not known yet. On"));
}

/* Under load an error that rises by more than a fiftieth, unless it is said what works against it. */
static void test_effects_without_a_current_under_load(void)
{
    static const char RISES[] = " Under load that does not hold by itself: there the error rises with it.";
    d.verdict = HCI_DIAGNOSIS_PARTLY;
    d.holdout_before_Nm = 0.1;
    d.holdout_after_Nm = 0.1021;
    TEST_ASSERT_FALSE(says(RISES));
    d.no_load_alone = true;
    TEST_ASSERT_TRUE(says(RISES));
    d.holdout_after_Nm = 0.1019;
    TEST_ASSERT_FALSE(says(RISES));
    d.holdout_after_Nm = 0.1021;
    d.no_load_denied = "It was left out";
    TEST_ASSERT_FALSE(says(RISES));
    TEST_ASSERT_TRUE(says(" It was left out."));
    d.no_load_against = true;
    TEST_ASSERT_TRUE(
        says(" Under load the ripple is larger with it: something that is not known makes the same orders "
             "there and works against it."));
}

/* ---- unknown ---- */

static void unknown(void)
{
    d.verdict = HCI_DIAGNOSIS_UNKNOWN;
    d.findings = 0;
}

static const char
    NO_EFFECT[] = "No known effect explains what the model lacks.",
    NO_TORQUE[] = "What the model lacks does not show in these torques.",
    LOADS[] = "Nothing is missing in the ripple, and the mean of the torque is an unknown load, of which "
              "nothing is told.";

static void test_nothing_explains_it(void)
{
    unknown();
    TEST_ASSERT_EQUAL_STRING(NO_EFFECT, words());
    d.search = HCI_WORK_LIMITED;
    d.further_work = 16.0;
    TEST_ASSERT_TRUE(says("What the model lacks is not known yet."));
}

/* Voltages that differ by more than a fiftieth, or loads, are all that is wrong where nothing else is left.
 */
static void test_what_else_is_left_beside_voltages_and_loads(void)
{
    for (int loads = 0; loads < 2; ++loads)
        for (int k = 0; k < 7; ++k) {
            setUp();
            unknown();
            d.open_voltage_off = loads ? 0.0 : 0.021;
            d.unknown_loads = (size_t)loads;
            d.wanders = k == 1;
            d.means_open = k == 2;
            d.unexplained_count = k == 3;
            d.disbelieved = k == 4 ? "cogging" : NULL;
            d.contradicted = k == 5;
            if (k == 6) add("friction", HCI_FINDING_ADDED, 300.0);
            TEST_ASSERT_EQUAL(k == 0, says(loads ? LOADS : NO_TORQUE));
            TEST_ASSERT_EQUAL(k > 0, says(NO_EFFECT));
        }
    setUp();
    unknown();
    d.open_voltage_off = 0.019;
    TEST_ASSERT_TRUE(says(NO_EFFECT));
    d.unknown_loads = 2;
    d.search = HCI_WORK_INTERRUPTED;
    TEST_ASSERT_TRUE(says("is not known yet"));
}

static void test_what_is_left(void)
{
    unknown();
    d.contradicted = d.wanders = d.means_open = true;
    d.unexplained[0] = (hci_unexplained){6.0, 0.3, 0.4, 1.5, 0.5, false, 0.25};
    d.unexplained[1] = (hci_unexplained){0.0, 0.3, 0.4, 0.0, 2.0, true, 0.75};
    d.unexplained_count = 2;
    TEST_ASSERT_EQUAL_STRING("No known effect explains what the model lacks. Effects that describe the runs "
                             "that were fitted and not those "
                             "that were held out were dropped. What would explain all runs says nothing of a "
                             "run left out. Something in it "
                             "does not repeat with the turn of the rotor. Order 6 (up to 0.25 N·m) grows as "
                             "|i|^1.5 |ω|^0.5. Order 0 (up to "
                             "0.75 N·m) grows as |i|^0 |ω|^2 and turns its sign with the direction.",
                             words());
}

/* ---- values that are not plausible ---- */

static void disbelieve(double share)
{
    unknown();
    d.disbelieved = "current_gain";
    d.disbelieved_share = share;
}

/* Less than half of the torque per ampere is said. */
static void test_values_that_are_not_plausible(void)
{
    disbelieve(0.49);
    TEST_ASSERT_EQUAL_STRING(
        "No known effect explains what the model lacks. The recordings would fit gains of the current "
        "sensors, but with "
        "values that are not plausible (it would leave 0.49 of the declared torque per ampere of i_q), so "
        "it was left "
        "out: see with `check` whether signs, units, angle and motor are those of the machine folder.",
        words());
    disbelieve(0.51);
    TEST_ASSERT_TRUE(says("not plausible, so it was left out: see with"));
}

/* Of torque sensors alone, and of loads that are alike. */
static void test_one_load(void)
{
    static const char SAID[] = "All loads are of one size";
    disbelieve(0.6);
    d.runs = 3;
    for (size_t k = 0; k < 3; ++k)
        run[k] = (hci_run_errors){.source = HCI_TORQUE_MEASURED, .mean_torque_Nm = k == 0 ? -0.04 : 1.0};
    TEST_ASSERT_TRUE(says(SAID));
    run[2].mean_torque_Nm = 0.81;
    TEST_ASSERT_TRUE(says(SAID));
    run[2].mean_torque_Nm = 0.79;
    TEST_ASSERT_FALSE(says(SAID));
    run[2].mean_torque_Nm = -1.0;
    TEST_ASSERT_FALSE(says(SAID));
    run[2].mean_torque_Nm = 1.0;
    run[2].torque_varies_Nm = 0.29;
    TEST_ASSERT_TRUE(says(SAID));
    run[2].torque_varies_Nm = 0.31;
    TEST_ASSERT_FALSE(says(SAID));
    run[2].torque_varies_Nm = 0.0;
    run[0].source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_FALSE(says(SAID));
    run[0].source = HCI_TORQUE_MEASURED;
    d.disbelieved = NULL;
    TEST_ASSERT_FALSE(says(SAID));
}

/* Means that are more than half of the mean square of the errors. */
static void test_means_in_place_of_signs(void)
{
    for (int means = 0; means < 2; ++means) {
        disbelieve(0.6);
        d.runs = 2;
        run[0] = (hci_run_errors){.rms_before_Nm = 0.3, .source = HCI_TORQUE_MEASURED};
        run[1] = (hci_run_errors){.rms_before_Nm = 0.4, .source = HCI_TORQUE_INERTIA};
        run[1].error_mean_before_Nm = -sqrt((means ? 0.51 : 0.49) * 0.25);
        TEST_ASSERT_EQUAL(
            means, says("most of what the declared machine leaves is the mean of each run, as where the "
                        "zero of the torque sensor or the friction is another one from run to run."));
    }
    run[0].source = HCI_TORQUE_HOLDING;
    TEST_ASSERT_TRUE(
        says("is the mean of each run, as where a load or the friction is another one from run to run."));
    d.disbelieved_share = 0.4;
    TEST_ASSERT_FALSE(says("most of what"));
}

/* ---- what makes the means differ ---- */

static void means(size_t runs, const double *torque_Nm, const double *left_Nm)
{
    unknown();
    d.means_open = d.means_alone = true;
    d.runs = runs;
    for (size_t k = 0; k < runs; ++k)
        run[k] = (hci_run_errors){.source = HCI_TORQUE_MEASURED,
                                  .rms_before_Nm = 0.1,
                                  .mean_torque_Nm = torque_Nm[k],
                                  .error_mean_after_Nm = left_Nm[k]};
}

static const char
    GROWS[] = "says nothing of a run left out. What is left of them grows with the torque, as where a "
              "current, the torque or the magnets are scaled otherwise from run to run.",
    RIGHT[] = "says nothing of a run left out. Without a torque the means are right, so no zero is another "
              "one each time; it may be the scale of a current or of the torque, or magnets whose "
              "temperature was not recorded.",
    ZERO[] = "says nothing of a run left out, as where the zero of a sensor is another one each time.";

/* A correlation of 0.9: of torques (−1, 1, −1, 1) and what is left, 0.9 of it along them and the rest across.
 */
static void test_means_that_grow_with_the_torque(void)
{
    static const double TORQUE_NM[4] = {4.0, 6.0, 4.0, 6.0};
    for (int grows = 0; grows < 2; ++grows) {
        const double c = grows ? 0.905 : 0.895, s = sqrt(1.0 - c * c);
        const double left_Nm[4] = {0.2 + c + s, 0.2 - c + s, 0.2 + c - s, 0.2 - c - s};
        means(4, TORQUE_NM, left_Nm);
        TEST_ASSERT_EQUAL(grows, says(GROWS));
        TEST_ASSERT_EQUAL(!grows, says(ZERO));
    }
    d.runs = 3;
    TEST_ASSERT_FALSE(says(GROWS));
}

/* Runs below a twentieth of the largest torque have none; what is left of their means is less than a tenth,
 * as rms, of what is left of at least four others. */
static void test_means_that_are_right_without_a_torque(void)
{
    static const double OTHERS_NM = 0.03;
    for (int k = 0; k < 5; ++k) {
        const double idle_Nm = k == 2 ? 0.1 : 0.098, idle_left_Nm = (k == 1 ? 0.11 : 0.09) * OTHERS_NM;
        const double torque_Nm[6] = {idle_Nm, -2.0, 2.0, -2.0, 2.0, k == 3 ? 0.0 : 1.9},
                     left_Nm[6] = {-idle_left_Nm, OTHERS_NM, OTHERS_NM, -OTHERS_NM, -OTHERS_NM, idle_left_Nm};
        means(k == 4 ? 4 : k == 3 ? 6 : 5, torque_Nm, left_Nm);
        TEST_ASSERT_EQUAL(k == 0 || k == 3, says(RIGHT));
    }
}

static void test_means_that_are_off_without_a_torque_at_all(void)
{
    static const double NONE[5] = {0.0}, LEFT_NM[5] = {0.03, -0.03, 0.02, -0.01, 0.02};
    means(5, NONE, LEFT_NM);
    TEST_ASSERT_TRUE(says(ZERO));
    for (size_t k = 0; k < 5; ++k)
        run[k].source = HCI_TORQUE_INERTIA;
    TEST_ASSERT_TRUE(
        says("says nothing of a run left out, as where a load or the friction is another one each time."));
    d.runs = 0;
    TEST_ASSERT_TRUE(says(ZERO));
}

/* ---- what was not taken ---- */

/* Three are said, of more than 100. */
static void test_what_is_plain_and_not_taken(void)
{
    add("cogging", HCI_FINDING_REJECTED, 99.0);
    TEST_ASSERT_FALSE(says("Decisive"));
    add("back_emf", HCI_FINDING_REJECTED, 101.0);
    add("unknown", HCI_FINDING_REJECTED, 900.0);
    add("reluctance", HCI_FINDING_REJECTED, 800.0);
    add("saturation", HCI_FINDING_REJECTED, 700.0);
    add("current_gain", HCI_FINDING_REJECTED, 600.0);
    TEST_ASSERT_TRUE(
        says(" Decisive by ΔBIC and not taken: back-EMF (101), reluctance torque (800), saturation (700); "
             "what each would explain beside the rest is small beside the noise, or does not hold in runs "
             "left out."));
    d.verdict = HCI_DIAGNOSIS_PARTLY;
    TEST_ASSERT_TRUE(
        says("saturation (700); none of them explains enough of it, or holds in runs left out."));
    d.search = HCI_WORK_LIMITED;
    d.further_work = 16.0;
    TEST_ASSERT_TRUE(says("saturation (700); none of them was confirmed as far as was looked."));
    d.verdict = HCI_DIAGNOSIS_COMPLETE;
    TEST_ASSERT_TRUE(says("saturation (700); what each would"));
    d.verdict = HCI_DIAGNOSIS_UNKNOWN;
    d.drowned_Nm = 1.0;
    TEST_ASSERT_TRUE(says("saturation (700); what each would"));
    d.disbelieved = "cogging";
    TEST_ASSERT_FALSE(says("Decisive"));
    d.disbelieved = NULL;
    d.not_searched = true;
    d.slip = "x";
    TEST_ASSERT_FALSE(says("Decisive"));
}

/* ---- slips ---- */

static void test_a_slip(void)
{
    unknown();
    d.slip = "The angle runs backward";
    TEST_ASSERT_TRUE(says(
        " The angle runs backward: see with `check` whether signs, angle, pole pairs and motor are those "
        "of the machine folder."));
    d.not_searched = true;
    TEST_ASSERT_EQUAL_STRING(
        "No effect was looked for, since none makes what is wrong with the files: The angle runs "
        "backward. As declared the machine leaves 0.5 N·m rms of what was measured. Mend that first: "
        "see with `check`.",
        words());
}

/* ---- what was taken out or not looked at ---- */

static void test_swings(void)
{
    d.runs = 4;
    d.swing[0] = (hci_free_swing){false, 12.5, 0.02, 0.3, 2};
    d.swings = 1;
    TEST_ASSERT_TRUE(
        says(" The torque has a swing of 0.3 N·m at 12.5 ± 0.02 Hz (2 of 4 runs), which does not repeat with "
             "the turn of the rotor, as of a load, a bearing, a belt or the mains: it was taken out."));
    d.swing[1] = (hci_free_swing){true, 0.37, 0.001, 0.2, 3};
    d.swing[2] = (hci_free_swing){false, 50.0, 0.1, 0.1, 1};
    d.swings = 3;
    TEST_ASSERT_TRUE(
        says(" The torque has a swing of 0.3 N·m at 12.5 ± 0.02 Hz (2 of 4 runs), a swing of 0.2 N·m that "
             "comes 0.37 ± 0.001 times a turn (3 of 4 runs) and a swing of 0.1 N·m at 50 ± 0.1 Hz (1 of 4 "
             "runs), which"));
    unknown();
    d.not_searched = true;
    d.slip = "x";
    TEST_ASSERT_TRUE(says("at 50 ± 0.1 Hz (1 of 4 runs)."));
}

static void test_free_shafts(void)
{
    d.runs = 3;
    TEST_ASSERT_FALSE(says("free shaft"));
    run[0].source = run[2].source = HCI_TORQUE_INERTIA;
    run[1].source = HCI_TORQUE_MEASURED;
    TEST_ASSERT_TRUE(says(" The torque of 2 of 3 runs is inertia x acceleration, as of a free shaft."));
    TEST_ASSERT_FALSE(says("The mean currents"));
    d.of_mean_currents = 1;
    TEST_ASSERT_TRUE(says(" The mean currents of 1 of them, at constant speed, are friction."));
    TEST_ASSERT_FALSE(says("No run tells the torque per ampere"));
    d.held_constant_Nm_per_A = 0.25;
    TEST_ASSERT_TRUE(
        says("currents times the declared 0.25 N·m/A, and where that is off by 5 %, so are they;"));
}

/* Above a hundredth of a gain, and a fiftieth of the voltages. */
static void test_voltages_without_a_current(void)
{
    d.beyond_voltages = 0.0099;
    d.open_voltage_off = 0.0199;
    TEST_ASSERT_FALSE(says("voltages"));
    d.beyond_voltages = 0.0101;
    TEST_ASSERT_TRUE(says(
        " Its torque per ampere is 1 % above what the voltages that were recorded without a current "
        "show: a reluctance torque where an i_d flows, magnets that are colder under load, and a gain of "
        "the torque or current sensors look the same."));
    d.beyond_voltages = -0.12;
    TEST_ASSERT_TRUE(
        says(" Its torque per ampere is 12 % below what the voltages that were recorded without a current "
             "show: iron that saturates, magnets that are warmer under load, and a gain of the torque or "
             "current sensors look the same."));
    d.verdict = HCI_DIAGNOSIS_AMBIGUOUS;
    TEST_ASSERT_FALSE(says("Its torque per ampere"));
    d.verdict = HCI_DIAGNOSIS_EXPLAINED;
    d.against_voltages = true;
    TEST_ASSERT_FALSE(says("Its torque per ampere"));
    TEST_ASSERT_TRUE(says(" The torques ask for another torque per ampere, but the voltages"));
    d.open_voltage_off = 0.0201;
    TEST_ASSERT_TRUE(
        says(" The voltages that were recorded without a current differ from speed x back_emf.csv by 2 %;"));
}

/* ---- a search that ended early ---- */

static void test_a_search_that_ended_early(void)
{
    static const char NOISE[] = ": nothing but noise is left, yet others",
                      BEST[] = ": this is the best model that it had found";
    TEST_ASSERT_FALSE(says("The search"));
    d.search = HCI_WORK_INTERRUPTED;
    for (int k = 0; k < 4; ++k) {
        d.verdict = k == 2   ? HCI_DIAGNOSIS_AMBIGUOUS
                    : k == 3 ? HCI_DIAGNOSIS_COMPLETE
                             : HCI_DIAGNOSIS_EXPLAINED;
        d.rms_after_Nm = d.noise_Nm * (k == 1 ? 1.11 : 1.09);
        TEST_ASSERT_EQUAL(k == 0 || k == 3, says(NOISE));
        TEST_ASSERT_EQUAL(k == 1 || k == 2, says(BEST));
        TEST_ASSERT_TRUE(begins("The search was interrupted: "));
        TEST_ASSERT_FALSE(says("it gets further"));
    }
    d.search = HCI_WORK_LIMITED;
    d.further_work = 16.0;
    d.verdict = HCI_DIAGNOSIS_AMBIGUOUS;
    TEST_ASSERT_TRUE(begins("The search reached the limit of its work: this is"));
    TEST_ASSERT_TRUE(says("compared with it (it gets further with --work 16, which"));
    d.verdict = HCI_DIAGNOSIS_COMPLETE;
    TEST_ASSERT_TRUE(begins("The search reached the limit of its work: nothing"));
    TEST_ASSERT_TRUE(says("(exit code 1); --work 16 lets it"));
}

/* ---- nothing can be said ---- */

static void test_nothing_was_measured(void)
{
    unknown();
    d.nothing_measured = true;
    TEST_ASSERT_TRUE(begins("Nothing can be said: no recording to fit to"));
    TEST_ASSERT_FALSE(says(NO_EFFECT));
}

/* ---- the one that disagrees ---- */

static void test_the_one_that_disagrees(void)
{
    d.odd = (hci_odd_run){.file = "a.csv", .rms_Nm = 2.0, .others_Nm = 0.1};
    TEST_ASSERT_TRUE(begins("Only a.csv disagrees with the others: its error is 2 N·m rms, theirs 0.1 "
                            "N·m; a swapped phase, another index, unit or sign in that file would do "
                            "it, and so would whatever happened in it alone. It was taken out: look "
                            "at that file. Of the others: The model"));
    strcpy(d.odd.slip, "b is c");
    TEST_ASSERT_TRUE(says("0.1 N·m; most of that goes if b is c. It was taken out"));
    d.odd.mended = true;
    d.odd.mended_Nm = 0.3;
    TEST_ASSERT_TRUE(says("; it is as if b is c: with that mended its error is 0.3 N·m. It was"));
}

static void test_the_one_that_is_set_aside(void)
{
    d.odd =
        (hci_odd_run){.file = "a.csv", .rms_Nm = 2.0, .others_Nm = 0.1, .is_aside = true, .noise_Nm = 0.1};
    TEST_ASSERT_TRUE(begins("With a.csv the recordings are not explained, and without it they are: it is set "
                            "aside. The machine of the others leaves 2 N·m rms there, of which 0.1 N·m are "
                            "noise: what is different there is not known. Of the others: The model"));
    d.odd.rms_Nm = 0.14;
    TEST_ASSERT_TRUE(says("noise, and so describes it nearly as well. Of the others: "));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_one_that_is_set_aside);
    RUN_TEST(test_one_effect);
    RUN_TEST(test_several_effects);
    RUN_TEST(test_what_became_of_the_error);
    RUN_TEST(test_runs_that_were_held_out);
    RUN_TEST(test_effects_that_hang_on_a_run);
    RUN_TEST(test_nothing_is_missing);
    RUN_TEST(test_effects_that_explain_the_same);
    RUN_TEST(test_a_part_is_explained);
    RUN_TEST(test_effects_without_a_current_under_load);
    RUN_TEST(test_nothing_explains_it);
    RUN_TEST(test_what_else_is_left_beside_voltages_and_loads);
    RUN_TEST(test_what_is_left);
    RUN_TEST(test_values_that_are_not_plausible);
    RUN_TEST(test_one_load);
    RUN_TEST(test_means_in_place_of_signs);
    RUN_TEST(test_means_that_grow_with_the_torque);
    RUN_TEST(test_means_that_are_right_without_a_torque);
    RUN_TEST(test_means_that_are_off_without_a_torque_at_all);
    RUN_TEST(test_what_is_plain_and_not_taken);
    RUN_TEST(test_a_slip);
    RUN_TEST(test_swings);
    RUN_TEST(test_free_shafts);
    RUN_TEST(test_voltages_without_a_current);
    RUN_TEST(test_a_search_that_ended_early);
    RUN_TEST(test_nothing_was_measured);
    RUN_TEST(test_the_one_that_disagrees);
    return UNITY_END();
}
