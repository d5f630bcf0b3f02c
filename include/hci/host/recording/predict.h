/* What a machine's model says of a run: torque for the angle and the currents that were recorded. */
#ifndef HCI_HOST_RECORDING_PREDICT_H
#define HCI_HOST_RECORDING_PREDICT_H

#include "hci/effects/effect.h"
#include "hci/host/machine/expected_ripple.h"
#include "hci/host/machine/machine.h"
#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One sample of a run that has an angle, as the effects take it: rates of change are 0. */
hci_sample hci_predict_reading(const hci_run *run, size_t sample);

/* The samples of a run as the effects take them. needs: of HCI_EFFECT_NEEDS_RATE, how fast the currents
 * change in the rotor frame, and HCI_EFFECT_NEEDS_ACCELERATION, which take time and are 0 where they are not
 * asked for. What the run does not have is 0, temperatures NAN. reading: out, run->count. HCI_ERROR_INPUT for
 * a run without an angle, HCI_ERROR_MEMORY. O(samples). */
hci_status hci_predict_readings(const hci_run *run, int pole_pairs, unsigned needs, hci_sample *reading,
                                hci_note *note);

/* The torque that the sensor of the bench should have read: declared machine, and effects, the sensor's lag
 * along the run included where the run has time. torque_Nm: out, run->count. HCI_ERROR_INPUT, _MEMORY.
 * O(samples·(terms + harmonics)). */
hci_status hci_predict(const hci_machine_data *machine, const hci_effects *effects, const hci_run *run,
                       double *torque_Nm, hci_note *note);

/* In sum, over the samples; NAN where the run has no torque. */
typedef struct {
    size_t count;                             /* samples */
    hci_torque_source source;                 /* where the torque of the run is from */
    double mean_model_Nm, ripple_model_Nm;    /* ripple: rms about the mean */
    double mean_torque_Nm, ripple_torque_Nm;  /* the same of the run's torque */
    double mean_residual_Nm, rms_residual_Nm; /* residual: torque of the run − model */
    double worst_residual_Nm;                 /* largest absolute value */
    size_t worst_sample;                      /* where, from 0 */
    double peak_to_peak_Nm;                   /* largest less smallest torque of the run */
    hci_expected_ripple expected;             /* of the real machine with these currents */
    hci_note remark;                          /* of reading and predicting, or "" */
} hci_prediction;

/* Predicts a run file by a machine folder with its effects, and writes the run's own columns with
 * torque_model_Nm and, where the run has a torque, residual_Nm; of a free shaft also torque_inertia_Nm.
 * A run without a torque column whose current makes much more than inertia times acceleration is no free
 * shaft: it has no torque, and the remark says so. Columns of these names are replaced, and are empty in rows
 * that were left out on reading. reading: pole pairs and inertia are those of the machine. out: path of the
 * file, or NULL: nothing is written. *prediction: out. HCI_ERROR_INPUT, _MEMORY, _OUTPUT, _NOT_FINITE. */
hci_status hci_predict_file(const char *machine, const char *run, const hci_run_options *reading,
                            const char *out, hci_prediction *prediction, hci_note *note);

/* A run as it was read, and what the model says of each of its samples. Start with {0}. */
typedef struct {
    hci_run run;         /* its torque is NULL where there is nothing to compare with */
    double *model_Nm;    /* [run.count] */
    double *residual_Nm; /* [run.count], torque of the run − model; NULL where the run has no torque */
} hci_predicted_run;

/* The same without a file: the samples are kept. *predicted: out, to be given to hci_predicted_run_release;
 * empty on failure. Errors as of hci_predict_file. */
hci_status hci_predict_samples(const char *machine, const char *run, const hci_run_options *reading,
                               hci_predicted_run *predicted, hci_prediction *prediction, hci_note *note);

/* Frees what it holds and empties it. */
void hci_predicted_run_release(hci_predicted_run *predicted);

#ifdef __cplusplus
}
#endif

#endif
