/* Which column holds a quantity, in which unit, and why one cannot be used. */
#include "host/csv/column.h"

#include <math.h>
#include <string.h>

#include "host/csv/table.h"
#include "support/draws.h"
#include "support/files.h"
#include "support/texts.h"
#include "unity.h"

static hci_csv *csv;
static hci_note note;

void setUp(void)
{
    csv = NULL;
    files_begin();
}

void tearDown(void)
{
    hci_csv_free(csv);
    files_end();
}

static void read_text(const char *text)
{
    hci_csv_free(csv);
    csv = NULL;
    memset(&note, 0, sizeof note);
    files_write(files_path("a.csv"), text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(files_path("a.csv"), &csv, &note), note.text);
}

static void give(const char *name, size_t column)
{
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give(csv, name, column, &note));
}

/* The column that is found for a name, its factor, and whether the file says a unit. */
static void is_found(const char *name, size_t column, double factor, bool has_unit)
{
    const hci_column_match found = hci_column_find(csv, name);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_COLUMN_ONE, found.kind, name);
    TEST_ASSERT_EQUAL_UINT64(column, found.column);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * factor, factor, found.factor);
    TEST_ASSERT_EQUAL(has_unit, found.has_unit);
    TEST_ASSERT_TRUE(hci_csv_has(csv, name));
}

static void is_not_there(const char *name)
{
    size_t column;
    TEST_ASSERT_EQUAL(HCI_COLUMN_NONE, hci_column_find(csv, name).kind);
    TEST_ASSERT_FALSE(hci_csv_has(csv, name) || hci_csv_find(csv, name, &column));
}

/* hci_csv_has: whether it is there, though it cannot be used. */
static void is_refused(const char *name, hci_column_kind kind, bool has, const char *words)
{
    size_t column;
    const hci_column_match found = hci_column_find(csv, name);
    TEST_ASSERT_EQUAL(kind, found.kind);
    TEST_ASSERT_EQUAL(has, hci_csv_has(csv, name));
    TEST_ASSERT_TRUE(hci_csv_find(csv, name, &column));
    TEST_ASSERT_EQUAL_UINT64(found.column, column);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_column_error(csv, name, &found, &note));
    text_has(words, note.text);
}

/* ---- by its own name ---- */

static void test_units_of_names_and_rows(void)
{
    read_text("lamp,theta_m_deg,torque\n1,2,3\n");
    is_found("theta_m_rad", 1, REF_PI / 180.0, true);
    is_found("torque_Nm", 2, 1.0, false);
    is_found("torque_mNm", 2, 1.0, false); /* without a unit it is in that asked for */
    is_not_there("iq_A");
    is_not_there("theta_e_rad");
    read_text("theta_m,torque_mNm,iq\ndeg,mNm,-\n1,2,3\n");
    is_found("theta_m_rad", 0, REF_PI / 180.0, true);
    is_found("torque_Nm", 1, 1e-3, true);
    is_found("iq_A", 2, 1.0, false);
    read_text("torque_A,torque_Nm\n1,2\n"); /* a name of another dimension is another one */
    is_found("torque_Nm", 1, 1.0, true);
}

static void test_columns_that_cannot_be_used(void)
{
    read_text("torque_Nm,lamp,torque_mNm\n1,2,3\n");
    is_refused(
        "torque_Nm", HCI_COLUMN_TWICE, true,
        "a.csv:1: column 3 `torque_mNm`: found `torque_Nm` a second time, expected one column for it; remove "
        "or rename one of them");
    read_text("lamp,torque\nV,A\n1,2\n");
    is_refused("torque_Nm", HCI_COLUMN_OTHER_UNIT, false,
               "a.csv:2: column 2 `torque`: found the unit `A`, expected a unit of the quantity asked for; "
               "correct the "
               "unit");
    read_text("lamp,torque_Nm\nV,mNm\n1,2\n");
    is_refused("torque_Nm", HCI_COLUMN_CONFLICT, true,
               "a.csv:2: column 2 `torque_Nm`: found the unit `mNm`, expected the unit in the column's name; "
               "correct");
    read_text("lamp,torque,id,iq\nV,parsec,A,A\n1,2,3,4\n");
    is_refused("torque_Nm", HCI_COLUMN_UNKNOWN_UNIT, true,
               "a.csv:2: column 2 `torque`: found `parsec`, expected " HCI_CSV_UNIT_EXPECTED
               "; " HCI_CSV_UNIT_REMEDY);
    read_text("torque,torque_Nm\nA,Nm\n1,2\n"); /* one in another unit yields to one that is right, … */
    is_found("torque_Nm", 1, 1.0, true);
    read_text("torque_Nm,torque\nNm,A\n1,2\n"); /* … on either side */
    is_found("torque_Nm", 0, 1.0, true);
}

static void test_columns_that_are_missing(void)
{
    static const char *const NAMES[] = {"torque_Nm", "lamp", "iq_A", "id_A"};
    char text[900] = "lamp,,torque_Nm";
    read_text("lamp,,torque_Nm\n1,2,3\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_columns_check(csv, NAMES, 2, &note));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_columns_check(csv, NAMES, 4, &note));
    text_has("a.csv:1: found no column `iq_A` but `lamp`, `torque_Nm`, expected it in the header; add it",
             note.text);
    for (int k = 0; k < 60; ++k) /* as many as there is room for */
        sprintf(text + strlen(text), ",column%d", 10 + k);
    strcat(text, "\n");
    read_text(text);
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_columns_check(csv, NAMES + 2, 1, &note));
    text_has("`column10`, `column11`", note.text);
    text_has("`, \xE2\x80\xA6, expected it in the header", note.text);
    text_lacks("column69", note.text);
}

/* ---- that the user names ---- */

static void test_columns_that_are_given(void)
{
    hci_note told = {{0}};
    read_text("lamp,lamp_mNm,lamp_A,torque_Nm\n1,2,3,4\n");
    give("torque", 0);
    is_found("torque_Nm", 0, 1.0, false); /* before that of its name */
    TEST_ASSERT_FALSE(hci_csv_told(csv, "torque_Nm", &told));
    give("torque", 1);
    is_found("torque_Nm", 1, 1e-3, true); /* the last word counts */
    give("torque_kNm", 0);
    is_found("torque_Nm", 0, 1e3, true);
    TEST_ASSERT_NULL(hci_column_find(csv, "torque_Nm").overruled_by);
    give("torque_kNm", 1);
    is_found("torque_Nm", 1, 1e3, true); /* whatever the file says */
    TEST_ASSERT_EQUAL_STRING("torque_kNm", hci_column_find(csv, "torque_Nm").overruled_by);
    TEST_ASSERT_TRUE(hci_csv_told(csv, "torque_Nm", &told));
    text_has("`lamp_mNm` is read in kNm, as `torque_kNm` says, and not in the unit that the file has for it",
             told.text);
    give("torque_mNm", 1);
    TEST_ASSERT_NULL(hci_column_find(csv, "torque_Nm").overruled_by);
    give("torque", 2);
    is_refused("torque_Nm", HCI_COLUMN_GIVEN_UNIT, true,
               "a.csv:1: column 3 `lamp_A`: found a unit that is none of `torque_Nm`, expected a unit of the "
               "quantity "
               "asked for; name another column, or correct the unit in the file");
}

/* A column that is given goes by that name alone. */
static void test_what_is_given_is_not_its_own(void)
{
    read_text("iq_A,lamp\n1,2\n");
    is_found("iq_A", 0, 1.0, true);
    give("id_A", 0);
    is_found("id_A", 0, 1.0, true);
    is_not_there("iq_A");
    give("none", 1);
    is_not_there("torque_Nm");
}

/* In the unit that such a name has elsewhere, as turns per second of ODrive. */
static void test_a_usual_unit(void)
{
    read_text("x.vel_estimate,lamp\n1,2\n");
    give("speed", 0);
    is_found("speed_rad_per_s", 0, 2.0 * REF_PI, false);
    give("speed", 1);
    is_found("speed_rad_per_s", 1, 1.0, false);
    give("torque", 0);
    is_found("torque_Nm", 0, 1.0, false); /* of another quantity it says none */
}

static void test_counts_of_an_encoder(void)
{
    read_text("lamp,enc_deg\n1,2\n");
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_give_counts(csv, "theta_m", 1, 4096.0, &note));
    is_found("theta_m_rad", 1, 2.0 * REF_PI / 4096.0, true);
    TEST_ASSERT_NULL(hci_column_find(csv, "theta_m_rad").overruled_by);
    csv->given[0].divisor = -2.0;
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, -REF_PI / 4096.0, hci_column_find(csv, "theta_m_rad").factor);
    TEST_ASSERT_TRUE(hci_csv_counts("Encoder_Count") && hci_csv_counts("enc cnt") &&
                     hci_csv_counts("TICKS") && hci_csv_counts("pulses") && hci_csv_counts("increments"));
    TEST_ASSERT_FALSE(hci_csv_counts("encoder") || hci_csv_counts("") || hci_csv_counts("con t"));
}

/* Behind the name, in brackets, of a channel, or in a row. */
static void test_units_of_any_column(void)
{
    read_text("AI3 (mV),lamp,x_A,Torque\\CAN: 1 [Nm]\n1,2,3,4\n");
    const char *const units[] = {"mV", NULL, "A", "Nm"};
    for (size_t k = 0; k < 4; ++k) {
        const hci_unit *unit = hci_column_unit(csv, k);
        TEST_ASSERT_EQUAL(units[k] == NULL, unit == NULL);
        TEST_ASSERT_TRUE(unit == NULL || hci_unit_equal(unit, hci_unit_find(units[k], strlen(units[k]))));
    }
    read_text("lamp,other\nV,-\n1,2\n");
    TEST_ASSERT_NOT_NULL(hci_column_unit(csv, 0));
    TEST_ASSERT_NULL(hci_column_unit(csv, 1));
}

/* ---- angles that may be either ---- */

static void test_an_angle_that_is_not_clear(void)
{
    size_t column;
    read_text("lamp,theta\n1,2\n");
    TEST_ASSERT_TRUE(hci_csv_unclear(csv, &column));
    TEST_ASSERT_EQUAL_UINT64(1, column);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_check_clear(csv, &note));
    text_has(
        "a.csv:1: column 2 `theta`: found an angle that may be mechanical or electrical, expected theta_m or "
        "theta_e; rename the column to the one it is, say --column \"theta_m=theta\"",
        note.text);
    give("theta_m", 1);
    TEST_ASSERT_FALSE(hci_csv_unclear(csv, &column));
    TEST_ASSERT_EQUAL(HCI_OK, hci_csv_check_clear(csv, &note));
    read_text("theta,speed_rad_per_s\n1,2\n");
    memset(&note, 0, sizeof note);
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_check_clear(csv, &note));
    text_has("expected one that goes where the speed leads; by the speed and the time of this file",
             note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_units_of_names_and_rows);
    RUN_TEST(test_columns_that_cannot_be_used);
    RUN_TEST(test_columns_that_are_missing);
    RUN_TEST(test_columns_that_are_given);
    RUN_TEST(test_what_is_given_is_not_its_own);
    RUN_TEST(test_a_usual_unit);
    RUN_TEST(test_counts_of_an_encoder);
    RUN_TEST(test_units_of_any_column);
    RUN_TEST(test_an_angle_that_is_not_clear);
    return UNITY_END();
}
