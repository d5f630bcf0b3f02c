/* An angle whose name does not say whether it is mechanical or electrical. */
#ifndef HCI_SRC_HOST_RECORDING_BARE_ANGLE_H
#define HCI_SRC_HOST_RECORDING_BARE_ANGLE_H

#include "hci/host/csv/csv.h"

/* Gives such a column the name of what it is, where time and mechanical speed tell: the one turns as fast as
 * the speed says, the other by the pole pairs faster (0: by any whole number). Where the file gives no unit,
 * degrees are told from radians so too. A speed whose unit is that of its name in a tool
 * alone (`velocity`: moteus has turn/s, SimpleFOC rad/s) is one in rad/s, turn/s, rpm or degrees/s where a
 * mechanical angle in a unit of its own, or a bare one in rad, goes as far as it then says (to 2 %). What was
 * decided is noted in the table. A file with an electrical angle, or without time or speed, stays as it is.
 * HCI_ERROR_MEMORY. O(rows). */
hci_status hci_bare_angle_decide(hci_csv *csv, int pole_pairs, hci_note *note);

/* Of an angle that is still not told, why: HCI_ERROR_INPUT where it stands, or goes as time and speed say in
 * another unit of one of the three columns, which is named; HCI_OK of any other file. HCI_ERROR_MEMORY.
 * O(rows). */
hci_status hci_bare_angle_explain(hci_csv *csv, int pole_pairs, hci_note *note);

#endif
