/* Whether a drive reads a table at the angle that its log has. */
#ifndef HCI_HOST_CURRENTS_TABLE_ROTATION_H
#define HCI_HOST_CURRENTS_TABLE_ROTATION_H

#include "hci/host/currents/currents.h"
#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How the currents of a recording lie to those of a table: i(θ) = gain · table(θ + rotation), or with −θ
 * where it is read backwards; or so i_d and i_q alone, in the frame of θ, where of_index. */
typedef struct {
    double rotation_rad; /* electrical, −π·period … π·period: the table is read so far ahead of the log's
                            angle */
    double error_rad;    /* standard error of it */
    double gain;         /* the recorded currents by the table's: the share of the torque */
    bool backwards;      /* against the direction of the log's angle */
    bool of_index; /* the drive commutates by an angle of its own, which is that of the log, and reads i_d and
                    * i_q of the table at another place; else the phase currents are turned as a whole */
    bool is_found; /* the table is in the recording: at its best it leaves less than 95 % of the rms */
    bool is_rotated; /* by more than three errors, half a step and 0.01 rad, which leaves a twentieth less of
                      * the difference, or backwards */
    double harmonics, harmonics_error; /* what the table has beside its fundamental, in the currents: 1 is as
                                        * in the table; and its standard error. 0 where the table has none */
    bool is_seen; /* the harmonics stand out of the error, with the share of the torque; or the table has none
                   */
    double step_rad;        /* electrical, of the log's angle where it stands still between samples; else 0 */
    size_t pole_pairs_seen; /* where it is not found: pole pairs with which it is; 0: none up to 64 */
    double left_as_is;      /* rms of what differs by rms of the currents, at no rotation */
    double left;            /* and at this one */
    double left_elsewhere; /* at the best rotation in another electrical turn of the table; 1 with one turn */
    size_t period_turns;   /* electrical turns in the table */
    size_t samples;        /* that were compared */
} hci_table_rotation;

/* Compares. HCI_ERROR_INPUT where the run has no currents or no angle, or the table none; _MEMORY. A current
 * loop that lags behind its reference looks like a table that is read too late: take a slow log. */
hci_status hci_table_rotation_of(const hci_currents *table, const hci_run *run, int pole_pairs,
                                 hci_table_rotation *rotation, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
