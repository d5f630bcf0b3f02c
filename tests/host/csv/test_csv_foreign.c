/* Tables of other tools: every name of docs/files.md is read as the page says, and the page lists every name
 * that the program knows; lines before the header; units in names and rows. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hci/host/base/unit.h"
#include "hci/host/csv/csv.h"
#include "hci/host/recording/run.h"
#include "host/base/unit_lookup.h"
#include "host/csv/alias.h"
#include "support/files.h"
#include "support/reference.h"
#include "support/texts.h"
#include "unity.h"

static char path[64];

void setUp(void)
{
    files_begin();
    snprintf(path, sizeof path, "%s", files_path("table.csv"));
}

void tearDown(void)
{
    files_end();
}

static hci_csv *read_text(const char *text)
{
    hci_note note = {{0}};
    hci_csv *csv;
    files_write(path, text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_read(path, &csv, &note), note.text);
    hci_csv_orders_of(csv, 1, HCI_ORDER_ELECTRICAL);
    return csv;
}

static double first_number(const hci_csv *csv, const char *column)
{
    double values[16] = {0};
    hci_note note = {{0}};
    TEST_ASSERT_LESS_THAN(16, (int)hci_csv_rows(csv));
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_numbers(csv, column, values, &note), note.text);
    return values[0];
}

/* ---- the names ---- */

/* A file with the column alone, and what it needs beside it. */
static hci_csv *read_alias(const hci_alias *alias, const char *unit)
{
    char text[256];
    snprintf(text, sizeof text, "\"%s%s%s%s%s\",x%s%s\n2,1%s\n", alias->name[0] == '.' ? "drive.axis0" : "",
             alias->name, unit != NULL ? " [" : "", unit != NULL ? unit : "", unit != NULL ? "]" : "",
             alias->beside != NULL ? "," : "", alias->beside != NULL ? alias->beside : "",
             alias->beside != NULL ? ",1" : "");
    return read_text(text);
}

static const char *unit_of(const char *column)
{
    size_t base;
    hci_unit_of_name(column, &base);
    return column[base] == '\0' ? "1" : column + base + 1;
}

static void test_every_name_is_read_in_its_unit(void)
{
    for (size_t k = 0; k < hci_alias_count; ++k) {
        const hci_alias *alias = &hci_aliases[k];
        if (alias->column == NULL) continue;
        const char *canonical = unit_of(alias->column);
        double factor = 1.0;
        if (alias->unit != NULL) {
            TEST_ASSERT_TRUE_MESSAGE(hci_unit_factor(alias->unit, canonical, &factor), alias->name);
        }
        hci_csv *csv = read_alias(alias, alias->unit == NULL ? canonical : NULL);
        TEST_ASSERT_TRUE_MESSAGE(hci_csv_has(csv, alias->column), alias->name);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15 + 4e-16 * factor, 2.0 * factor, first_number(csv, alias->column));
        hci_note told = {{0}};
        TEST_ASSERT_EQUAL_MESSAGE(alias->meaning != NULL, hci_csv_told(csv, alias->column, &told),
                                  alias->name);
        if (alias->meaning != NULL) text_has(alias->meaning, told.text);
        hci_csv_free(csv);
    }
}

/* A name that is only read with a unit is not taken without one, and what may be two things is refused. */
static void test_names_that_say_too_little_are_not_read(void)
{
    for (size_t k = 0; k < hci_alias_count; ++k) {
        const hci_alias *alias = &hci_aliases[k];
        if (alias->column != NULL && alias->unit != NULL) continue;
        hci_csv *csv = read_alias(alias, NULL);
        hci_note note = {{0}};
        if (alias->column != NULL) {
            TEST_ASSERT_FALSE_MESSAGE(hci_csv_has(csv, alias->column), alias->name);
            TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_csv_check_clear(csv, &note), note.text);
        } else {
            TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_check_clear(csv, &note));
            text_has("expected theta_m or theta_e; rename the column", note.text);
            TEST_ASSERT_FALSE(hci_csv_has(csv, "theta_m_rad"));
            TEST_ASSERT_FALSE(hci_csv_has(csv, "theta_e_rad"));
        }
        hci_csv_free(csv);
    }
}

static void test_spelling_does_not_count(void)
{
    static const char *const same[] = {"i_sq",     "I_SQ",   "isq",    "i-sq",    "I sq",
                                       "i_sq (A)", "i_sq_A", "isq[A]", "i_sq / A"};
    static const char *const other[] = {"-i_sq",          "i_sqr", "i_s",   "i_sq (V)",
                                        "i_sq (furlong)", "i.sq",  "x.i_sq"};
    char text[64];
    for (size_t k = 0; k < sizeof same / sizeof *same; ++k) {
        snprintf(text, sizeof text, "%s,x\n1,2\n", same[k]);
        hci_csv *csv = read_text(text);
        TEST_ASSERT_TRUE_MESSAGE(hci_csv_has(csv, "iq_A"), same[k]);
        hci_csv_free(csv);
    }
    for (size_t k = 0; k < sizeof other / sizeof *other; ++k) {
        snprintf(text, sizeof text, "%s,x\n1,2\n", other[k]);
        hci_csv *csv = read_text(text);
        TEST_ASSERT_FALSE_MESSAGE(hci_csv_has(csv, "iq_A"), other[k]);
        hci_csv_free(csv);
    }
}

static void test_one_letter_stands_as_it_is_written(void)
{
    hci_csv *csv = read_text("t,T,n [rpm],N\n1,2,3,4\n");
    TEST_ASSERT_EQUAL_DOUBLE(1, first_number(csv, "time_s"));
    TEST_ASSERT_EQUAL_DOUBLE(2, first_number(csv, "torque_Nm"));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, REF_PI / 10, first_number(csv, "speed_rad_per_s"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "temperature_C"));
    hci_csv_free(csv);
    csv = read_text("t,n\n1,2\n"); /* may be the number of the sample */
    TEST_ASSERT_FALSE(hci_csv_has(csv, "speed_rad_per_s"));
    hci_csv_free(csv);
    csv = read_text("T (degC),x\n2,1\n");
    TEST_ASSERT_EQUAL_DOUBLE(2, first_number(csv, "temperature_C"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "torque_Nm"));
    hci_csv_free(csv);
}

static void test_an_own_name_comes_first(void)
{
    hci_csv *csv = read_text("i_sq,iq\n1,2\n");
    hci_note told = {{0}};
    TEST_ASSERT_EQUAL_DOUBLE(2, first_number(csv, "iq_A"));
    TEST_ASSERT_FALSE(hci_csv_told(csv, "iq_A", &told));
    hci_csv_free(csv);
    csv = read_text("i_sq,q_current\n1,2\n");
    double value;
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "iq_A", &value, &told));
    text_has("found `iq_A` a second time, expected one column for it; remove or rename one", told.text);
    hci_csv_free(csv);
}

/* Beside tau_M, theta_m is electrical; theta_M, and theta_m elsewhere, is mechanical. */
static void test_a_column_beside_it_changes_what_a_name_means(void)
{
    hci_csv *csv = read_text("theta_m,tau_M\n1,2\n");
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_e_rad"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "theta_m_rad"));
    hci_csv_free(csv);
    csv = read_text("theta_M,tau_M\n1,2\n");
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_m_rad"));
    TEST_ASSERT_FALSE(hci_csv_has(csv, "theta_e_rad"));
    hci_csv_free(csv);
    csv = read_text("theta_m,torque\n1,2\n");
    TEST_ASSERT_TRUE(hci_csv_has(csv, "theta_m_rad"));
    hci_csv_free(csv);
    csv = read_text("theta,Id,Fd\n180,2,1\n");
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, REF_PI, first_number(csv, "theta_e_rad"));
    hci_csv_free(csv);
}

static void test_told_units_are_those_that_were_supposed(void)
{
    hci_note told = {{0}};
    hci_csv *csv = read_text("erpm,position (deg)\n60,90\n");
    TEST_ASSERT_TRUE(hci_csv_told(csv, "speed_e_rad_per_s", &told));
    TEST_ASSERT_EQUAL_STRING("`erpm` is read as the electrical speed, divided by the pole pairs, in rpm",
                             told.text);
    told.text[0] = '\0';
    TEST_ASSERT_TRUE(hci_csv_told(csv, "theta_m_rad", &told));
    TEST_ASSERT_EQUAL_STRING("`position (deg)` is read as the mechanical angle", told.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, REF_PI / 2, first_number(csv, "theta_m_rad"));
    hci_csv_free(csv);
}

/* ---- the page ---- */

typedef struct {
    char name[16][64];
    size_t names;
    char column[16][64];
    size_t columns;
    char unit[64], tool[64], remark[256];
} page_row;

/* What stands between backticks, at most 16. */
static size_t words_of(const char *cell, char word[16][64])
{
    size_t count = 0;
    for (const char *at = strchr(cell, '`'); at != NULL; at = strchr(at + 1, '`')) {
        const char *end = strchr(at + 1, '`');
        TEST_ASSERT_TRUE(end != NULL && end - at < 64 && count < 16);
        snprintf(word[count++], 64, "%.*s", (int)(end - at - 1), at + 1);
        at = end;
    }
    return count;
}

static void copy_cell(const char *cell, size_t length, char *out, size_t size)
{
    while (length > 0 && *cell == ' ') {
        ++cell;
        --length;
    }
    while (length > 0 && cell[length - 1] == ' ')
        --length;
    TEST_ASSERT_LESS_THAN((int)size, (int)length);
    memcpy(out, cell, length);
    out[length] = '\0';
}

static page_row parse_row(const char *line)
{
    page_row row = {.names = 0};
    char cell[5][512];
    const char *at = line + 1;
    for (int k = 0; k < 5; ++k) {
        const char *end = strchr(at, '|');
        TEST_ASSERT_NOT_NULL_MESSAGE(end, line);
        copy_cell(at, (size_t)(end - at), cell[k], sizeof cell[k]);
        at = end + 1;
    }
    row.names = words_of(cell[0], row.name);
    row.columns = words_of(cell[1], row.column);
    TEST_ASSERT_TRUE_MESSAGE(row.columns > 0 || strcmp(cell[1], "refused") == 0, line);
    copy_cell(cell[2], strlen(cell[2]), row.unit, sizeof row.unit);
    copy_cell(cell[3], strlen(cell[3]), row.tool, sizeof row.tool);
    copy_cell(cell[4], strlen(cell[4]), row.remark, sizeof row.remark);
    return row;
}

static bool is_same(const char *a, const char *b)
{
    return a == NULL || b == NULL ? a == b : strcmp(a, b) == 0;
}

/* The alias of the program that a name of the page is, or NULL. */
static const hci_alias *find_alias(const page_row *row, size_t k)
{
    char beside[96];
    const char *unit = strcmp(row->unit, "must be said") == 0 || row->unit[0] == '\0' ? NULL : row->unit;
    const char *column = row->columns == 0 ? NULL : row->column[row->columns == 1 ? 0 : k];
    for (size_t i = 0; i < hci_alias_count; ++i) {
        const hci_alias *a = &hci_aliases[i];
        if (!is_same(a->name, row->name[k]) || !is_same(a->column, column) || !is_same(a->unit, unit))
            continue;
        if (!is_same(a->tool, row->tool)) continue;
        snprintf(beside, sizeof beside, "beside `%s`", a->beside != NULL ? a->beside : "");
        if ((a->beside != NULL) != (strstr(row->remark, beside) != NULL)) continue;
        if (a->meaning == NULL || strstr(row->remark, a->meaning) != NULL) return a;
    }
    return NULL;
}

static void check_row(const page_row *row, bool *listed)
{
    TEST_ASSERT_TRUE(row->columns <= 1 || row->columns == row->names);
    for (size_t k = 0; k < row->names; ++k) {
        const hci_alias *alias = find_alias(row, k);
        TEST_ASSERT_NOT_NULL_MESSAGE(alias, row->name[k]);
        listed[alias - hci_aliases] = true;
    }
}

static void test_the_page_lists_every_name(void)
{
    char line[1024];
    bool inside = false, *listed = calloc(hci_alias_count, sizeof *listed);
    FILE *page = fopen("docs/files.md", "r");
    TEST_ASSERT_NOT_NULL(page);
    while (fgets(line, sizeof line, page) != NULL) {
        if (strncmp(line, "| name in the file |", 20) == 0) inside = true;
        if (!inside || strncmp(line, "| `", 3) != 0) continue;
        const page_row row = parse_row(line);
        check_row(&row, listed);
    }
    fclose(page);
    for (size_t k = 0; k < hci_alias_count; ++k)
        TEST_ASSERT_TRUE_MESSAGE(listed[k], hci_aliases[k].name);
    free(listed);
}

/* ---- where the table begins ---- */

/* line: of the header where something stands before it, or 0. */
static const struct {
    const char *text;
    size_t line;
    const char *name;
} beginnings[] = {
    {"a,b\n1,2\n3,4\n", 0, "a"},
    {"# about\n\na,b\n1,2\n", 0, "a"},
    {"Study\nCase,1\nTime(s),Torque(Nm)\n0,1\n1,2\n", 3, "Time(s)"},
    {"Study\r\nCase,1\r\nTime(s),Torque(Nm)\r\n0,1\r\n1,2\r\n", 3, "Time(s)"},
    {"Title,Torque\nTime(s),Torque(Nm)\n0,1\n1,2\n", 2, "Time(s)"},    /* one known name against two */
    {"speed,torque\nTime(s),Torque(Nm)\n0,1\n1,2\n", 0, "speed"},      /* either */
    {"Torque,Title\nTorque(Nm),Time(s)\n0,1\n1,2\n", 2, "Torque(Nm)"}, /* the first is known in both */
    {"this,that\nup,down\n0,1\n1,2\n", 0, "this"},                     /* either */
    {"this,that,more\nup,down\n0,1\n1,2\n", 2, "up"},
    {"Model,X\n,,,\nTIME,CH1,CH2\n0,1,2\n", 3, "TIME"},
    {"Length,4\nSource,CH1\nSecond,Volt\n0,1\n1,2\n", 2, "Source"}, /* a row of units is no header */
    {"gain,pace,more\nbar,rpm,A\n1,2,3\n4,5,6\n", 0, "gain"},
    {"x-axis,1\nsecond,Volt\n0,1\n1,2\n", 0, "x-axis"},
    {"about;it\na;b;c\n1,5;2,5;3\n4;5;6\n", 2, "a"},
    {"about\na\tb\n1\t2\n", 2, "a"},
    {"\"about, at\nlength\"\nx,y\n1,2\n", 3, "x"},
    {"a,b\n1,x\n3,4\n", 0, "a"}, /* a broken first row */
    {"name,value\nfoo,bar\n1,2\n3,4\n", 0, "name"},
    {"file,role\nx.csv,fit\ny.csv,fit\n", 0, "file"},
    {"about;;;;\na;b;c;d;e\ns;A;A;V;\n1,5;2,5;;4;a word\n4;5;6;7;\n", 2, "a"}, /* empty cells and words */
    {"about;;;\na;b;c;d\n1;;;word\n4;5;6;7\n", 0, "about"},                    /* mostly no numbers */
    {"about\na,a\n1,2\n3,4\n", 0, "about"},                                    /* not all different */
    {"about\na,b\n1,2\n3,4,5\n", 0, "about"},                                  /* not as many numbers */
};

static void test_the_header_is_found(void)
{
    for (size_t k = 0; k < sizeof beginnings / sizeof *beginnings; ++k) {
        hci_note note = {{0}};
        hci_csv *csv = NULL;
        files_write(path, beginnings[k].text);
        if (hci_csv_read(path, &csv, &note) != HCI_OK) { /* then of what the first line is */
            TEST_ASSERT_EQUAL_MESSAGE(0, beginnings[k].line, beginnings[k].text);
            continue;
        }
        TEST_ASSERT_EQUAL_STRING_MESSAGE(beginnings[k].name, hci_csv_name(csv, 0), beginnings[k].text);
        TEST_ASSERT_EQUAL_MESSAGE(beginnings[k].line, hci_csv_header_line(csv), beginnings[k].text);
        hci_csv_free(csv);
    }
}

static void test_lines_are_those_of_the_file(void)
{
    hci_csv *csv =
        read_text("\xEF\xBB\xBFStudy\r\n\r\nCase,1\r\n# x\r\nt,torque\r\ns,mNm\r\n0,1\r\n\r\n1,2\r\n2,x\r\n");
    double values[3];
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(5, hci_csv_header_line(csv));
    TEST_ASSERT_EQUAL(7, hci_csv_line(csv, 0));
    TEST_ASSERT_EQUAL(9, hci_csv_line(csv, 1));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "torque_Nm", values, &note));
    text_has(":10: column 2 `torque`: found `x`", note.text);
    hci_csv_free(csv);
}

/* ---- units ---- */

static void test_units_of_other_tools_convert(void)
{
    static const struct {
        const char *from, *to;
        double factor;
    } known[] = {
        {"Volt", "V", 1},
        {"second", "s", 1},
        {"sec", "ms", 1e3},
        {"ns", "s", 1e-9},
        {"degrees", "rad", REF_PI / 180},
        {"turns", "rad", 2 * REF_PI},
        {"Revolution", "deg", 360},
        {"turn/s", "rpm", 60},
        {"deg/s", "rpm", 1.0 / 6},
        {"rev/min", "rad/s", REF_PI / 30},
        {"NewtonMeter", "Nm", 1},
        {"mNewtonMeter", "Nm", 1e-3},
        {"kNm", "Nm", 1e3},
        {"N cm", "Nm", 1e-2},
        {"Ft-Lbs", "Nm", 0.3048 * 4.4482216152605},
        {"lbf-in", "Nm", 0.0254 * 4.4482216152605},
        {"oz-in", "Nm", 0.0254 * 4.4482216152605 / 16.0},
        {"kgf cm", "Nm", 0.0980665},
        {"g*cm^2", "kgm2", 1e-7},
        {"Wb", "mWb", 1e3},
        {"Vs", "Wb", 1},
        {"Celsius", "degC", 1},
        {"nH", "H", 1e-9},
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        double factor = 0;
        TEST_ASSERT_TRUE_MESSAGE(hci_unit_factor(known[k].from, known[k].to, &factor), known[k].from);
        TEST_ASSERT_DOUBLE_WITHIN(1e-14 * known[k].factor, known[k].factor, factor);
    }
}

static void test_unknown_units_matter_only_where_they_are_asked_for(void)
{
    hci_csv *csv = read_text("torque,speed,iq,p\nfurlong,rpm,A,bar\n1,60,2,3\n");
    double value = 0;
    hci_note note = {{0}};
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 2 * REF_PI, first_number(csv, "speed_rad_per_s"));
    TEST_ASSERT_EQUAL_DOUBLE(2, first_number(csv, "iq_A"));
    TEST_ASSERT_EQUAL(HCI_ERROR_INPUT, hci_csv_numbers(csv, "torque_Nm", &value, &note));
    text_has(
        ":2: column 1 `torque`: found `furlong`, expected a unit, as in the other cells; in a row of units",
        note.text);
    hci_csv_free(csv);
}

static void test_units_stand_behind_names_in_several_ways(void)
{
    hci_csv *bare = read_text("order [],x ()\n1,2\n");
    TEST_ASSERT_EQUAL_DOUBLE(1, first_number(bare, "order"));
    TEST_ASSERT_EQUAL_DOUBLE(2, first_number(bare, "x"));
    hci_csv_free(bare);
    static const char *const names[] = {"torque_mNm",   "torque (mNm)", "torque[mNm]",
                                        "Torque / mNm", "Torque/mN*m",  "\"Torque, mNm\""};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        char text[64];
        snprintf(text, sizeof text, "%s,x\n1500,2\n", names[k]);
        hci_csv *csv = read_text(text);
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.5, first_number(csv, "torque_Nm"));
        hci_csv_free(csv);
    }
}

/* ---- runs ---- */

static void test_a_run_tells_what_was_supposed(void)
{
    hci_run run;
    hci_note note = {{0}};
    hci_csv_free(read_text("Log\nms_today;erpm;encoder_position;q_axis_current;\n1000;600;0;1;\n1010;600;6;1;"
                           "\n1020;600;12;1;\n"));
    TEST_ASSERT_EQUAL_MESSAGE(
        HCI_OK, hci_run_read(path, &(hci_run_options){.pole_pairs = 10, .inertia_kgm2 = NAN}, &run, &note),
        note.text);
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 2 * REF_PI, run.speed_rad_per_s[1]); /* 60 rpm */
    TEST_ASSERT_DOUBLE_WITHIN(1e-14, REF_PI / 15, run.theta_m_rad[2]);
    text_has("line 2 is the header, what stands before it is not read; `erpm` is read as", run.remark.text);
    text_has("`encoder_position` is read as the mechanical angle of an encoder", run.remark.text);
    hci_run_release(&run);
    hci_csv_free(read_text("theta,iq\n1,2\n"));
    TEST_ASSERT_EQUAL(
        HCI_ERROR_INPUT,
        hci_run_read(path, &(hci_run_options){.pole_pairs = 10, .inertia_kgm2 = NAN}, &run, &note));
    text_has(":1: column 1 `theta`: found an angle that may be mechanical or electrical", note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_name_is_read_in_its_unit);
    RUN_TEST(test_names_that_say_too_little_are_not_read);
    RUN_TEST(test_spelling_does_not_count);
    RUN_TEST(test_one_letter_stands_as_it_is_written);
    RUN_TEST(test_an_own_name_comes_first);
    RUN_TEST(test_a_column_beside_it_changes_what_a_name_means);
    RUN_TEST(test_told_units_are_those_that_were_supposed);
    RUN_TEST(test_the_page_lists_every_name);
    RUN_TEST(test_the_header_is_found);
    RUN_TEST(test_lines_are_those_of_the_file);
    RUN_TEST(test_units_of_other_tools_convert);
    RUN_TEST(test_unknown_units_matter_only_where_they_are_asked_for);
    RUN_TEST(test_units_stand_behind_names_in_several_ways);
    RUN_TEST(test_a_run_tells_what_was_supposed);
    return UNITY_END();
}
