/* Maps of other makers' drives: written, recognised and read back to the last bit; terms, phases and angles
 * by their formulas; and an allocator that fails at each place. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/host/emit/emit_foreign.h"
#include "host/base/memory.h"
#include "host/foreign/as_recording.h"
#include "host/foreign/code.h"
#include "host/foreign/text.h"
#include "support/files.h"
#include "unity.h"

static hci_foreign_map written, back;
static hci_machine_data machine;
static hci_note note;

void setUp(void)
{
    memset(&written, 0, sizeof written);
    memset(&back, 0, sizeof back);
    memset(&machine, 0, sizeof machine);
    memset(&note, 0, sizeof note);
    files_begin();
}

void tearDown(void)
{
    hci_memory_fail_after(-1);
    hci_foreign_map_release(&written);
    hci_foreign_map_release(&back);
    hci_machine_release(&machine);
    files_end();
}

/* ---- a map that is nobody's ---- */

static double some(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (1 << 23) - 1.0;
}

static void fill_terms(hci_foreign_map *map, unsigned seed)
{
    map->terms = map->type->most_terms;
    for (size_t k = 0; k < map->terms; ++k)
        map->term[k] = (hci_foreign_term){(double)(3 * k + 1), 0.1 + fabs(some(&seed)), 3.0 * some(&seed)};
}

static void fill(hci_foreign_map *map, hci_foreign_name name, unsigned seed)
{
    hci_foreign_map_init(map, hci_foreign_types[name]);
    map->offset_deg = 100.0 * some(&seed);
    map->direction = seed % 2 ? 1 : -1;
    if (map->type->has_counts) map->counts_per_A = 123.4;
    if (map->type->has_wave) map->wave = HCI_FOREIGN_COSINE_LAG;
    if (map->type->most_terms > 0) {
        fill_terms(map, seed);
    } else {
        const size_t points = map->type->points ? map->type->points : 16;
        TEST_ASSERT_EQUAL(HCI_OK, hci_foreign_map_points(map, points, &note));
        for (size_t k = 0; k < points * map->columns; ++k)
            map->value[k] = 2.0 * some(&seed);
    }
    map->type->fit(map);
}

/* One of the files, as text; the first is read back. */
static char *file_of(const hci_foreign_map *map, size_t which)
{
    static const char *const LINES[] = {"a line", NULL};
    const hci_foreign_files files = {.name = "map", .lines = LINES};
    hci_output *out;
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_open(files_path("out"), &out, &note));
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_file(out, "map", &note));
    map->type->write[which](map, &files, out);
    TEST_ASSERT_EQUAL(HCI_OK, hci_output_commit(out, &note));
    const char *kept = files_read(files_path("out/map"));
    char *text = malloc(strlen(kept) + 1);
    return strcpy(text, kept);
}

static char *text_of(const hci_foreign_map *map)
{
    return file_of(map, 0);
}

static void same_map(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(written.offset_deg, back.offset_deg);
    TEST_ASSERT_EQUAL(written.direction, back.direction);
    TEST_ASSERT_EQUAL_DOUBLE(written.counts_per_A, back.counts_per_A);
    TEST_ASSERT_EQUAL(written.wave, back.wave);
    TEST_ASSERT_EQUAL(written.points, back.points);
    TEST_ASSERT_EQUAL(written.terms, back.terms);
    for (size_t k = 0; k < written.points * written.columns; ++k)
        TEST_ASSERT_TRUE(written.value[k] == back.value[k]);
}

static void same_currents(void)
{
    for (int k = 0; k < 5000; ++k) {
        double a[2], b[2];
        written.type->at(&written, k / 5000.0, 0.01 * (k % 30), a);
        back.type->at(&back, k / 5000.0, 0.01 * (k % 30), b);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, a[0], b[0]);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-12, a[1], b[1], written.type->word);
    }
}

static void test_read_back_is_what_was_written(void)
{
    for (int name = 0; name < HCI_FOREIGN_TARGET_COUNT; ++name)
        for (unsigned seed = 1; seed < 4; ++seed) {
            fill(&written, (hci_foreign_name)name, seed);
            char *text = text_of(&written);
            TEST_ASSERT_EQUAL_STRING(written.type->word, hci_foreign_recognise(text)->word);
            TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_foreign_read(written.type, "map", text, &back, &note),
                                      note.text);
            same_map();
            same_currents();
            free(text);
            hci_foreign_map_release(&written);
            hci_foreign_map_release(&back);
        }
}

/* A wave is a whole word; any other one leaves the sine. */
static void test_the_wave_of_a_head(void)
{
    for (int wave = 0; wave <= HCI_FOREIGN_COSINE_LAG; ++wave)
        for (int whole = 0; whole < 2; ++whole) {
            char text[120];
            snprintf(text, sizeof text, "# wave %s%s\n# a b c d e f g h i j k l m n\n",
                     hci_foreign_wave_word((hci_foreign_wave)wave), whole ? "" : "s");
            hci_foreign_map_init(&back, &hci_foreign_beckhoff);
            TEST_ASSERT_EQUAL(HCI_OK, hci_foreign_read_head("map", text, &back, &note));
            TEST_ASSERT_EQUAL_MESSAGE(whole ? wave : HCI_FOREIGN_SINE, back.wave, text);
        }
}

/* The value of a subindex of the drive's list in place of what stands there. */
static hci_status read_beckhoff(const char *start, const char *value)
{
    fill(&written, HCI_FOREIGN_BECKHOFF, 1);
    char *text = text_of(&written), changed[8192];
    const char *cell = strstr(text, start) + strlen(start), *rest = cell + strcspn(cell, ",");
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(cell - text), text, value, rest);
    const hci_status status = hci_foreign_read(written.type, "map", changed, &back, &note);
    free(text);
    hci_foreign_map_release(&written);
    hci_foreign_map_release(&back);
    return status;
}

static void test_ranges_of_beckhoff(void)
{
    static const struct {
        const char *start, *good, *bad[2];
    } CASE[] = {{"CB,0x07,UINT32,", "200", {"201", "1.5"}},
                {"CB,0x08,REAL32,", "360", {"360.5", "-1"}},
                {"CB,0x23,REAL32,", "0", {"361", "-0.5"}},
                {"CB,0x24,REAL32,", "1000", {"-0.001", "nan"}}};
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; ++k) {
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, read_beckhoff(CASE[k].start, CASE[k].good), note.text);
        for (size_t j = 0; j < 2; ++j) {
            TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, read_beckhoff(CASE[k].start, CASE[k].bad[j]),
                                      CASE[k].bad[j]);
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "0x32CB"), note.text);
        }
    }
}

/* A map that adds nothing adds 0, in either direction, and not -0. */
static void test_nothing_is_zero_without_a_sign(void)
{
    for (int name = 0; name < HCI_FOREIGN_TARGET_COUNT; ++name)
        for (int direction = -1; direction <= 1; direction += 2) {
            char *csv;
            fill(&written, (hci_foreign_name)name, 1);
            written.direction = direction;
            written.terms = 0;
            for (size_t k = 0; k < written.points * written.columns; ++k)
                written.value[k] = 0.0;
            TEST_ASSERT_EQUAL(HCI_OK, hci_foreign_as_csv(&written, &csv, &note));
            TEST_ASSERT_NULL_MESSAGE(strstr(csv, ",-0"), written.type->word);
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(csv, ",0\n"), written.type->word);
            hci_memory_free(csv);
            hci_foreign_map_release(&written);
        }
}

/* ---- rows of C ---- */

/* Two or four numbers in each of 2, 4, 8 … 4096 rows, and nothing else. */
static void test_rows_that_are_none(void)
{
    static const char *const NONE[] = {"float t;", "t[] ={{1, 2}, {3, 4}}"},
                             *const OTHER[] = {
                                 "t = {}",
                                 "t = {{1, 2}}",
                                 "t = {{1, 2}, {3, 4}, {5, 6}}",
                                 "t = {{1}, {2}}",
                                 "t = {{1, 2, 3}, {4, 5, 6}}",
                                 "t = {{1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}}",
                                 "t = {{1, 2}, {1, 2, 3, 4}}",
                                 "t = {{1, 2, 3, 4}, {1, 2}}",
                                 "t = {{}, {1, 2}}",
                                 "t = {{1, 2}, {x, 2}}",
                                 "t = {{1, 2}, {3, 4}",
                                 "t = {{1, 2}, {3, 4",
                                 "t = {{1, 2}, {3, 4}; }",
                                 "t = {1, 2, 3, 4}",
                             };
    for (size_t k = 0; k < sizeof NONE / sizeof *NONE + sizeof OTHER / sizeof *OTHER; ++k) {
        const char *text = k < 2 ? NONE[k] : OTHER[k - 2];
        hci_foreign_map_init(&back, &hci_foreign_simplefoc);
        memset(&note, 0, sizeof note);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_ERROR_INPUT, hci_foreign_read_rows("a/map.h", text, &back, &note),
                                  text);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(
            k < 2
                ? "a/map.h: found no table, expected rows {…} of 2 or 4 numbers, a power of two of them up "
                  "to "
                  "4096; emit it again"
                : "a/map.h: found other rows, expected rows {…} of 2 or 4 numbers, a power of two of them up "
                  "to 4096; emit it again",
            note.text, text);
        hci_foreign_map_release(&back);
    }
}

/* Columns that a row does not have are 0; a float has its letter or not. */
static void test_rows_of_two_and_four(void)
{
    static const struct {
        const char *text;
        double value[8];
    } CASE[] = {{"t[2][2] = {\n  {1.5f, -2},\r\n  {3,4e1f}};", {1.5, -2.0, 0.0, 0.0, 3.0, 40.0, 0.0, 0.0}},
                {"= {{1,2,3,4}, {5f, 6f, -7f, 8.25f},}", {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, -7.0, 8.25}}};
    for (size_t k = 0; k < 2; ++k) {
        hci_foreign_map_init(&back, &hci_foreign_simplefoc);
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_foreign_read_rows("map", CASE[k].text, &back, &note),
                                  note.text);
        TEST_ASSERT_EQUAL_UINT64(2, back.points);
        for (size_t j = 0; j < 8; ++j)
            TEST_ASSERT_EQUAL_DOUBLE(CASE[k].value[j], back.value[j]);
        hci_foreign_map_release(&back);
    }
}

static void test_the_most_rows(void)
{
    for (size_t rows = 2048; rows <= 8192; rows *= 2) {
        char *text = calloc(rows + 2, 8), *end = text + sprintf(text, "= {");
        for (size_t k = 0; k < rows; ++k)
            end += sprintf(end, "{%zu,1},", k % 10);
        strcpy(end, "}");
        hci_foreign_map_init(&back, &hci_foreign_simplefoc);
        TEST_ASSERT_EQUAL(rows <= 4096 ? HCI_OK : HCI_ERROR_INPUT,
                          hci_foreign_read_rows("map", text, &back, &note));
        TEST_ASSERT_TRUE(rows > 4096 || (back.points == rows && back.value[4 * (rows - 1) + 1] == 1.0));
        hci_foreign_map_release(&back);
        free(text);
    }
}

static unsigned byte_at(const char *text)
{
    unsigned byte;
    TEST_ASSERT_EQUAL(1, sscanf(text, "%2X", &byte));
    return byte;
}

/* The records of an Intel HEX: whole by their sums, and in them amplitude, phase and order, low bytes first.
 */
static void test_the_flash_of_openffboard(void)
{
    unsigned char flash[256] = {0};
    fill(&written, HCI_FOREIGN_OPENFFBOARD, 1);
    char *text = file_of(&written, 1);
    for (const char *line = strchr(text, ':'); line != NULL; line = strchr(line + 1, ':')) {
        const unsigned count = byte_at(line + 1), address = byte_at(line + 3) << 8 | byte_at(line + 5);
        unsigned sum = 0;
        for (unsigned k = 0; k < count + 5; ++k)
            sum += byte_at(line + 1 + 2 * k);
        TEST_ASSERT_EQUAL(0, sum & 255);
        for (unsigned k = 0; byte_at(line + 7) == 0 && k < count; ++k)
            flash[address + k] = (unsigned char)byte_at(line + 9 + 2 * k);
    }
    for (size_t k = 0; k < written.terms; ++k) {
        const unsigned char *b = flash + 12 * k;
        for (int part = 0; part < 2; ++part) {
            const uint32_t bits = b[4 * part] | (uint32_t)b[4 * part + 1] << 8 |
                                  (uint32_t)b[4 * part + 2] << 16 | (uint32_t)b[4 * part + 3] << 24;
            const float wanted = part ? (float)written.term[k].phase_rad
                                      : (float)(written.term[k].amplitude * written.counts_per_A);
            float found;
            memcpy(&found, &bits, sizeof found);
            TEST_ASSERT_TRUE(found == wanted);
        }
        TEST_ASSERT_EQUAL((unsigned)written.term[k].order, b[8] | b[9] << 8);
    }
    free(text);
}

static void test_other_files_are_not_maps(void)
{
    static const char *const TEXT[] = {"",
                                       "#\n",
                                       "[\n",
                                       "a,b\n1,2\n",
                                       "12:30:05,1.5\n12:30:06,1.6\n",
                                       "time_s,theta_m_rad,iq_A\n0,0,1\n",
                                       "theta_m_rad,id_A,iq_A,torque_Nm\n0,0,1,0\n",
                                       "index,subindex,type,value,name\n0x1000,0x00,UINT32,1,device\n",
                                       "motor.poles 4\nmotor.cogging_dq_scale 0.1\n"};
    for (size_t k = 0; k < sizeof TEXT / sizeof *TEXT; ++k)
        TEST_ASSERT_NULL_MESSAGE(hci_foreign_recognise(TEXT[k]), TEXT[k]);
}

/* Any beginning of a map is refused or read, and nothing is left. */
static void test_cut_off_anywhere(void)
{
    for (int name = 0; name < HCI_FOREIGN_TARGET_COUNT; ++name) {
        fill(&written, (hci_foreign_name)name, 7);
        char *text = text_of(&written);
        const size_t size = strlen(text), step = size / 300 + 1;
        for (size_t length = size; length > step; length -= step) {
            char *part = malloc(length + 1);
            memcpy(part, text, length);
            part[length] = '\0';
            const hci_foreign_type *type = hci_foreign_recognise(part);
            hci_note why = {{0}};
            const hci_status status = type ? hci_foreign_read(type, "part", part, &back, &why) : HCI_OK;
            TEST_ASSERT_EQUAL(status != HCI_OK, why.text[0] != '\0');
            hci_foreign_map_release(&back);
            free(part);
        }
        free(text);
        hci_foreign_map_release(&written);
    }
}

/* ---- formulas ---- */

static void test_terms_are_the_strongest_orders(void)
{
    enum { SAMPLES = 512 };
    double value[SAMPLES];
    hci_foreign_map_init(&written, &hci_foreign_beckhoff);
    for (int k = 0; k < SAMPLES; ++k) {
        const double x = 2.0 * HCI_PI * k / SAMPLES;
        value[k] = 3.0; /* a mean is no term */
        for (int n = 1; n <= 12; ++n)
            value[k] += n * sin(5 * n * x + 0.1 * n);
    }
    hci_foreign_find_terms(&written, value, SAMPLES);
    TEST_ASSERT_EQUAL(10, written.terms);
    TEST_ASSERT_EQUAL(2, written.left_out);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, written.left_out_amplitude);
    for (size_t k = 0; k < 10; ++k) {
        const double n = 12.0 - (double)k;
        TEST_ASSERT_EQUAL_DOUBLE(5.0 * n, written.term[k].order);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, n, written.term[k].amplitude);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1 * n, written.term[k].phase_rad);
    }
}

/* Of ten samples orders below the fifth; what is below 1e-4 of the largest value is none. */
static void test_terms_of_few_samples(void)
{
    enum { SAMPLES = 10 };
    double value[SAMPLES];
    hci_foreign_map_init(&written, &hci_foreign_beckhoff);
    for (int k = 0; k < SAMPLES; ++k) {
        const double x = 2.0 * HCI_PI * k / SAMPLES;
        value[k] = 2.0 * sin(4.0 * x + 0.7) + 5.0 * cos(5.0 * x) + 9e-4 * sin(2.0 * x) + 5e-4 * sin(3.0 * x);
    }
    hci_foreign_find_terms(&written, value, SAMPLES);
    TEST_ASSERT_EQUAL(2, written.terms);
    TEST_ASSERT_EQUAL(0, written.left_out);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, written.term[0].order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, written.term[0].amplitude);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.7, written.term[0].phase_rad);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, written.term[1].order);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 9e-4, written.term[1].amplitude);
}

static double wave_at(hci_foreign_wave wave, double x, double phase)
{
    switch (wave) {
    case HCI_FOREIGN_SINE:
        return sin(x + phase);
    case HCI_FOREIGN_COSINE:
        return cos(x + phase);
    case HCI_FOREIGN_SINE_LAG:
        return sin(x - phase);
    case HCI_FOREIGN_COSINE_LAG:
        break;
    }
    return cos(x - phase);
}

static void test_waves_are_the_same_sine(void)
{
    hci_foreign_map_init(&written, &hci_foreign_beckhoff);
    for (int wave = 0; wave <= HCI_FOREIGN_COSINE_LAG; ++wave)
        for (double phase = -7.0; phase < 7.0; phase += 0.3) {
            written.wave = (hci_foreign_wave)wave;
            const double there = hci_foreign_phase_in_file(&written, phase);
            TEST_ASSERT_TRUE(there >= 0.0 && there < 2.0 * HCI_PI);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, sin(0.8 + phase), wave_at(written.wave, 0.8, there));
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, sin(0.8 + phase),
                                      sin(0.8 + hci_foreign_phase_of_file(&written, there)));
        }
}

static void test_angle_there_and_back(void)
{
    fill(&written, HCI_FOREIGN_MCSDK, 5);
    for (double theta = -9.0; theta < 9.0; theta += 0.37) {
        const double turn = hci_foreign_turn(&written, theta);
        TEST_ASSERT_TRUE(turn >= 0.0 && turn < 1.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, sin(0.5 * (hci_foreign_theta_rad(&written, turn) - theta)));
    }
}

/* Between two rows a drive goes straight, and from the last one to the first: hat functions; for each ampere
 * of its own it adds the third and fourth column. Harmonics are sines of the drive's angle. */
static void added_by(const hci_foreign_map *map, double turn, double own_A, double add[2])
{
    add[0] = add[1] = 0.0;
    for (size_t j = 0; j < map->terms; ++j)
        add[1] += map->term[j].amplitude *
                  sin(map->term[j].order * turn * 2.0 * 3.14159265358979324 + map->term[j].phase_rad);
    for (size_t j = 0; j < map->points; ++j) {
        const double apart = fabs(turn * (double)map->points - (double)j),
                     around = (double)map->points - apart;
        const double share = fmax(0.0, 1.0 - fmin(apart, around)), *v = map->value + j * map->columns;
        if (map->columns == 1) add[1] += share * v[0];
        for (size_t c = 0; c < 2 && map->columns > 1; ++c)
            add[c] += share * (v[c] + (map->columns == 4 ? own_A * v[2 + c] : 0.0));
    }
}

static void test_what_drives_make_of_a_map(void)
{
    for (int name = 0; name < HCI_FOREIGN_TARGET_COUNT; ++name) {
        const hci_foreign_type *type = hci_foreign_types[name];
        const bool exact = name == HCI_FOREIGN_CSV;
        const bool straight = exact || name == HCI_FOREIGN_SIMPLEFOC || name == HCI_FOREIGN_MOTEUS;
        if (!straight && type->most_terms == 0) continue;
        fill(&written, (hci_foreign_name)name, 7);
        const double near = exact ? 1e-12 : written.counts_per_A > 0.0 ? 1.0 / written.counts_per_A : 2e-4;
        for (int k = 0; k < 997; ++k) {
            const double turn = k / 997.0, own_A = 0.7 * (k % 5) - 1.1;
            double add[2], wanted[2];
            type->at(&written, turn, own_A, add);
            added_by(&written, turn, own_A, wanted);
            for (int c = 0; c < 2; ++c)
                TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(near, wanted[c], add[c], type->word);
        }
        hci_foreign_map_release(&written);
    }
}

/* In single precision an angle may be rounded to a whole turn, which is the first row. */
static void test_the_end_of_a_turn(void)
{
    double first[2], last[2];
    fill(&written, HCI_FOREIGN_SIMPLEFOC, 7);
    written.type->at(&written, 0.0, 0.4, first);
    written.type->at(&written, 1.0 - 1e-12, 0.4, last);
    for (int c = 0; c < 2; ++c)
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, first[c], last[c]);
    hci_foreign_map_release(&written);
}

/* A chord of a smooth curve is as far above it as below. */
static void test_balanced_nodes_halve_the_error(void)
{
    enum { POINTS = 64 };
    double low = 0.0, high = 0.0;
    hci_foreign_map_init(&written, &hci_foreign_moteus);
    TEST_ASSERT_EQUAL(HCI_OK, hci_foreign_map_points(&written, POINTS, &note));
    for (int k = 0; k < POINTS; ++k)
        written.value[k] = sin(4.0 * HCI_PI * k / POINTS);
    TEST_ASSERT_EQUAL(HCI_OK, hci_foreign_balance(&written, &note));
    for (int k = 0; k < 4096; ++k) {
        double value;
        hci_foreign_line(&written, k / 4096.0, &value);
        const double off = value - sin(4.0 * HCI_PI * k / 4096.0);
        low = fmin(low, off);
        high = fmax(high, off);
    }
    const double step = 4.0 * HCI_PI / POINTS;
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * step * step / 16.0, step * step / 16.0, high);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * step * step / 16.0, -step * step / 16.0, low);
}

/* ---- out of memory ---- */

static hci_status emit(hci_foreign_name target)
{
    const hci_wave current = {1.0, 1, 0.0, 2.0}; /* i_d: one torque less to tell */
    const hci_emit_foreign_request request = {.name = "map",
                                              .target = target,
                                              .machine_folder = "data/machine_a",
                                              .machine = &machine,
                                              .currents = &current,
                                              .current_count = 1,
                                              .counts_per_A =
                                                  hci_foreign_types[target]->has_counts ? 100.0 : 0.0,
                                              .encoder_direction = 1};
    memset(&note, 0, sizeof note);
    return hci_emit_foreign(files_path("emitted"), &request, NULL, &note);
}

static void test_out_of_memory_leaves_nothing(void)
{
    TEST_ASSERT_EQUAL(HCI_OK, hci_machine_read("data/machine_a", &machine, &note));
    /* a table, and harmonics with three files */
    static const hci_foreign_name TARGET[] = {HCI_FOREIGN_MCSDK, HCI_FOREIGN_OPENFFBOARD};
    for (size_t which = 0; which < 2; ++which) {
        hci_status status = HCI_ERROR_MEMORY;
        for (long k = 0; status == HCI_ERROR_MEMORY; ++k) {
            hci_memory_fail_after(k);
            status = emit(TARGET[which]);
            hci_memory_fail_after(-1);
            TEST_ASSERT_TRUE(!status || files_count(files_path("emitted")) <= 0);
        }
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
        files_remove(files_path("emitted"));
    }
}

static void test_out_of_memory_when_reading(void)
{
    for (int name = 0; name < HCI_FOREIGN_TARGET_COUNT; ++name) {
        hci_csv *csv = NULL;
        hci_status status = HCI_ERROR_MEMORY;
        fill(&written, (hci_foreign_name)name, 3);
        free(text_of(&written));
        for (long k = 0; status == HCI_ERROR_MEMORY; ++k) {
            memset(&note, 0, sizeof note);
            hci_memory_fail_after(k);
            status = hci_csv_read(files_path("out/map"), &csv, &note);
            hci_memory_fail_after(-1);
        }
        TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, status, note.text);
        TEST_ASSERT_EQUAL_STRING(written.type->word, hci_csv_map_of(csv));
        hci_csv_free(csv);
        hci_foreign_map_release(&written);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_read_back_is_what_was_written);
    RUN_TEST(test_the_wave_of_a_head);
    RUN_TEST(test_ranges_of_beckhoff);
    RUN_TEST(test_nothing_is_zero_without_a_sign);
    RUN_TEST(test_rows_that_are_none);
    RUN_TEST(test_rows_of_two_and_four);
    RUN_TEST(test_the_most_rows);
    RUN_TEST(test_the_flash_of_openffboard);
    RUN_TEST(test_other_files_are_not_maps);
    RUN_TEST(test_cut_off_anywhere);
    RUN_TEST(test_terms_are_the_strongest_orders);
    RUN_TEST(test_terms_of_few_samples);
    RUN_TEST(test_waves_are_the_same_sine);
    RUN_TEST(test_angle_there_and_back);
    RUN_TEST(test_what_drives_make_of_a_map);
    RUN_TEST(test_the_end_of_a_turn);
    RUN_TEST(test_balanced_nodes_halve_the_error);
    RUN_TEST(test_out_of_memory_leaves_nothing);
    RUN_TEST(test_out_of_memory_when_reading);
    return UNITY_END();
}
