/* Lists of recordings: currents that were calculated are no log, each thing that tells them from one; and
 * what is said of a list whose rows cannot be read. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/recording/run.h"
#include "host/base/memory.h"
#include "support/files.h"
#include "support/reference.h"
#include "support/texts.h"

enum { N = 96 };

static hci_runs runs;
static hci_note note;
static hci_run_options reading;

void setUp(void)
{
    files_begin();
    memset(&runs, 0, sizeof runs);
    memset(&note, 0, sizeof note);
    reading = (hci_run_options){.pole_pairs = 3};
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_runs_release(&runs);
    files_end();
}

/* ---- currents that solve has written ---- */

/* A turn of phases with i_d = −0.4, i_q = 3 and ripple, as solve writes it, but for: */
typedef struct {
    bool has_time, has_torque, has_dq, has_phases;
    const char *angle;
    double from, uneven, size_A, sum_A;
    int rows;
} made;

static const made AS_SOLVED = {false, true, true, true, "theta_e_rad", 0.0, 0.0, 1.0, 0.0, N};

static void write_made(const made *m)
{
    FILE *file = fopen(files_path("w.csv"), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "%s%s%s%s%s\n", m->has_time ? "time_s," : "", m->angle,
            m->has_phases ? ",ia_A,ib_A,ic_A" : "", m->has_dq ? ",id_A,iq_A" : "",
            m->has_torque ? ",torque_Nm" : "");
    for (int k = 0; k < m->rows; ++k) {
        const double e = m->from + 2.0 * REF_PI * k / N + (k == N / 2 ? m->uneven : 0.0),
                     q = m->size_A * (3.0 + 0.2 * sin(6.0 * e)), d = -0.4 * m->size_A;
        if (m->has_time) fprintf(file, "%.9g,", 1e-3 * k);
        fprintf(file, "%.17g", e);
        for (int s = 0; s < 3 && m->has_phases; ++s) {
            const double x = e - 2.0 * REF_PI * s / 3.0;
            fprintf(file, ",%.17g", q * sin(x) - d * cos(x) + m->sum_A / 3.0);
        }
        if (m->has_dq) fprintf(file, ",%.17g,%.17g", d, q);
        fprintf(file, m->has_torque ? ",2.7\n" : "\n");
    }
    fclose(file);
}

static bool is_refused(const made *m)
{
    write_made(m);
    memset(&note, 0, sizeof note);
    const hci_status status = hci_runs_add(&runs, files_path("w.csv"), HCI_ROLE_FIT, &reading, &note);
    const bool refused =
        status != HCI_OK && strstr(note.text, "found calculated currents, as solve writes them") != NULL;
    TEST_ASSERT_EQUAL_MESSAGE(status == HCI_OK, !refused, note.text);
    hci_runs_release(&runs);
    return refused;
}

static void test_calculated_currents(void)
{
    made m = AS_SOLVED; /* with three pole pairs the angle of the rotor is a third of it */
    TEST_ASSERT_TRUE(is_refused(&m));
    m.from = 1e-6; /* measured from somewhere */
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.uneven = 3.0 * 0.9e-9 * N;
    TEST_ASSERT_TRUE(is_refused(&m));
    m.uneven = 3.0 * 1.1e-9 * N;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.uneven = -3.0 * 1.1e-9 * N;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.sum_A = 2.9e-9; /* the largest is 3.1 A, about */
    TEST_ASSERT_TRUE(is_refused(&m));
    m.sum_A = 3.3e-9;
    TEST_ASSERT_FALSE(is_refused(&m));
    m.sum_A = -3.3e-9;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.size_A = 0.0;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.has_time = true;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.has_dq = false;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.has_phases = false;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.has_torque = false;
    TEST_ASSERT_FALSE(is_refused(&m));
    m = AS_SOLVED, m.angle = "theta_m_rad";
    TEST_ASSERT_FALSE(is_refused(&m));
}

/* ---- lists ---- */

static hci_status read_list(const char *text)
{
    files_write(files_path("list.csv"), text);
    hci_runs_release(&runs);
    memset(&note, 0, sizeof note);
    return hci_runs_read(files_path("list.csv"), &(hci_runs_options){.run = reading}, &runs, &note);
}

static void test_what_is_said_of_a_list(void)
{
    static const struct {
        const char *list, *words;
    } CASE[] = {
        {"file,role\na.csv,fit\nnone.csv,fit\n",
         "list.csv:3: column 1 `file`: found `none.csv`, expected a recording "
         "that can be read"},
        {"file,role\na.csv,fit\nnone.csv,fit\n",
         "none.csv: No such file or directory; a path begins at the folder of the list"},
        {"file,role\na.csv,fit\na.csv,holdout\n", "list.csv:3: column 1 `file`: found `a.csv`"},
        {"file,role\na.csv,fit\n,fit\n", "expected the path of a run; fill it or remove the row"},
        {"file,role\na.csv,train\n", "found `train`, expected `fit` or `holdout`"},
        {"name,role\na.csv,fit\n", "list.csv:1: found no column `file` but `name`"},
        {"time_s,iq_A\n0,1\n1,1\n", "found a recording with time_s, expected a list of recordings"},
        {"file,role\nw.csv,fit\n", "w.csv: found calculated currents"},
    };
    files_write(files_path("a.csv"),
                "time_s,theta_m_rad,iq_A,torque_Nm\n0,0,1,2\n1,0.5,1,2\n2,1,1,2\n3,1.5,1,2\n");
    write_made(&AS_SOLVED);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_list("file,role\na.csv,fit\n"), note.text);
    TEST_ASSERT_EQUAL(1, runs.count);
    TEST_ASSERT_EQUAL(4, runs.run[0].count);
    TEST_ASSERT_EQUAL_STRING("a.csv", runs.run[0].name);
    TEST_ASSERT_EQUAL_STRING(files_path("a.csv"), runs.origin[0].path);
    TEST_ASSERT_EQUAL_STRING("", runs.origin[0].columns);
    TEST_ASSERT_EQUAL(HCI_ERROR_ARGUMENT, hci_runs_add(&runs, files_path("a.csv"), HCI_ROLE_FIT, &reading,
                                                       &note)); /* read from a file */
    for (size_t k = 0; k < sizeof CASE / sizeof CASE[0]; ++k) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, read_list(CASE[k].list), CASE[k].list);
        text_has(CASE[k].words, note.text);
    }
}

static void test_runs_that_are_added(void)
{
    files_write(files_path("a.csv"), "time_s,theta_m_rad,iq_A,torque_Nm\n0,0,1,2\n1,0.5,1,2\n2,1,1,2\n");
    files_write(files_path("b.csv"), "time_s,theta_m_rad,iq_A,torque_Nm\n0,0,1,2\n1,0.5,1,2\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_runs_add(&runs, files_path("a.csv"), HCI_ROLE_HOLDOUT, &reading, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_runs_add(&runs, files_path("b.csv"), HCI_ROLE_FIT, &reading, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT,
                      hci_runs_add(&runs, files_path("b.csv"), HCI_ROLE_FIT, &reading, &note));
    text_has("b.csv: found it a second time, expected each recording once", note.text);
    TEST_ASSERT_EQUAL(2, runs.count);
    TEST_ASSERT_EQUAL(3, runs.run[0].count);
    TEST_ASSERT_EQUAL(2, runs.run[1].count);
    TEST_ASSERT_EQUAL(HCI_ROLE_HOLDOUT, runs.role[0]);
    TEST_ASSERT_EQUAL(HCI_ROLE_FIT, runs.role[1]);
}

static void test_without_memory(void)
{
    files_write(files_path("a.csv"), "time_s,theta_m_rad,iq_A,torque_Nm\n0,0,1,2\n1,0.5,1,2\n2,1,1,2\n");
    files_write(files_path("list.csv"), "file,role\na.csv,fit\n");
    for (long k = 0; k < 400; ++k) {
        memset(&note, 0, sizeof note);
        hci_memory_fail_after(k);
        const hci_status status =
            hci_runs_read(files_path("list.csv"), &(hci_runs_options){.run = reading}, &runs, &note);
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK || status == HCI_ERROR_MEMORY);
        TEST_ASSERT_EQUAL(status != HCI_OK, note.text[0] != '\0');
        hci_runs_release(&runs);
        if (status == HCI_OK) return;
    }
    TEST_FAIL_MESSAGE("it never succeeds");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_calculated_currents);
    RUN_TEST(test_what_is_said_of_a_list);
    RUN_TEST(test_runs_that_are_added);
    RUN_TEST(test_without_memory);
    return UNITY_END();
}
