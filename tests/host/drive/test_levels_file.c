/* Levels of torque from folders of solutions that are written by hand: their order, the two parts of one
 * folder, and what a loop in d and q cannot make. */
#include <math.h>
#include <sys/stat.h>

#include "hci/host/currents/solution_folder.h"
#include "hci/host/drive/drive.h"
#include "support/files.h"
#include "unity.h"

enum { FOLDERS = 3 };

static hci_loop_levels levels;
static hci_note note;
static char folder[FOLDERS][100];
static const char *path[FOLDERS];

void setUp(void)
{
    files_begin();
    memset(&note, 0, sizeof note);
    memset(&levels, 0, sizeof levels);
}

void tearDown(void)
{
    hci_loop_levels_release(&levels);
    files_end();
}

static void write_in(const char *at, const char *name, const char *text)
{
    char file[200];
    snprintf(file, sizeof file, "%s/%s", at, name);
    files_write(file, text);
}

#define CURRENTS "order,set,amplitude_A,phase_rad\n"

/* Folder k of a solution: a torque, and waves. */
static void solution(int k, double torque_Nm, const char *waves)
{
    char text[300];
    snprintf(folder[k], sizeof folder[k], "%s/s%d", files_root, k);
    path[k] = folder[k];
    TEST_ASSERT_EQUAL_INT(0, mkdir(folder[k], 0700));
    snprintf(text, sizeof text, "order,target_Nm\n0,%.17g\n6,0\n", torque_Nm);
    write_in(folder[k], "spectrum.csv", text);
    snprintf(text, sizeof text, CURRENTS "%s", waves);
    write_in(folder[k], "currents.csv", text);
}

static void test_levels_ascend(void)
{
    hci_currents alone[FOLDERS];
    solution(0, 4.0, "1,pos,8,0\n");
    solution(1, -2.0, "1,pos,4,3.141592653589793\n5,neg,0.5,1\n");
    solution(2, 1.0, "1,pos,2,0\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_loop_levels_read(path, FOLDERS, false, &levels, &note), note.text);
    TEST_ASSERT_EQUAL(3, levels.count);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, levels.level[0].torque_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, levels.level[1].torque_Nm);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, levels.level[2].torque_Nm);
    TEST_ASSERT_EQUAL(2, levels.level[0].count);
    TEST_ASSERT_EQUAL(1, levels.level[2].count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 8.0, levels.level[2].waves[0].sine);
    uint64_t hash = 0;
    for (int k = 0; k < FOLDERS; ++k) { /* of all of them, in the order in which they are given */
        TEST_ASSERT_EQUAL(HCI_OK,
                          hci_solution_read_currents(path[k], HCI_SOLUTION_CURRENTS, &alone[k], &note));
        hash = hash * 31u ^ alone[k].hash;
        hci_currents_release(&alone[k]);
    }
    TEST_ASSERT_TRUE(hash == levels.hash);
}

/* B + T·A at −T and at T, where A and B have an order in common. */
static void test_two_parts_of_one_folder(void)
{
    solution(0, -5.0, "1,pos,8,0\n");
    write_in(folder[0], "currents_constant.csv", CURRENTS "1,pos,0.5,0\n7,pos,0.25,0\n");
    write_in(folder[0], "currents_per_Nm.csv",
             "order,set,amplitude_A_per_Nm,phase_rad\n1,pos,1.5,0\n5,neg,0.1,0\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_loop_levels_read(path, 1, true, &levels, &note), note.text);
    TEST_ASSERT_EQUAL(2, levels.count);
    for (size_t k = 0; k < 2; ++k) {
        const double torque_Nm = k ? 5.0 : -5.0;
        double of[8] = {0.0};
        TEST_ASSERT_EQUAL_DOUBLE(torque_Nm, levels.level[k].torque_Nm);
        TEST_ASSERT_EQUAL(3, levels.level[k].count);
        for (size_t w = 0; w < 3; ++w) {
            const hci_wave *x = &levels.level[k].waves[w];
            TEST_ASSERT_EQUAL(x->order == 5.0 ? -1 : 1, x->sequence);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, x->cosine);
            of[(int)x->order] = x->sine;
        }
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.5 + 1.5 * torque_Nm, of[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * torque_Nm, of[5]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.25, of[7]);
    }
}

static void check_refused(size_t count, bool per_torque, hci_status status, const char *word)
{
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(status, hci_loop_levels_read(path, count, per_torque, &levels, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, word), note.text);
    TEST_ASSERT_TRUE(levels.count == 0 && levels.level == NULL);
}

static void test_what_is_refused(void)
{
    solution(0, 4.0, "1,pos,8,0\n");
    solution(1, 4.0, "1,pos,9,0\n");
    solution(2, 5.0, "1,pos,9,0\n3,zero,1,0\n");
    check_refused(2, false, HCI_ERROR_ARGUMENT, "found 4 N·m twice");
    check_refused(2, true, HCI_ERROR_ARGUMENT, "takes one folder");
    check_refused(1, true, HCI_ERROR_INPUT, "no currents_per_Nm.csv");
    check_refused(3, false, HCI_ERROR_INPUT, "order 3 are a zero sequence");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_levels_ascend);
    RUN_TEST(test_two_parts_of_one_folder);
    RUN_TEST(test_what_is_refused);
    return UNITY_END();
}
