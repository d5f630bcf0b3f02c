/* What is wrong with recordings that can be read, and with the folder for the results. Uses tune_steps. */
#ifndef HCI_CLI_TUNE_SUSPECT_H
#define HCI_CLI_TUNE_SUSPECT_H

#include "cli/tune/tune_steps.h"

/* Bytes of what is said of one column. */
enum { CLI_TUNE_COLUMN_WORDS = 400 };

/* "--column 'theta_m_deg=angle'", or with COLUMN where its name is not known. */
void cli_tune_say_column(const char *quantity, const char *column, char text[CLI_TUNE_COLUMN_WORDS]);

/* The unit that an angle was read in, as names of columns end: "rad", "deg", "turn"; NULL: another one, such
 * as counts. */
const char *cli_tune_unit_of_angle(const hci_run *run);

/* "360 is degrees in a column that is read in turns; say --column 'theta_m_deg=angle'": what a column of
 * angle, speed or time is in where the angle goes so many times as far as the speed leads; "": nothing that
 * is known. */
void cli_tune_say_unit_of_ratio(const cli_tuning *tune, double ratio, char text[CLI_TUNE_COLUMN_WORDS]);

/* ", or 2 whole turns if `angle` is in turns: ...", where a mechanical angle in rad covers so many times 1/2π
 * of a turn; "" otherwise. */
void cli_tune_say_turns(const cli_tuning *tune, char text[CLI_TUNE_COLUMN_WORDS]);

/* Refuses a folder that has anything else in it than tune writes. */
hci_status cli_tune_claim_folder(const char *folder, hci_note *note);

/* Refuses a folder in which a call of tune did not end; after earlier results were put back. */
hci_status cli_tune_expect_finished(const char *folder, hci_note *note);

/* Sets jump_rad and is_not_followed by the recordings that are used. */
void cli_tune_suspect(cli_tuning *tune);

/* Of a torque that was measured without current, which friction makes brake. */
typedef struct {
    double drives_Nm; /* mean with the motion: half the difference of two directions; 0: it brakes */
    double mean_Nm;   /* as it was read, in the direction with more samples */
    bool has_both;    /* directions */
    size_t run;       /* the first with such a torque */
} cli_tune_torque_way;

/* What stands out of the ripple alone drives. */
cli_tune_torque_way cli_tune_torque_way_of(const cli_tuning *tune);

/* Recordings whose currents are clipped. */
size_t cli_tune_clipped(const cli_tuning *tune);

/* Recordings whose measured torque is clipped. */
size_t cli_tune_torque_clipped(const cli_tuning *tune);

/* Whether no recording has a measured torque but such ones. */
bool cli_tune_all_torque_clipped(const cli_tuning *tune);

/* Why the current of a shaft that turns fast by its angle tells nothing, and in which unit of the angle it
 * would have turned slowly; false: none does. */
bool cli_tune_say_fast(const cli_tuning *tune, char *text, size_t size);

/* Whether a slow turn goes one way alone, whose current is not read as the answer to a cogging torque. */
bool cli_tune_is_one_way(const cli_tuning *tune);

#endif
