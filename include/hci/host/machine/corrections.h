/* What a drive has to do to the readings of its sensors before currents for the true machine do in it what
 * they are meant for. */
#ifndef HCI_HOST_MACHINE_CORRECTIONS_H
#define HCI_HOST_MACHINE_CORRECTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/effects/effect.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes that the words of all sensors of a drive fit in. */
enum { HCI_CORRECTIONS_SIZE = 1024 };

/* The corrections of the current and position sensors that `effects` describe, with their values: "take 0.06
 * A from i_a, …; divide i_a by 1.012; …", each the inverse of its effect to first order, in ASCII for the
 * comment of a source. Torque sensors are none of a drive, and an angle that seems to be read before it is true
 * is left as it is. text: out; "" where there is nothing to correct;
 * what has no room is cut off. size: of text, HCI_CORRECTIONS_SIZE will do. */
void hci_corrections_words(const hci_effects *effects, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
