/* The few largest of many, in their own order. */
#include <stdlib.h>
#include <string.h>

#include "host/plot/plot.h"

static int by_place(const void *a, const void *b)
{
    const size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

size_t hci_plot_largest(double (*weight)(const void *context, size_t k), const void *context, size_t count,
                        size_t most, size_t *place)
{
    size_t chosen = 0;
    for (size_t k = 0; k < count; ++k) {
        const double w = weight(context, k);
        size_t at = chosen;
        if (!(w > 0.0)) continue;
        while (at > 0 && weight(context, place[at - 1]) < w)
            --at;
        if (at == most) continue;
        if (chosen < most) ++chosen;
        memmove(place + at + 1, place + at, (chosen - at - 1) * sizeof *place);
        place[at] = k;
    }
    qsort(place, chosen, sizeof *place, by_place);
    return chosen;
}
