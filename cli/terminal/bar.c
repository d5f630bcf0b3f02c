#include "cli/terminal/bar.h"

#include <math.h>
#include <string.h>

/* What a cell of a bar shows that is filled to so many eighths. */
static const char *cell_text(int eighths, bool marked, bool ascii)
{
    static const char *const BLOCKS[] = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};
    if (ascii) return marked ? "|" : eighths >= 4 ? "#" : " ";
    return marked ? "│" : BLOCKS[eighths];
}

void cli_bar_text(double share, double mark, int cells, bool ascii, char *text)
{
    const int eighths = share > 0.0 ? (int)(8.0 * cells * fmin(share, 1.0) + 0.5) : 0;
    const int marked = mark >= 0.0 && mark < 1.0 ? (int)(mark * cells) : -1;
    text[0] = '\0';
    for (int k = 0; k < cells; ++k) {
        const int filled = eighths - 8 * k;
        strcat(text, cell_text(filled < 0 ? 0 : filled > 8 ? 8 : filled, k == marked, ascii));
    }
}
