/* Where in the rotor frame the recorded currents lie: along which line, or which curve, the torque was
 * measured, and what the table keeps to. Uses tune_recorded. */
#ifndef HCI_CLI_TUNE_LINE_H
#define HCI_CLI_TUNE_LINE_H

#include "cli/tune/tune_steps.h"

/* An angle of currents that a drive means to have at 0, and of sensors that differ. */
#define CLI_TUNE_LEAST_ANGLE_DEG 1.0

/* Whether all currents in the rotor frame lie on one line, as with i_d at 0: the torque shows one sum of the
 * back-EMF along i_d and along i_q then, in which its orders 6k − 1 and 6k + 1 are one order 6k. */
bool cli_tune_currents_are_in_line(const cli_tuning *tune);

/* Whether they do so near i_q: then the table keeps to the line too, and how the machine acts off it does not
 * matter. angle_deg: out, of the line, i_d = -I sin, i_q = I cos; 0 where it is as good as that. */
bool cli_tune_line_is_kept(const cli_tuning *tune, double *angle_deg);

/* Whether they do so, or each load has one direction that goes over into that of the next, as where a drive
 * asks for the shortest current of each torque. angle_deg: out, of the recordings at a mean torque, between
 * two loads in proportion, and beyond the largest as it is there. O(samples + recordings²). */
bool cli_tune_curve_is_kept(const cli_tuning *tune, double mean_Nm, double *angle_deg);

#endif
