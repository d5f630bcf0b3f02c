/* Emitted tables are read back from their C text and compared with waves by their sine formula in double. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "hci/host/emit/emit.h"
#include "host/base/memory.h"
#include "support/current_waves.h"
#include "support/files.h"
#include "support/reference.h"
#include "unity.h"

/* Memory that tearDown frees, also when a test fails half-way. */
static void *held[64];
static size_t held_count;

static void *hold(size_t size)
{
    TEST_ASSERT_LESS_THAN(sizeof held / sizeof *held, held_count);
    return held[held_count++] = calloc(size, 1);
}

static void let_go(void)
{
    while (held_count > 0)
        free(held[--held_count]);
}

void setUp(void)
{
    files_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    let_go();
    files_end();
}

static void at_most(double limit, double value)
{
    char text[80];
    snprintf(text, sizeof text, "%.9g is not at most %.9g", value, limit);
    TEST_ASSERT_TRUE_MESSAGE(value <= limit, text);
}

static void more_than(double limit, double value)
{
    char text[80];
    snprintf(text, sizeof text, "%.9g is not more than %.9g", value, limit);
    TEST_ASSERT_TRUE_MESSAGE(value > limit, text);
}

static hci_emit_request request_for(const currents *c)
{
    hci_emit_request r = {0};
    r.name = "ripple_free";
    r.format = HCI_EMIT_F32;
    r.currents = c->wave;
    r.current_count = c->count;
    return r;
}

/* ---- reading back ---- */

static char *read_text(const char *file)
{
    const char *kept = files_read(files_path(file));
    return strcpy(hold(strlen(kept) + 1), kept);
}

typedef struct {
    char *text;
    float *rows;
    hci_table_f32_probe probes[16];
    hci_table_f32 table;
} emitted;

/* A float literal: decimal point, suffix f, no blank inside. */
static float take_float(const char **text)
{
    char *end;
    const char *start = *text + strcspn(*text, "-0123456789");
    const float value = strtof(start, &end);
    TEST_ASSERT_NOT_NULL_MESSAGE(memchr(start, '.', (size_t)(end - start)), "a decimal point");
    TEST_ASSERT_EQUAL_INT('f', *end);
    *text = end + 1;
    return value;
}

static uint32_t take_uint(const char **text)
{
    char *end;
    const unsigned long value = strtoul(*text + strcspn(*text, "0123456789"), &end, 0);
    TEST_ASSERT_EQUAL_INT('u', *end);
    *text = end + 1;
    return (uint32_t)value;
}

static const char *after(const char *text, const char *what)
{
    const char *found = strstr(text, what);
    TEST_ASSERT_NOT_NULL_MESSAGE(found, what);
    return found + strlen(what);
}

static void take_rows(emitted *e)
{
    const char *at = after(e->text, "ripple_free_rows[");
    const size_t count = strtoul(at, NULL, 10);
    at = after(at, "{");
    TEST_ASSERT_EQUAL((e->table.points + 1) * e->table.columns * e->table.parts, count);
    e->rows = hold(count * sizeof *e->rows);
    for (size_t k = 0; k < count; ++k)
        e->rows[k] = take_float(&at);
    TEST_ASSERT_EQUAL_STRING_LEN(",\n};", at, 4);
    e->table.rows = e->rows;
}

static void take_probes(emitted *e)
{
    const char *at = after(e->text, "ripple_free_probes[");
    at = after(at, "{\n");
    TEST_ASSERT_LESS_OR_EQUAL(16, e->table.probe_count);
    for (uint32_t k = 0; k < e->table.probe_count; ++k) {
        e->probes[k].angle = take_uint(&at);
        e->probes[k].torque_Nm = take_float(&at);
        for (int s = 0; s < 3; ++s)
            e->probes[k].expected[s] = take_float(&at);
    }
    TEST_ASSERT_EQUAL_STRING_LEN("}},\n};", at, 6);
    e->table.probes = e->probes;
}

/* What a compiler would make of ripple_free.c. */
static void read_back(emitted *e)
{
    memset(e, 0, sizeof *e);
    e->text = read_text("ripple_free.c");
    const char *at = after(
        e->text, "const hci_table_f32 ripple_free = {\n    ripple_free_rows,\n    ripple_free_probes,\n");
    e->table.probe_count = take_uint(&at);
    e->table.points = take_uint(&at);
    e->table.columns = take_uint(&at);
    e->table.parts = take_uint(&at);
    at = after(at, "HCI_TABLE_");
    e->table.frame = strncmp(at, "DQ", 2) == 0 ? HCI_TABLE_DQ : HCI_TABLE_ABC;
    e->table.period_turns = take_uint(&at);
    e->table.sum32 = take_uint(&at);
    at = after(at, "\n");
    e->table.max_error_A = take_float(&at);
    at = after(at, "\n");
    e->table.peak_A = take_float(&at);
    at = after(at, "\n");
    e->table.reference_torque_Nm = take_float(&at);
    take_rows(e);
    take_probes(e);
}

static hci_emit_result emit_well(const hci_emit_request *r)
{
    hci_note note = {{0}};
    hci_emit_result result = {0};
    const hci_status status = hci_emit(files_root, r, &result, &note);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
    TEST_ASSERT_EQUAL_STRING("", note.text);
    return result;
}

static hci_emit_result emit_and_read(const hci_emit_request *r, emitted *e)
{
    const hci_emit_result result = emit_well(r);
    read_back(e);
    TEST_ASSERT_EQUAL(result.chosen.points, e->table.points);
    TEST_ASSERT_EQUAL(result.columns, e->table.columns);
    TEST_ASSERT_EQUAL(result.parts, e->table.parts);
    TEST_ASSERT_EQUAL(result.period_turns, e->table.period_turns);
    TEST_ASSERT_EQUAL_HEX32(result.crc32, hci_table_f32_crc32(&e->table));
    TEST_ASSERT_EQUAL_DOUBLE(result.chosen.max_error_A, (double)e->table.max_error_A);
    TEST_ASSERT_EQUAL_DOUBLE(result.peak_A, (double)e->table.peak_A);
    TEST_ASSERT_EQUAL(HCI_TABLE_GOOD, hci_table_f32_check(&e->table));
    return result;
}

/* ---- error ---- */

static double random_theta(const emitted *e, uint64_t *seed, uint32_t *angle)
{
    *angle = (uint32_t)ref_uniform(seed, 0.0, 4294967296.0);
    return 2.0 * REF_PI * e->table.period_turns * (double)*angle / 4294967296.0;
}

/* Largest distance of the runtime from i = T·a + b at random angles, and at random torques up to `torque_Nm`.
 */
static double worst_error(const emitted *e, const currents *a, const currents *b, double torque_Nm, int draws)
{
    uint64_t seed = 7;
    double worst = 0.0;
    for (int k = 0; k < draws; ++k) {
        const double torque = k % 2 == 0 ? torque_Nm : ref_uniform(&seed, -torque_Nm, torque_Nm);
        double constant[3], slope[3] = {0.0, 0.0, 0.0};
        float current[3];
        uint32_t angle;
        const double theta = random_theta(e, &seed, &angle);
        reference_currents(b, e->table.frame, theta, constant);
        if (a != NULL) reference_currents(a, e->table.frame, theta, slope);
        hci_table_f32_currents(&e->table, angle, (float)torque, current);
        for (int s = 0; s < 3; ++s)
            worst = ref_worse(worst, (double)current[s] - constant[s] - torque * slope[s]);
    }
    return worst;
}

static void check_error(const hci_emit_request *r, const currents *c)
{
    emitted e;
    const hci_emit_result result = emit_and_read(r, &e);
    const double worst = worst_error(&e, NULL, c, 0.0, 20000);
    at_most(result.chosen.max_error_A, worst);
    /* and it is the error, not just something larger: 20000 angles come close to the worst one */
    more_than(0.97 * result.chosen.max_error_A, worst);
}

static void test_stated_error_holds(void)
{
    static const size_t points[] = {5, 32, 100, 256, 777};
    const currents c = injected();
    for (size_t k = 0; k < sizeof points / sizeof *points; ++k) {
        hci_emit_request r = request_for(&c);
        r.points = points[k];
        check_error(&r, &c);
        r.frame = HCI_TABLE_DQ;
        check_error(&r, &c);
    }
}

/* Where nothing is left to interpolate the error is that of single precision. */
static void test_constant_current_needs_one_point(void)
{
    currents c = {.count = 0};
    emitted e;
    add(&c, 1, 1, 10.0, 0.3);
    hci_emit_request r = request_for(&c);
    r.frame = HCI_TABLE_DQ;
    r.max_error_A = 2e-5;
    const hci_emit_result result = emit_and_read(&r, &e);
    TEST_ASSERT_EQUAL(1, result.chosen.points);
    at_most(2e-5, worst_error(&e, NULL, &c, 0.0, 2000));
}

static double stated_error(hci_emit_request r, size_t points)
{
    r.points = points;
    r.max_error_A = 0.0;
    return emit_well(&r).chosen.max_error_A;
}

static void check_fewest(hci_emit_request r, const currents *c, double bound_A)
{
    emitted e;
    r.max_error_A = bound_A;
    const hci_emit_result result = emit_and_read(&r, &e);
    at_most(bound_A, result.chosen.max_error_A);
    at_most(bound_A, worst_error(&e, NULL, c, 0.0, 5000));
    TEST_ASSERT_EQUAL_DOUBLE(result.chosen.max_error_A, stated_error(r, result.chosen.points));
    for (size_t points = 1; points < result.chosen.points; ++points)
        more_than(bound_A, stated_error(r, points));
    r.points = result.chosen.points - 1;
    r.max_error_A = 0.0;
    emit_and_read(&r, &e);
    /* the stated error is 0.1 % above the true one, so that it holds between the angles that were measured */
    more_than(0.99 * bound_A, worst_error(&e, NULL, c, 0.0, 20000));
}

static void test_fewest_points_for_an_error(void)
{
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    check_fewest(r, &c, 2.0);
    check_fewest(r, &c, 0.3);
    r.frame = HCI_TABLE_DQ;
    check_fewest(r, &c, 0.2);
}

static void test_peak_is_the_largest_phase_current(void)
{
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    double peak = 0.0;
    for (int k = 0; k < 30000; ++k)
        peak = fmax(peak, fabs(ref_waves_at(c.ref, c.count, k % 3, 2.0 * REF_PI * k / 30000.0)));
    for (int frame = 0; frame < 2; ++frame) {
        r.frame = frame == 0 ? HCI_TABLE_ABC : HCI_TABLE_DQ;
        /* both are the largest of finitely many samples near a flat top */
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * peak, peak, emit_well(&r).peak_A);
    }
}

/* ---- forms ---- */

static void test_two_parts_add_up(void)
{
    currents a = injected();
    const currents b = cogging_part();
    for (size_t k = 0; k < a.count; ++k) {
        a.ref[k].amplitude /= 4.0;
        a.wave[k].sine /= 4.0;
        a.wave[k].cosine /= 4.0;
    }
    for (int frame = 0; frame < 2; ++frame) {
        emitted e;
        hci_emit_request r = request_for(&b);
        r.frame = frame == 0 ? HCI_TABLE_ABC : HCI_TABLE_DQ;
        r.per_Nm = a.wave;
        r.per_Nm_count = a.count;
        r.reference_torque_Nm = 6.0;
        r.max_error_A = 0.2;
        const hci_emit_result result = emit_and_read(&r, &e);
        TEST_ASSERT_EQUAL(2, result.parts);
        TEST_ASSERT_EQUAL_DOUBLE(6.0, (double)e.table.reference_torque_Nm);
        const double worst = worst_error(&e, &a, &b, 6.0, 20000);
        at_most(result.chosen.max_error_A, worst);
        more_than(0.9 * result.chosen.max_error_A, worst);
        r.points = result.chosen.points - 1;
        r.max_error_A = 0.0;
        more_than(0.2, emit_well(&r).chosen.max_error_A);
    }
}

static void test_neutral_conductor_has_three_columns(void)
{
    currents c = injected();
    emitted e;
    add(&c, 3, 0, 2.0, 0.6);
    hci_emit_request r = request_for(&c);
    r.has_neutral = true;
    const hci_emit_result result = emit_and_read(&r, &e);
    TEST_ASSERT_EQUAL(3, result.columns);
    TEST_ASSERT_EQUAL((result.chosen.points + 1) * 3 * 4, result.chosen.bytes);
    /* nothing was said of the size: the fewest points within 1 % of the peak */
    at_most(0.01 * result.peak_A, result.chosen.max_error_A);
    more_than(0.01 * result.peak_A, stated_error(r, result.chosen.points - 1));
    at_most(result.chosen.max_error_A, worst_error(&e, NULL, &c, 0.0, 5000));
}

static void check_period(double first, double second, size_t turns)
{
    emitted e;
    currents c = {.count = 0};
    add(&c, 1, 1, 5.0, 0.0);
    add(&c, first, 1, 1.0, 0.7);
    add(&c, second, -1, 0.5, -1.7);
    hci_emit_request r = request_for(&c);
    r.points = 100 * turns;
    const hci_emit_result result = emit_and_read(&r, &e);
    TEST_ASSERT_EQUAL(turns, result.period_turns);
    for (size_t k = 0; k < c.count; ++k) /* as they are meant */
        c.ref[k].order = floor(c.ref[k].order * (double)turns + 0.5) / (double)turns;
    at_most(result.chosen.max_error_A, worst_error(&e, NULL, &c, 0.0, 5000));
}

static void test_fractional_orders_lengthen_the_period(void)
{
    check_period(5.0, 7.0, 1);
    check_period(0.5, 7.0, 2);
    check_period(0.333333, 7.0, 3);
    check_period(1.0 / 7.0, 2.5, 14);
    check_period(0.0, 12.25, 4);
}

/* An order with few decimals is the fraction that it means: no step where the period closes. */
static void test_rounded_orders_are_made_exact(void)
{
    hci_emit_result result[2];
    for (int k = 0; k < 2; ++k) {
        currents c = {.count = 0};
        add(&c, k == 0 ? 0.333333 : 1.0 / 3.0, 1, 1.0, 0.7);
        add(&c, k == 0 ? 1.666667 : 5.0 / 3.0, -1, 2.0, 0.1);
        const hci_emit_request r = request_for(&c);
        result[k] = emit_well(&r);
    }
    TEST_ASSERT_EQUAL_HEX32(result[1].crc32, result[0].crc32);
}

/* ---- text ---- */

/* CRC-32 byte by byte over little-endian bytes, most literally. */
static uint32_t crc32_of(const float *values, size_t count)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t k = 0; k < count; ++k) {
        uint32_t bits;
        memcpy(&bits, &values[k], 4);
        for (int byte = 0; byte < 4; ++byte) {
            crc ^= bits >> 8 * byte & 0xFFu;
            for (int bit = 0; bit < 8; ++bit)
                crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
        }
    }
    return ~crc;
}

static void test_crc_is_of_the_rows_and_guards_them(void)
{
    const currents c = injected();
    emitted e;
    hci_emit_request r = request_for(&c);
    r.points = 64;
    emit_and_read(&r, &e);
    TEST_ASSERT_EQUAL_HEX32(crc32_of(e.rows, 65 * 2), hci_table_f32_crc32(&e.table));
    TEST_ASSERT_EQUAL_MEMORY(e.rows, e.rows + 64 * 2, 2 * sizeof *e.rows);
    for (size_t k = 0; k < 65 * 2; ++k) {
        const float kept = e.rows[k];
        e.rows[k] = nextafterf(kept, 100.0f);
        TEST_ASSERT_EQUAL(HCI_TABLE_BAD_CRC, hci_table_f32_check(&e.table));
        e.rows[k] = kept;
    }
}

/* A table of other currents that is sound in itself is caught by the probes. */
static void test_probes_catch_other_currents(void)
{
    currents c = injected();
    emitted right, wrong;
    hci_emit_request r = request_for(&c);
    emit_and_read(&r, &right);
    c.wave[2].cosine += 0.5;
    emit_and_read(&r, &wrong);
    wrong.table.probes = right.table.probes;
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_PROBE, hci_table_f32_check(&wrong.table));
    wrong.table.probes = wrong.probes;
    wrong.table.frame = HCI_TABLE_DQ;
    TEST_ASSERT_EQUAL(HCI_TABLE_BAD_PROBE, hci_table_f32_check(&wrong.table));
}

static void test_same_request_same_bytes(void)
{
    static const char *const lines[] = {"machine: A, pole pairs 2", "target: scenario 2"};
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    r.provenance = lines;
    r.provenance_count = 2;
    r.input_hash = 0x0123456789abcdefu;
    (void)emit_well(&r);
    char *header = read_text("ripple_free.h"), *source = read_text("ripple_free.c");
    (void)emit_well(&r);
    char *header_again = read_text("ripple_free.h"), *source_again = read_text("ripple_free.c");
    TEST_ASSERT_EQUAL_STRING(header, header_again);
    TEST_ASSERT_EQUAL_STRING(source, source_again);
    TEST_ASSERT_EQUAL(2, files_count(files_root));
    TEST_ASSERT_NULL(strstr(header, files_root));
    TEST_ASSERT_NULL(strstr(source, files_root));
}

static void expect_motor(const char *name, size_t pole_pairs, const char *line)
{
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    snprintf(r.facts.machine, sizeof r.facts.machine, "%s", name);
    r.facts.pole_pairs = pole_pairs;
    (void)emit_well(&r);
    const char *found = strstr(read_text("ripple_free.h"), " * Motor:");
    TEST_ASSERT_EQUAL(line != NULL, found != NULL);
    if (line) TEST_ASSERT_EQUAL_STRING_LEN(line, found, strlen(line));
}

static void test_motor_is_named_where_it_is_known(void)
{
    expect_motor("", 0, NULL);
    expect_motor("fan", 0, " * Motor:  fan.\n");
    expect_motor("fan", 1, " * Motor:  fan, 1 pole pair.\n");
    expect_motor("", 7, " * Motor:  name not known, 7 pole pairs.\n");
}

static void test_header_says_what_a_reader_must_know(void)
{
    static const char *const lines[] = {"machine: A, pole pairs 2"};
    static const char *const must[] = {"SPDX-License-Identifier: MIT",
                                       "hci_currents_abc i = hci_table_f32_abc(&ripple_free, angle);",
                                       "extern const hci_table_f32 ripple_free;",
                                       "#if HCI_TABLE_VERSION != 2\n#error ",
                                       "2^32 = 1 electrical turn.",
                                       "FNV-1a 0123456789abcdef\n",
                                       "machine: A, pole pairs 2\n",
                                       "Orders: electrical",
                                       "ic_A = -ia_A - ib_A",
                                       "rising zero crossing of the fundamental of phase a's back-EMF"};
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    r.provenance = lines;
    r.provenance_count = 1;
    r.input_hash = 0x0123456789abcdefu;
    (void)emit_well(&r);
    char *header = read_text("ripple_free.h");
    for (size_t k = 0; k < sizeof must / sizeof *must; ++k)
        (void)after(header, must[k]);
}

/* Order 5 of negative sequence in the phases is order 6 of i_d and i_q. */
static void test_header_says_what_a_loop_has_to_follow(void)
{
    static const hci_wave WAVE[] = {{1.0, 1, 4.0, 0.0}, {5.0, -1, 0.5, 0.2}};
    hci_emit_request r = {
        .name = "ripple_free", .format = HCI_EMIT_F32, .currents = WAVE, .current_count = 2};
    (void)emit_well(&r);
    (void)after(read_text("ripple_free.h"), "has to follow up to 5.0 times the electrical frequency");
    r.frame = HCI_TABLE_DQ;
    (void)emit_well(&r);
    (void)after(read_text("ripple_free.h"), "has to follow up to 6.0 times the electrical frequency");
}

/* ---- refusals ---- */

static void refuse(hci_emit_request r, hci_status status, const char *words)
{
    hci_note note = {{0}};
    hci_emit_result result = {.columns = 4711};
    TEST_ASSERT_EQUAL(status, hci_emit(files_root, &r, &result, &note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, words), note.text);
    TEST_ASSERT_EQUAL(4711, result.columns);
    TEST_ASSERT_EQUAL(0, files_count(files_root));
}

static void test_names_that_are_no_identifiers_are_refused(void)
{
    static const char *const bad[] = {"",
                                      "1st",
                                      "a-b",
                                      "a b",
                                      "a.b",
                                      "../a",
                                      "a/b",
                                      "static",
                                      "class",
                                      "and_eq",
                                      "int",
                                      "_a",
                                      "a__b",
                                      "uint32_t",
                                      "hci_x",
                                      "HCI_X",
                                      "linux",
                                      "main",
                                      "caf\xc3\xa9",
                                      "typeof",
                                      "a*/b",
                                      "a123456789012345678901234567890123456789012345678"};
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        r.name = bad[k];
        refuse(r, HCI_ERROR_ARGUMENT, "table name");
    }
    r.name = NULL;
    refuse(r, HCI_ERROR_ARGUMENT, "table name");
}

static void test_other_names_are_taken(void)
{
    static const char *const good[] = {"a", "Motor_1", "statics", "t", "hci", "x_", "CLASS"};
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    for (size_t k = 0; k < sizeof good / sizeof *good; ++k) {
        r.name = good[k];
        (void)emit_well(&r);
    }
    TEST_ASSERT_EQUAL(2 * sizeof good / sizeof *good, files_count(files_root));
}

/* The line of the header that says how a table is read names the function of its format, frame and parts. */
static void test_the_header_says_how_it_is_read(void)
{
    static const struct {
        hci_emit_format format;
        hci_table_frame frame;
        bool has_parts;
        const char *use;
    } CASE[] = {
        {HCI_EMIT_I16, HCI_TABLE_DQ, false, "hci_currents_dq i = hci_table_i16_dq(&ripple_free, angle);"},
        {HCI_EMIT_I16, HCI_TABLE_ABC, true,
         "hci_currents_abc i = hci_table_i16_abc_torque(&ripple_free, angle, torque_Nm);"},
        {HCI_EMIT_Q15, HCI_TABLE_ABC, false, "hci_units_abc i = hci_table_i16_abc_q15(&ripple_free, angle);"},
        {HCI_EMIT_Q15, HCI_TABLE_DQ, true,
         "hci_units_dq i = hci_table_i16_dq_torque_q15(&ripple_free, angle, torque_q15);"},
        {HCI_EMIT_I8, HCI_TABLE_DQ, false, "hci_units_dq i = hci_table_i16_dq_q15(&ripple_free, angle);"}};
    const currents a = injected(), b = cogging_part();
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        hci_emit_request r = request_for(&b);
        r.format = CASE[k].format;
        r.frame = CASE[k].frame;
        r.max_error_A = 0.2;
        if (CASE[k].has_parts) {
            r.per_Nm = a.wave;
            r.per_Nm_count = a.count;
            r.reference_torque_Nm = 1.0;
        }
        (void)emit_well(&r);
        const char *header = read_text("ripple_free.h");
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(header, CASE[k].use), strstr(header, "Use:"));
        TEST_ASSERT_EQUAL(CASE[k].has_parts, strstr(header, "|torque| <= ") != NULL);
        TEST_ASSERT_EQUAL(CASE[k].has_parts, strstr(header, " * Form:   i = torque") != NULL);
        TEST_ASSERT_EQUAL(CASE[k].has_parts && CASE[k].format == HCI_EMIT_Q15,
                          strstr(header, "torque_q15 is 32767 at reference_torque_Nm") != NULL);
    }
}

/* Of a small motor 0.1 N·m may be all; 0 or less is none. */
static void test_any_reference_torque_above_zero_is_taken(void)
{
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    r.per_Nm = c.wave;
    r.per_Nm_count = c.count;
    r.reference_torque_Nm = -0.1;
    refuse(r, HCI_ERROR_ARGUMENT, "reference torque -0.1");
    for (double torque = 0.1; torque > 1e-7; torque *= 0.1) {
        hci_note note = {{0}};
        r.reference_torque_Nm = torque;
        TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, hci_emit(files_root, &r, NULL, &note), note.text);
    }
}

static void test_requests_that_cannot_be_met_are_refused(void)
{
    static const char *const bad_line[] = {"fine", "ends */ here"};
    const currents c = injected();
    hci_emit_request r = request_for(&c);
    r.shape = HCI_EMIT_CUBIC;
    refuse(r, HCI_ERROR_ARGUMENT, "`cubic` with format `f32`");
    r = request_for(&c);
    r.max_error_A = 0.1;
    r.max_bytes = 1000;
    refuse(r, HCI_ERROR_ARGUMENT, "bytes: found at most 1000, but the smallest table takes");
    r = request_for(&c);
    r.max_instructions = 10;
    refuse(r, HCI_ERROR_ARGUMENT,
           "instructions: found at most 10, but a linear table of format f32 takes about 29");
    r = request_for(&c);
    r.format = HCI_EMIT_I16;
    r.points = HCI_TABLE_I16_MOST_INTERVALS + 1;
    refuse(r, HCI_ERROR_ARGUMENT, "4096, expected 1 to 4095");
    r = request_for(&c);
    r.points = 100;
    r.max_error_A = 0.1;
    refuse(r, HCI_ERROR_ARGUMENT, "one of them");
    r.points = 0;
    r.max_error_A = -0.1;
    refuse(r, HCI_ERROR_ARGUMENT, "more than 0");
    r.max_error_A = (double)NAN;
    refuse(r, HCI_ERROR_NOT_FINITE, "finite");
    r.max_error_A = 1e-6;
    refuse(r, HCI_ERROR_ARGUMENT, "65536 points");
    r = request_for(&c);
    r.points = HCI_EMIT_MAX_POINTS + 1;
    refuse(r, HCI_ERROR_ARGUMENT, "65537");
    r = request_for(&c);
    r.provenance = bad_line;
    r.provenance_count = 2;
    refuse(r, HCI_ERROR_ARGUMENT, "provenance");
    r = request_for(&c);
    r.per_Nm = c.wave;
    r.per_Nm_count = c.count;
    refuse(r, HCI_ERROR_ARGUMENT, "reference torque");
}

static void refuse_wave(double order, int sequence, double amplitude, hci_table_frame frame, bool has_neutral,
                        hci_status status, const char *words)
{
    currents c = injected();
    const hci_wave w = {order, sequence, amplitude, 0.0};
    c.wave[c.count++] = w;
    hci_emit_request r = request_for(&c);
    r.frame = frame;
    r.has_neutral = has_neutral;
    refuse(r, status, words);
}

static void test_currents_that_cannot_be_emitted_are_refused(void)
{
    refuse_wave(3, 0, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "star");
    refuse_wave(3, 0, 1.0, HCI_TABLE_DQ, true, HCI_ERROR_ARGUMENT, "dq");
    refuse_wave(-5, 1, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "order -5");
    refuse_wave(5, 2, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "sequence");
    refuse_wave(5, 1, (double)NAN, HCI_TABLE_ABC, false, HCI_ERROR_NOT_FINITE, "order 5");
    refuse_wave((double)INFINITY, 1, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_NOT_FINITE, "finite");
    refuse_wave(5, 1, 3e38, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "single precision");
    refuse_wave(5, 1, 1e300, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "single precision");
    refuse_wave(sqrt(2.0), 1, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "repeat");
    refuse_wave(40000, 1, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "too few");
    refuse_wave(1e300, 1, 1.0, HCI_TABLE_ABC, false, HCI_ERROR_ARGUMENT, "too few");
}

static void test_folder_that_cannot_be_written_is_an_output_error(void)
{
    const currents c = injected();
    const hci_emit_request r = request_for(&c);
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(HCI_ERROR_OUTPUT, hci_emit("/dev/null/x", &r, NULL, &note));
    TEST_ASSERT_NOT_EQUAL(0, note.text[0]);
}

static void test_every_failing_allocation_is_survived(void)
{
    const currents c = injected();
    const hci_emit_request r = request_for(&c);
    hci_status status = HCI_ERROR_MEMORY;
    long succeed = 0;
    for (; status != HCI_OK && succeed < 100; ++succeed) {
        hci_memory_fail_after(succeed);
        status = hci_emit(files_root, &r, NULL, NULL);
        if (status == HCI_OK) break;
        TEST_ASSERT_EQUAL(HCI_ERROR_MEMORY, status);
        TEST_ASSERT_EQUAL(0, files_count(files_root));
    }
    TEST_ASSERT_EQUAL(HCI_OK, status);
    TEST_ASSERT_GREATER_THAN(2, succeed);
}

/* ---- ripple ---- */

/* A sinusoidal machine, whose torque of i_q is 1.5 · 0.4 N·m/A whatever the angle, with cogging torque. */
static const double NM_PER_A = 1.5 * 0.4, COGGING_NM = 0.02;

static hci_machine_data machine_with_cogging(void)
{
    hci_machine_data machine;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL(0, mkdir(files_path("machine"), 0777));
    files_write(files_path("machine/machine.csv"), "name,value,unit\npole_pairs,2,1\n");
    files_write(files_path("machine/back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.4,0\n");
    files_write(files_path("machine/cogging.csv"), "order,amplitude_Nm,phase_rad\n6,0.02,0.3\n");
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_machine_read(files_path("machine"), &machine, &note), note.text);
    return machine;
}

static void widen(double range[2], double x)
{
    range[0] = fmin(range[0], x);
    range[1] = fmax(range[1], x);
}

/* What the emitted text makes of the torque, by the sine formula in double. */
static void ripple_of_text(const emitted *e, const currents *c, double *with_Nm, double *own_Nm)
{
    double with[2] = {HUGE_VAL, -HUGE_VAL}, own[2] = {HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 100000; ++k) {
        const double theta = 2.0 * REF_PI * k / 100000.0;
        double exact[3];
        float read[3];
        reference_currents(c, HCI_TABLE_DQ, theta, exact);
        hci_table_f32_currents(&e->table, (uint32_t)(k / 100000.0 * 4294967296.0), 0.0f, read);
        widen(own, NM_PER_A * ((double)read[1] - exact[1]));
        widen(with, NM_PER_A * (double)read[1] + COGGING_NM * sin(6.0 * theta + 0.3));
    }
    *with_Nm = with[1] - with[0];
    *own_Nm = own[1] - own[0];
}

static void test_ripple_is_that_of_the_emitted_numbers(void)
{
    const currents c = injected();
    hci_machine_data machine = machine_with_cogging();
    emitted e;
    double with_Nm, own_Nm;
    hci_emit_request r = request_for(&c);
    r.frame = HCI_TABLE_DQ;
    r.points = 100;
    r.machine = &machine;
    r.machine_folder = files_path("machine");
    const hci_emit_result result = emit_and_read(&r, &e);
    TEST_ASSERT_EQUAL(1, result.ripples);
    ripple_of_text(&e, &c, &with_Nm, &own_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * own_Nm, own_Nm, result.ripple[0].own_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * with_Nm, with_Nm, result.ripple[0].with_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 2.0 * COGGING_NM, result.ripple[0].sine_Nm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, NM_PER_A * 12.0 * cos(0.2), result.ripple[0].torque_Nm);
    TEST_ASSERT_NOT_NULL(strstr(read_text("ripple_free.h"), " * Ripple: the cut to this table makes "));
    hci_machine_release(&machine);
}

/* What is chosen keeps the part of the table below a tenth of the ripple to expect, and no format is refused.
 */
static void test_chosen_cut_adds_little_to_the_ripple_to_expect(void)
{
    const currents c = injected();
    hci_machine_data machine = machine_with_cogging();
    hci_emit_request r = request_for(&c);
    r.machine = &machine;
    r.machine_folder = files_path("machine");
    for (int form = 0; form < 2 * (HCI_EMIT_CSV + 1); ++form) {
        r.format = (hci_emit_format)(form / 2);
        r.frame = form % 2 == 0 ? HCI_TABLE_ABC : HCI_TABLE_DQ;
        r.expected_ripple_Nm = 0.1;
        const hci_emit_result known = emit_well(&r);
        if (r.format == HCI_EMIT_I8) continue; /* too coarse: as fine as it is */
        at_most(0.01, known.ripple[0].own_Nm);
        more_than(0.002, known.ripple[0].own_Nm);
        r.expected_ripple_Nm = 0.0;
        const hci_emit_result unknown = emit_well(&r);
        at_most(unknown.peak_A / 4096.0, unknown.chosen.max_error_A);
        at_most(16384, (double)unknown.chosen.bytes);
        r.expected_ripple_Nm = 1e6;
        at_most(0.01 * known.peak_A, emit_well(&r).chosen.max_error_A);
    }
    hci_machine_release(&machine);
}

/* Many waves over many turns: nothing but what was asked for is made, unless a size is given. */
static void test_shapes_beside_are_made_where_that_is_quick(void)
{
    enum { WAVES = 120 };
    hci_wave wave[WAVES];
    for (size_t k = 0; k < WAVES; ++k)
        wave[k] = (hci_wave){1.0 + (double)(6 * k) / 14.0, 1, k == 0 ? 10.0 : 0.01, 0.0};
    const currents few = injected();
    hci_emit_request quick = request_for(&few), r = quick;
    r.currents = wave;
    r.current_count = WAVES;
    TEST_ASSERT_EQUAL(1, emit_well(&r).choices);
    r.max_error_A = 0.3;
    TEST_ASSERT_EQUAL(HCI_EMIT_MOST_CHOICES, emit_well(&r).choices);
    TEST_ASSERT_EQUAL(HCI_EMIT_MOST_CHOICES, emit_well(&quick).choices);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_shapes_beside_are_made_where_that_is_quick);
    RUN_TEST(test_ripple_is_that_of_the_emitted_numbers);
    RUN_TEST(test_chosen_cut_adds_little_to_the_ripple_to_expect);
    RUN_TEST(test_stated_error_holds);
    RUN_TEST(test_constant_current_needs_one_point);
    RUN_TEST(test_fewest_points_for_an_error);
    RUN_TEST(test_peak_is_the_largest_phase_current);
    RUN_TEST(test_two_parts_add_up);
    RUN_TEST(test_neutral_conductor_has_three_columns);
    RUN_TEST(test_fractional_orders_lengthen_the_period);
    RUN_TEST(test_rounded_orders_are_made_exact);
    RUN_TEST(test_crc_is_of_the_rows_and_guards_them);
    RUN_TEST(test_probes_catch_other_currents);
    RUN_TEST(test_same_request_same_bytes);
    RUN_TEST(test_motor_is_named_where_it_is_known);
    RUN_TEST(test_header_says_what_a_reader_must_know);
    RUN_TEST(test_header_says_what_a_loop_has_to_follow);
    RUN_TEST(test_names_that_are_no_identifiers_are_refused);
    RUN_TEST(test_other_names_are_taken);
    RUN_TEST(test_the_header_says_how_it_is_read);
    RUN_TEST(test_any_reference_torque_above_zero_is_taken);
    RUN_TEST(test_requests_that_cannot_be_met_are_refused);
    RUN_TEST(test_currents_that_cannot_be_emitted_are_refused);
    RUN_TEST(test_folder_that_cannot_be_written_is_an_output_error);
    RUN_TEST(test_every_failing_allocation_is_survived);
    return UNITY_END();
}
