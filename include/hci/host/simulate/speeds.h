/* Torque ripple through a real current loop over the speed: the tables that `emit --drive` writes, read by
 * the code that runs on a target, in the simulated drive. */
#ifndef HCI_HOST_SIMULATE_SPEEDS_H
#define HCI_HOST_SIMULATE_SPEEDS_H

#include "hci/host/base/progress.h"
#include "hci/host/drive/drive.h"
#include "hci/host/machine/effects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What flows, and what is done about the loop: X(value, word). */
#define HCI_REMEDY_NAMES(X)                                                                                  \
    X(HCI_REMEDY_SINE, "sine")                                                                               \
    X(HCI_REMEDY_TABLE, "table")                                                                             \
    X(HCI_REMEDY_LEAD, "lead")                                                                               \
    X(HCI_REMEDY_COMPENSATION, "compensation")                                                               \
    X(HCI_REMEDY_FEEDFORWARD, "feedforward")

/* The last four are hci_loop_remedy of hci/loop.h. */
typedef enum {
    HCI_REMEDY_SINE,         /* i_d = 0 and a constant i_q, no table */
    HCI_REMEDY_TABLE,        /* the table as it is */
    HCI_REMEDY_LEAD,         /* read ahead */
    HCI_REMEDY_COMPENSATION, /* each order divided by the loop */
    HCI_REMEDY_FEEDFORWARD,  /* the voltage is given too */
    HCI_REMEDIES             /* how many */
} hci_remedy;

/* Its word; a static string. */
const char *hci_remedy_name(hci_remedy remedy);

/* What a drive did at one speed with one remedy. */
typedef struct {
    double mean_Nm;                            /* torque */
    double T_ripple_percent, F_ripple_percent; /* as of hci_simulation */
    double ripple_Nm;                          /* torque, peak to peak */
    double peak_A;                             /* of a phase */
    double line_V;                             /* largest line voltage at the machine */
    double limited_share;                      /* of the samples asked for more voltage than there is */
    double worst_T_ripple_percent; /* with R, L and flux wrong by model_error; NAN where it is 0 */
} hci_speed_result;

/* All remedies at one speed. */
typedef struct {
    double speed_rad_per_s;         /* mechanical */
    double needed_V;                /* dc link voltage that the currents as they are wanted need */
    double back_emf_V;              /* the same without any current */
    double response_ripple_percent; /* of the mean torque, peak to peak, that compensation can be left with by
                                     * what loop.csv does not tell; NAN without it, and without a torque */
    size_t orders_short; /* of the table: not whole, since the voltage or the sampling does not do */
    hci_speed_result remedy[HCI_REMEDIES]; /* by hci_remedy */
} hci_speed_row;

/* What is asked for. */
typedef struct {
    const hci_machine_data *machine; /* as read */
    const hci_effects *effects; /* of the simulated machine, in the voltages of its tables too; NULL: none */
    hci_drive_data *drive;      /* as read; its defaults are filled in */
    const hci_loop_level *levels;   /* of torque, as of hci_emit_loop */
    size_t level_count;             /* entries of levels */
    double torque_Nm;               /* asked of the table */
    const double *speeds_rad_per_s; /* mechanical, not 0, of one sign, ascending in size */
    size_t speed_count;             /* entries of speeds_rad_per_s */
    double model_error;     /* 0.1: R, L and flux of the machine are 10 % off in all ways; 0: not asked */
    hci_progress *progress; /* may be NULL */
    void *progress_context; /* first argument of progress */
} hci_speeds_request;

/* Start with {0}. */
typedef struct {
    hci_speed_row *row;        /* one for each speed */
    size_t count;              /* entries of row */
    double torque_Nm;          /* asked for */
    double model_error;        /* as requested */
    double dc_link_V;          /* of the drive */
    double reached_V;          /* what dead time leaves of it */
    double highest_order;      /* of the table, electrical, in the rotor frame */
    double coarse_mean_Nm;     /* mean torque of the table, read at encoder_counts that are fewer than twice
                                * that order takes, at low speed; NAN: they are not */
    double lead_s;             /* by which the table is read ahead */
    double voltage_rad_per_s;  /* mechanical: above it the voltage does not do for all orders; HUGE_VAL */
    double sampled_rad_per_s;  /* mechanical: above it the sampling does not do for all orders; HUGE_VAL */
    double measured_rad_per_s; /* mechanical: above it orders lie beyond the measured response; HUGE_VAL */
    double response_error;     /* share of the measured answer that loop.csv is off between its points, by how
                                * well     they tell one another; NAN: there is none, or it is not known */
    double harmful_rad_per_s[HCI_REMEDIES]; /* mechanical, signed as the speeds: beyond it, straight between
                                               them, the plain sine has less T_ripple at the same torque;
                                               HUGE_VAL where it has not */
} hci_speeds;

/* Runs each remedy at each speed. HCI_ERROR_INPUT, _ARGUMENT, _NUMERIC, _MEMORY. *speeds is to be given to
 * hci_speeds_release; it is empty on failure. Same input, same result to the bit on one libm. */
hci_status hci_simulate_speeds(const hci_speeds_request *request, hci_speeds *speeds, hci_note *note);

/* Whether a remedy and the plain sine make the same mean torque at one of the speeds, to a tenth of that
 * asked for, and at least half of it: else the ripple of the one says nothing beside that of the other. */
bool hci_speeds_is_comparable(const hci_speeds *speeds, size_t row, hci_remedy remedy);

/* Whether it is, and T_ripple of the remedy more than that of the plain sine, by 0.1 % of it at least. */
bool hci_speeds_is_worse(const hci_speeds *speeds, size_t row, hci_remedy remedy);

/* Frees what the result holds and empties it. */
void hci_speeds_release(hci_speeds *speeds);

#ifdef __cplusplus
}
#endif

#endif
