/* A convex program of limits and wishes under construction: rows, cones and equations (stage.c). Each
 * row has one number for each unknown and the right side behind them. */
#ifndef HCI_SRC_HOST_LIMIT_BUILD_H
#define HCI_SRC_HOST_LIMIT_BUILD_H

#include "host/limit/program.h"

/* Unknowns: the coordinates over scale_A; then, of all stages but COPPER, what is minimised over scale_Nm (a
 * share for FIT); of a peak-to-peak also the highest and the lowest torque. Rows are divided by their limits,
 * so that all are near 1. */
typedef struct {
    const hci_limit_program *of;
    hci_limit_stage stage;
    size_t n, coordinates, width; /* unknowns; those that are currents; n + 1 */

    size_t rows, room;
    double *row;
    double *low;         /* of two-sided rows; room */
    hci_limit_point *at; /* of rows of angles: which; NONE of others; room */
    size_t *limit_of;    /* whose multiplier a row has: hci_limit_tag, 0 of none; room */
    size_t two_sided, linear;
    size_t distance;     /* 1 + row of the distance from the centre; 0: none */
    size_t *cone, cones; /* rows of each cone; room */

    double *equal; /* rows */
    size_t equalities;
    double *p, *c; /* ½xᵀPx + c·x */
    bool is_full;  /* memory is out */
} hci_limit_build;

/* False when memory is out. To be released in any case. */
bool hci_limit_build_begin(const hci_limit_program *of, hci_limit_stage stage, hci_limit_build *build);
void hci_limit_build_release(hci_limit_build *build);

/* A new row of zeros; NULL when memory is out, and then the program is not used. */
double *hci_limit_row_add(hci_limit_build *build);

/* Around the rows of a cone, its head first. */
void hci_limit_cone_begin(hci_limit_build *build);
void hci_limit_cone_end(hci_limit_build *build);

/* A new equation of zeros. */
double *hci_limit_equation_add(hci_limit_build *build);

/* Position of what is minimised; of the highest and the lowest torque after it. */
size_t hci_limit_objective(const hci_limit_build *build);

/* Whether a peak-to-peak is minimised, whose rows are linear. */
bool hci_limit_is_swing(const hci_limit_build *build);

/* Of a limit, and what it was made of. */
size_t hci_limit_tag(hci_limit_kind kind, int phase);
size_t hci_limit_tag_of(const hci_limit_point *point); /* of a current or voltage */
void hci_limit_of_tag(size_t tag, hci_limit_kind *kind, int *phase);

#endif
