/* Swings of several runs that are one: of the same frequency, or as often in a turn. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_SWING_GROUPS_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_SWING_GROUPS_H

#include <stdbool.h>

#include "host/diagnose/prepare/run_statistics.h"

typedef struct {
    bool of_turn;        /* frequency is per turn of the rotor, else in Hz */
    double frequency;    /* mean, weighted by the errors */
    double error;        /* standard error */
    double amplitude_Nm; /* mean */
    size_t runs;         /* in so many */
} hci_swing_group;

/* Those of most runs first. */
typedef struct {
    hci_swing_group group[HCI_MOST_SWINGS];
    size_t count;
} hci_swing_groups;

/* statistics: of each run. */
hci_swing_groups hci_swing_groups_find(const hci_run_statistics *statistics, size_t runs);

/* Whether a swing is one of a group. */
bool hci_swing_is_of(const hci_swing *swing, const hci_swing_group *group);

#endif
