/* The effects that diagnose has found, and their values, as the words of tune ask for them. Uses
 * tune_steps. */
#ifndef HCI_CLI_TUNE_EFFECTS_H
#define HCI_CLI_TUNE_EFFECTS_H

#include "cli/tune/tune_steps.h"

/* The place of "sine" or "cosine" among the values of an effect, of an order; -1: none. O(terms). */
int cli_tune_place_of(const hci_effect *effect, const char *name, double order);

/* The amplitude of the order of value k, at its sine, or at a cosine that has none beside it; else 0.
 * std_error: out, in the same unit. O(terms). */
double cli_tune_amplitude_of(const hci_effect *effect, size_t k, double *std_error);

/* Whether an effect is a sum of sines with cosines. O(terms²). */
bool cli_tune_has_orders(const hci_effect *effect);

/* The effect of a finding; NULL: not among those of the corrected machine. */
const hci_effect *cli_tune_effect_of(const cli_tuning *tune, const hci_finding *finding);

/* Whether an effect is a torque that follows the angle alone, as cogging torque is; a back-EMF; a friction.
 * NULL is none. */
bool cli_tune_is_of_angle(const hci_effect *effect);
bool cli_tune_is_of_emf(const hci_effect *effect);
bool cli_tune_is_friction(const hci_effect *effect);

/* An effect that the recordings show and that is of a kind, from number *from of the findings on, which is
 * then behind it; NULL: none. */
const hci_effect *cli_tune_next_found(const cli_tuning *tune, bool (*is_kind)(const hci_effect *),
                                      size_t *from);

#endif
