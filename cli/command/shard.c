#include "cli/command/shard.h"

#include <math.h>
#include <string.h>

#include "hci/host/base/number.h"

enum { NUMBER_SIZE = 32 };

static bool is_whole(double value)
{
    return value >= 1.0 && value <= CLI_MOST_SHARES && floor(value) == value;
}

hci_status cli_shard_read(const char *text, cli_shard *shard, hci_note *note)
{
    const char *slash = text ? strchr(text, '/') : NULL;
    char share[NUMBER_SIZE] = "";
    double of[2];
    *shard = (cli_shard){1, 1};
    if (!text) return HCI_OK;
    if (slash && (size_t)(slash - text) < sizeof share) memcpy(share, text, (size_t)(slash - text));
    if (slash && hci_number_parse(share, &of[0]) && hci_number_parse(slash + 1, &of[1]) && is_whole(of[0]) &&
        is_whole(of[1]) && of[0] <= of[1]) {
        *shard = (cli_shard){(size_t)of[0], (size_t)of[1]};
        return HCI_OK;
    }
    return hci_note_set(note, HCI_ERROR_ARGUMENT, "--shard: found `%.60s`, expected a share such as 3/16",
                        text);
}

bool cli_shard_has(const cli_shard *shard, size_t index)
{
    return index % shard->shares == shard->share - 1;
}
