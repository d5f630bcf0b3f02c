/* A parameter over the date, and from batch to batch. */
#ifndef HCI_SRC_HOST_FLEET_TRENDS_H
#define HCI_SRC_HOST_FLEET_TRENDS_H

#include <stddef.h>

/* A motor's value. */
typedef struct {
    double value, std_error;
    double day;        /* NAN: not known */
    const char *batch; /* "": not known */
} hci_trend_point;

/* A straight line over the day, weighted by 1/(between² + std_error²). per_day, std_error: out; NAN where
 * there are less than three days. Changes the order of the points. O(n log n). */
void hci_trend_find(hci_trend_point *point, size_t n, double between, double *per_day, double *std_error);

/* Whether batches differ. NAN with less than two batches. */
typedef struct {
    double deviation;     /* of the batches' means beyond what chance makes of them */
    double criterion;     /* F as a normal deviate */
    const char *furthest; /* batch whose mean is furthest from that of all; NULL: less than two */
    double beside;        /* by so much */
    double widening; /* of the standard error of a trend, since motors of a batch are no independent ones; 1:
                        none */
} hci_trend_of_batches;

/* Analysis of variance. Changes the order of the points. O(n log n). */
hci_trend_of_batches hci_trend_batches(hci_trend_point *point, size_t n);

/* F of so many degrees of freedom as a normal deviate (E. Paulson, Annals of Mathematical Statistics 13,
 * 1942). */
double hci_trend_normal_of_F(double F, double above, double below);

#endif
