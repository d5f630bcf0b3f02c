/* Normal equations of models that were computed before, and what follows from them without the samples.
 *
 * In: a model, and the rows that some others had. Out: its normal equations, where one of them has all its
 * columns and the two differ only in values that the torque is linear in. With values that differ by d
 *
 *     Xᵀ(y − Xd) = Xᵀy − Gd      (y − Xd)² = y² − 2 dᵀXᵀy + dᵀGd
 *
 * and fewer columns are rows and columns of the same G. Any other difference, of a delay, a gain or the noise
 * that weights the rows, changes X, and nothing is known. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_KNOWN_EQUATIONS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_KNOWN_EQUATIONS_H

#include "host/diagnose/fit/model.h"
#include "host/diagnose/reading/regression.h"
#include "host/numeric/normal_equations.h"

enum { HCI_KNOWN_EQUATIONS = 64 }; /* that are kept, the last ones used */

/* A term of a model that was linearised. */
typedef struct {
    const hci_effect_type *type;
    size_t parameter;
    double order, value;
    size_t column; /* of the normal equations; SIZE_MAX: none */
    bool shown;    /* every run in use shows it: its column is not emptied anywhere */
} hci_known_term;

typedef struct {
    hci_normal_equations normal; /* of the rows alone, without expectations */
    hci_known_term *term;
    size_t terms;
    hci_noise *noise; /* of each segment, as it was */
    bool *use;        /* of each run, as it was */
    size_t asked;     /* when it was asked for last */
} hci_known_model;

/* Start with {0}. Release with hci_known_equations_release. */
struct hci_known_equations {
    hci_known_model model[HCI_KNOWN_EQUATIONS];
    size_t asked;
};

/* Adds to *normal, which has been started with the columns of the model. False when they are not known, and
 * then nothing is changed. known: may be NULL. O(columns²). */
bool hci_known_equations_find(hci_known_equations *known, const hci_regression *regression,
                              const hci_model *model, hci_normal_equations *normal);

/* Keeps a copy in place of the one that was asked for longest ago. shown: of each column, whether every run
 * in use shows it. known: may be NULL. False when memory is out. */
bool hci_known_equations_keep(hci_known_equations *known, const hci_regression *regression,
                              const hci_model *model, const bool *shown, const hci_normal_equations *normal);

void hci_known_equations_release(hci_known_equations *known);

#endif
