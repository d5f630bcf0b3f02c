/* The pictures of `tune`, each a sentence and the drawing that shows it. */
#ifndef HCI_SRC_HOST_REPORT_TUNE_TUNING_PICTURES_H
#define HCI_SRC_HOST_REPORT_TUNE_TUNING_PICTURES_H

#include "hci/host/report/tune/tuning.h"
#include "host/report/page/solution_sections.h"

/* Torque with and without current, and the currents, over the same angle. page: with facts. */
void hci_page_tuned(const hci_solution_page *page, const hci_tuning *tuning);

/* The log that is shown; nothing where there is none. */
void hci_page_log(hci_output *out, const hci_tuning *tuning);

#endif
