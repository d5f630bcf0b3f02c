#include "cli/terminal/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int by_place(const void *a, const void *b)
{
    const size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

size_t cli_pick(double (*value)(const void *context, size_t k), const void *context, size_t count,
                double least, size_t pick[CLI_MOST_ROWS], size_t *left_out)
{
    double largest = 0.0;
    size_t picked = 0, eligible = 0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, value(context, k));
    for (size_t k = 0; k < count && largest > 0.0; ++k) {
        const double v = value(context, k);
        size_t at = picked;
        if (!(v >= least * largest)) continue;
        ++eligible;
        while (at > 0 && value(context, pick[at - 1]) < v)
            --at;
        if (at == CLI_MOST_ROWS) continue;
        if (picked < CLI_MOST_ROWS) ++picked;
        memmove(pick + at + 1, pick + at, (picked - at - 1) * sizeof *pick);
        pick[at] = k;
    }
    qsort(pick, picked, sizeof *pick, by_place);
    if (left_out) *left_out = eligible - picked;
    return picked;
}
