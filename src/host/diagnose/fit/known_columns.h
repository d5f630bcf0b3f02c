/* Derivatives by values that are 0, sample by sample, as they were found before.
 *
 * In: a model with candidates. Out: the part of it that has to be predicted, and where the derivatives by all
 * other candidates are known. Most candidates are nothing yet, and the torque is linear in them: they add
 * nothing to what is predicted, and their derivatives stay as they are while the test stand does. Known are
 * those of the last few states of that: values of sensors and channels, and runs in use. */
#ifndef HCI_SRC_HOST_DIAGNOSE_FIT_KNOWN_COLUMNS_H
#define HCI_SRC_HOST_DIAGNOSE_FIT_KNOWN_COLUMNS_H

#include "host/diagnose/fit/model.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/diagnose/reading/regression.h"

enum { HCI_KNOWN_TABLES = 2, HCI_KNOWN_NUMBERS = 1 << 24 /* of a table, at most */ };

/* A derivative by one term. */
typedef struct {
    const hci_effect_type *type;
    size_t parameter;
    double order, reference_current_A;
} hci_known_column;

/* A value that other derivatives depend on. */
typedef struct {
    const hci_effect_type *type;
    hci_effect_term term;
} hci_stand_value;

/* What is known in one state of the test stand. */
typedef struct {
    hci_stand_value *stand;
    size_t stand_count;
    bool *use; /* of each run */
    hci_known_column *column;
    size_t count, capacity;
    double *value; /* [samples + 1][capacity], of holding tests in units of the modelled torque per ampere; of
                    * samples that are not in use nothing; the last row of the torque per ampere */
    size_t asked;  /* when it was asked for last */
} hci_known_table;

/* Start with {0}. Release with hci_known_columns_release. */
struct hci_known_columns {
    hci_known_table table[HCI_KNOWN_TABLES];
    size_t asked;
};

/* Where the derivative by a column of the model comes from. */
typedef struct {
    size_t column, place; /* of the model; among the terms of what is predicted */
    size_t slot;          /* of the table; SIZE_MAX: it is not kept */
} hci_column_source;

/* Start with {0}. Release with hci_column_plan_release. */
typedef struct {
    hci_effects list; /* to be predicted */
    hci_effect *effect;
    hci_effect_term *term;
    hci_column_source *predicted, *known; /* both [columns]; of the second the place means nothing */
    size_t predicted_count, known_count;
    hci_known_table *table;    /* NULL: nothing is known and nothing will be */
    size_t filled;             /* columns of the table once all segments in use have been filled */
    double *constant_by_value; /* [columns], derivatives of the torque per ampere */
} hci_column_plan;

/* keeps: whether to look for what is known and to keep what is predicted; a regression may have no place for
 * it. The plan is kept as long as the model. False when memory is out. O(terms²). */
bool hci_column_plan_make(const hci_regression *regression, const hci_model *model, bool keeps,
                          hci_column_plan *plan);
void hci_column_plan_release(hci_column_plan *plan);

/* The derivatives of the torque per ampere, before all segments, where a shaft hardly accelerates.
 * predicted: of the list. */
void hci_column_plan_constants(const hci_column_plan *plan, const hci_regression *regression,
                               const hci_predicted_reading *predicted);

/* Writes the derivatives of a segment, x[sample·columns + column of the model], and those that were predicted
 * into the table. predicted: of the list, with what a scale of the current's torque takes away apart. */
void hci_column_plan_fill(const hci_column_plan *plan, const hci_regression *regression,
                          const hci_segment *segment, const hci_predicted_reading *predicted, double *x);

/* What has been predicted is known from now on: of all segments in use. Without it nothing is. */
void hci_column_plan_keep(const hci_column_plan *plan);

void hci_known_columns_release(hci_known_columns *known);

#endif
