/* The phase currents of a recording in the rotor frame, and rates found there as phase quantities: what
 * prediction, diagnosis and the analysis of waveforms all ask of a run. */
#ifndef HCI_SRC_HOST_RECORDING_ROTOR_FRAME_H
#define HCI_SRC_HOST_RECORDING_ROTOR_FRAME_H

#include "hci/effects/effect.h"
#include "hci/host/recording/run.h"
#include "host/recording/rotor_frame.h"

/* i_d, i_q and the zero sequence of sample k, in A. run: with currents and an angle. */
hci_dq hci_run_dq(const hci_run *run, int pole_pairs, size_t k);

/* The same of one sample on its own. */
hci_dq hci_sample_dq(const hci_sample *sample, int pole_pairs);

/* Phase quantities of a vector in the rotor frame at an electrical angle. */
void hci_phases_of_dq(hci_dq x, double theta_e_rad, double abc[3]);

/* Whether the currents lie on one line of the rotor frame, by their mean squares along it and across: those
 * of a drive that keeps its own i_d at 0 do, with the right number of pole pairs. iq_share: out, cosine of
 * the angle between that line and i_q, 0 to 1. O(samples). */
bool hci_run_currents_in_line(const hci_run *run, double *iq_share);

/* Whether phase currents of a steady length go round another whole number of times in a turn of the shaft
 * than there are pole pairs, of a run with a mechanical angle. turns: out, how many, negative against the
 * angle. False where rows lie too far apart. O(samples). */
bool hci_run_currents_go_otherwise(const hci_run *run, double *turns);

/* Where crests of a current stand. */
typedef struct {
    double at_A;
    size_t rows; /* that do */
    bool of_iq;  /* else of a phase */
} hci_run_crests;

/* Whether a phase current or i_q stands at its least or its largest value in 1 % of the samples or more, and
 * in fewer than half of them, and five times as often as within a twentieth of it, where there are some: a
 * current that was rounded coarsely stands at its other values as well. Before anything is taken out of the
 * current. crests: out, the first that do. O(samples). */
bool hci_run_is_clipped(const hci_run *run, hci_run_crests *crests);

#endif
