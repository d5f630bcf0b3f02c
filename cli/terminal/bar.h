/* One bar of characters. Uses nothing of cli. */
#ifndef HCI_CLI_BAR_H
#define HCI_CLI_BAR_H

#include <stdbool.h>

/* A bar in so many cells, of blocks or of ASCII (cli_is_ascii). share: how much of it is filled, mark: where
 * a line goes across it, both from 0 to 1, NAN for none. text: out, 4 bytes for each cell and one. */
void cli_bar_text(double share, double mark, int cells, bool ascii, char *text);

#endif
