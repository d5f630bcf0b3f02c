/* The corrected machine on disk, the same bytes twice, and what goes wrong: no run to fit, no memory. */
#include <unistd.h>

#include "hci/host/report/write.h"
#include "host/base/memory.h"

#include "support/diagnosing.h"

void setUp(void)
{
    dataset_start();
}

void tearDown(void)
{
    dataset_end();
}

/* ---- no runs ---- */

static void test_no_run_to_fit(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, diagnose(NULL));
    record(200, &(point){60.0, 1.0, 0.0, 0.0, 0.0});
    role[0] = HCI_ROLE_HOLDOUT;
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, diagnose(NULL));
    role[0] = HCI_ROLE_FIT;
    double *torque_Nm = run[0].torque_Nm;
    run[0].torque_Nm = NULL;
    const hci_status without_torque = diagnose(NULL); /* an answer, which says that nothing can be said */
    run[0].torque_Nm = torque_Nm;
    TEST_ASSERT_EQUAL_INT(HCI_NOT_REACHED, without_torque);
    TEST_ASSERT_TRUE(diagnosis.nothing_measured && diagnosis.verdict == HCI_DIAGNOSIS_UNKNOWN);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.findings);
    TEST_ASSERT_NULL(diagnosis.run);
}

/* ---- files ---- */

static void write_into(const char *folder)
{
    hci_note note = {{0}};
    const hci_status status =
        hci_diagnosis_write(&diagnosis, NULL, &runs, files_root, files_path(folder), &note);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, status, note.text);
}

/* The corrected machine says what the diagnosis says of it, and lacks nothing. */
static void test_corrected_machine(void)
{
    hci_effects_data effects = {0};
    hci_machine_data corrected;
    hci_note note = {{0}};
    record(600, &(point){60.0, 2.0, 0.3, 0.0, 0.0});
    record(600, &(point){-150.0, 7.0, 0.3, 0.0, 0.0});
    for (size_t j = 0; j < 3600; ++j) /* readings that a regression smooths, and a prediction does not */
        run[j / 1800].i_A[j % 1800] += 0.005 * ref_normal(&seed);
    diagnose(NULL);
    write_into("out");
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_machine_read(files_path("out/machine"), &corrected, &note),
                                  note.text);
    TEST_ASSERT_EQUAL_INT(HCI_OK, hci_effects_read_machine(files_path("out/machine"), &effects, &note));
    for (size_t k = 0; k < runs.count; ++k) {
        double square = 0.0;
        for (size_t j = 0; j < run[k].count; ++j) {
            hci_sample x = {.theta_m_rad = run[k].theta_m_rad[j],
                            .speed_rad_per_s = run[k].speed_rad_per_s[j],
                            .temperature_C = (double)NAN};
            memcpy(x.i_abc, run[k].i_A + 3 * j, sizeof x.i_abc);
            const double error =
                run[k].torque_Nm[j] - hci_effects_predict(&corrected.model, &effects.list, &x, NULL);
            square += error * error / (double)run[k].count;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * NOISE_NM, sqrt(square), diagnosis.run[k].rms_after_Nm);
    }
    TEST_ASSERT_EQUAL_INT(HCI_OK, diagnose(&effects.list));
    TEST_ASSERT_EQUAL_INT(HCI_DIAGNOSIS_COMPLETE, diagnosis.verdict);
    TEST_ASSERT_EQUAL_UINT64(1, diagnosis.effects.list.count); /* what it had */
    hci_machine_release(&corrected);
    hci_effects_release(&effects);
}

static void test_same_bytes(void)
{
    char command[256];
    record(300, &(point){60.0, 2.0, 0.3, 0.0, 0.0});
    record(300, &(point){-60.0, 5.0, 0.3, 0.0, 0.0});
    for (int k = 0; k < 2; ++k) {
        diagnose(NULL);
        write_into(k == 0 ? "first" : "second");
    }
    snprintf(command, sizeof command,
             "cd %s && test -s first/effects.csv -a -s first/errors.csv -a -s first/machine/effects.csv && "
             "diff -r first second",
             files_root);
    TEST_ASSERT_EQUAL_INT(0, system(command));
}

/* Each number of what no effect explains is in its column, in the table and in the summary. */
static void test_what_is_not_explained(void)
{
    record(80, &(point){60.0, 2.0, 0.3, 0.0, 0.0});
    diagnose(NULL);
    TEST_ASSERT_EQUAL_UINT64(0, diagnosis.unexplained_count);
    diagnosis.unexplained_count = 2;
    diagnosis.unexplained[0] = (hci_unexplained){.order = 6.0,
                                                 .sine_Nm = 0.25,
                                                 .cosine_Nm = -0.5,
                                                 .current_exponent = 1.5,
                                                 .speed_exponent = 2.0,
                                                 .amplitude_Nm = 0.75};
    diagnosis.unexplained[1] = (hci_unexplained){.order = 12.5, .sine_Nm = 3.0, .turns_sign = true};
    write_into("out");
    const char *table = files_read(files_path("out/unexplained.csv"));
    TEST_ASSERT_EQUAL_STRING("order,sine_Nm,cosine_Nm,current_exponent,speed_exponent,direction_exponent\n"
                             "6,0.25,-0.5,1.5,2,0\n12.5,3,0,0,0,1\n",
                             strchr(table, '\n') + 1);
    const char *summary = strstr(files_read(files_path("out/summary.json")), "\"unexplained\"");
    TEST_ASSERT_NOT_NULL(summary);
    static const char *const IN_ORDER[] = {"\"order\":\t6",           "\"sine_Nm\":\t0.25",
                                           "\"cosine_Nm\":\t-0.5",    "\"current_exponent\":\t1.5",
                                           "\"speed_exponent\":\t2",  "\"turns_sign\":\tfalse",
                                           "\"amplitude_Nm\":\t0.75", "\"order\":\t12.5",
                                           "\"sine_Nm\":\t3",         "\"turns_sign\":\ttrue"};
    for (size_t k = 0; k < sizeof IN_ORDER / sizeof *IN_ORDER; ++k) {
        summary = strstr(summary, IN_ORDER[k]);
        TEST_ASSERT_NOT_NULL_MESSAGE(summary, IN_ORDER[k]);
    }
    diagnosis.unexplained_count = 0;
    write_into("out");
    TEST_ASSERT_EQUAL(-1, access(files_path("out/unexplained.csv"), F_OK));
}

/* ---- memory ---- */

/* The first allocations fail one by one, later ones in large steps: each one in test_diagnose_long. */
static void test_memory_is_out(void)
{
    long n = 0;
    record(80, &(point){60.0, 2.0, 0.3, 0.0, 0.0});
    while (diagnose_with(n) == HCI_ERROR_MEMORY)
        n += n < 30 ? 1 : n / 2;
    TEST_ASSERT_TRUE(n > 150);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_run_to_fit);
    RUN_TEST(test_corrected_machine);
    RUN_TEST(test_same_bytes);
    RUN_TEST(test_what_is_not_explained);
    RUN_TEST(test_memory_is_out);
    return UNITY_END();
}
