/* The smallest further measurement that would tell two explanations apart. */
#ifndef HCI_SRC_HOST_ADVISE_H
#define HCI_SRC_HOST_ADVISE_H

#include "evidence.h"

/* Looks through steady runs of one mechanical turn over currents, current angles, speeds and directions
 * within the range of the recordings, and four times the speed where they have one only. For each, χ² by
 * which the explanation `right` would contradict `wrong` after `wrong` has been fitted again, with what the
 * recordings know of its parameters. text: out, in words: the run with the least current and speed that is
 * decisive, or the best one. HCI_ERROR_MEMORY. */
hci_status hci_advise(const hci_evidence *evidence, const hci_suspects *right, const hci_suspects *wrong,
                      const char *right_name, const char *wrong_name, char *text, size_t size,
                      hci_note *note);

#endif
