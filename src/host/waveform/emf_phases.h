/* The three voltages of a back-EMF as copies of one wave, a third of a period apart. Waves are complex
 * numbers S + jC = A exp(jγ). */
#ifndef HCI_SRC_HOST_WAVEFORM_EMF_PHASES_H
#define HCI_SRC_HOST_WAVEFORM_EMF_PHASES_H

#include <stdbool.h>

#include "host/waveform/task.h"

enum { HCI_EMF_INVERSE = 3, HCI_EMF_CHANNELS = 4 }; /* va, vb, vc, and 1/ω, which an offset follows */

/* A departure of so many standard errors is said. */
#define HCI_EMF_TIMES_ERROR 5.0

typedef struct {
    int sequence;   /* −1: the phases follow each other as a-c-b */
    bool counts[3]; /* channels of the balanced part */
} hci_emf_phases;

hci_average_harmonic hci_emf_turned(hci_average_harmonic wave, double angle_rad);
double hci_emf_length(hci_average_harmonic wave);

/* Turns order k of phase s onto that of phase a, of which it is the third-of-a-period copy. */
hci_average_harmonic hci_emf_onto_a(hci_average_harmonic wave, size_t order, int sequence, size_t phase);

/* Mean of an order in one pass over the channels that count, or over these but `except`. */
hci_average_harmonic hci_emf_balanced(const hci_average *average, const hci_emf_phases *phases, size_t pass,
                                      size_t order, size_t except);

/* rms over the passes of a channel's fundamental. */
double hci_emf_size(const hci_average *average, size_t channel);

/* Leaves out the channel whose scale is not that of the other two. */
void hci_emf_choose_channels(const hci_average *average, hci_emf_phases *phases);

/* Each channel against the others, into the result and its remark. inverse: mean of 1/ω over all passes. */
hci_status hci_emf_compare_channels(const hci_waveform_task *t, const hci_average *average,
                                    const hci_emf_phases *phases, double inverse);

#endif
