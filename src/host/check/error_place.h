/* Where a convention error stands: file, line and column of the number, what it says and what it should say.
 */
#ifndef HCI_SRC_HOST_CHECK_ERROR_PLACE_H
#define HCI_SRC_HOST_CHECK_ERROR_PLACE_H

#include "hci/host/check/check.h"
#include "host/check/convention_errors.h"

/* Whether the files have what an error is about, so that it can stand in them at all. */
bool hci_check_error_applies(const check_error *error, const check_data *data);

/* Fills all of a finding but its probability and alternatives, for an error of the interpretation `as`. */
void hci_check_error_locate(const check_error *error, const check_data *data, const check_interpretation *as,
                            hci_check_finding *finding);

#endif
