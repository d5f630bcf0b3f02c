/* The torque that a model has the sensor read along a segment, and its derivatives by the model's values.
 *
 * The torque at each sample is that of the effects; a lag or resonance of the sensor then filters it along
 * time. The mean of a steady turn is run through several times until the sensor has settled. Where the
 * torque was measured as an acceleration, a slope of the speed over a window, it is the mean over that
 * window.
 *
 * In a holding test the current is what was measured, and the torque that the model leaves stands for the
 * current that would make it: it is given in units of the declared torque per ampere, so that a model which
 * makes no torque at all does not describe every holding test. The same holds for a free shaft that hardly
 * accelerates. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_PREDICTED_READING_H
#define HCI_SRC_HOST_DIAGNOSE_READING_PREDICTED_READING_H

#include "host/diagnose/reading/regression.h"

/* The mean of a steady turn is run through so many times at most, so that a slow sensor settles. */
enum { HCI_SETTLING_TURNS = 4 };

#define HCI_SETTLED 16.0 /* time constants, after which 1e-7 is left */

/* How long a sensor with such dynamics takes to settle; 0 without any, INFINITY where it never does. */
double hci_settling_s(const hci_effects *effects);

/* Samples of the turns before the mean of a steady one that take so long, at most all but one of
 * HCI_SETTLING_TURNS. sample: of the segment. */
size_t hci_settling_samples(const hci_binned_sample *sample, const hci_segment *segment, double settling_s);

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

/* Whether a run's torque stands for a current: nothing in it tells the size of a torque per ampere. */
bool hci_run_reads_current(const hci_run *run);

/* False when memory is out, and then there is nothing to release. */
bool hci_predicted_reading_make(const hci_regression *regression, const hci_effects *effects,
                                bool derivatives, hci_predicted_reading *reading_out);
void hci_predicted_reading_release(hci_predicted_reading *reading_out);

/* Fills torque_Nm and by_value for the samples of a segment. Of a shaft that hardly accelerates what the
 * current makes is torque_Nm in units of constant_Nm_per_A: by_value is less current_Nm[k] ·
 * constant_by_value[c] / constant_Nm_per_A there, unless that is wanted apart. O(samples·terms). */
void hci_predicted_reading_fill(const hci_regression *regression, const hci_effects *effects,
                                const hci_segment *segment, hci_predicted_reading *reading_out);

/* Whether a torque sensor and a clock stood beside each other, so that its lag shows: where readings
 * are free of noise, which any lag would take away, or the lag is declared. */
bool hci_predicted_reading_is_dynamic(const hci_regression *regression, const hci_segment *segment);

/* Measured less modelled torque of each sample of the runs in use, others 0: residual_Nm[samples].
 * Without its mean in each segment of a run whose mean is not known.
 * HCI_ERROR_MEMORY. O(samples·terms). */
hci_status hci_regression_residual(const hci_regression *regression, const hci_effects *effects,
                                   double *residual_Nm, hci_note *note);

#endif
