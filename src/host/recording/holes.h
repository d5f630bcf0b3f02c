/* Rows of a recording that cannot be used: cells without a number, lines that are cut or joined, lines that
 * are there twice, readings that stand still while the rest goes on. */
#ifndef HCI_SRC_HOST_RECORDING_HOLES_H
#define HCI_SRC_HOST_RECORDING_HOLES_H

#include "host/recording/run_columns.h"

/* Finds the columns of a recording as hci_run_columns_find does. Where holes may be left out
 * (hci_csv_read_recording) it reads those that say something of their own, and leaves out the rows in which
 * one of them has no number, those that repeat the row before them with its time, and those in which the
 * torque, or all currents, were not read anew. Of a recording with a torque also those in which the shaft
 * stands while it turns otherwise, and those in which the torque is at the end of its sensor, which sets
 * c->torque_is_clipped. Where one of three phase currents is at the end of its sensor it is taken from the
 * two others, as far as they make no sum elsewhere. c->ready, c->row and c->count: of the rows that are left.
 * A column without any number is one that the file does not have, and missing temperatures are interpolated.
 * remark says what was left out, each once. HCI_ERROR_INPUT where more than half of the rows would be, or for
 * a column that cannot be read; HCI_ERROR_MEMORY. */
hci_status hci_run_columns_open(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note);

/* So, for who can do without angle and voltages. */
hci_status hci_run_columns_open_any(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note);

#endif
