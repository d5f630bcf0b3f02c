/* Which values of a fit are outside of a table of limits. */
#include <math.h>
#include <string.h>

#include "hci/host/fleet/fit.h"
#include "support/files.h"
#include "unity.h"

static hci_fleet_fit fit;
static hci_note note;

void setUp(void)
{
    static const char *const NAME[][2] = {
        {"cogging", "sine_12"}, {"cogging", "cosine_12"}, {"friction", "coulomb"}};
    static const double VALUE[] = {0.02, -0.01, NAN};
    files_begin();
    memset(&fit, 0, sizeof fit);
    memset(&note, 0, sizeof note);
    for (int k = 0; k < 3; ++k) {
        strcpy(fit.parameter[k].effect, NAME[k][0]);
        strcpy(fit.parameter[k].parameter, NAME[k][1]);
        fit.parameter[k].value = VALUE[k];
    }
    fit.count = 3;
    fit.rms_after_Nm = 0.003;
}

void tearDown(void)
{
    files_end();
}

static hci_status judge(const char *rows)
{
    char text[512];
    snprintf(text, sizeof text, "effect,parameter,low,high\n%s", rows);
    files_write(files_path("limits.csv"), text);
    fit.remark.text[0] = note.text[0] = '\0';
    return hci_fleet_fit_judge(files_path("limits.csv"), &fit, &note);
}

static void finds(const char *rows, size_t judged, size_t beyond, const char *words)
{
    fit.judged = fit.beyond = 77; /* of no earlier table */
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, judge(rows), note.text);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(judged, fit.judged, rows);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(beyond, fit.beyond, rows);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(fit.remark.text, words), fit.remark.text);
    TEST_ASSERT_EQUAL(beyond == 0, fit.remark.text[0] == '\0');
}

/* A value on its limit is within; an empty end is none, and no end at all judges nothing. */
static void test_what_is_within_and_beyond(void)
{
    finds("cogging,sine_12,-0.02,0.02\n", 1, 0, "");
    finds("cogging,sine_12,0.02,0.03\n", 1, 0, "");
    finds("cogging,sine_12,,0.019\n", 1, 1, "cogging sine_12: found 0.02, expected -inf … 0.019");
    finds("cogging,sine_12,0.021,\n", 1, 1, "found 0.02, expected 0.021 … inf");
    finds("cogging,sine_12,,\n", 0, 0, "");
    finds("cogging,cosine_12,-0.02,0\ncogging,sine_12,0,0.01\n", 2, 1, "sine_12");
    finds("residual,rms,,0.002\n", 1, 1, "residual rms: found 0.003");
    finds("residual,rms,,0.003\n", 1, 0, "");
    finds("friction,coulomb,0,1\n", 1, 1, "friction coulomb: not told, expected 0 … 1");
}

/* File, line and column are named. */
static void test_what_is_no_table_of_limits(void)
{
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, judge("cogging,sine_12,0.03,0.02\n"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "limits.csv:2"), note.text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "no more than high"), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, judge("cogging,sine_12,0,1\ncogging,coulomb,0,1\n"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "limits.csv:3"), note.text);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, judge("friction,sine_12,0,1\n"));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, judge("cogging,sine_12,low,1\n"));
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, hci_fleet_fit_judge(files_path("none.csv"), &fit, &note));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_within_and_beyond);
    RUN_TEST(test_what_is_no_table_of_limits);
    return UNITY_END();
}
