/* From current waves to the rows of a table: its values, how far interpolation is off, and the fewest points.
 */
#ifndef HCI_SRC_HOST_EMIT_TABULATE_H
#define HCI_SRC_HOST_EMIT_TABULATE_H

#include "hci/host/emit/emit.h"
#include "host/currents/wave_samples.h"

/* i(θ) = T·A(θ) + B(θ) over a period of `period_turns` electrical turns, of which every order is a whole
 * multiple. */
typedef struct {
    const hci_wave *constant, *per_Nm;
    size_t constant_count, per_Nm_count;
    hci_table_frame frame;
    size_t columns, parts, period_turns;
    double torque_Nm; /* error and peak are those of |T| up to this; 0 with one part */
    hci_wave_samples constant_samples, per_Nm_samples; /* of them, where there are many; {0}: none */
} hci_tabulation;

/* Σ|A| of the waves at the reference torque: no current is larger. */
double hci_tabulation_bound_A(const hci_tabulation *t);

/* The order of a wave in the columns: its own in those of the phases, n − σ in the rotor frame, where it may
 * be below 0. */
double hci_tabulation_order_seen(const hci_tabulation *t, const hci_wave *wave);

/* Σ n²A at the reference torque, n as the columns see it: no second derivative of a current by the angle is
 * larger. */
double hci_tabulation_bend_A(const hci_tabulation *t);

/* The highest order of all waves in the phases, at least 1. */
double hci_tabulation_highest_order(const hci_tabulation *t);

/* The highest order in the columns: what a current loop that is given them has to follow. */
double hci_tabulation_highest_seen(const hci_tabulation *t);

/* The float that is not below x. */
float hci_tabulation_round_up(double x);

/* The exact currents ia, ib, ic or id, iq, 0 at an angle of the table. phase_A: out, may be NULL: the largest
 * |phase current|. */
void hci_tabulation_exact(const hci_tabulation *t, uint32_t angle, double torque_Nm, double current[3],
                          double *phase_A);

/* The largest |phase current| at the reference torque, to about 1e-4 of it. */
double hci_tabulation_peak_A(const hci_tabulation *t);

/* A current in A or A/(N·m), or 0 where it is but rounding dust of sin and cos. */
double hci_tabulation_clean(double current);

/* Fills rows[(points + 1)·columns·parts], measures it, and states points, error and peak in *table, whose
 * other fields but probes and CRC are set too. */
void hci_tabulate(const hci_tabulation *t, size_t points, float *rows, hci_table_f32 *table);

/* The same of rows that are not to be written: where there are samples of the waves they are off by 1e-11 of
 * these, and quickly made. */
void hci_tabulate_roughly(const hci_tabulation *t, size_t points, float *rows, hci_table_f32 *table);

/* As hci_tabulate, with the fewest points whose error is at most max_error_A; rows for most_points points, at
 * most HCI_EMIT_MAX_POINTS. False when no table is good enough; *table is then undefined. */
bool hci_tabulate_within(const hci_tabulation *t, double max_error_A, size_t most_points, float *rows,
                         hci_table_f32 *table);

#endif
