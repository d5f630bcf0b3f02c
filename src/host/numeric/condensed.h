/* Groups of rows of a least-squares problem, each in as few numbers as say the same.
 *
 * In: normal equations XᵀX, Xᵀy, yᵀy of a group, such as one recording. Out: F and g with
 *
 *     XᵀX = F Fᵀ      Xᵀy = F g      yᵀy = gᵀg + rest
 *
 * where F has as many columns as the group tells of unknowns, which are far fewer than the unknowns. */
#ifndef HCI_SRC_HOST_NUMERIC_CONDENSED_H
#define HCI_SRC_HOST_NUMERIC_CONDENSED_H

#include "host/base/watch.h"
#include "host/numeric/normal_equations.h"

typedef struct {
    size_t rank;
    double *factor; /* [n][rank]: F */
    double *moment; /* [rank]: g */
    double rest;    /* square that no unknown describes */
    double rows;
} hci_condensed_group;

/* Start with {0}. */
typedef struct {
    size_t n; /* unknowns */
    hci_condensed_group *group;
    size_t count;
    double *gram, *moment; /* [n][n], [n]: Σ XᵀX and Σ Xᵀy over the groups */
    hci_watch *watch;      /* asked between groups by what takes long; NULL: nobody ends it */
} hci_condensed;

/* Room for so many groups of n unknowns. False when memory is out, and then *all is empty. */
bool hci_condensed_start(hci_condensed *all, size_t n, size_t groups);
void hci_condensed_release(hci_condensed *all);

/* Adds a group. unit[n]: size that each unknown is expected to have, > 0: what makes less than 10⁻⁶ of the
 * largest regressor at that size is left out. False when memory is out. O(n rank²). */
bool hci_condensed_add(hci_condensed *all, const hci_normal_equations *group, const double *unit);

/* The same with groups joined that tell the same: whose XᵀX, each unknown in units of what all groups tell of
 * it, have a cosine of `alike` or more. joined: out, start with {0}; of[all->count]: out, the joined group of
 * each. False when memory is out or the watch stops, and then *joined is empty. O(n groups² + n² rank
 * groups), and n rank² of each pair whose diagonals alone do not tell that it differs. */
bool hci_condensed_join(const hci_condensed *all, const double *unit, double alike, hci_condensed *joined,
                        size_t *of);

#endif
