/* The report of `harmonics` on the terminal. Uses the folder terminal. */
#ifndef HCI_CLI_HARMONICS_WORDS_H
#define HCI_CLI_HARMONICS_WORDS_H

#include "hci/host/waveform/waveform.h"

/* How many orders there are, where they are from, how sure they are, and a drawing, on standard output. run:
 * its path. */
void cli_show_waveform(const hci_waveform *w, const char *run);

#endif
