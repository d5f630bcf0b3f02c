#include "core/math/sort.h"

static void sift_down(void *items, size_t root, size_t count, const hci_sorting *sorting)
{
    for (size_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && sorting->comes_after(items, child + 1, child)) ++child;
        if (!sorting->comes_after(items, child, root)) return;
        sorting->swap(items, root, child);
    }
}

void hci_sort(void *items, size_t count, const hci_sorting *sorting)
{
    for (size_t k = count / 2; k-- > 0;)
        sift_down(items, k, count, sorting);
    for (size_t k = count; k-- > 1;) {
        sorting->swap(items, 0, k);
        sift_down(items, 0, k, sorting);
    }
}
