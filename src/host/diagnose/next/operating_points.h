/* Steady runs that a drive can play, for a recording to come.
 *
 * In: the recordings so far and what the machine is rated for. Out: a grid of currents, speeds and directions
 * within that, from the least effort to the largest. */
#ifndef HCI_SRC_HOST_DIAGNOSE_NEXT_OPERATING_POINTS_H
#define HCI_SRC_HOST_DIAGNOSE_NEXT_OPERATING_POINTS_H

#include "hci/host/machine/machine.h"
#include "host/diagnose/reading/regression.h"

/* What may be played, and how it would be recorded. */
typedef struct {
    hci_torque_source source;               /* MEASURED; without a torque sensor HOLDING or INERTIA */
    double most_A;                          /* length of the current vector */
    double least_rad_per_s, most_rad_per_s; /* > 0, mechanical */
    double most_V;                          /* peak of a phase; INFINITY: not known */
    double volts_s, ohm;  /* peak back-EMF of a phase per mechanical rad/s; resistance or 0 */
    double noise_Nm;      /* of a sample */
    double temperature_C; /* of the last recording that tells it, or NAN */
    const hci_run_statistics
        *recorded;   /* [recorded_count], of the recordings so far; those that are not used */
    const bool *use; /* have false here, and are no reason not to record a point */
    size_t recorded_count;
} hci_playable;

/* rated_current and rated_speed where the machine declares them, else what was recorded; the voltage of
 * dc_link_voltage where that is declared. Speeds are those of the recordings, and at least 0.1 rad/s, a turn
 * a minute; where they have one speed only, a quarter of it, or four times if the rating allows. */
hci_playable hci_playable_of(const hci_regression *regression, const hci_machine_data *machine);

/* Mean of |speed| of a run, rad/s; of one that turns there and back too. 0: not known. */
double hci_run_speed(const hci_regression *regression, size_t run);

/* iq_A: NAN where the current answers to what holds or brakes the shaft, and cannot be chosen. */
typedef struct {
    double id_A, iq_A, speed_rad_per_s; /* signed */
} hci_operating_point;

enum { HCI_OPERATING_POINTS = 64 };

/* Fills point[HCI_OPERATING_POINTS] with what no recording of ten turns or more has shown, or with all where
 * all have been; returns how many there are, at least one. */
size_t hci_operating_points(const hci_playable *playable, hci_operating_point *point);

#endif
