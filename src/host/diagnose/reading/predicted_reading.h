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

#include "host/diagnose/reading/along_time.h"
#include "host/diagnose/reading/predicted_rows.h"

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
