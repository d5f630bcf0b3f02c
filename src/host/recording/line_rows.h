/* A recording that was interpolated onto rows of its own, as spreadsheets and scripts do to bring logs
 * together: back to the points that were measured. */
#ifndef HCI_SRC_HOST_RECORDING_LINE_ROWS_H
#define HCI_SRC_HOST_RECORDING_LINE_ROWS_H

#include "host/recording/run_columns.h"

/* Where the torque runs along straight lines between points at equal distances (straight_lines.h): c->ready,
 * c->row (the nearest) and c->count of these points. Columns that were interpolated with it are taken back so
 * too, and others along the straight line between the two rows beside a point. Points in a hole, or at which
 * an angle begins its turn again, are left out. remark says it. Anything else is left as it is.
 * HCI_ERROR_MEMORY. O(n). */
hci_status hci_line_rows_take(hci_run_columns *c);

#endif
