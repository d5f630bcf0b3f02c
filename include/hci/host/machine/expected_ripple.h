/* What the torque of the real machine is expected to do, from what its recordings leave open. */
#ifndef HCI_HOST_MACHINE_EXPECTED_RIPPLE_H
#define HCI_HOST_MACHINE_EXPECTED_RIPPLE_H

#include "hci/host/machine/uncertainty.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether it can be told. */
typedef enum {
    HCI_RIPPLE_KNOWN,
    HCI_RIPPLE_NO_RECORDINGS, /* the machine has no uncertainty.csv */
    HCI_RIPPLE_OTHER_EFFECTS, /* effects.csv is not the one that uncertainty.csv was found for */
    HCI_RIPPLE_TOO_FAR, /* parts of one or two recordings tell nothing of currents so far outside of them */
    HCI_RIPPLE_UNTOLD,  /* the recordings tell of no order of the torque, or of the lowest alone, such as ones
                         * with a few samples in a turn */
    HCI_RIPPLE_UNEXPLAINED, /* the diagnosis that the machine comes from has not explained its recordings */
    HCI_RIPPLE_SWAYED,  /* a load that turns with the shaft makes with the back-EMF what looks like cogging
                           torque */
    HCI_RIPPLE_UNLOADED /* no recording shows a torque under load, and what was found without bounds nothing
                         */
} hci_ripple_state;

/* Why it is not known in words, "" where it is; a static string. */
const char *hci_ripple_state_words(hci_ripple_state state);

/* Ripple and mean of the torque. Of twenty machines that the recordings allow, one exceeds each figure. */
typedef struct {
    hci_ripple_state state;             /* where not known, all numbers are NAN */
    double peak_to_peak_Nm;             /* max − min over the angle */
    double T_ripple_percent;            /* 100 (max − min)/|mean|; NAN without a mean */
    double middle_percent;              /* the same that half of the machines exceed */
    double error_peak_to_peak_Nm;       /* max − min of the torque less that of the model */
    double worst_order, worst_order_Nm; /* the order that differs most from what is wanted, and that
                                         * amplitude; NAN where the samples are no whole turns */
    hci_measured_range id_A, iq_A;      /* that flow */
    hci_measured_range measured_id_A, measured_iq_A, measured_speed_rad_per_s; /* that were recorded */
    double outside_share;      /* of the angle, where i_d or i_q is outside of what was recorded: 0 to 1 */
    double outside_A;          /* how far at most */
    bool speed_outside;        /* the speed is; false where it is not known */
    size_t recordings;         /* that tell it; 0: not known. Of fewer than three, parts were compared */
    hci_machine_origin origin; /* known or not: where the model comes from */
    double unbelievable_order; /* the order of an effect's back-EMF that is larger than magnets and windings
                                * make it; NAN: none */
    double unbelievable_share; /* its amplitude over that of the fundamental; NAN: none */
    double mean_Nm;            /* of the torque of the model; NAN where the samples are no whole turns */
    double mean_error_Nm;      /* size of the mean torque less that; NAN with it */
    double table_peak_to_peak_Nm; /* the part of peak_to_peak_Nm that the cut of a table adds; 0: currents as
                                   * they were solved */
    double loop_peak_to_peak_Nm;  /* the part that a current loop adds; 0: currents that flow as they are */
    double angle_peak_to_peak_Nm; /* the part that the steps of a recorded angle add */
    double left_peak_to_peak_Nm;  /* the part that only what the model leaves of its recordings asks for */
    bool if_in_time; /* all of it is of a torque sensor that is in time, which recordings of one speed do not
                      * tell; set by whom the recordings are known to */
} hci_expected_ripple;

/* The same with a table that the currents were cut to. table_Nm: peak to peak, of the torque with the table
 * less that of the currents; mean_Nm: of the torque. */
void hci_expected_ripple_add_table(hci_expected_ripple *expected, double table_Nm, double mean_Nm);

/* The same with a current loop. loop_Nm: peak to peak, of the torque through the loop less that of currents
 * that flow as they are. */
void hci_expected_ripple_add_loop(hci_expected_ripple *expected, double loop_Nm, double mean_Nm);

/* The same with an angle that was recorded in steps, whose middle is half of one away where they were cut off
 * and not rounded. angle_Nm: peak to peak, of the torque with the currents so much early or late, less that
 * in time. */
void hci_expected_ripple_add_angle(hci_expected_ripple *expected, double angle_Nm, double mean_Nm);

/* Whether what holds for the model may not hold for the machine at all: the diagnosis has not explained its
 * recordings, or a value of it is not believable. */
bool hci_expected_ripple_is_doubtful(const hci_expected_ripple *expected);

/* A bound as sentences and tables say it: two digits, rounded up. */
double hci_ripple_bound_as_said(double value);

/* What to expect in a few plain sentences. size: of text, 1024 will do. */
void hci_expected_ripple_words(const hci_expected_ripple *expected, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
