/* The columns of a recording, read once for all who need them: which quantities a file has, under which name
 * and in what unit, what was supposed of a name that could mean something else, and the values in SI units.
 * In: a file that has been cut into cells (csv.h, which translates names and units of other tools). Out:
 * values as they were recorded: an angle is not unwrapped, a speed not divided by the pole pairs, i_d and i_q
 * are not turned. A new quantity is one line in HCI_RUN_COLUMNS. */
#ifndef HCI_SRC_HOST_RECORDING_RUN_COLUMNS_H
#define HCI_SRC_HOST_RECORDING_RUN_COLUMNS_H

#include "hci/host/csv/csv.h"
#include "hci/host/recording/run.h"

/* Phases of one kind follow each other. */
#define HCI_RUN_COLUMNS(X)                                                                                   \
    X(TIME, "time_s")                                                                                        \
    X(THETA_M, "theta_m_rad")                                                                                \
    X(THETA_E, "theta_e_rad")                                                                                \
    X(SPEED, "speed_rad_per_s")                                                                              \
    X(SPEED_E, "speed_e_rad_per_s")                                                                          \
    X(IA, "ia_A")                                                                                            \
    X(IB, "ib_A")                                                                                            \
    X(IC, "ic_A")                                                                                            \
    X(ID, "id_A")                                                                                            \
    X(IQ, "iq_A")                                                                                            \
    X(VA, "va_V")                                                                                            \
    X(VB, "vb_V")                                                                                            \
    X(VC, "vc_V")                                                                                            \
    X(VAB, "vab_V")                                                                                          \
    X(VBC, "vbc_V")                                                                                          \
    X(VCA, "vca_V")                                                                                          \
    X(VD, "vd_V")                                                                                            \
    X(VQ, "vq_V")                                                                                            \
    X(TORQUE, "torque_Nm")                                                                                   \
    X(TORQUE_COMPUTED, "torque_computed_Nm")                                                                 \
    X(TEMPERATURE, "temperature_C")

typedef enum {
#define HCI_RUN_ONE(name, text) HCI_RUN_##name,
    HCI_RUN_COLUMNS(HCI_RUN_ONE)
#undef HCI_RUN_ONE
        HCI_RUN_COLUMN_COUNT
} hci_run_column;

typedef struct {
    const hci_csv *csv; /* the caller's */
    size_t count;       /* samples, at least one */
    size_t *row;        /* [count], of the file, from 0; NULL: each row is a sample */
    bool has[HCI_RUN_COLUMN_COUNT];
    size_t at[HCI_RUN_COLUMN_COUNT];     /* column of the file, where it has one */
    double *value[HCI_RUN_COLUMN_COUNT]; /* [count], in the unit of the name; NULL: absent, or not yet read */
    double *ready[HCI_RUN_COLUMN_COUNT]; /* [count], read while looking for holes, and not asked for yet */
    bool is_instantaneous[3];     /* of each phase current in amperes rms: it is none, and was taken so */
    bool torque_is_clipped;       /* rows with the torque at its least or largest value are left out */
    char time_like[HCI_RUN_NAME]; /* as --column takes it, what may be the time, which was not read */
    bool *used;                   /* of each column of the file */
    hci_note *remark, *note;      /* the caller's: what was supposed; the error */
} hci_run_columns;

/* Finds the columns and reads none. remark: out, what was supposed on reading, now and later; starts with
 * {0}. *c is to be released even after a failure. HCI_ERROR_INPUT for a file without samples, without angle
 * or voltages, or with an angle that may be mechanical or electrical; HCI_ERROR_MEMORY. */
hci_status hci_run_columns_find(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note);

/* The column that was not read and may be a measured torque, as --column takes it, or else one that may be
 * the force of a load cell, as its header says; the remark tells it, too. text, force: out, left where there
 * is none. */
void hci_run_columns_torque_like(const hci_run_columns *c, char text[HCI_RUN_NAME], char force[HCI_RUN_NAME]);

/* Tells in the remark which columns that were not read are currents by their unit or name. text: out, the
 * first that may be i_q, as --column takes it; left where there is none. */
void hci_run_columns_current_like(const hci_run_columns *c, char text[HCI_RUN_NAME]);

/* The same of the first that may be the speed, in the remark alone. */
void hci_run_columns_speed_like(const hci_run_columns *c);

/* Adds to an error which column may be the angle, and how to say it. */
void hci_run_columns_say_angle(const hci_run_columns *c, hci_note *missing);

/* The column that was not read and may be the angle, as --column takes it: an encoder's counts over those of
 * a turn, which theta_m_rad, [count], tells where they are usual ones. text: out, left
 * where there is none; the remark says it, too. HCI_ERROR_MEMORY. */
hci_status hci_run_columns_angle_like(const hci_run_columns *c, const double *theta_m_rad,
                                      char text[HCI_RUN_NAME]);

/* The counts of a turn nearest to a number that encoders have, powers of two and round decimal ones; 0: it is
 * not within 5 % of one. */
double hci_usual_counts(double found);

/* So, for who can do without angle and voltages: any column that is known will do. */
hci_status hci_run_columns_find_any(const hci_csv *csv, hci_run_columns *c, hci_note *remark, hci_note *note);
void hci_run_columns_release(hci_run_columns *c);

/* What a 1 of a column that the file has is in the canonical unit. */
double hci_run_column_factor(const hci_run_columns *c, hci_run_column which);

/* The line of the row of units, where that names the unit of a column; 0: none does. */
size_t hci_run_column_unit_line(const hci_run_columns *c, hci_run_column which);

/* Whether a column that the file has says its unit, by its header, the row of units or who named it. */
bool hci_run_column_names_unit(const hci_run_columns *c, hci_run_column which);

/* Reads a column into c->value, if the file has it. HCI_ERROR_INPUT with line and column, HCI_ERROR_MEMORY.
 */
hci_status hci_run_column_read(hci_run_columns *c, hci_run_column which);

/* The values, which are then the caller's to free; NULL where there are none. */
double *hci_run_column_take(hci_run_columns *c, hci_run_column which);

/* Frees the values. */
void hci_run_column_drop(hci_run_columns *c, hci_run_column which);

/* A column that says again what others say, or that the caller has no use for: it is not reported as
 * unused. */
void hci_run_column_leave(hci_run_columns *c, hci_run_column which);

/* Whether there is an angle, or what does without one: voltages, a speed over time, or torque and i_q. */
bool hci_run_columns_suffice(const hci_run_columns *c);

/* The canonical name, with its unit. */
const char *hci_run_column_name(hci_run_column which);

/* Says of a torque that a drive has computed that it is not used. */
void hci_run_computed_torque_leave(hci_run_columns *c);

/* As the header spells it, and the line of the header in the file; NULL: the file does not have it. */
const char *hci_run_column_header(const hci_run_columns *c, hci_run_column which, size_t *line);

/* Names the columns of the file that were not read, in the remark. */
void hci_run_columns_tell_unused(const hci_run_columns *c);

/* ---- three phases, by the first of them: HCI_RUN_IA, HCI_RUN_VA or HCI_RUN_VAB */

/* How many of the three the file has. */
int hci_run_phase_count(const hci_run_columns *c, hci_run_column first);

/* Which voltages to take: all three phases, else line voltages, of which two will do, else two phases, whose
 * third makes the sum 0, as in a star without neutral. False: none of these. */
bool hci_run_voltages(const hci_run_columns *c, hci_run_column *first);

hci_status hci_run_phases_read(hci_run_columns *c, hci_run_column first);

/* Phase quantities of one sample; of two columns, the third makes the sum 0. Of line voltages the phases have
 * the sum 0, too: orders divisible by three are not in them. */
void hci_run_phases_at(const hci_run_columns *c, hci_run_column first, size_t sample, double x[3]);

#endif
