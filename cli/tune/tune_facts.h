/* What the steps of tune leave open or make doubtful, as its words and its verdict ask for it. Uses
 * tune_steps. */
#ifndef HCI_CLI_TUNE_FACTS_H
#define HCI_CLI_TUNE_FACTS_H

#include "cli/tune/tune_steps.h"

/* Whether the measured back-EMF contradicts the data sheet. */
bool cli_tune_is_off_sheet(const cli_tuning *tune);

/* Whether slots and poles say of cogging torque where the logs were not looked at. */
bool cli_tune_misses_slots(const cli_tuning *tune);

/* The order up to which recordings show a torque of the angle by the slope of the speed; 0: where another one
 * shows it, or no slot is known to be beyond it. */
double cli_tune_reach_of_slopes(const cli_tuning *tune);

/* Whether the sign of a current is all that a torque is told by, and nothing tells it. */
bool cli_tune_lacks_sign(const cli_tuning *tune);

/* Whether the angle of all recordings that show a torque is one of the electrical turn alone. */
bool cli_tune_is_electrical_alone(const cli_tuning *tune);

/* Whether the angle of the table is that of the measured back-EMF, since no recording has one: the drive has
 * to find its zero before the table can be played. */
bool cli_tune_is_without_angle(const cli_tuning *tune);

/* Whether phase currents without a torque sensor lie elsewhere than along i_q. deg: out, the --angle-offset
 * with which they do, or half an electrical turn more. */
bool cli_tune_off_iq(const cli_tuning *tune, double *offset_deg);

/* Whether nothing in the recordings counts the pole pairs that were given. */
bool cli_tune_is_uncounted(const cli_tuning *tune);

/* By how many seconds the angle is found to be read before it is true, as no sensor does; 0: it is not. */
double cli_tune_early_s(const cli_tuning *tune);

/* Whether it is, and all torques were measured at one speed, forward or back: how much smaller a late sensor
 * has read the ripple is not told then. */
bool cli_tune_is_late_at_one_pace(const cli_tuning *tune);

/* Whether the bound is of recordings at one speed or without a time, which do not tell a torque sensor that
 * reads late. */
bool cli_tune_hangs_on_lag(const cli_tuning *tune);

/* What a delay of the torque sensor, of its filter or its logger leaves of the ripple of a plain sine, in the
 * mean of ways in which orders fall together, peak to peak, for each second of it, as long as that is little
 * beside a period; 0: no recording of one has a time. */
double cli_tune_late_Nm_per_s(const cli_tuning *tune);

/* Whether no recording of a torque sensor has a time. */
bool cli_tune_lacks_times(const cli_tuning *tune);

/* Whether no log has a torque of any kind. */
bool cli_tune_lacks_torque(const cli_tuning *tune);

/* A column that was not read and may be the torque, or i_q where no current was read, as --column takes it:
 * "torque_Nm=COLUMN"; NULL: none. */
const char *cli_tune_torque_like(const cli_tuning *tune);

/* The header of a column that was not read and may be the force of a load cell; NULL: none. */
const char *cli_tune_force_like(const cli_tuning *tune);
const char *cli_tune_current_like(const cli_tuning *tune);

/* A recording whose angle and current say nothing since no time was read and nobody says that the shaft is
 * turned slowly; NULL: none. */
const hci_run *cli_tune_lacks_time(const cli_tuning *tune);

/* The column in one of the two. text: out. */
void cli_tune_column_of(const char *like, char text[HCI_RUN_NAME]);

/* Whether the torque that is asked for takes less current, by the constant of the sheet, than the shaft took
 * that was turned without a load. */
bool cli_tune_is_below_idle(const cli_tuning *tune);

/* What said that constant: "--kv", or the back-EMF of a machine. */
const char *cli_tune_constant_option(const cli_tuning *tune);

/* An electrical order as people say it: 12, or 12/7 of 7 pole pairs. */
enum { CLI_TUNE_ORDER = 24 };
const char *cli_tune_order_words(const cli_tuning *tune, double order, char text[CLI_TUNE_ORDER]);

/* The largest ripple that is left unexplained in a recording, rms; 0 where all are near their noise. */
double cli_tune_unexplained_Nm(const cli_tuning *tune);

/* Peak to peak in the model, of the plain sine and with the table: as it was read back, or of the currents
 * where that is not known. */
void cli_tune_swing_of(const cli_tuning *tune, double *before_Nm, double *after_Nm);

/* The largest torque that a recording shows by a sensor, by an acceleration or by its currents. */
double cli_tune_largest_recorded_Nm(const cli_tuning *tune);

/* The mean torque that the solved currents make, in N·m; not above the wanted one where limits act. */
double cli_tune_made_Nm(const cli_tuning *tune);

/* --angle-offset of a zero that is turned by so much, with the one that was given, in electrical degrees. */
double cli_tune_offset_to_give(const cli_tuning *tune, double turned_deg);

/* The largest phase current in a recording. */
double cli_tune_largest_recorded_A(const cli_tuning *tune);

/* Whether the ripple of the model is far beyond all torque that a recording shows. */
bool cli_tune_is_never_seen(const cli_tuning *tune);

/* Whether the table makes another mean torque than is wanted. */
bool cli_tune_misses_torque(const cli_tuning *tune);

/* Whether the currents are not what was wanted, by more than their cut to a table makes anyhow. */
bool cli_tune_is_missed(const cli_tuning *tune);

/* Whether the peak current of the table is so far beyond the recorded ones that a wrong unit is likely. */
bool cli_tune_is_far_beyond(const cli_tuning *tune);

/* The speed, in rpm, at which the back-EMF is what the winding drops at the rated current, where no motor
 * turns so fast: Kv, resistance or current is another one; 0: believable, or not known. */
double cli_tune_strange_rpm(const cli_tuning *tune);

/* What the inertia that a slow turn itself asked for took out of its torque, rms, the most of all recordings;
 * of: out, that recording, which has the inertia. 0: --inertia was given, or none was asked for. */
double cli_tune_taken_by_inertia_Nm(const cli_tuning *tune, const hci_run **of);

/* The slow turn of unknown inertia that it matters most for; NULL: none. */
const hci_run *cli_tune_untold_inertia(const cli_tuning *tune);

/* The recording whose turns deny the declared inertia; NULL: none. */
const hci_run *cli_tune_denied_inertia(const cli_tuning *tune);

/* Whether all torque is the declared inertia x acceleration, of shafts without a current: nothing tells it
 * then. */
bool cli_tune_is_scaled_by_inertia(const cli_tuning *tune);

/* What the declared inertia takes out of the torque of a slow turn, rms, the most of all recordings, where no
 * turns tell it within a factor of three. 0: they do, or none is declared. */
double cli_tune_hangs_on_inertia_Nm(const cli_tuning *tune);

/* Whether the bound on the ripple is more than the torque itself, and than the ripple of a plain sine: it
 * bounds nothing. */
bool cli_tune_is_boundless(const cli_tuning *tune);

/* Whether the bound on the ripple is no less than the ripple of a plain sine: no less is promised. */
bool cli_tune_promises_nothing(const cli_tuning *tune);

/* A table with which the known ripple is not smaller in the very model that it was solved for, or which takes
 * none away since none was found. */
bool cli_tune_is_of_no_use(const cli_tuning *tune);

/* Whether a recording without a speed took so long, with rows so far apart, that its time may be in
 * milliseconds; text: out, the question. */
bool cli_tune_say_long(const cli_tuning *tune, char *text, size_t size);

/* How many runs are tabulated as torques are calculated, where others were measured over time; else 0. */
size_t cli_tune_calculated_beside(const cli_tuning *tune);

/* Whether all are: there is no bench, no sensor and no speed. */
bool cli_tune_is_calculated(const cli_tuning *tune);

#endif
