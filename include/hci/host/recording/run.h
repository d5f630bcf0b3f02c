/* A recording from a bench, or a simulated one, and lists of them. */
#ifndef HCI_HOST_RECORDING_RUN_H
#define HCI_HOST_RECORDING_RUN_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"
#include "hci/host/base/progress.h"
#include "hci/host/csv/csv.h"
#include "hci/host/recording/column_names.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The electrical order up to which cogging torque is looked at where nothing is said. */
#define HCI_USUAL_ORDER 60.0

/* What stands behind the column in current_like, where its numbers are digits of a firmware. */
#define HCI_RUN_DIGITS_PER_A "/DIGITS_PER_A"

/* Where the torque of a run comes from. */
typedef enum {
    HCI_TORQUE_NONE,     /* neither of the following */
    HCI_TORQUE_MEASURED, /* a column torque_Nm */
    HCI_TORQUE_HOLDING,  /* that column is 0 throughout: the shaft is at rest and the current is the reading;
                          * or as below */
    HCI_TORQUE_INERTIA   /* a free shaft: moment of inertia × angular acceleration */
} hci_torque_source;

/* Bytes of the name of a column that is told. */
enum { HCI_RUN_NAME = 96 };

/* Columns of `count` samples as they were recorded; what the run does not have is NULL. Start with {0}. */
typedef struct {
    char *name;            /* the file as the list names it */
    size_t count;          /* samples */
    int pole_pairs;        /* by which it was read */
    double *time_s;        /* ascending; NULL: the samples have no order in time */
    double gap_s;          /* longer steps of time_s are gaps, as between tests of one file; 0: no time */
    double *theta_m_rad;   /* mechanical, unwrapped */
    double angle_step_rad; /* mechanical, in which it was written down; 0: in none that is seen, or it has no
                            * time */
    double *speed_rad_per_s; /* mechanical, signed; recorded, or the slope of the angle over time where it is
                              * not or stands at 0 while the angle moves; NULL: not known */
    size_t speed_window;     /* samples that the speed is a slope of the angle over; 0: it was recorded */
    double *i_A;             /* [count][3], phase currents; of dq currents, turned by the recorded angle */
    double *torque_Nm;       /* on the shaft, as torque_source says */
    size_t torque_window;    /* samples that an acceleration in torque_Nm is a slope over; 0: it has none */
    double torque_reach;     /* electrical order up to which that slope shows torque; 0: it has none */
    double *temperature_C;   /* of the magnets */
    double *v_V;             /* [count][3], phase voltages */
    hci_torque_source torque_source; /* where torque_Nm is from */
    bool turn_known;  /* the angle is mechanical, or an electrical one that is not wrapped: orders k/p are in
                         it */
    bool is_unsteady; /* a holding test whose shaft sticks and slips: its current tells no cogging torque */
    bool is_clipped;  /* crests of its current stand at one value: a limit, or a sensor at its end */
    bool torque_is_clipped;   /* its torque stood at the end of its sensor in rows that are left out */
    bool speed_is_electrical; /* speed_rad_per_s was recorded as that, and the pole pairs divided it */
    bool lacks_id;            /* i_q was recorded and i_d not, which is taken as 0 */
    bool slow_beside_others;  /* a slow turn by what other recordings of its list tell, not by itself */
    double inertia_share;     /* rms of the inertia x acceleration that was taken out of the current, over the
                               * torque    that the current makes; 0: nothing was */
    double turns_inertia_kgm2; /* that makes the torques of slow turns agree, taken out, of this or of other
                                * recordings of its list; 0: none was found */
    double turns_inertia_error_kgm2; /* standard error of that, of how the turns agree */
    double iq_per_acceleration, iq_per_acceleration_error; /* of a shaft without a torque sensor: A by which
                                                            * i_q is larger for each rad/s², and its standard
                                                            * error; 0: the run does not tell it */
    double least_inertia_kgm2,
        most_inertia_kgm2; /* where the inertia is declared: between these a slow turn tells it
                            * by its two directions, a free shaft by what its current
                            * accelerates, by the torque constant; 0: they do not */
    bool denies_inertia;   /* the declared one is far from that: the torques are wrong by what accelerates */
    double inertia_limit_kgm2; /* a slow turn whose inertia is not known: from here on it takes
                                * a tenth or more of the torque that the current makes; 0: it does not matter,
                                * or is known */
    bool needs_inertia; /* a slow turn of which the current answers a part that only the inertia tells: it has
                         * no torque */
    bool rough_clock;   /* its stamps came early and late by turns, and were mended or are so still */
    char angle_like[HCI_RUN_NAME]; /* zero_is_unknown, and this, as --column takes it, may read an angle that
                                    * stands in the file; "": none */
    int current_way; /* of a run without a torque sensor, whose i_q was recorded, or phase currents that lie
                      * along i_q: 1 where it accelerates and overcomes friction, -1 where it works against
                      * the motion, 0 where that is not told */
    int other_pole_pairs;   /* how often its phase currents go round in a turn of the shaft, where that is not
                               the number of pole pairs; 0: it is, or nothing tells */
    bool counts_pole_pairs; /* phase currents beside a mechanical angle keep to one line of the rotor frame */
    double off_iq_rad; /* angle of that line from i_q, electrical, of phase currents without a torque sensor,
                        * -π/2 to π/2, where it is none of noise: the zero of the angle is another one, or
                        * the drive makes an i_d; else 0 */
    char current_column[HCI_RUN_NAME]; /* header of the column of i_q; "": none */
    double swept_rad;     /* mechanical, of all rows, where some of a slow turn were left out; else 0 */
    bool torque_is_typed; /* one number in every row beside a current that varies: no measurement, not used */
    double torque_typed_Nm; /* that number; 0 where there is none */
    bool is_electrical;     /* an electrical angle was recorded; else its zero is supposed to be that of the
                             * mechanical one */
    bool zero_is_given;     /* by an offset that the user adds to the angle */
    double zero_offset_rad; /* that offset, electrical */
    bool zero_is_unknown;   /* the angle is the integral of the speed, from 0 */
    bool voltage_is_dq;     /* v_V was v_d and v_q, turned by the recorded angle: says nothing of its zero */
    bool only_mean;         /* no angle, but torques over i_d and i_q: means over a turn. i_A is of angle 0 */
    bool mean_is_unknown;   /* a constant load stands in torque_Nm too: only what varies says something */
    bool hardly_accelerates; /* beside mean_is_unknown: the current does not accelerate, so that the torque
                                per ampere is not told */
    bool has_both_frames;    /* phase currents and both of i_d and i_q were recorded */
    bool has_sum;            /* all three currents were recorded, so that their sum says something */
    double
        drive_constant_Nm_per_A; /* of i_q, by a torque that the drive computed from it; 0: none is known */
    int computed_phase; /* 1, 2, 3: of two phase currents the third was made, so that the sum is 0; 0: not */
    bool switched_off;  /* every current is 0 in every row, or there is no column of them: of a drive that is
                         * switched off, so that not even zeros of its sensors are in them */
    char force_like[HCI_RUN_NAME];  /* no torque was read, and the column of this header may be the force of a
                                       load cell on a lever; "": none */
    char torque_like[HCI_RUN_NAME]; /* no torque was read, and this, as --column takes it, may read one that
                                     * stands in the file; "": none */
    char current_like[HCI_RUN_NAME];      /* the same of i_q, where no current was read */
    char time_like[HCI_RUN_NAME];         /* the same of the time, where none was read */
    char commanded_voltage[HCI_RUN_NAME]; /* header of a v_q that was not used, since no current was recorded
                                           * beside it; "": none */
    double commanded_unit_V;              /* a 1 of that column in V; 0: none */
    char angle_column[HCI_RUN_NAME], speed_column[HCI_RUN_NAME],
        time_column[HCI_RUN_NAME]; /* headers of the columns that these were read from, as far as there is
                                    * room; "": none */
    double angle_unit_rad;         /* a 1 of that column in rad, electrical where is_electrical; 0: none */
    double speed_unit_rad_per_s;   /* the same of the speed; 0: none was recorded */
    bool angle_is_counted;         /* the numbers of that column are whole, as an encoder counts */
    bool is_tabulated; /* without a time, at constant currents and even angles, as torques are calculated */
    bool is_point;     /* one of several operating points that its file holds */
    size_t *row;       /* [count], of the file, from 0; NULL: each row is a sample */
    hci_note remark;   /* what was supposed on reading, or "" */
} hci_run;

/* What reading a run asks for beside its file. */
typedef struct {
    int pole_pairs;      /* to turn electrical angles into mechanical ones; 0: those in the file, which only
                          * what a device has learnt has */
    double inertia_kgm2; /* for a run without torque_Nm; NAN or 0: not known, the torque is then missing */
    double torque_constant_Nm_per_A; /* of i_q, for a torque that a drive computed; 0: not known */
    bool holding;              /* without a torque column the shaft is turned slowly, and its torque is 0 */
    bool strict;               /* a hole refuses the file */
    hci_order_base order_base; /* of the tables of a machine that is read beside */
    const hci_column_names *columns; /* which column is what, before all names; NULL: names say it */
    size_t *columns_found; /* of each of columns: goes up by one where the file has it, and not to have it is
                            * no error; NULL: it is one */
    const hci_column_names *list_columns; /* the same for all runs of a list, which counts least; or NULL */
    const hci_csv_memory *memory;         /* recordings in memory: read in place of files of their names */
    size_t memory_count;                  /* entries of memory */
} hci_run_options;

/* Reads a run: an angle or voltages, and what else there is of time_s, theta_m_rad, theta_e_rad,
 * speed_rad_per_s (or speed_e_rad_per_s, of the electrical angle), ia_A, ib_A, ic_A (of two the third makes
 * the sum 0), id_A, iq_A (i_d is 0 without), torque_Nm, temperature_C, va_V, vb_V, vc_V (or line voltages
 * vab_V, vbc_V, vca_V; or vd_V, vq_V, v_d being 0 without), in any unit and by the names of other tools,
 * which the remark tells where they could mean something else. No current is none that flows.
 *
 * An angle within one turn that jumps by more than half a turn has been wrapped, and the turns are put back
 * (where it jumps by a whole one, its readings may span 3 % more);
 * one that is beyond a turn is as it stands, unless it jumps back against its way by whole turns. Samples
 * without time, or all recorded at speed 0, of which one in twenty is more than a third of a turn from the
 * one before are points without order, and keep the angles that they have. With time that is an error, unless
 * the speed tells how far the shaft has turned. Of both angles the electrical one gives the phase.
 *
 * Rows with a hole (a cell that is empty, not finite or no number; too few or too many cells) and rows that
 * repeat the one before them, time included, are left out, and the remark counts them; more than half of the
 * rows is an error, and so is each of them where options->strict. A column of holes alone is as if it were
 * not there; temperatures that are missing are interpolated.
 *
 * Without an angle a speed over time gives one from an unknown zero (phase currents are then not of it, and
 * refused); torque_Nm and iq_A without either are taken as means over a turn.
 *
 * A run without torque_Nm has inertia × acceleration, or a torque of 0 where options->holding, or where it is
 * a slow turn under control: its current varies by more than five times what accelerates, and its kinetic
 * energy is less than the work of that over one electrical radian; or, where the inertia is not known and the
 * torque constant is, it turns forward and back at no more than 20 rpm. With the inertia any slow turn of one
 * steady speed is one. What of its i_q accelerates is then taken out where inertia and torque constant are
 * known, by the orders of the angle over time where whole turns show them, or where forward and back differ
 * by what one inertia explains. Where a usual inertia would matter and is not known, the run has no torque
 * and needs_inertia is set.
 *
 * On failure *run is empty. HCI_ERROR_INPUT, _MEMORY, _ARGUMENT for less than one pole pair. O(samples). */
hci_status hci_run_read(const char *path, const hci_run_options *options, hci_run *run, hci_note *note);

/* The same of a file that has been read, by hci_csv_read_recording where holes may be left out. */
hci_status hci_run_of_csv(const hci_csv *csv, const hci_run_options *options, hci_run *run, hci_note *note);

/* Reads a recording as hci_run_read does, strictly or not, with the columns that options->columns and
 * `columns.csv` beside the file name. One in memory, whose numbers have to stay as long as *csv, has no such
 * file beside it. */
hci_status hci_run_csv(const char *path, const hci_run_options *options, hci_csv **csv, hci_note *note);

/* Whether the current works against a load, as a brake: the size of i_q is more than four times what it
 * varies by, forward or back. A shaft that control turns slowly tells the harmonics of the back-EMF then, as
 * well as cogging torque and friction. False without currents or an angle. O(samples). */
bool hci_run_is_loaded(const hci_run *run, int pole_pairs);

/* Frees what a run holds and empties it. */
void hci_run_release(hci_run *run);

/* What a run is for. */
typedef enum {
    HCI_ROLE_FIT,    /* the model is fitted to it */
    HCI_ROLE_HOLDOUT /* the model is tested on it */
} hci_role;

/* Where a run is from, so that it can be read again. */
typedef struct {
    char *path;    /* of the file, from where the program runs */
    char *columns; /* that options or the list name, "NAME=COLUMN;NAME=COLUMN"; or "" */
    size_t row;    /* of the list, from 0: the points of one file have the same */
} hci_run_origin;

/* A list of runs: columns file, role, optionally note, test, columns. Start with {0}. */
typedef struct {
    hci_run *run;           /* in the order of the list */
    hci_role *role;         /* of each */
    hci_run_origin *origin; /* of each; NULL: not known */
    size_t count;           /* entries of run, role and origin */
    char *list;             /* the file that names them, as it was given; NULL where there is none */
} hci_runs;

/* What reading them asks for. */
typedef struct {
    hci_run_options run;    /* of each */
    hci_progress *progress; /* called with the share of files read; may be NULL */
    void *context;          /* of progress */
} hci_runs_options;

/* Reads a list and its runs, whose paths are relative to it. `columns.csv` beside the list names columns of
 * all of them, before that beside a run; a cell `columns` of the list does so of one run
 * instead. A cell `test` that
 * is `holding` stands for hci_run_options.holding. A table of torques over the angle at 2 to 400 constant
 * currents, without a time, is a run for each of them, all of the same origin. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_runs_read(const char *path, const hci_runs_options *options, hci_runs *runs, hci_note *note);

/* Reads one more run, or those of a table of torques, of a file or of memory, into a list that was not read
 * from one: its origins are not known. HCI_ERROR_ARGUMENT for a list that was, _INPUT, also for a run of the
 * same name; _MEMORY. The list is as it was then. */
hci_status hci_runs_add(hci_runs *runs, const char *path, hci_role role, const hci_run_options *options,
                        hci_note *note);

/* Puts the runs of `more`, which is empty then, behind those of `runs`; both were read from lists. `list`
 * becomes that of `more`. HCI_ERROR_INPUT where a file is in both; HCI_ERROR_MEMORY; both are as they were
 * then. */
hci_status hci_runs_join(hci_runs *runs, hci_runs *more, hci_note *note);

/* Whether a run is a further operating point of the file that the one before it is from. */
bool hci_runs_is_further_point(const hci_runs *runs, size_t run);

/* Frees what a list holds, its runs included, and empties it. */
void hci_runs_release(hci_runs *runs);

#ifdef __cplusplus
}
#endif

#endif
