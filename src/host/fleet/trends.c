#include "host/fleet/trends.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- over the day ---- */

static int by_day(const void *a, const void *b)
{
    const double x = ((const hci_trend_point *)a)->day, y = ((const hci_trend_point *)b)->day;
    if (isnan(x) || isnan(y)) return isnan(x) - isnan(y);
    return (x > y) - (x < y);
}

static size_t days_of(const hci_trend_point *point, size_t n)
{
    size_t days = 0;
    for (size_t k = 0; k < n && !isnan(point[k].day); ++k)
        days += k == 0 || point[k].day != point[k - 1].day;
    return days;
}

void hci_trend_find(hci_trend_point *point, size_t n, double between, double *per_day, double *std_error)
{
    double weight = 0.0, day = 0.0, value = 0.0, square = 0.0, product = 0.0;
    *per_day = *std_error = NAN;
    qsort(point, n, sizeof *point, by_day);
    if (days_of(point, n) < 3) return;
    while (n > 0 && isnan(point[n - 1].day))
        --n;
    for (size_t k = 0; k < n; ++k) {
        const double w = 1.0 / (between * between + point[k].std_error * point[k].std_error);
        weight += w;
        day += w * point[k].day;
        value += w * point[k].value;
    }
    day /= weight;
    value /= weight;
    for (size_t k = 0; k < n; ++k) {
        const double w = 1.0 / (between * between + point[k].std_error * point[k].std_error);
        square += w * (point[k].day - day) * (point[k].day - day);
        product += w * (point[k].day - day) * (point[k].value - value);
    }
    *per_day = product / square;
    *std_error = 1.0 / sqrt(square);
}

/* ---- from batch to batch ---- */

static int by_batch(const void *a, const void *b)
{
    return strcmp(((const hci_trend_point *)a)->batch, ((const hci_trend_point *)b)->batch);
}

double hci_trend_normal_of_F(double F, double above, double below)
{
    const double a = 2.0 / (9.0 * above), b = 2.0 / (9.0 * below), root = cbrt(F);
    return ((1.0 - b) * root - (1.0 - a)) / sqrt(b * root * root + a);
}

/* Sums of one batch after the other. */
typedef struct {
    double batches, motors, squares_of_counts, mean, between, within;
    const char *furthest;
    double beside;
} variance;

static void add_batch(const hci_trend_point *point, size_t n, double grand, variance *v)
{
    double mean = 0.0;
    for (size_t k = 0; k < n; ++k)
        mean += point[k].value / (double)n;
    if (!v->furthest || fabs(mean - grand) > fabs(v->beside)) {
        v->furthest = point[0].batch;
        v->beside = mean - grand;
    }
    for (size_t k = 0; k < n; ++k)
        v->within += (point[k].value - mean) * (point[k].value - mean);
    v->between += (double)n * (mean - grand) * (mean - grand);
    v->squares_of_counts += (double)n * (double)n;
    v->motors += (double)n;
    v->batches += 1.0;
}

/* 1 + (m − 1) ρ, the variance of a mean over batches of m whose motors are alike by ρ (L. Kish, Survey
 * Sampling, 1965). */
static double widening_of(double deviation, double within, double usual)
{
    const double alike = deviation * deviation / (deviation * deviation + within);
    return sqrt(1.0 + fmax(usual - 1.0, 0.0) * alike);
}

hci_trend_of_batches hci_trend_batches(hci_trend_point *point, size_t n)
{
    hci_trend_of_batches found = {NAN, NAN, NULL, 0.0, 1.0};
    variance v = {.furthest = NULL};
    size_t first = 0;
    qsort(point, n, sizeof *point, by_batch);
    while (first < n && point[first].batch[0] == '\0')
        ++first;
    for (size_t k = first; k < n; ++k)
        v.mean += point[k].value / (double)(n - first);
    for (size_t from = first, to; from < n; from = to) {
        for (to = from + 1; to < n && strcmp(point[to].batch, point[from].batch) == 0;)
            ++to;
        add_batch(point + from, to - from, v.mean, &v);
    }
    if (v.batches < 2.0 || v.motors - v.batches < 1.0 || !(v.within > 0.0)) return found;
    const double above = v.between / (v.batches - 1.0), below = v.within / (v.motors - v.batches);
    const double usual = (v.motors - v.squares_of_counts / v.motors) / (v.batches - 1.0);
    found.deviation = sqrt(fmax((above - below) / usual, 0.0));
    found.criterion = hci_trend_normal_of_F(above / below, v.batches - 1.0, v.motors - v.batches);
    found.furthest = v.furthest;
    found.beside = v.beside;
    found.widening = widening_of(found.deviation, below, usual);
    return found;
}
