/* Where a recording to come would say most about a torque that no effect explains.
 *
 * In: what the model leaves of the recordings. Out: operating points at which the laws of growth that
 * describe one of its orders about equally well differ most; or those that are furthest from all recordings.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_NEXT_UNKNOWN_POINTS_H
#define HCI_SRC_HOST_DIAGNOSE_NEXT_UNKNOWN_POINTS_H

#include "host/diagnose/next/operating_points.h"

/* One of a list of operating points. */
typedef struct {
    size_t point;
    double chi_square; /* between the laws, of HCI_LEAST_TURNS turns; NAN: not known */
    double order;      /* at which they differ most, electrical; NAN: none */
    double spread_Nm;  /* amplitude, root mean square over the laws */
} hci_telling_point;

/* A choice from count operating points, most telling first: each says most of what those before it leave
 * open. most: of chosen. Returns how many, 0 where none would tell the laws apart. */
typedef struct {
    const hci_operating_point *point;
    size_t count, most;
    hci_telling_point *chosen;
} hci_point_choice;

/* What the model leaves. */
typedef struct {
    const double *residual_Nm; /* of each sample of the dataset */
    const double *order;       /* [orders], electrical, that the laws are to describe */
    size_t orders;
} hci_open_orders;

/* *found: how many were chosen. HCI_ERROR_MEMORY. O(orders·(samples + laws·points·most)). */
hci_status hci_points_of_growth(const hci_regression *regression, const hci_open_orders *open,
                                const hci_playable *playable, const hci_point_choice *choice, size_t *found,
                                hci_note *note);

/* Those that are furthest from all recordings in currents, speed and direction. Returns how many. */
size_t hci_points_not_recorded(const hci_regression *regression, const hci_playable *playable,
                               const hci_point_choice *choice);

#endif
