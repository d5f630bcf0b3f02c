#include "host/machine/inductance.h"

#include <math.h>
#include <string.h>

#include "hci/host/csv/csv.h"
#include "hci/math/fourier.h"
#include "host/base/memory.h"

static const char *const VALUE[HCI_PHASE_MATRIX] = {"La_H", "Lb_H", "Lc_H", "Mab_H", "Mbc_H", "Mca_H"};
static const char *const SLOPE[HCI_PHASE_MATRIX] = {"dLa_H_per_rad",  "dLb_H_per_rad",  "dLc_H_per_rad",
                                                    "dMab_H_per_rad", "dMbc_H_per_rad", "dMca_H_per_rad"};

/* Orders whose slope is below this share of the largest are left out. */
#define NEGLIGIBLE_SLOPE 1e-6

/* Entries that differ from a balanced winding's by no more than this share of the largest are rounding. */
#define BALANCED 1e-6

#define ANGLE_TOLERANCE_RAD 1e-4

/* Means of slopes up to this share of the largest order are errors of whoever measured or computed them. */
#define MOST_MEAN 0.05

/* Checks the angles and tells how many rows make one turn: all of them, or all but the repeated end point. */
static hci_status check_angles(const hci_csv *csv, const double *theta_rad, size_t rows, size_t *count,
                               hci_note *note)
{
    double step_rad;
    if (rows < 8)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: found %zu rows, expected at least 8 over one electrical turn",
                            hci_csv_path(csv), rows);
    *count = fabs(theta_rad[rows - 1] - theta_rad[0] - 2.0 * HCI_PI) < ANGLE_TOLERANCE_RAD ? rows - 1 : rows;
    step_rad = 2.0 * HCI_PI / (double)*count;
    for (size_t k = 0; k < rows; ++k)
        if (fabs(theta_rad[k] - theta_rad[0] - step_rad * (double)k) > ANGLE_TOLERANCE_RAD)
            return hci_csv_error(csv, "theta_e_rad", k, note, "equal steps over one electrical turn",
                                 "resample the table, and give electrical, not mechanical, angles");
    return HCI_OK;
}

/* Coefficients of one order for all six columns; the first angle need not be zero: sin m(θ − θ_0) is turned
 * back. */
static hci_status analyse_order(const double *column, size_t stride, size_t count, double first_rad, size_t m,
                                hci_inductance *out)
{
    const double c = cos((double)m * first_rad), s = sin((double)m * first_rad);
    out->order = (double)m;
    for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q) {
        hci_harmonic h;
        const hci_status status = hci_fourier_uniform(column + q * stride, count, 1, (double)m, &h);
        if (status) return status;
        out->sine[q] = h.sine * c + h.cosine * s;
        out->cosine[q] = h.cosine * c - h.sine * s;
    }
    return HCI_OK;
}

static double largest_entry(const hci_inductance *t)
{
    double largest = 0.0;
    for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q)
        largest = fmax(largest, hypot(t->sine[q], t->cosine[q]));
    return largest;
}

/* d/dθ_m of S sin mθ + C cos mθ is p m (S cos mθ − C sin mθ). */
static hci_inductance_slope slope_of(const hci_inductance *l, int pole_pairs)
{
    hci_inductance_slope slope = {l->order, {0}, {0}};
    for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q) {
        slope.sine[q] = -pole_pairs * l->order * l->cosine[q];
        slope.cosine[q] = pole_pairs * l->order * l->sine[q];
    }
    return slope;
}

/* Three entries that are one waveform shifted by a third of a turn each have S + jC of order m turned by
 * −m2π/3 from one to the next. Their mean, turned to the first. */
static void mean_of_three(const hci_inductance *t, size_t first, double *sine, double *cosine)
{
    *sine = *cosine = 0.0;
    for (size_t q = 0; q < 3; ++q) {
        const double angle = 2.0 * HCI_PI / 3.0 * t->order * (double)q;
        *sine += (t->sine[first + q] * cos(angle) - t->cosine[first + q] * sin(angle)) / 3.0;
        *cosine += (t->sine[first + q] * sin(angle) + t->cosine[first + q] * cos(angle)) / 3.0;
    }
}

/* The balanced form of one order: the mean of three, turned to each. */
static hci_inductance balanced(const hci_inductance *t)
{
    hci_inductance b = {t->order, {0}, {0}};
    for (size_t first = 0; first < HCI_PHASE_MATRIX; first += 3) {
        double s, c;
        mean_of_three(t, first, &s, &c);
        for (size_t q = 0; q < 3; ++q) {
            const double angle = 2.0 * HCI_PI / 3.0 * t->order * (double)q;
            b.sine[first + q] = s * cos(angle) + c * sin(angle);
            b.cosine[first + q] = c * cos(angle) - s * sin(angle);
        }
    }
    return b;
}

/* A table that is balanced but for its last digits is taken as balanced: else rounding connects every order
 * with every other one. */
static void balance(hci_inductance *terms, size_t count)
{
    double largest = 0.0, deviation = 0.0;
    for (size_t k = 0; k < count; ++k) {
        hci_inductance difference = balanced(&terms[k]);
        for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q) {
            difference.sine[q] -= terms[k].sine[q];
            difference.cosine[q] -= terms[k].cosine[q];
        }
        largest = fmax(largest, largest_entry(&terms[k]));
        deviation = fmax(deviation, largest_entry(&difference));
    }
    for (size_t k = 0; k < count && deviation <= BALANCED * largest; ++k)
        terms[k] = balanced(&terms[k]);
}

/* The mean of a slope over a turn is zero, or the inductance would grow with every turn, and the machine make
 * energy of nothing. What errors leave of it becomes zero. */
static hci_status drop_mean_slope(hci_inductance *terms, size_t count, const char *path, hci_note *note)
{
    const double mean = largest_entry(&terms[0]);
    double largest = 0.0;
    for (size_t k = 1; k < count; ++k)
        largest = fmax(largest, largest_entry(&terms[k]));
    if (mean > MOST_MEAN * largest)
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: found slopes with a mean of up to %.3g H/rad over the turn, expected 0, since an "
            "inductance comes back to where it was; name the columns La_H … Mca_H if they are "
            "inductances, or subtract the mean of each",
            path, mean);
    terms[0] = (hci_inductance){0.0, {0}, {0}};
    return HCI_OK;
}

/* Keeps the orders that matter. terms: all orders of the file, L or L'. */
static void keep_orders(const hci_inductance *terms, size_t count, bool are_slopes, int pole_pairs,
                        hci_inductance_table *t)
{
    double largest = 0.0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, largest_entry(&terms[k]) * (are_slopes ? 1.0 : pole_pairs * terms[k].order));
    for (size_t k = 0; k < count; ++k) {
        const hci_inductance_slope slope = are_slopes ? terms[k] : slope_of(&terms[k], pole_pairs);
        const bool matters = largest_entry(&slope) > NEGLIGIBLE_SLOPE * largest;
        if (matters) t->slope[t->slope_count++] = slope;
        if (!are_slopes && (matters || k == 0)) t->inductance[t->inductance_count++] = terms[k];
    }
}

/* The columns of the file, and all orders of them. */
typedef struct {
    const hci_csv *csv;
    bool are_slopes;
    double *theta_rad;     /* of each row */
    double *column;        /* [HCI_PHASE_MATRIX][rows] */
    hci_inductance *terms; /* of each order */
} analysis;

static hci_status read_columns(const analysis *a, hci_note *note)
{
    const size_t rows = hci_csv_rows(a->csv);
    hci_status status = hci_csv_numbers(a->csv, "theta_e_rad", a->theta_rad, note);
    for (size_t q = 0; q < HCI_PHASE_MATRIX && !status; ++q)
        status = hci_csv_numbers(a->csv, a->are_slopes ? SLOPE[q] : VALUE[q], a->column + q * rows, note);
    return status;
}

static hci_status analyse(const analysis *a, int pole_pairs, hci_inductance_table *t, hci_note *note)
{
    const size_t rows = hci_csv_rows(a->csv);
    size_t count = 0, orders;
    hci_status status = read_columns(a, note);
    if (!status) status = check_angles(a->csv, a->theta_rad, rows, &count, note);
    orders = (count + 1) / 2;
    for (size_t m = 0; m < orders && !status; ++m)
        status = analyse_order(a->column, rows, count, a->theta_rad[0], m, &a->terms[m]);
    if (!status && a->are_slopes) status = drop_mean_slope(a->terms, orders, hci_csv_path(a->csv), note);
    if (!status) balance(a->terms, orders);
    if (!status) keep_orders(a->terms, orders, a->are_slopes, pole_pairs, t);
    return status;
}

static hci_status from_csv(const hci_csv *csv, int pole_pairs, hci_inductance_table *t, hci_note *note)
{
    const size_t rows = hci_csv_rows(csv);
    analysis a = {.csv = csv, .are_slopes = !hci_csv_has(csv, VALUE[0]) && hci_csv_has(csv, SLOPE[0])};
    hci_status status = HCI_OK;
    a.theta_rad = hci_memory_new(rows, sizeof *a.theta_rad);
    a.column = hci_memory_new(HCI_PHASE_MATRIX * rows, sizeof *a.column);
    a.terms = hci_memory_new(rows, sizeof *a.terms);
    t->inductance = hci_memory_new(rows, sizeof *t->inductance);
    t->slope = hci_memory_new(rows, sizeof *t->slope);
    if (!a.theta_rad || !a.column || !a.terms || !t->inductance || !t->slope)
        status = hci_note_memory(note, hci_csv_path(csv), "%zu rows", rows);
    if (!status) status = analyse(&a, pole_pairs, t, note);
    hci_memory_free(a.theta_rad);
    hci_memory_free(a.column);
    hci_memory_free(a.terms);
    return status;
}

hci_status hci_inductance_read(const char *path, int pole_pairs, hci_inductance_table *table, hci_note *note)
{
    hci_csv *csv;
    hci_status status;
    memset(table, 0, sizeof *table);
    status = hci_csv_read(path, &csv, note);
    if (status) return status;
    status = from_csv(csv, pole_pairs, table, note);
    hci_csv_free(csv);
    if (status) {
        hci_memory_free(table->inductance);
        hci_memory_free(table->slope);
        memset(table, 0, sizeof *table);
    }
    return status;
}
