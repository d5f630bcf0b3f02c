/* A share of independent work, as `--shard 3/16` names it. Uses the headers of host. */
#ifndef HCI_CLI_SHARD_H
#define HCI_CLI_SHARD_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"

enum { CLI_MOST_SHARES = 100000 };

/* Share `share` of `shares`, from 1. */
typedef struct {
    size_t share, shares;
} cli_shard;

/* text: or NULL for all of it, share 1 of 1. HCI_ERROR_ARGUMENT. */
hci_status cli_shard_read(const char *text, cli_shard *shard, hci_note *note);

/* Whether the item with this index, from 0, belongs to the share. */
bool cli_shard_has(const cli_shard *shard, size_t index);

#endif
