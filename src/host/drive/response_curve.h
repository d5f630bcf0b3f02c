/* A measured response between and beyond its points. What changes little from one point to the next is not
 * the response but its ratio to a loop of the same kind, so that such a loop is found first: k_p, k_i and a
 * delay. */
#ifndef HCI_SRC_HOST_DRIVE_RESPONSE_CURVE_H
#define HCI_SRC_HOST_DRIVE_RESPONSE_CURVE_H

#include <stddef.h>

#include "host/drive/loop_model.h"

/* 1/(C H) of one axis at a frequency: C the controller, H the hold and the delay of its voltage. */
typedef struct {
    double rad_per_s;       /* ascending, > 0 */
    double complex through; /* A/V, not 0 */
    double weight;          /* > 0: share that the measured answer changes by for a share of `through` */
} hci_curve_point;

/* What stands between the points. */
typedef enum {
    HCI_CURVE_STRAIGHT, /* the values themselves, straight; from 0 at a standstill, and as the last one above
                         */
    HCI_CURVE_RATIO,    /* the loop that was found, times its ratio to the points, straight between them */
    HCI_CURVE_LOOP      /* the loop that was found, alone: what the points are beside it is noise */
} hci_curve_kind;

/* C = k_p + k_i T/(z − 1), H = sinc(νT/2) e^(−jν delay). */
typedef struct {
    double kp_ohm, ki_ohm_per_s, delay_s;
} hci_curve_loop;

/* Points to the memory of the caller. */
typedef struct {
    const hci_curve_point *point;
    size_t count;  /* >= 4 */
    size_t usable; /* of them below half the sampling: a loop is found of these */
    double sample_s;
    hci_curve_kind kind;
    hci_curve_loop loop;
    double error; /* of the curve, a share of the measured answer: the root mean square over the inner points
                   * of weight·|told/measured − 1|, each told by the others; of the loop alone, which is a
                   * mean over them, √(3/2n) of that for its three numbers. NAN where too few are below half
                   * the sampling */
} hci_response_curve;

/* The kind that tells points best which are left out in turn, at most 32 of them. O(count) of some thousands.
 */
hci_response_curve hci_response_curve_of(const hci_curve_point *point, size_t count, double sample_s);

/* Its value at a frequency > 0, below half the sampling. */
double complex hci_response_curve_at(const hci_response_curve *curve, double rad_per_s);

/* Frequencies between which straight lines are within a thousandth of both curves, or as near as `most` of
 * them come: from the lowest that tells something to highest_rad_per_s. Returns how many, 2 to most. */
size_t hci_response_curve_grid(const hci_response_curve curve[2], double highest_rad_per_s, size_t most,
                               double *rad_per_s);

#endif
