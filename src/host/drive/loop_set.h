/* What hci/loop.h runs on, made of a machine, a drive and currents: the orders of current and voltage. */
#ifndef HCI_SRC_HOST_DRIVE_LOOP_SET_H
#define HCI_SRC_HOST_DRIVE_LOOP_SET_H

#include "hci/effects/effect.h"
#include "hci/host/drive/drive.h"
#include "hci/loop.h"
#include "host/drive/sampled_run.h"

enum { HCI_LOOP_MOST_LEVELS = 33, HCI_LOOP_MOST_POINTS = 4096 };

typedef struct {
    const hci_machine_data *machine; /* fitted */
    const hci_drive_data *drive;     /* fitted */
    const hci_loop_level *levels; /* ascending by torque, equally far apart; 1, 2 or an odd number of them */
    size_t level_count;
    double max_error_A;         /* of the splines; 0: 2e-4 of the largest current */
    double speed_rad_per_s;     /* mechanical; 0: the table is used as far as it goes */
    const hci_effects *effects; /* of the machine, which the voltage is of too; NULL: none */
} hci_loop_task;

/* Start with {0}. */
typedef struct {
    hci_loop_f32 loop; /* points into the arrays below */
    hci_loop_wave *waves;
    uint16_t *orders;
    hci_loop_range *ranges;
    hci_loop_response *responses;
    double max_error_A;        /* of any current against the waves of its level */
    double peak_A;             /* largest current, length of the vector */
    double voltage_rad_per_s;  /* mechanical: above it the voltage does not do for all orders; HUGE_VAL */
    double sampled_rad_per_s;  /* mechanical: above it the sampling does not do for all orders; HUGE_VAL */
    double measured_rad_per_s; /* mechanical: above it orders lie beyond the measured response; HUGE_VAL */
    double response_error[2]; /* of d and q, share: how far loop.csv is off between its points; NAN without */
    double share_left_out;    /* largest current of the orders that were too small to keep, of the peak */
} hci_loop_set;

/* HCI_ERROR_INPUT, _ARGUMENT (levels that do not fit), _MEMORY. To be released, on failure too. */
hci_status hci_loop_set_make(const hci_loop_task *task, hci_loop_set *set, hci_note *note);
void hci_loop_set_release(hci_loop_set *set);

/* What hci_measured_loop_swing_Nm says of a set that was made of loop.csv, in % of the torque of a level; NAN
 * without one, or without a torque. speed: mechanical. */
double hci_loop_set_response_percent(const hci_loop_set *set, const hci_loop_task *task, size_t level,
                                     double speed_rad_per_s);

/* The highest order, electrical. */
double hci_loop_set_highest_order(const hci_loop_set *set);

/* What hci_coarse_mean_Nm says of a torque that is asked for; NAN where the angle is not coarse. */
double hci_loop_set_coarse_mean_Nm(const hci_loop_set *set, const hci_loop_task *task, double torque_Nm);

/* The larger of both response_error. */
double hci_loop_set_response_error(const hci_loop_set *set);

#endif
