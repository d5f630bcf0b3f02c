#include "core/math/sort.h"

enum { FEW = 12, MOST_DEPTH = 64 }; /* items that are put in order one by one; see sort_range */

/* Items first … first + count. */
typedef struct {
    void *items;
    size_t first, count;
    const hci_sorting *by;
} range;

static bool comes_after(const range *r, size_t a, size_t b)
{
    return r->by->comes_after(r->items, r->first + a, r->first + b);
}

static void swap(const range *r, size_t a, size_t b)
{
    r->by->swap(r->items, r->first + a, r->first + b);
}

static bool is_sorted(const range *r)
{
    for (size_t k = 1; k < r->count; ++k)
        if (comes_after(r, k - 1, k)) return false;
    return true;
}

static void insert_each(const range *r)
{
    for (size_t k = 1; k < r->count; ++k)
        for (size_t j = k; j > 0 && comes_after(r, j - 1, j); --j)
            swap(r, j - 1, j);
}

/* ---- where quicksort does badly ---- */

static void sift_down(const range *r, size_t root, size_t count)
{
    for (size_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && comes_after(r, child + 1, child)) ++child;
        if (!comes_after(r, child, root)) return;
        swap(r, root, child);
    }
}

static void heap_sort(const range *r)
{
    for (size_t k = r->count / 2; k-- > 0;)
        sift_down(r, k, r->count);
    for (size_t k = r->count; k-- > 1;) {
        swap(r, 0, k);
        sift_down(r, 0, k);
    }
}

/* ---- quicksort ---- */

/* The median of the first, the middle and the last one to the front: the last one does not come before it. */
static void choose_pivot(const range *r)
{
    const size_t middle = r->count / 2, last = r->count - 1;
    if (comes_after(r, middle, last)) swap(r, middle, last);
    if (comes_after(r, 0, last)) swap(r, 0, last);
    if (comes_after(r, middle, 0)) swap(r, middle, 0);
}

/* Where the first one belongs: none before that comes after it, and none behind that it comes after. */
static size_t divide(const range *r)
{
    size_t low = 0, high = r->count;
    choose_pivot(r);
    for (;;) {
        do
            ++low;
        while (comes_after(r, 0, low));
        do
            --high;
        while (comes_after(r, high, 0));
        if (low >= high) break;
        swap(r, low, high);
    }
    swap(r, 0, high);
    return high;
}

/* The smaller part first and the larger one in the loop, so that little waits; depth: how often it may
 * divide. */
static void sort_range(range r, int depth)
{
    for (; r.count > FEW && depth > 0; --depth) {
        const size_t at = divide(&r);
        range before = r, behind = r;
        before.count = at;
        behind.first += at + 1;
        behind.count -= at + 1;
        sort_range(before.count < behind.count ? before : behind, depth - 1);
        r = before.count < behind.count ? behind : before;
    }
    if (r.count > FEW)
        heap_sort(&r);
    else
        insert_each(&r);
}

void hci_sort(void *items, size_t count, const hci_sorting *sorting)
{
    const range all = {items, 0, count, sorting};
    int depth = 0;
    for (size_t k = count; k > 1 && depth < MOST_DEPTH; k /= 2)
        depth += 2;
    if (!is_sorted(&all)) sort_range(all, depth);
}
