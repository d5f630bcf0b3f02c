/* What cannot be read leaves its struct empty, whatever was in it before, so that it may be released; what is
 * released is empty, and may be released again. */
#include <string.h>

#include "hci/host/currents/component_set.h"
#include "hci/host/currents/currents.h"
#include "hci/host/currents/target.h"
#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"
#include "hci/host/recording/run.h"
#include "support/files.h"
#include "unity.h"

static const char NOWHERE[] = "no_such_folder/no_such_file.csv";

static hci_note note;

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static bool is_empty(const void *x, size_t size)
{
    const unsigned char *byte = x;
    for (size_t k = 0; k < size; ++k)
        if (byte[k] != 0) return false;
    return true;
}

/* TYPE is read by READ into x, which was full of something else, and released by RELEASE, twice. */
#define EMPTIED(TYPE, READ, RELEASE)                                                                         \
    do {                                                                                                     \
        TYPE x;                                                                                              \
        memset(&x, 0x5a, sizeof x);                                                                          \
        TEST_ASSERT_NOT_EQUAL(HCI_OK, READ);                                                                 \
        RELEASE(&x);                                                                                         \
        TEST_ASSERT_TRUE_MESSAGE(is_empty(&x, sizeof x), #TYPE);                                             \
        RELEASE(&x);                                                                                         \
    } while (0)

static void test_what_is_not_there(void)
{
    const hci_run_options run = {.pole_pairs = 2};
    const hci_runs_options runs = {.run = {.pole_pairs = 2}};
    EMPTIED(hci_machine_data, hci_machine_read(NOWHERE, &x, &note), hci_machine_release);
    EMPTIED(hci_run, hci_run_read(NOWHERE, &run, &x, &note), hci_run_release);
    EMPTIED(hci_runs, hci_runs_read(NOWHERE, &runs, &x, &note), hci_runs_release);
    EMPTIED(hci_effects_data, hci_effects_read(NOWHERE, &x, &note), hci_effects_release);
    EMPTIED(hci_target, hci_target_read(NOWHERE, &x, &note), hci_target_release);
    EMPTIED(hci_currents, hci_currents_read(NOWHERE, false, &x, &note), hci_currents_release);
    EMPTIED(hci_component_set, hci_component_set_read(NOWHERE, false, &x, &note), hci_component_set_release);
}

/* A file that is there and is wrong behind its header. */
static void test_what_is_wrong(void)
{
    const hci_run_options run = {.pole_pairs = 2};
    files_write(files_path("wrong.csv"),
                "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n0,0,1,x,0,1\n0.1,y,1,0,0,1\n");
    EMPTIED(hci_run, hci_run_read(files_path("wrong.csv"), &run, &x, &note), hci_run_release);
    files_write(files_path("wrong.csv"), "order,amplitude_Nm,phase_rad\n0,1,0\n6,much,0\n");
    EMPTIED(hci_target, hci_target_read(files_path("wrong.csv"), &x, &note), hci_target_release);
    files_write(files_path("wrong.csv"), "order,set,amplitude_A,phase_rad\n1,pos,1,0\n5,up,1,0\n");
    EMPTIED(hci_currents, hci_currents_read(files_path("wrong.csv"), false, &x, &note), hci_currents_release);
    EMPTIED(hci_component_set, hci_component_set_read(files_path("wrong.csv"), false, &x, &note),
            hci_component_set_release);
    files_write(files_path("wrong.csv"),
                "effect,parameter,value,unit,std_error\nfriction,coulomb,1,Nm,0.1\nfriction,no_such,1,Nm,\n");
    EMPTIED(hci_effects_data, hci_effects_read(files_path("wrong.csv"), &x, &note), hci_effects_release);
}

/* The same of what was read. */
#define RELEASED(TYPE, READ, RELEASE)                                                                        \
    do {                                                                                                     \
        TYPE x;                                                                                              \
        memset(&x, 0x5a, sizeof x);                                                                          \
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, READ, note.text);                                              \
        TEST_ASSERT_FALSE_MESSAGE(is_empty(&x, sizeof x), #TYPE);                                            \
        RELEASE(&x);                                                                                         \
        TEST_ASSERT_TRUE_MESSAGE(is_empty(&x, sizeof x), #TYPE);                                             \
        RELEASE(&x);                                                                                         \
    } while (0)

static void test_what_was_read(void)
{
    const hci_runs_options runs = {.run = {.pole_pairs = 2}};
    RELEASED(hci_machine_data, hci_machine_read("data/machine_a", &x, &note), hci_machine_release);
    RELEASED(hci_target, hci_target_read("data/scenarios/02/target.csv", &x, &note), hci_target_release);
    RELEASED(hci_currents, hci_currents_read("data/example_currents/currents.csv", false, &x, &note),
             hci_currents_release);
    RELEASED(hci_component_set, hci_component_set_read("data/scenarios/02/harmonics.csv", false, &x, &note),
             hci_component_set_release);
    files_write(files_path("log.csv"),
                "time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm\n0,0,1,-1,0,1\n0.1,0.1,1,0,"
                "-1,1\n0.2,0.2,1,0,-1,1\n0.3,0.3,1,0,-1,1\n");
    files_write(files_path("list.csv"), "file,role\nlog.csv,fit\n");
    RELEASED(hci_runs, hci_runs_read(files_path("list.csv"), &runs, &x, &note), hci_runs_release);
    files_write(files_path("effects.csv"),
                "effect,parameter,value,unit,std_error\nfriction,coulomb,1,Nm,0.1\n");
    RELEASED(hci_effects_data, hci_effects_read(files_path("effects.csv"), &x, &note), hci_effects_release);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_not_there);
    RUN_TEST(test_what_is_wrong);
    RUN_TEST(test_what_was_read);
    return UNITY_END();
}
