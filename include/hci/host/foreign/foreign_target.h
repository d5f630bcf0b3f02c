/* Drives of other makers that take a compensation map, by the words of options and files. */
#ifndef HCI_HOST_FOREIGN_FOREIGN_TARGET_H
#define HCI_HOST_FOREIGN_FOREIGN_TARGET_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* X(value, word), one line a target. */
#define HCI_FOREIGN_TARGETS(X) X(HCI_FOREIGN_MOTEUS, "moteus")

/* A target. */
typedef enum {
#define HCI_FOREIGN_VALUE(value, word) value,
    HCI_FOREIGN_TARGETS(HCI_FOREIGN_VALUE)
#undef HCI_FOREIGN_VALUE
        HCI_FOREIGN_TARGET_COUNT /* how many there are */
} hci_foreign_name;

/* The word of a target; a static string. */
const char *hci_foreign_word(hci_foreign_name name);

/* Whether the values of its maps are torques in N·m; else currents in A. */
bool hci_foreign_is_torque(hci_foreign_name name);

#ifdef __cplusplus
}
#endif

#endif
