/* The rows that a predicted reading is worked out in: torques, and their derivatives by the model's values.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_PREDICTED_ROWS_H
#define HCI_SRC_HOST_DIAGNOSE_READING_PREDICTED_ROWS_H

#include "host/diagnose/reading/regression.h"

/* Long enough for the longest segment with its repetitions. Start with {0}. */
typedef struct {
    double *torque_Nm;
    double *by_value; /* [samples][terms], derivatives by the values of all terms; NULL: not wanted */
    double *time_s;
    double *sum;         /* [2 terms], for means */
    double *row;         /* [2 (terms + 1)], for means over bins */
    double *work;        /* [2 samples], for slopes */
    hci_effects present; /* what of the effects makes a torque, and what of the readings */
    hci_effect *present_effect;
    hci_effect_term *present_term;
    bool instant; /* wanted as it is at each sample, not as a slope shows it */
    bool apart;   /* wanted: derivatives at a scale of the current's torque that stays as it is */
    size_t terms;
    double finest_order; /* of a model whose sensor answers along time; NAN: it does not */
    size_t asked;        /* out: samples and places between them that the model was asked at, of a segment */
    size_t filtered; /* out: samples that went through a stage of a torque sensor, those before included */
    double holding_scale; /* of torques that stand for a current: declared over modelled torque per ampere */
    double *current_Nm;   /* [samples], what a current makes of torque_Nm where its scale is no value of the
                           * rows: of a shaft that hardly accelerates; NULL: no such run is in use */
    double constant_Nm_per_A;  /* the modelled torque per ampere, there */
    double *constant_by_value; /* [terms], its derivatives; 0: no such run */
} hci_predicted_reading;

#endif
