/* Three currents of a machine without a neutral conductor sum to nothing. In: their columns. Out: the one
 * channel that has to be read otherwise for that to hold, such as a clamp that sits the other way round. */
#ifndef HCI_SRC_HOST_CHECK_ODD_CHANNEL_H
#define HCI_SRC_HOST_CHECK_ODD_CHANNEL_H

#include <stdbool.h>
#include <stddef.h>

typedef enum {
    CHECK_CHANNELS_AGREE, /* as far as is known */
    CHECK_CHANNEL_ODD,    /* one of them reads gain times the current */
    CHECK_CHANNEL_DEAD,   /* one of them reads nothing */
    CHECK_CHANNELS_TWINS  /* two hold the same, and which is which is not told */
} check_channel_state;

typedef struct {
    check_channel_state state;
    int phase; /* 0, 1, 2 for a, b, c; of twins the one that is none of them */
    double gain;
} check_odd_channel;

/* column: three of `count` samples. O(count). */
check_odd_channel hci_check_odd_channel(const double *const column[3], size_t count);

#endif
