/* Headers that say more than the name of their channel: the group that it stands in, the device or the
 * program that it comes from. */
#ifndef HCI_SRC_HOST_CSV_CHANNEL_NAME_H
#define HCI_SRC_HOST_CSV_CHANNEL_NAME_H

#include <stdbool.h>
#include <stddef.h>

enum { HCI_CHANNEL_SIZE = 96 };

/* The channel of such a header: the last part of "/'Group'/'Channel [Nm]'" (npTDMS), "Channel\Source: 1"
 * (asammdf) or "MAIN.fbAxis.Channel" (a controller), of the last only where what stands before it names
 * places alone. False: the header is the name itself, or its group is one of what is wanted and not of what
 * is. is_of_place: out, whether it is of a controller: such a name counts only with its unit, since each
 * controller has units of its own. */
bool hci_channel_name(const char *header, char name[HCI_CHANNEL_SIZE], bool *is_of_place);

/* Whether a word of the text speaks of what is wanted, limited or put on, and not of what is. */
bool hci_channel_is_wanted(const char *text, size_t length);

#endif
