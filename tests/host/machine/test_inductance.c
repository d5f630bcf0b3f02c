/* Tables of slopes: what their mean over a turn may be. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/machine/machine.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/machine/inductance.h"
#include "support/files.h"
#include "unity.h"

enum { ROWS = 24 };

static hci_inductance_table table;

void setUp(void)
{
    files_begin();
    files_write(files_path("machine.csv"), "name,value\npole_pairs,3\n");
    files_write(files_path("back_emf.csv"), "order,amplitude_Nm_per_A,phase_rad\n1,0.5,0\n");
}

void tearDown(void)
{
    hci_memory_free(table.inductance);
    hci_memory_free(table.slope);
    memset(&table, 0, sizeof table);
    files_end();
}

/* Slopes of amplitude 1 mH/rad at order 2, in phase a with a mean as a share of that; the angle of one row is
 * off. */
static hci_status read_rows(double mean, int at, double off_rad, hci_machine_data *machine, hci_note *note)
{
    char text[ROWS * 160];
    size_t used = (size_t)snprintf(text, sizeof text,
                                   "theta_e_rad,dLa_H_per_rad,dLb_H_per_rad,dLc_H_per_rad,"
                                   "dMab_H_per_rad,dMbc_H_per_rad,dMca_H_per_rad\n");
    for (int k = 0; k < ROWS; ++k) {
        const double theta = 2.0 * HCI_PI * k / ROWS, third = 2.0 * HCI_PI / 3.0;
        used += (size_t)snprintf(text + used, sizeof text - used, "%.17g,%.17g,%.17g,%.17g,0,0,0\n",
                                 theta + (k == at ? off_rad : 0.0), 1e-3 * (sin(2.0 * theta) + mean),
                                 1e-3 * sin(2.0 * (theta - third)), 1e-3 * sin(2.0 * (theta + third)));
    }
    files_write(files_path("inductance.csv"), text);
    return hci_machine_read(files_root, machine, note);
}

static hci_status read_slopes(double mean, hci_machine_data *machine, hci_note *note)
{
    return read_rows(mean, 0, 0.0, machine, note);
}

/* What finite elements leave of a mean is no slope: it would make energy of nothing.
 */
static void test_a_small_mean_is_left_out(void)
{
    hci_machine_data machine;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_slopes(0.03, &machine, &note), note.text);
    TEST_ASSERT_EQUAL_UINT64(1, machine.model.slope_count);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0, machine.model.slope[0].order);
    hci_machine_release(&machine);
}

static void test_a_large_mean_is_no_slope(void)
{
    hci_machine_data machine;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_slopes(0.07, &machine, &note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "inductance.csv"));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "subtract the mean"));
}

/* Any row but the first, from which the others are counted; its line is named. */
static void test_uneven_angles_are_refused(void)
{
    for (int at = 1; at < ROWS; ++at)
        for (int sign = -1; sign <= 1; sign += 2) {
            hci_machine_data machine;
            hci_note note = {{0}};
            char where[40];
            snprintf(where, sizeof where, "inductance.csv:%d:", at + 2);
            TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_rows(0.0, at, sign * 2e-4, &machine, &note));
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, where), note.text);
            TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "equal steps"), note.text);
        }
}

/* ---- tables by their waves ---- */

enum { ENTRIES = HCI_PHASE_MATRIX, ORDERS = 3 };

static const char *const L_NAMES = "La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H",
                         *const SLOPE_NAMES = "dLa_H_per_rad,dLb_H_per_rad,dLc_H_per_rad,"
                                              "dMab_H_per_rad,dMbc_H_per_rad,dMca_H_per_rad";
static const int ORDER[ORDERS] = {0, 2, 5};
static double sine[ORDERS][ENTRIES], cosine[ORDERS][ENTRIES];

/* Waves of all six entries that have nothing in common. */
static void make_uneven(void)
{
    for (int k = 0; k < ORDERS; ++k)
        for (int q = 0; q < ENTRIES; ++q) {
            sine[k][q] = k > 0 ? 1e-4 * (1.0 + 0.3 * q - 0.7 * k) : 0.0;
            cosine[k][q] = 1e-4 * (0.5 - 0.2 * q * q + 0.4 * k);
        }
}

/* The same wave in three entries each, a third of a turn apart; off: of one entry, as a share. */
static void make_even(double off)
{
    for (int k = 0; k < ORDERS; ++k)
        for (int q = 0; q < ENTRIES; ++q) {
            const double s = k > 0 ? 1e-4 * (q < 3 ? 1.3 : -0.6) : 0.0,
                         c = 1e-4 * (q < 3 ? 2.0 : -0.9) / (1.0 + k),
                         shift = ORDER[k] * 2.0 * HCI_PI * (q % 3) / 3.0;
            sine[k][q] = s * cos(shift) + c * sin(shift);
            cosine[k][q] = c * cos(shift) - s * sin(shift);
        }
    cosine[1][4] += off * 2e-4;
}

static void write_table(const char *names, size_t rows, double first_rad, double step_rad)
{
    FILE *file = fopen(files_path("l.csv"), "w");
    TEST_ASSERT_NOT_NULL(file);
    fprintf(file, "theta_e_rad,%s\n", names);
    for (size_t k = 0; k < rows; ++k) {
        const double theta = first_rad + step_rad * (double)k;
        fprintf(file, "%.17g", theta);
        for (int q = 0; q < ENTRIES; ++q) {
            double sum = 0.0;
            for (int j = 0; j < ORDERS; ++j)
                sum += sine[j][q] * sin(ORDER[j] * theta) + cosine[j][q] * cos(ORDER[j] * theta);
            fprintf(file, ",%.17g", sum);
        }
        fputc('\n', file);
    }
    fclose(file);
}

static hci_status read_table(hci_note *note)
{
    hci_memory_free(table.inductance);
    hci_memory_free(table.slope);
    memset(note, 0, sizeof *note);
    return hci_inductance_read(files_path("l.csv"), 3, &table, note);
}

static void read_whole(const char *names, size_t rows, double first_rad, double step_rad)
{
    hci_note note;
    write_table(names, rows, first_rad, step_rad);
    TEST_ASSERT_EQUAL_INT_MESSAGE(HCI_OK, read_table(&note), note.text);
}

/* From any first angle, with the end of the turn or without, an even number of rows or not. */
static void test_inductances_and_their_slopes(void)
{
    static const size_t ROWS_OF_A_TURN[] = {12, 13, 24};
    make_uneven();
    for (int n = 0; n < 3; ++n)
        for (size_t repeated = 0; repeated < 2; ++repeated) {
            read_whole(L_NAMES, ROWS_OF_A_TURN[n] + repeated, 0.37, 2.0 * HCI_PI / (double)ROWS_OF_A_TURN[n]);
            TEST_ASSERT_EQUAL_UINT64(3, table.inductance_count);
            TEST_ASSERT_EQUAL_UINT64(2, table.slope_count);
            for (int k = 0; k < ORDERS; ++k)
                for (int q = 0; q < ENTRIES; ++q) {
                    const hci_inductance *l = &table.inductance[k];
                    TEST_ASSERT_EQUAL_DOUBLE(ORDER[k], l->order);
                    TEST_ASSERT_DOUBLE_WITHIN(1e-16, sine[k][q], l->sine[q]);
                    TEST_ASSERT_DOUBLE_WITHIN(1e-16, cosine[k][q], l->cosine[q]);
                    if (k == 0) continue;
                    const hci_inductance_slope *d = &table.slope[k - 1];
                    TEST_ASSERT_EQUAL_DOUBLE(ORDER[k], d->order);
                    TEST_ASSERT_DOUBLE_WITHIN(1e-14, -3.0 * ORDER[k] * cosine[k][q], d->sine[q]);
                    TEST_ASSERT_DOUBLE_WITHIN(1e-14, 3.0 * ORDER[k] * sine[k][q], d->cosine[q]);
                }
        }
}

/* Of slopes alone no inductances are known. */
static void test_slopes_alone(void)
{
    make_uneven();
    for (int q = 0; q < ENTRIES; ++q)
        cosine[0][q] = 1e-7 * q; /* a mean that is left out */
    read_whole(SLOPE_NAMES, 16, -0.2, 2.0 * HCI_PI / 16.0);
    TEST_ASSERT_EQUAL_UINT64(0, table.inductance_count);
    TEST_ASSERT_EQUAL_UINT64(2, table.slope_count);
    for (int k = 1; k < ORDERS; ++k)
        for (int q = 0; q < ENTRIES; ++q) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-15, sine[k][q], table.slope[k - 1].sine[q]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-15, cosine[k][q], table.slope[k - 1].cosine[q]);
        }
}

/* Orders whose slope is a millionth of the largest are left out. */
static void test_small_orders_are_left_out(void)
{
    for (int more = 0; more < 2; ++more) {
        make_uneven();
        for (int q = 0; q < ENTRIES; ++q) { /* 2·1e-4 beside 5·4e-11 or 5·4.4e-11 */
            sine[1][q] = q == 3 ? 1e-4 : 0.0;
            sine[2][q] = q == 5 ? (more ? 4.4e-11 : 3.6e-11) : 0.0;
            cosine[1][q] = cosine[2][q] = 0.0;
        }
        read_whole(L_NAMES, 16, 0.0, 2.0 * HCI_PI / 16.0);
        TEST_ASSERT_EQUAL_UINT64(more ? 2 : 1, table.slope_count);
        TEST_ASSERT_EQUAL_UINT64(more ? 3 : 2, table.inductance_count);
    }
}

/* Entries that are a millionth off those of a balanced winding become these, and no more than a millionth. */
static void test_rounding_of_a_balanced_table(void)
{
    for (int more = 0; more < 2; ++more) {
        make_even(more ? 4e-6 : 5e-7);
        read_whole(L_NAMES, 24, 0.1, 2.0 * HCI_PI / 24.0);
        double apart = 0.0;
        for (size_t k = 0; k < table.inductance_count; ++k)
            for (int q = 0; q < ENTRIES; ++q) {
                const hci_inductance *l = &table.inductance[k];
                const int first = q - q % 3;
                const double shift = l->order * 2.0 * HCI_PI * (q % 3) / 3.0;
                apart = fmax(apart,
                             fabs(l->sine[q] - l->sine[first] * cos(shift) - l->cosine[first] * sin(shift)));
                apart = fmax(
                    apart, fabs(l->cosine[q] - l->cosine[first] * cos(shift) + l->sine[first] * sin(shift)));
                TEST_ASSERT_DOUBLE_WITHIN(4e-6 * 2e-4, cosine[k][q], l->cosine[q]);
                TEST_ASSERT_DOUBLE_WITHIN(4e-6 * 2e-4, sine[k][q], l->sine[q]);
            }
        TEST_ASSERT_EQUAL(more, apart > 1e-15);
    }
}

/* Eight rows, and steps that are even within 1e-4 rad. */
static void test_rows_of_a_table(void)
{
    hci_note note;
    make_uneven();
    for (int j = 0; j < ORDERS; ++j)
        for (int q = 0; q < ENTRIES; ++q)
            if (j == 2) sine[j][q] = cosine[j][q] = 0.0;
    write_table(L_NAMES, 7, 0.0, 2.0 * HCI_PI / 7.0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_table(&note));
    TEST_ASSERT_NOT_NULL(strstr(note.text, "found 7 rows, expected at least 8 over one electrical turn"));
    TEST_ASSERT_NULL(table.slope);
    read_whole(L_NAMES, 8, 0.0, 2.0 * HCI_PI / 8.0);
    read_whole(L_NAMES, 16, 0.0, 2.0 * HCI_PI / 16.0 + 0.9e-4 / 15.0);
    write_table(L_NAMES, 16, 0.0, 2.0 * HCI_PI / 16.0 + 1.05e-4 / 15.0);
    TEST_ASSERT_EQUAL_INT(HCI_ERROR_INPUT, read_table(&note));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(note.text, "l.csv:17: column 1"), note.text);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_inductances_and_their_slopes);
    RUN_TEST(test_slopes_alone);
    RUN_TEST(test_small_orders_are_left_out);
    RUN_TEST(test_rounding_of_a_balanced_table);
    RUN_TEST(test_rows_of_a_table);
    RUN_TEST(test_a_small_mean_is_left_out);
    RUN_TEST(test_uneven_angles_are_refused);
    RUN_TEST(test_a_large_mean_is_no_slope);
    return UNITY_END();
}
