/* Words of commands and states. */
#include "hci/host/fleet/results.h"

#define NAME_OF(value, word) [value] = word,

const char *hci_fleet_command_name(hci_fleet_command command)
{
    static const char *const NAME[] = {HCI_FLEET_COMMAND_NAMES(NAME_OF)};
    return NAME[command];
}

const char *hci_fleet_state_name(hci_fleet_state state)
{
    static const char *const NAME[] = {HCI_FLEET_STATE_NAMES(NAME_OF)};
    return NAME[state];
}
