/* Loops over many numbers, compiled three times: for every processor of the kind, and for those with vectors
 * of four and of eight doubles. Which of them is taken is decided when the program starts. Each number is
 * computed by the same operations in the same order in all, so results do not depend on the processor.
 *
 * HCI_WIDE stands before a function. Elsewhere than with GCC on x86-64 and glibc, and under a sanitizer, it
 * is nothing. */
#ifndef HCI_SRC_HOST_NUMERIC_WIDE_H
#define HCI_SRC_HOST_NUMERIC_WIDE_H

#include <limits.h> /* says __GLIBC__ */

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) &&                 \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HCI_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define HCI_WIDE
#endif

#endif
