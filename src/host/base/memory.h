/* Allocation for host code: the only file that uses the heap. A limit lets tests make allocations fail. */
#ifndef HCI_SRC_HOST_BASE_MEMORY_H
#define HCI_SRC_HOST_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

/* Like calloc/realloc/free; NULL when memory is out. A size of 0 gives a valid pointer. */
void *hci_memory_new(size_t count, size_t size);
void *hci_memory_resize(void *block, size_t count, size_t size);
void hci_memory_free(void *block);

/* A copy of a text, or of its first bytes, with a 0 behind; NULL when memory is out. O(length). */
char *hci_memory_text(const char *text);
char *hci_memory_text_part(const char *text, size_t length);

/* malloc and realloc by their own signatures, for the hooks of other libraries (calloc: hci_memory_new; free:
 * hci_memory_free). */
void *hci_memory_malloc(size_t size);
void *hci_memory_realloc(void *block, size_t size);

/* Whether an allocation has failed since the last call. A function may have gone on without what it had no
 * memory for, and its result is then another one: who writes or keeps a result asks before. */
bool hci_memory_was_short(void);

/* It was short elsewhere, as in the C library. */
void hci_memory_is_short(void);

/* For tests: let `count` more allocations succeed and every later one fail; a negative count switches this
 * off. SuiteSparse and cJSON allocate through these functions too. */
void hci_memory_fail_after(long count);

/* The same, but only one allocation fails: libraries may go on after it. */
void hci_memory_fail_once_after(long count);

#endif
