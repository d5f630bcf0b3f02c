/* What the current loop of a drive is, with a machine, before anything runs: bandwidth, how far it is from
 * the edge of stability, up to which speed it does, and whether its measured response is that of its gains.
 */
#ifndef HCI_HOST_DRIVE_DRIVE_FACTS_H
#define HCI_HOST_DRIVE_DRIVE_FACTS_H

#include "hci/host/drive/drive.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What would make a measured response that of the gains: X(value, word, what it says). */
#define HCI_RESPONSE_READINGS(X)                                                                             \
    X(HCI_RESPONSE_AS_DECLARED, "as_declared", "as declared")                                                \
    X(HCI_RESPONSE_OTHER_CURRENT, "other_current",                                                           \
      "it is of the other current: change `response_of`, `samples` as the drive reads it or `current` as "   \
      "an "                                                                                                  \
      "analyser does")                                                                                       \
    X(HCI_RESPONSE_FREQUENCY, "frequency",                                                                   \
      "the frequencies are in another unit than Hz: multiply the column `frequency_Hz`")                     \
    X(HCI_RESPONSE_SCALE, "scale",                                                                           \
      "current and reference are in different units, such as peak and rms: multiply the gains")              \
    X(HCI_RESPONSE_HALF_TURN, "half_turn",                                                                   \
      "current and reference have different signs: add half a turn to the phases")                           \
    X(HCI_RESPONSE_GAINS, "gains", "k_p and k_i of the drive are others")                                    \
    X(HCI_RESPONSE_DELAY, "delay", "computing_delay is another")                                             \
    X(HCI_RESPONSE_UNKNOWN, "unknown", "no other gains, delay or units explain it")

/* Which reading of a response agrees. */
typedef enum {
    HCI_RESPONSE_AS_DECLARED,   /* within HCI_RESPONSE_TOLERANCE */
    HCI_RESPONSE_OTHER_CURRENT, /* that which flows for that of the samples, or the other way round */
    HCI_RESPONSE_FREQUENCY,     /* frequencies in rad/s, or turns that were taken for rad */
    HCI_RESPONSE_SCALE,         /* all gains times one factor */
    HCI_RESPONSE_HALF_TURN,     /* all phases half a turn on */
    HCI_RESPONSE_GAINS,         /* gains of the drive times one factor with which it is stable */
    HCI_RESPONSE_DELAY,         /* another computing delay */
    HCI_RESPONSE_UNKNOWN        /* none of these */
} hci_response_reading;

/* Share by which a response may be off: what R and L that are known to a tenth do to it, and some noise. */
#define HCI_RESPONSE_TOLERANCE 0.2

/* What is known of a loop. */
typedef struct {
    hci_drive_data drive;     /* fitted, without its response and path */
    double inductance_H[2];   /* L_d and L_q, means over a turn */
    double bandwidth_Hz[2];   /* d and q: the answer is 3 dB down, at standstill; INFINITY: nowhere below the
                                 highest frequency */
    double peak[2];           /* d and q: largest answer to a reference of 1, at standstill */
    double peak_Hz[2];        /* where */
    double lead_s;            /* how late the current is at low frequency */
    double largest_pole;      /* of the closed loop at standstill, in z */
    double gain_margin;       /* both gains can be so many times as large; at most 100 */
    double stable_rad_per_s;  /* mechanical speed from which on it is not stable; INFINITY: none that the
                                 sampling does for */
    double sampled_rad_per_s; /* mechanical speed with 10 samples in an electrical turn */
    int pole_pairs;           /* of the machine */
    double speed_rad_per_s;   /* that was asked for, mechanical; 0: none */
    double highest_order;     /* in the rotor frame, that the sampling does for at that speed */
    size_t response_count;    /* frequencies of the response; 0: none, and all that follow are NAN */
    double response_off;      /* largest |measured/computed − 1| */
    double response_off_Hz;   /* where */
    hci_response_reading reading; /* what explains it */
    double reading_off;           /* what is left with that reading */
    double reading_value;         /* factor of the gains of the drive, of the frequencies or of the measured
                                   * gains, or computing delay in s; else NAN */
} hci_drive_facts;

/* The word of a reading in files. */
const char *hci_response_reading_name(hci_response_reading reading);
/* Bytes of what is said of a reading. */
enum { HCI_RESPONSE_TEXT_SIZE = 256 };
/* What the reading of a response says, with its value and what is left, for people. */
void hci_response_reading_text(const hci_drive_facts *facts, char text[HCI_RESPONSE_TEXT_SIZE]);
/* Says that the response of a drive, as read or fitted, is not that of its gains, and why. Nothing where it
 * is, or where there is none. */
void hci_drive_remark_response(const hci_drive_data *drive, const hci_machine_data *machine,
                               hci_note *remark);

/* Looks at the loop. speed_rad_per_s: mechanical, 0 for none. The drive is fitted by it. HCI_ERROR_INPUT as
 * hci_drive_fit and hci_drive_check_speed, so where the loop is not stable; _MEMORY. */
hci_status hci_drive_facts_of(hci_drive_data *drive, const hci_machine_data *machine, double speed_rad_per_s,
                              hci_drive_facts *facts, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
