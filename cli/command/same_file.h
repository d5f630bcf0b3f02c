/* Whether a result would replace what is read. */
#ifndef HCI_CLI_SAME_FILE_H
#define HCI_CLI_SAME_FILE_H

#include <stdbool.h>

/* Whether both paths are of one file or folder that is there. */
bool cli_is_same_file(const char *path, const char *other);

#endif
