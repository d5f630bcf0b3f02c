/* A motor's row: what stands in each column, and where it is from. */
#ifndef HCI_SRC_HOST_FLEET_ROW_H
#define HCI_SRC_HOST_FLEET_ROW_H

#include "hci/host/fleet/results.h"

/* What to do about a file of a batch that is another one than it wrote. */
#define HCI_FLEET_BATCH_AGAIN "the same hci-solve batch again writes it anew"

/* The header of fleet.csv, without its end. */
void hci_fleet_header(hci_fleet_command command, char header[HCI_FLEET_ROW_SIZE]);

/* The row of a motor; part: the folder with its results. */
void hci_fleet_row_make(const hci_fleet_results *results, size_t motor, const hci_fleet_outcome *outcome,
                        const hci_fleet_digest *digest, const char *part, char row[HCI_FLEET_ROW_SIZE]);

/* The cell of a column of a row, without quotes. cell: out, "" where there is none; size: of it. */
void hci_fleet_row_cell(const char *row, const char *header, const char *column, char *cell, size_t size);

/* What a row has beyond the motor's own columns, its state and exit code: what was found, and the digest. */
const char *hci_fleet_row_findings(const char *row);

#endif
