/* Sorting in place: the C library's qsort may allocate. Quicksort, and heap sort where that divides badly. */
#ifndef HCI_SRC_CORE_MATH_SORT_H
#define HCI_SRC_CORE_MATH_SORT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    bool (*comes_after)(const void *items, size_t a, size_t b);
    void (*swap)(void *items, size_t a, size_t b);
} hci_sorting;

/* Puts items[0 … count) in ascending order. O(n log n). */
void hci_sort(void *items, size_t count, const hci_sorting *sorting);

#endif
