/* The published machines, currents and scenarios in data/: figures as printed, and what the model makes of
 * them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/machine/system.h"
#include "hci/machine/torque.h"
#include "support/reference.h"
#include "unity.h"

enum { MAX_ROWS = 64, MAX_FIELDS = 4, MAX_TEXT = 160, MAX_ORDERS = 1024 };

typedef struct {
    size_t count;
    char field[MAX_ROWS][MAX_FIELDS][MAX_TEXT];
} table;

void setUp(void)
{
}

void tearDown(void)
{
}

static int next_line(FILE *file, char line[512])
{
    do {
        if (fgets(line, 512, file) == NULL) return 0;
    } while (line[0] == '#');
    line[strcspn(line, "\n")] = '\0';
    return 1;
}

static void split(const char *line, char field[MAX_FIELDS][MAX_TEXT])
{
    for (int k = 0; k < MAX_FIELDS; ++k) {
        const size_t length = strcspn(line, ",");
        TEST_ASSERT_TRUE(length < MAX_TEXT);
        memcpy(field[k], line, length);
        field[k][length] = '\0';
        line += length + (line[length] == ',');
    }
    TEST_ASSERT_EQUAL_STRING_MESSAGE("", line, "too many fields");
}

/* A table of at most four columns without quotes. */
static void read_table(const char *path, const char *header, table *out)
{
    char line[512] = "";
    FILE *file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    out->count = 0;
    next_line(file, line);
    TEST_ASSERT_EQUAL_STRING_MESSAGE(header, line, path);
    while (next_line(file, line)) {
        TEST_ASSERT_TRUE_MESSAGE(out->count < MAX_ROWS, path);
        split(line, out->field[out->count++]);
    }
    fclose(file);
}

static double number(const table *t, size_t row, size_t column)
{
    char *end = NULL;
    const double x = strtod(t->field[row][column], &end);
    TEST_ASSERT_TRUE_MESSAGE(end != t->field[row][column] && *end == '\0', t->field[row][column]);
    return x;
}

static const char *machine_file(char machine, const char *name)
{
    static char path[64];
    snprintf(path, sizeof path, "data/machine_%c/%s.csv", machine, name);
    return path;
}

static const char *scenario_file(int scenario, const char *name)
{
    static char path[64];
    snprintf(path, sizeof path, "data/scenarios/%02d/%s.csv", scenario, name);
    return path;
}

static const char *value_of(const table *t, const char *name)
{
    for (size_t k = 0; k < t->count; ++k)
        if (strcmp(t->field[k][0], name) == 0) return t->field[k][1];
    TEST_FAIL_MESSAGE(name);
    return "";
}

/* Tables 4 and 5 as printed, typed a second time. */
static const double EMF_ORDER[5] = {1, 5, 7, 11, 13};
static const double EMF_V[2][5] = {{21.93, -5.02, 4.80, -8.10, -1.61}, {111.53, 13.39, 3.39, -2.10, -2.07}};
static const double COGGING_NM[2][7] = {{0.0021, 0.3102, 0.0031, 0.3702, 0.0011, 0.2470, 0.0000},
                                        {0.0000, 0.2246, 0.0374, 0.1402, 0.0691, 0.0000, 0.0241}};
static const double COGGING_RAD[2][7] = {{1.22, 1.76, -1.57, -1.19, 1.88, 2.15, 0.00},
                                         {0.00, 1.76, -1.29, -1.19, -1.10, 0.00, 2.23}};

static void test_machines_are_tables_2_to_5(void)
{
    static table t;
    for (int m = 0; m < 2; ++m) {
        const char machine = (char)('a' + m);
        read_table(machine_file(machine, "machine"), "name,value,unit,source", &t);
        TEST_ASSERT_EQUAL_STRING("2", value_of(&t, "pole_pairs"));
        TEST_ASSERT_EQUAL_STRING("50", value_of(&t, "emf_frequency"));
        TEST_ASSERT_EQUAL_STRING("star", value_of(&t, "connection"));
        TEST_ASSERT_EQUAL_STRING("12", value_of(&t, "rated_current"));
        for (size_t k = 0; k < t.count; ++k)
            TEST_ASSERT_TRUE(strlen(t.field[k][3]) > 0);

        read_table(machine_file(machine, "back_emf"), "order,amplitude_V,phase_rad", &t);
        TEST_ASSERT_EQUAL_UINT64(5, t.count);
        for (size_t k = 0; k < 5; ++k) {
            TEST_ASSERT_EQUAL_DOUBLE(EMF_ORDER[k], number(&t, k, 0));
            TEST_ASSERT_EQUAL_DOUBLE(EMF_V[m][k], number(&t, k, 1));
            TEST_ASSERT_EQUAL_DOUBLE(0.0, number(&t, k, 2));
        }
        read_table(machine_file(machine, "cogging"), "order,amplitude_Nm,phase_rad", &t);
        TEST_ASSERT_EQUAL_UINT64(7, t.count);
        for (size_t k = 0; k < 7; ++k) {
            TEST_ASSERT_EQUAL_DOUBLE(6.0 * (double)(k + 1), number(&t, k, 0));
            TEST_ASSERT_EQUAL_DOUBLE(COGGING_NM[m][k], number(&t, k, 1));
            TEST_ASSERT_EQUAL_DOUBLE(COGGING_RAD[m][k], number(&t, k, 2));
        }
    }
}

/* Volts at 50 Hz to N·m/A: ω_m = 2π·50/(pole pairs). */
static size_t read_back_emf(char machine, hci_wave *waves)
{
    static table t;
    read_table(machine_file(machine, "machine"), "name,value,unit,source", &t);
    const double omega_m =
        2.0 * REF_PI * strtod(value_of(&t, "emf_frequency"), NULL) / strtod(value_of(&t, "pole_pairs"), NULL);
    read_table(machine_file(machine, "back_emf"), "order,amplitude_V,phase_rad", &t);
    for (size_t k = 0; k < t.count; ++k)
        waves[k] = hci_wave_polar(number(&t, k, 0), hci_sequence_of_order(number(&t, k, 0)),
                                  number(&t, k, 1) / omega_m, number(&t, k, 2));
    return t.count;
}

static double amplitude_at(const hci_harmonic *spectrum, size_t count, double order)
{
    for (size_t k = 0; k < count; ++k)
        if (fabs(spectrum[k].order - order) < 1e-3) return hypot(spectrum[k].sine, spectrum[k].cosine);
    return 0.0;
}

/* Mutual torque of 12 A and 0.2 rad, sampled from Eq. (3), (5) and (7) with the printed figures. */
static void transform_table_3(int m, ref_spectrum *out)
{
    double samples[REF_SAMPLES];
    for (size_t j = 0; j < REF_SAMPLES; ++j) {
        const double theta = ref_theta(j, 1);
        samples[j] = 0.0;
        for (int s = 0; s < 3; ++s) {
            double e = 0.0;
            for (size_t k = 0; k < 5; ++k)
                e += EMF_V[m][k] / (REF_PI * 50.0) * sin(EMF_ORDER[k] * (theta - 2.0 * REF_PI * s / 3.0));
            samples[j] += e * 12.0 * sin(theta - 2.0 * REF_PI * s / 3.0 + 0.2);
        }
    }
    ref_transform(samples, out);
}

/* Mean, order 6 and order 12 in N·m to three decimals, from E_1 cos 0.2 and |E_7 e^{-j0.2} − E_5 e^{j0.2}|
 * and |E_13 e^{-j0.2} − E_11 e^{j0.2}|, each times (3/2)·12 A; the published figures carry no more. */
static const double TABLE_3_NM[2][3] = {{2.463, 1.103, 0.762}, {12.526, 1.186, 0.095}};

static void test_mutual_torque_at_table_3(void)
{
    const hci_wave current = hci_wave_polar(1, 1, 12.0, 0.2);
    for (int m = 0; m < 2; ++m) {
        hci_wave emf[8];
        hci_harmonic spectrum[64];
        double orders[64];
        size_t count = 0;
        ref_spectrum reference;
        const hci_machine machine = {2, emf, read_back_emf((char)('a' + m), emf), NULL, 0, NULL, 0};
        TEST_ASSERT_EQUAL_INT(HCI_OK, hci_torque_orders(&machine, &current, 1, orders, 64, &count));
        hci_torque_spectrum(&machine, &current, 1, orders, count, spectrum);
        transform_table_3(m, &reference);
        printf("machine %c: mean %.6f N·m, order 6 %.6f N·m, order 12 %.6f N·m\n", 'A' + m,
               spectrum[0].cosine, amplitude_at(spectrum, count, 6), amplitude_at(spectrum, count, 12));
        TEST_ASSERT_DOUBLE_WITHIN(0.0005, TABLE_3_NM[m][0], spectrum[0].cosine);
        TEST_ASSERT_DOUBLE_WITHIN(0.0005, TABLE_3_NM[m][1], amplitude_at(spectrum, count, 6));
        TEST_ASSERT_DOUBLE_WITHIN(0.0005, TABLE_3_NM[m][2], amplitude_at(spectrum, count, 12));
        /* rounding of 256 samples of at most 25 N·m */
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, ref_distance(&reference, spectrum, count, 1, NULL));
    }
}

static size_t read_currents(const char *path, const char *set, ref_wave *waves)
{
    static table t;
    read_table(path, "order,set,amplitude_A,phase_rad", &t);
    for (size_t k = 0; k < t.count; ++k) {
        TEST_ASSERT_EQUAL_STRING(set, t.field[k][1]);
        const double order = number(&t, k, 0);
        waves[k] =
            (ref_wave){order, strcmp(set, "sym") == 0 ? order : 1.0, number(&t, k, 2), number(&t, k, 3)};
    }
    return t.count;
}

static void test_example_currents_are_table_1_twice(void)
{
    static const double expected[7][3] = {{1, 10, 0},     {2, 2, 0.25},  {4, 1, 0},      {5, 0.5, 0},
                                          {7, 0.25, 0.5}, {8, 0.125, 1}, {10, 0.0625, 0}};
    ref_wave sym[8], asym[8];
    TEST_ASSERT_EQUAL_UINT64(7, read_currents("data/example_currents/currents.csv", "sym", sym));
    TEST_ASSERT_EQUAL_UINT64(7,
                             read_currents("data/example_currents/currents_asymmetrical.csv", "asym", asym));
    for (int k = 0; k < 7; ++k) {
        TEST_ASSERT_EQUAL_DOUBLE(expected[k][0], sym[k].order);
        TEST_ASSERT_EQUAL_DOUBLE(expected[k][1], sym[k].amplitude);
        TEST_ASSERT_EQUAL_DOUBLE(expected[k][2] * REF_PI, sym[k].phase);
        TEST_ASSERT_EQUAL_DOUBLE(sym[k].order, asym[k].order);
        TEST_ASSERT_EQUAL_DOUBLE(sym[k].amplitude, asym[k].amplitude);
        TEST_ASSERT_EQUAL_DOUBLE(sym[k].phase, asym[k].phase);
    }
}

/* Figure 1: both systems sum to zero; in the symmetrical one each phase repeats the one before a third of a
 * turn later, in the asymmetrical one it does not. */
static void test_example_currents_are_a_symmetrical_and_an_asymmetrical_system(void)
{
    ref_wave sym[8], asym[8];
    double difference = 0.0;
    const size_t n = read_currents("data/example_currents/currents.csv", "sym", sym);
    read_currents("data/example_currents/currents_asymmetrical.csv", "asym", asym);
    for (int k = 0; k < 100; ++k) {
        const double theta = 0.063 * k, third = 2.0 * REF_PI / 3.0;
        const ref_wave *const both[2] = {sym, asym};
        for (int b = 0; b < 2; ++b)
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0,
                                      ref_waves_at(both[b], n, 0, theta) +
                                          ref_waves_at(both[b], n, 1, theta) +
                                          ref_waves_at(both[b], n, 2, theta));
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, ref_waves_at(sym, n, 0, theta - third),
                                  ref_waves_at(sym, n, 1, theta));
        difference =
            ref_worse(difference, ref_waves_at(asym, n, 0, theta - third) - ref_waves_at(asym, n, 1, theta));
    }
    TEST_ASSERT_TRUE(difference > 1.0);
}

/* Table 6 typed a second time. `rank`: of U over the orders > 0 that the set reaches with the back-EMF of
 * Table 4, from a singular value decomposition of sampled and transformed torques. */
typedef struct {
    const char *sym, *asym;
    double ripple[3][3]; /* order, amplitude in N·m, phase in rad; order 0 ends */
    size_t rank;
} scenario;

#define PAPER_SYM  "5 11 29 35"
#define SHARED_SET "5 7 13 19 25 29 31 37"

static const scenario TABLE_6[12] = {
    {"", "", {{0, 0, 0}}, 0},
    {PAPER_SYM, SHARED_SET, {{0, 0, 0}}, 20},
    {PAPER_SYM, "2 5 6 7 8 12 13 14 18 19 23 25 27 29 31 37", {{1, 3, 1}}, 36},
    {PAPER_SYM, "3 5 7 9 11 13 15 17 19 20 22 23 25 26 28 31 37", {{2, 3, 0}}, 38},
    {"4 " PAPER_SYM, "2 4 5 7 8 10 13 14 16 19 25 29 31 37", {{3, 3, 0}}, 32},
    {PAPER_SYM, SHARED_SET, {{4, 3, 0}}, 20},
    {PAPER_SYM, SHARED_SET, {{5, 3, 0}}, 20},
    {PAPER_SYM, SHARED_SET, {{6, 3, 0}}, 20},
    {PAPER_SYM, "4 5 7 10 13 17 19 23 25 29 31 35 37 41 47 53 58 64", {{34, 3, 0}}, 40},
    {PAPER_SYM, "7 13 19 20 25 26 31 33 37 39 45 51 57 63 69 74 80", {{50, 3, 0}}, 38},
    {PAPER_SYM, "2 3 5 7 8 9 11 12 13 14 15 17 19 20 22 23", {{2, 2, 0}, {13, 1, 0}}, 40},
    {PAPER_SYM,
     "2 5 7 8 11 13 17 18 19 23 24 25 29 30 31 35 36 37 41 42 46 48 52 54 59 65",
     {{6, 1, 0}, {22, 1, 0}, {35, 1, 0}},
     56},
};

static void test_targets_are_table_6(void)
{
    static table t;
    const double mean_Nm = 1.5 * 12.0 * (21.93 / (2.0 * REF_PI * 50.0 / 2.0)) * cos(0.2);
    for (int k = 0; k < 12; ++k) {
        size_t wanted = 0;
        read_table(scenario_file(k + 1, "target"), "order,amplitude_Nm,phase_rad", &t);
        TEST_ASSERT_EQUAL_DOUBLE(0.0, number(&t, 0, 0));
        TEST_ASSERT_DOUBLE_WITHIN(0.5e-9, mean_Nm, number(&t, 0, 1)); /* ten digits are written */
        TEST_ASSERT_EQUAL_DOUBLE(REF_PI / 2.0, number(&t, 0, 2));
        while (wanted < 3 && TABLE_6[k].ripple[wanted][0] > 0.0)
            ++wanted;
        TEST_ASSERT_EQUAL_UINT64(1 + wanted, t.count);
        for (size_t j = 0; j < wanted; ++j)
            for (size_t c = 0; c < 3; ++c)
                TEST_ASSERT_EQUAL_DOUBLE(TABLE_6[k].ripple[j][c], number(&t, 1 + j, c));
    }
}

/* Checks the rows from `row` on against a list of orders; returns the row after them. */
static size_t check_set(const table *t, size_t row, const char *orders, const char *set)
{
    for (char *end; *orders != '\0'; orders = end, ++row) {
        TEST_ASSERT_TRUE(row < t->count);
        TEST_ASSERT_EQUAL_DOUBLE(strtod(orders, &end), number(t, row, 0));
        TEST_ASSERT_EQUAL_STRING(set, t->field[row][1]);
    }
    return row;
}

static void test_harmonic_sets_are_table_6(void)
{
    static table t;
    for (int k = 0; k < 12; ++k) {
        read_table(scenario_file(k + 1, "harmonics"), "order,set", &t);
        const size_t row = check_set(&t, 0, TABLE_6[k].sym, "sym");
        TEST_ASSERT_EQUAL_UINT64(t.count, check_set(&t, row, TABLE_6[k].asym, "asym"));
    }
}

static size_t read_components(int number_of_scenario, hci_component *components)
{
    static table t;
    read_table(scenario_file(number_of_scenario, "harmonics"), "order,set", &t);
    for (size_t k = 0; k < t.count; ++k) {
        const double order = number(&t, k, 0);
        const int sym = strcmp(t.field[k][1], "sym") == 0;
        components[k] = (hci_component){order, sym ? hci_sequence_of_order(order) : 1};
        TEST_ASSERT_TRUE(components[k].sequence != 0); /* the machines are in star */
    }
    return t.count;
}

static size_t orders_above_zero(const hci_wave *emf, size_t emf_count, const hci_component *components,
                                size_t count, double *orders)
{
    size_t n = 0;
    for (size_t k = 0; k < count; ++k)
        n += hci_component_orders(emf, emf_count, components[k], orders + n);
    n = hci_orders_sort(orders, n);
    if (n == 0 || orders[0] > 0.5) return n;
    memmove(orders, orders + 1, (n - 1) * sizeof *orders);
    return n - 1;
}

static void exchange(double *x, double *y)
{
    const double swap = *x;
    *x = *y;
    *y = swap;
}

/* Brings the largest entry of the rest of the matrix to (r, r) and returns its magnitude. */
static double pivot(double *a, size_t rows, size_t columns, size_t r)
{
    size_t row = r, column = r;
    for (size_t c = r; c < columns; ++c) {
        for (size_t k = r; k < rows; ++k) {
            if (fabs(a[k + c * rows]) <= fabs(a[row + column * rows])) continue;
            row = k;
            column = c;
        }
    }
    for (size_t c = 0; c < columns; ++c)
        exchange(&a[r + c * rows], &a[row + c * rows]);
    for (size_t k = 0; k < rows; ++k)
        exchange(&a[k + r * rows], &a[k + column * rows]);
    return fabs(a[r + r * rows]);
}

/* Gaussian elimination with full pivoting of a rows × columns matrix, column-major. */
static size_t rank_of(double *a, size_t rows, size_t columns)
{
    for (size_t r = 0; r < rows && r < columns; ++r) {
        /* entries are 0.015 to 0.21; a dependent row leaves 1e-16 */
        if (pivot(a, rows, columns, r) < 1e-10) return r;
        for (size_t k = r + 1; k < rows; ++k) {
            const double factor = a[k + r * rows] / a[r + r * rows];
            for (size_t c = r; c < columns; ++c)
                a[k + c * rows] -= factor * a[r + c * rows];
        }
    }
    return rows < columns ? rows : columns;
}

static void test_published_sets_have_the_known_ranks(void)
{
    static double u[2 * 128 * 2 * MAX_ROWS];
    hci_wave emf[8];
    const size_t emf_count = read_back_emf('a', emf);
    for (int k = 1; k < 12; ++k) {
        hci_component components[MAX_ROWS];
        double orders[MAX_ORDERS];
        const size_t count = read_components(k + 1, components);
        const size_t reached = orders_above_zero(emf, emf_count, components, count, orders);
        TEST_ASSERT_TRUE(reached <= 128);
        hci_system_dense(&(hci_mutual_torque){emf, emf_count, orders, reached}, components, count, u);
        TEST_ASSERT_EQUAL_UINT64(TABLE_6[k].rank, rank_of(u, 2 * reached, 2 * count));
    }
}

/* All wanted ripple is within reach but order 5 of scenario 7. */
static void test_only_scenario_7_wants_what_its_set_cannot_reach(void)
{
    hci_wave emf[8];
    const size_t emf_count = read_back_emf('a', emf);
    for (int k = 0; k < 12; ++k) {
        hci_component components[MAX_ROWS];
        double orders[MAX_ORDERS];
        const size_t count = read_components(k + 1, components);
        const size_t reached = orders_above_zero(emf, emf_count, components, count, orders);
        for (size_t j = 0; j < 3 && TABLE_6[k].ripple[j][0] > 0.0; ++j) {
            const size_t at = hci_orders_find(orders, reached, TABLE_6[k].ripple[j][0]);
            TEST_ASSERT_EQUAL_INT(k + 1 == 7, at == reached);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_machines_are_tables_2_to_5);
    RUN_TEST(test_mutual_torque_at_table_3);
    RUN_TEST(test_example_currents_are_table_1_twice);
    RUN_TEST(test_example_currents_are_a_symmetrical_and_an_asymmetrical_system);
    RUN_TEST(test_targets_are_table_6);
    RUN_TEST(test_harmonic_sets_are_table_6);
    RUN_TEST(test_published_sets_have_the_known_ranks);
    RUN_TEST(test_only_scenario_7_wants_what_its_set_cannot_reach);
    return UNITY_END();
}
