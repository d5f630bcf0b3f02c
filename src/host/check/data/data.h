/* What `check` reads from the files: the numbers of a machine folder as they stand, each with its file, line
 * and column, and the statistics of its recordings. They are taken once; an interpretation (interpretation.h)
 * then says what they mean, and costs no second look at the samples. */
#ifndef HCI_SRC_HOST_CHECK_DATA_H
#define HCI_SRC_HOST_CHECK_DATA_H

#include <stdbool.h>

#include "hci/host/base/note.h"
#include "hci/host/csv/csv.h"
#include "hci/host/machine/machine.h"
#include "hci/host/recording/run.h"
#include "host/check/data/odd_channel.h"
#include "host/check/data/plane_vector.h"

/* Bytes of a text and of a path, as in check.h. */
enum { CHECK_TEXT = 128, CHECK_PATH = 512 };

/* ---- where a number stands */

typedef struct {
    const char *path;        /* NULL: the file does not have it */
    size_t line;             /* from 1 */
    char column[CHECK_TEXT]; /* as the header spells it */
    char text[CHECK_TEXT];   /* the cell */
    size_t unit_line;        /* of the row of units that names the unit of the column; 0: none does */
    double factor;           /* of a column: from its unit to that of the quantity; else 0 */
    bool names_unit;         /* of a column: its header, the row of units, or who named it, says its unit */
} check_place;

/* ---- machine folder */

/* Scalars of machine.csv. */
enum {
#define CHECK_VALUE_NAME(field, name, unit) CHECK_##field,
    HCI_MACHINE_VALUES(CHECK_VALUE_NAME)
#undef CHECK_VALUE_NAME
        CHECK_VALUE_COUNT
};

/* order, amplitude, phase as they stand; phases in radians where the column says so. */
typedef struct {
    char path[CHECK_PATH];
    size_t count; /* 0: no such table, or an empty one */
    double *order, *amplitude, *phase_rad;
    size_t largest;                                     /* row of the largest amplitude */
    double most_phase_rad;                              /* largest absolute phase */
    check_place order_cell, amplitude_cell, phase_cell; /* of that row */
} check_table;

/* inductance.csv, as far as it is compared. */
typedef struct {
    bool given, are_slopes;
    double reluctance_Nm_per_A2;           /* mean torque at i_d = i_q = 1 A, with the declared pole pairs */
    double inductance_d_H, inductance_q_H; /* mean over the turn; NAN for slopes */
    char path[CHECK_PATH];
    check_place cell;
} check_inductance;

/* ---- recordings */

/* The recorded angle is turned into an electrical one by a factor; so many factors can interpretations ask
 * for. */
enum { CHECK_SCALES = 12, CHECK_FORWARD = 0, CHECK_BACKWARD = 1 };

/* Means of x e^{∓jθ}, θ = scale × recorded angle: of waves that turn with the rotor, and against it. */
typedef struct {
    double scale;
    check_vector current[2], voltage[2];
} check_frame;

/* Means of what stands in v = R i + jω(L_d i_d + jL_q i_q) + jω k_e, which holds sample by sample and so for
 * every weighted mean. Those of v_d, v_q are weighted by the speed: Σ v ω / Σ |ω|, so that neither a speed
 * that varies nor one that changes its sign spoils them. */
typedef struct {
    check_vector voltage, current;
    check_vector speed_current; /* of speed × current */
    double speed;               /* in the unit of its column */
} check_voltage_terms;

/* Of a mechanical turn: orders below this, and so many lines of a ripple at most; pole pairs that are
 * counted. */
enum { CHECK_MOST_ORDER = 600, CHECK_MOST_LINES = 16, CHECK_MOST_PAIRS = 60 };

/* Interpretations ask for the same orders of the torque again and again. */
enum { CHECK_CACHED_ORDERS = 256 };

typedef struct {
    double order;
    check_vector wave;
} check_cached_order;

/* Orders of a mechanical turn of the ripple, and their least size (ripple_shift.h). */
enum { CHECK_RIPPLE_ORDERS = 60 };

typedef struct {
    bool is_taken;
    double least;
    check_vector wave[CHECK_RIPPLE_ORDERS + 1];
} check_turn_ripple;

/* The statistics of one recording, or of one direction of it (run_parts.h), in the units of its columns after
 * conversion to SI. */
typedef struct {
    const char *path;                               /* the caller's */
    size_t count;                                   /* samples */
    check_cached_order cached[CHECK_CACHED_ORDERS]; /* of the torque; the oldest gives way */
    size_t cached_count;
    check_turn_ripple ripple; /* taken the first time it is asked for */
    double *theta;            /* recorded angle; NULL: none */
    double *torque; /* torque in N·m; where the shaft was held, −i_q in A: what balances the cogging torque */
    bool is_held;          /* torque 0 throughout, and i_d, i_q */
    bool turns_steadily;   /* held by no one, but i_q turns the shaft steadily: it knows the orders of the
                              cogging torque, and its size as far as the speed was held */
    bool is_electrical;    /* the angle is theta_e */
    double given_zero_rad; /* electrical, that the user adds to the angle; 0: none */
    bool is_exchanged;     /* angle and torque stand in each other's column, as it seems */
    bool currents_are_exchanged; /* i_d and i_q, of a file without a torque */
    int standing_phase; /* the largest of phase currents that stand while the angle goes round; -1: they turn
                         */
    double standing_A;  /* its size */
    bool dq_is_steady;  /* i_d, i_q are more than noise about 0 */
    bool has_abc, has_dq, has_voltage, has_speed, has_torque;
    bool has_phase_voltage, has_dq_voltage; /* one of them where has_voltage */
    bool has_line_voltage;                  /* those of the phases are made of it */
    bool lacks_d_voltage;                   /* v_q alone: v_d is not known */
    bool lacks_d_current;                   /* i_d was not recorded, or is none */
    bool speed_is_electrical;               /* its column */
    bool dq_voltage_is_coherent;            /* follows the speed */
    double declared_pole_pairs;             /* of the machine; 0: not given */
    double angle_range;                     /* of the recorded angle */
    double angle_rate;                      /* of the recorded angle over the recorded time; NAN: unknown */
    double angle_ratio;                     /* theta_e over theta_m where both were recorded, else NAN */
    double speed;                           /* mean of the speed column */
    double speed_over_time;                /* of the speed column over the time of angle_rate; NAN: unknown */
    double speed_change;                   /* from the first to the last fifth, over the mean */
    double torque_mean, torque_variance;   /* mean, and mean square about it */
    double torque_at_speed;                /* mean of torque × speed over the mean speed */
    double typed_torque;                   /* one number in every row, that was not measured; 0: none */
    double current_square, voltage_square; /* mean |x|² */
    check_vector dq;                       /* mean of recorded i_d + j i_q */
    double product_dq;                     /* mean of i_d i_q as recorded */
    check_vector power;                    /* mean of voltage × conj(current) */
    check_voltage_terms terms;             /* of v_d, v_q */
    double current_order, voltage_order;   /* order and sequence against the recorded angle; NAN: none */
    double gear; /* turns of the rotor for one of the mechanical angle, by no whole number of electrical turns
                    in it and the declared pole pairs; 0: it is the rotor's, or nothing tells */
    bool current_is_steady; /* with one sign all the time */
    double frequency;       /* of the voltages over the recorded time, rad per unit of time; NAN: unknown */
    int current_way;        /* of the whole file without a torque: 1 where i_q accelerates and brakes against
                             * friction as    that of a motor does, -1 where it works against the motion, 0 where
                             * that        is not told */
    double phase_ratio;     /* length of the vector of phase currents over that of i_d, i_q; NAN: not both */
    double current_sum;     /* rms of ia + ib + ic over the rms of the currents; NAN: not three columns */
    check_odd_channel channel; /* of the currents, which all else here takes as it has to be read */
    double current_balance, voltage_balance; /* largest over smallest alternating rms of the phases */
    int line[CHECK_MOST_LINES], lines;       /* orders per turn with which the torque repeats */
    check_frame frame[CHECK_SCALES + 1];     /* the last: at the order that the recording itself has */
    check_place theta_cell, time_cell, speed_cell, current_cell, voltage_cell, torque_cell;
    check_place d_cell;        /* of i_d, where has_dq */
    check_place channel_cell;  /* of the odd channel */
    check_place phase_cell[3]; /* of the phase currents, where has_abc */
} check_run;

/* Of a machine folder and its recordings. run: a recording has as many as it has parts. */
typedef struct {
    char machine_path[CHECK_PATH];
    double value[CHECK_VALUE_COUNT]; /* canonical units; NAN: not given */
    check_place cell[CHECK_VALUE_COUNT];
    bool has_neutral;
    hci_order_base order_base; /* that the tables are declared with */
    bool emf_in_volts;
    check_table emf, cogging;
    check_inductance inductance;
    double scale[CHECK_SCALES];
    size_t scales;
    check_run *run;
    size_t runs;
    const hci_column_names *columns; /* what was said of columns when they were read; the caller's, or NULL */
    bool torque_zero_is_told;  /* by runs without current in both directions; the torques are without it */
    double no_current_A;       /* runs with less are without current */
    int pole_pairs_of_ripple;  /* that the orders of the ripple without load fit best; 0: no such recording */
    double counted_pole_pairs; /* by the recordings; 0: not counted */
} check_data;

/* *data starts from {0}; what these two leave is to be released even after a failure. HCI_ERROR_INPUT with
 * file, line and remedy, HCI_ERROR_MEMORY. remark: what to know of the machine's folder. */
hci_status hci_check_machine_read(const char *folder, check_data *data, hci_note *remark, hci_note *note);
/* After the machine. remark: [count], how each recording was read. */
hci_status hci_check_runs_read(const char *const *path, size_t count, const hci_run_options *reading,
                               check_data *data, hci_note *remark, hci_note *note);
void hci_check_data_release(check_data *data);

/* The zero that the user has given to the angles of the recordings, electrical; 0: none. */
double hci_check_given_zero_rad(const check_data *data);

/* The frame of a scale, whatever its sign; NULL where the run has no angle. */
const check_frame *hci_check_frame_of(const check_run *run, double scale);

/* S + jC of the torque of a run at an order of the recorded angle, by its sums with sine and cosine.
 * O(samples) the first time; the run keeps it. */
check_vector hci_check_torque_order(check_run *run, double order);

/* The lines of run->torque over a mechanical turn: run->line. False: out of memory. O(samples + orders²). */
bool hci_check_run_orders(check_run *run);

/* Whether more than noise and offsets flows. */
bool hci_check_has_current(const check_data *data, const check_run *run);

#endif
