/* What a note says of file, line, column and remedy, read back from the JSON by the parser of cJSON. */
#include <cjson/cJSON.h>
#include <string.h>

#include "hci/host/report/summary.h"
#include "unity.h"

static cJSON *json;

void setUp(void)
{
    json = NULL;
}

void tearDown(void)
{
    cJSON_Delete(json);
}

static const cJSON *entry(const char *name)
{
    return cJSON_GetObjectItem(cJSON_GetObjectItem(json, "error"), name);
}

static void is_text(const char *name, const char *expected)
{
    const cJSON *x = entry(name);
    TEST_ASSERT_EQUAL_MESSAGE(expected != NULL, x != NULL, name);
    if (expected) TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, x->valuestring, name);
}

/* 0: there is none. */
static void is_number(const char *name, double expected)
{
    const cJSON *x = entry(name);
    TEST_ASSERT_EQUAL_MESSAGE(expected > 0.0, x != NULL, name);
    if (x) TEST_ASSERT_EQUAL_DOUBLE(expected, x->valuedouble);
}

typedef struct {
    hci_status status;
    const char *words, *file;
    double line, column;
    const char *name, *remedy;
} failure;

static void expect(const failure *f)
{
    hci_note note = {{0}};
    strcpy(note.text, f->words);
    char *text = hci_failure_json(f->status, &note);
    TEST_ASSERT_NOT_NULL(text);
    cJSON_Delete(json);
    json = cJSON_Parse(text);
    hci_text_free(text);
    TEST_ASSERT_NOT_NULL(json);
    is_text("message", f->words[0] ? f->words : hci_status_text(f->status));
    is_text("status", hci_status_text(f->status));
    TEST_ASSERT_EQUAL_DOUBLE(hci_status_exit_code(f->status), entry("exit_code")->valuedouble);
    is_text("file", f->file);
    is_number("line", f->line);
    is_number("column", f->column);
    is_text("column_name", f->name);
    is_text("remedy", f->remedy);
}

static void test_all_parts(void)
{
    static const failure CASE[] = {
        {HCI_ERROR_INPUT, "a.csv:12: column 3 `i_a`: found `x`, expected a number; mend the cell", "a.csv",
         12.0, 3.0, "i_a", "mend the cell"},
        {HCI_ERROR_INPUT, "a.csv:7: column 31: found nothing", "a.csv", 7.0, 31.0, NULL, NULL},
        {HCI_ERROR_INPUT, "a.csv:7: columns 3 and 4 differ", "a.csv", 7.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "a.csv:7: column `x`: found nothing", "a.csv", 7.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "a.csv:1: column 2 `b: found", "a.csv", 1.0, 2.0, "b: found", NULL},
        {HCI_ERROR_INPUT, "a.csv: column 4 `t`: found nothing", "a.csv", 0.0, 4.0, "t", NULL},
        {HCI_ERROR_INPUT, "a.csv: no header; name the columns", "a.csv", 0.0, 0.0, NULL, "name the columns"},
        {HCI_NOT_REACHED, "out:5: something", "out", 5.0, 0.0, NULL, NULL},
        {HCI_ERROR_OUTPUT, "out/a.csv: cannot be made: No space left", "out/a.csv", 0.0, 0.0, NULL, NULL}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k)
        expect(&CASE[k]);
}

/* A path may have colons and numbers in it; the line is the first number between a colon and ": ". */
static void test_paths_with_colons(void)
{
    static const failure CASE[] = {
        {HCI_ERROR_INPUT, "a:3/b:4.csv:5: found `y:6: z`", "a:3/b:4.csv", 5.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "a:: found nothing", "a:", 0.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "a.csv:123456789012345678: far", "a.csv", 123456789012345678.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "a.csv:1234567890123456789: too far", "a.csv:1234567890123456789", 0.0, 0.0, NULL,
         NULL},
        {HCI_ERROR_INPUT, "a.csv:9:found", NULL, 0.0, 0.0, NULL, NULL}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k)
        expect(&CASE[k]);
}

/* A colon is one of a file only where the input or the output is wrong, and not behind an option. */
static void test_what_is_no_file(void)
{
    static const failure CASE[] = {
        {HCI_ERROR_ARGUMENT, "levels of torque: found 2; give 3", NULL, 0.0, 0.0, NULL, "give 3"},
        {HCI_ERROR_NUMERIC, "limits: no currents were found", NULL, 0.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "--target: no such file", NULL, 0.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "-x: no such file", "-x", 0.0, 0.0, NULL, NULL},
        {HCI_ERROR_INPUT, "nothing at all", NULL, 0.0, 0.0, NULL, NULL}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k)
        expect(&CASE[k]);
}

/* Of several remedies the last one; without words those of the status. */
static void test_the_last_remedy(void)
{
    static const failure CASE[] = {{HCI_ERROR_INPUT, "a.csv: found 1; 2; 3", "a.csv", 0.0, 0.0, NULL, "3"},
                                   {HCI_ERROR_INPUT, "a; b.csv:4: found x", "a; b.csv", 4.0, 0.0, NULL, NULL},
                                   {HCI_NOT_REACHED, "", NULL, 0.0, 0.0, NULL, "the nearest result is given"},
                                   {HCI_ERROR_MEMORY, "", NULL, 0.0, 0.0, NULL, NULL}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k)
        expect(&CASE[k]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_all_parts);
    RUN_TEST(test_paths_with_colons);
    RUN_TEST(test_what_is_no_file);
    RUN_TEST(test_the_last_remedy);
    return UNITY_END();
}
