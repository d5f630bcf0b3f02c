/* Points of a map: two columns that must be there, one that may be, and what is refused with its row. */
#include "hci/host/sweep/grid_file.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_grid_point *point;
static size_t count;
static hci_note note;

void setUp(void)
{
    files_begin();
    memset(&note, 0, sizeof note);
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_grid_points_free(point);
    point = NULL;
    files_end();
}

static hci_status read_text(const char *text)
{
    files_write(files_path("points.csv"), text);
    return hci_grid_read(files_path("points.csv"), &point, &count, &note);
}

static void test_columns(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, read_text("speed_rpm,dc_link_V,torque_Nm\n60,48,-1.5\n-120,1e-3,2\n0,400,0\n"), note.text);
    TEST_ASSERT_EQUAL_UINT64(3, count);
    static const double TORQUE[] = {-1.5, 2.0, 0.0}, RPM[] = {60.0, -120.0, 0.0},
                        LINK[] = {48.0, 1e-3, 400.0};
    for (size_t k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(TORQUE[k], point[k].torque_Nm);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, RPM[k] * 3.14159265358979 / 30.0, point[k].speed_rad_per_s);
        TEST_ASSERT_EQUAL_DOUBLE(LINK[k], point[k].link_V);
    }
}

static void test_without_a_voltage_that_of_the_machine(void)
{
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_text("torque_Nm,speed_rad_per_s\n1,2\n"), note.text);
    TEST_ASSERT_EQUAL_UINT64(1, count);
    TEST_ASSERT_TRUE(point[0].torque_Nm == 1.0 && point[0].speed_rad_per_s == 2.0 && isnan(point[0].link_V));
}

static void test_refusals(void)
{
    static const struct {
        const char *text, *words;
    } CASE[] = {
        {"torque_Nm,speed_rpm\n", "points.csv: no rows; expected a point in each, torque_Nm,speed_rpm"},
        {"torque_Nm,speed_rpm,dc_link_V\n1,2,48\n1,2,0\n",
         "points.csv:3: column 3 `dc_link_V`: found `0`, expected a voltage above 0"},
        {"torque_Nm,speed_rpm,dc_link_V\n1,2,-48\n1,2,48\n",
         "points.csv:2: column 3 `dc_link_V`: found `-48`, expected a voltage above 0"},
        {"torque_Nm,speed_rpm\n1,fast\n", "points.csv:2"},
        {"torque_Nm\n1\n", "speed_rad_per_s"},
        {"speed_rpm\n1\n", "torque_Nm"}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        memset(&note, 0, sizeof note);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, read_text(CASE[k].text), CASE[k].text);
        text_has(CASE[k].words, note.text);
        TEST_ASSERT_NULL(point);
        TEST_ASSERT_EQUAL_UINT64(0, count);
    }
}

static void test_memory_fails_anywhere(void)
{
    hci_status status = HCI_ERROR_MEMORY;
    for (int calls = 0; status && calls < 1000; ++calls) {
        hci_memory_fail_after(calls);
        status = read_text("torque_Nm,speed_rpm,dc_link_V\n1,2,48\n");
        hci_memory_fail_after(-1);
        TEST_ASSERT_TRUE(status == HCI_OK ? count == 1 : status == HCI_ERROR_MEMORY && !point && count == 0);
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_columns);
    RUN_TEST(test_without_a_voltage_that_of_the_machine);
    RUN_TEST(test_refusals);
    RUN_TEST(test_memory_fails_anywhere);
    return UNITY_END();
}
