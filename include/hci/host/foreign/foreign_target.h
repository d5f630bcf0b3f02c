/* Drives of other makers that take a compensation map, by the words of options and files. */
#ifndef HCI_HOST_FOREIGN_FOREIGN_TARGET_H
#define HCI_HOST_FOREIGN_FOREIGN_TARGET_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* X(value, word), one line a target. */
#define HCI_FOREIGN_TARGETS(X)                                                                               \
    X(HCI_FOREIGN_SIMPLEFOC, "simplefoc")                                                                    \
    X(HCI_FOREIGN_MCSDK, "st-mcsdk")                                                                         \
    X(HCI_FOREIGN_MOTEUS, "moteus")                                                                          \
    X(HCI_FOREIGN_NOVANTA, "novanta")                                                                        \
    X(HCI_FOREIGN_BECKHOFF, "beckhoff")                                                                      \
    X(HCI_FOREIGN_OPENFFBOARD, "openffboard")                                                                \
    X(HCI_FOREIGN_CSV, "csv")

/* A target. */
typedef enum {
#define HCI_FOREIGN_VALUE(value, word) value,
    HCI_FOREIGN_TARGETS(HCI_FOREIGN_VALUE)
#undef HCI_FOREIGN_VALUE
        HCI_FOREIGN_TARGET_COUNT /* how many there are */
} hci_foreign_name;

/* What a drive means by amplitude A and phase of an order n at the angle x: X(value, word). */
#define HCI_FOREIGN_WAVES(X)                                                                                 \
    X(HCI_FOREIGN_SINE, "sine")                                                                              \
    X(HCI_FOREIGN_COSINE, "cosine")                                                                          \
    X(HCI_FOREIGN_SINE_LAG, "sine-lag")                                                                      \
    X(HCI_FOREIGN_COSINE_LAG, "cosine-lag")

/* A sin(nx + phase), A cos(nx + phase), A sin(nx - phase), A cos(nx - phase). */
typedef enum {
#define HCI_FOREIGN_VALUE(value, word) value,
    HCI_FOREIGN_WAVES(HCI_FOREIGN_VALUE)
#undef HCI_FOREIGN_VALUE
} hci_foreign_wave;

/* The word of a target; a static string. */
const char *hci_foreign_word(hci_foreign_name name);

/* Whether the values of its maps are torques in N·m; else currents in A. */
bool hci_foreign_is_torque(hci_foreign_name name);

#ifdef __cplusplus
}
#endif

#endif
