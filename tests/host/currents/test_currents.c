/* Wanted torque, sets of components and currents from their files, by values and places that are written
 * here. */
#include <math.h>

#include "hci/host/currents/component_set.h"
#include "hci/host/currents/solution_folder.h"
#include "hci/host/currents/target.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_note note;

void setUp(void)
{
    memset(&note, 0, sizeof note);
    files_begin();
}

void tearDown(void)
{
    files_end();
}

static const char *file(const char *name, const char *text)
{
    files_write(files_path(name), text);
    return files_path(name);
}

/* ---- target.csv ---- */

static void test_a_target_is_sorted_and_complete(void)
{
    hci_target t;
    const char *path = file("target.csv", "order,amplitude_Nm,phase_rad,weight\n6,0.5,0.25,3\n0,-2,0,1\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read(path, &t, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(2, t.count);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, t.order[0].torque_Nm.order);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, hci_target_mean_Nm(&t));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5 * cos(0.25), t.order[1].torque_Nm.sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 0.5 * sin(0.25), t.order[1].torque_Nm.cosine);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, t.order[0].weight);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, hci_target_at(&t, 6.0).weight);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, hci_target_at(&t, 12.0).weight); /* not listed: wanted zero */
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_target_at(&t, 12.0).torque_Nm.sine);
    hci_target_release(&t);
    TEST_ASSERT_NULL(t.order);
}

/* Order 6 in each: by the option, by the header whatever the option, and as a fraction. */
static void test_orders_of_a_mechanical_turn(void)
{
    static const struct {
        const char *text;
        hci_order_base base;
    } cases[] = {{"order,amplitude_Nm,phase_rad\n42,1,0\n", HCI_ORDER_MECHANICAL},
                 {"mechanical_order,amplitude_Nm,phase_rad\n42,1,0\n", HCI_ORDER_ELECTRICAL},
                 {"mechanical_order,amplitude_Nm,phase_rad\n84/2,1,0\n", HCI_ORDER_MECHANICAL},
                 {"electrical_order,amplitude_Nm,phase_rad\n6,1,0\n", HCI_ORDER_MECHANICAL},
                 {"order,amplitude_Nm,phase_rad\n42/7,1,0\n", HCI_ORDER_ELECTRICAL}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        hci_target t;
        hci_note remark = {{0}};
        const char *path = file("target.csv", cases[k].text);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read_orders(path, cases[k].base, 7, &t, &remark, &note),
                                  note.text);
        TEST_ASSERT_EQUAL_DOUBLE(6.0, t.order[0].torque_Nm.order);
        TEST_ASSERT_EQUAL_STRING("", remark.text);
        hci_target_release(&t);
    }
}

static void test_mechanical_orders_need_pole_pairs(void)
{
    hci_target t;
    const char *path = file("target.csv", "mechanical_order,amplitude_Nm,phase_rad\n42,1,0\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_target_read(path, &t, &note));
    text_has("found orders of a mechanical turn", note.text);
    text_has("divide them by the pole pairs and name the column order", note.text);
}

static void test_mechanical_orders_of_components(void)
{
    hci_component_set set;
    const hci_set_tables of = {.pole_pairs = 7, .order_base = HCI_ORDER_MECHANICAL};
    const char *path = file("set.csv", "order,set\n35,neg\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_component_set_read_orders(path, &of, &set, &note), note.text);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, set.component[0].order);
    hci_component_set_release(&set);
}

static void test_phases_that_look_like_degrees_are_told(void)
{
    static const char *const texts[] = {
        "order,amplitude_Nm,phase_rad\n6,1,90\n", "order,amplitude_Nm,phase\n6,1,90\n",
        "order,amplitude_Nm,phase_rad\n6,1,6\n", "order,amplitude_Nm,phase_deg\n6,1,90\n"};
    for (size_t k = 0; k < 4; ++k) {
        hci_target t;
        hci_note remark = {{0}};
        const char *path = file("target.csv", texts[k]);
        TEST_ASSERT_EQUAL_MESSAGE(
            HCI_OK, hci_target_read_orders(path, HCI_ORDER_ELECTRICAL, 7, &t, &remark, &note), note.text);
        if (k < 2)
            text_has("a phase of 90 rad, which looks like degrees: if it is, name the column phase_deg",
                     remark.text);
        else
            TEST_ASSERT_EQUAL_STRING("", remark.text);
        hci_target_release(&t);
    }
}

static void test_weights_are_one_where_there_is_no_such_column(void)
{
    hci_target t;
    const char *path = file("target.csv", "order,amplitude_Nm,phase_rad\n6,0.5,0\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_target_read(path, &t, &note));
    TEST_ASSERT_EQUAL_DOUBLE(1.0, t.order[0].weight);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, hci_target_mean_Nm(&t));
    hci_target_release(&t);
}

/* Weights that would spoil the scale of the system, and by which row. */
static void test_weights_that_are_refused(void)
{
    static const char *const WEIGHT[] = {"-1", "2e6", "1e-7"};
    for (size_t k = 0; k < 3; ++k) {
        char text[96];
        hci_target t;
        snprintf(text, sizeof text, "order,amplitude_Nm,phase_rad,weight\n6,1,0,1\n0,1,0,%s\n", WEIGHT[k]);
        TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_target_read(file("target.csv", text), &t, &note));
        text_has("target.csv:3: column 4 `weight`", note.text);
        TEST_ASSERT_NULL(t.order);
        memset(&note, 0, sizeof note);
    }
}

static void test_the_largest_and_the_least_weight(void)
{
    hci_target t;
    const char *path = file("target.csv", "order,amplitude_Nm,phase_rad,weight\n0,1,0,1e-6\n6,1,0,1e6\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_target_read(path, &t, &note), note.text);
    TEST_ASSERT_EQUAL_DOUBLE(1e-6, hci_target_at(&t, 0.0).weight);
    TEST_ASSERT_EQUAL_DOUBLE(1e6, hci_target_at(&t, 6.0).weight);
    hci_target_release(&t);
}

/* ---- harmonics.csv ---- */

/* sym 5 is of negative sequence, as neg 5 is: counted once, and said. */
static void test_a_set_has_each_component_once(void)
{
    hci_component_set set;
    const char *path = file("harmonics.csv", "order,set\n5,neg\n7,asym\n5,sym\n13,pos\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_component_set_read(path, false, &set, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(3, set.count);
    for (size_t k = 0; k < set.count; ++k)
        TEST_ASSERT_EQUAL_INT(set.component[k].order == 5.0 ? -1 : 1, set.component[k].sequence);
    text_has("neg 5 and sym 5 are the same component", set.remark.text);
    hci_component_set_release(&set);
    TEST_ASSERT_NULL(set.component);
}

static void test_zero_sequence_takes_a_neutral_conductor(void)
{
    hci_component_set set;
    const char *path = file("harmonics.csv", "order,set\n3,zero\n");
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_component_set_read(path, false, &set, &note));
    text_has("harmonics.csv:2:", note.text);
    TEST_ASSERT_EQUAL(HCI_OK, hci_component_set_read(path, true, &set, &note));
    TEST_ASSERT_EQUAL_INT(0, set.component[0].sequence);
    hci_component_set_release(&set);
}

/* ---- currents.csv and the folder of a solution ---- */

static void test_currents_are_waves(void)
{
    hci_currents c, other;
    const char *path = file("currents.csv", "order,set,amplitude_A,phase_rad\n1,pos,10,0.5\n5,neg,2,0\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_currents_read(path, false, &c, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(2, c.count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 10.0 * cos(0.5), c.wave[0].sine);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 10.0 * sin(0.5), c.wave[0].cosine);
    TEST_ASSERT_EQUAL_INT(-1, c.wave[1].sequence);
    path = file("currents.csv", "order,set,amplitude_A,phase_rad\n1,pos,10,0.5\n5,neg,2.5,0\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_currents_read(path, false, &other, &note));
    TEST_ASSERT_TRUE(c.hash != other.hash);
    hci_currents_release(&other);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_currents_read(path, true, &other, &note)); /* no A per N·m */
    hci_currents_release(&c);
}

static void test_the_folder_of_a_solution(void)
{
    hci_currents c;
    double mean_Nm;
    const char *whole = file("currents.csv", "order,set,amplitude_A,phase_rad\n1,pos,10,0\n");
    TEST_ASSERT_TRUE(hci_solution_is_folder(files_root));
    TEST_ASSERT_FALSE(hci_solution_is_folder(whole));
    TEST_ASSERT_FALSE(hci_solution_has_parts(files_root));
    file("currents_per_Nm.csv", "order,set,amplitude_A_per_Nm,phase_rad\n1,pos,4,0\n");
    file("spectrum.csv", "order,target_Nm,target_phase_rad\n0,2.5,1.5707963267948966\n");
    TEST_ASSERT_TRUE(hci_solution_has_parts(files_root));
    TEST_ASSERT_EQUAL(HCI_OK,
                      hci_solution_read_currents(files_root, HCI_SOLUTION_CURRENTS_PER_NM, &c, &note));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, c.wave[0].sine);
    hci_currents_release(&c);
    TEST_ASSERT_EQUAL(HCI_OK, hci_solution_read_currents(files_root, HCI_SOLUTION_CURRENTS, &c, &note));
    TEST_ASSERT_EQUAL_DOUBLE(10.0, c.wave[0].sine);
    hci_currents_release(&c);
    TEST_ASSERT_EQUAL(HCI_OK, hci_solution_read_mean_torque(files_root, &mean_Nm, &note));
    TEST_ASSERT_EQUAL_DOUBLE(2.5, mean_Nm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_target_is_sorted_and_complete);
    RUN_TEST(test_orders_of_a_mechanical_turn);
    RUN_TEST(test_mechanical_orders_need_pole_pairs);
    RUN_TEST(test_mechanical_orders_of_components);
    RUN_TEST(test_phases_that_look_like_degrees_are_told);
    RUN_TEST(test_weights_are_one_where_there_is_no_such_column);
    RUN_TEST(test_weights_that_are_refused);
    RUN_TEST(test_the_largest_and_the_least_weight);
    RUN_TEST(test_a_set_has_each_component_once);
    RUN_TEST(test_zero_sequence_takes_a_neutral_conductor);
    RUN_TEST(test_currents_are_waves);
    RUN_TEST(test_the_folder_of_a_solution);
    return UNITY_END();
}
