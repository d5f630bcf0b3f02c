/* The drive that is to make the currents: drive.csv, and the measured response of its current loop,
 * loop.csv. */
#ifndef HCI_HOST_DRIVE_DRIVE_H
#define HCI_HOST_DRIVE_DRIVE_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/drive/plant.h"
#include "hci/host/currents/currents.h"
#include "hci/host/machine/machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Numbers of drive.csv: X(field, name in the file, unit, lowest, highest, default, what it is). Unit `count`
 * is a whole number. Not given: NAN until hci_drive_fit has filled the defaults in. */
#define HCI_DRIVE_VALUES(X)                                                                                  \
    X(sample_s, "current_sample_time", "s", 1e-7, 0.1, "100 us", "of the current loop")                      \
    X(bandwidth_Hz, "bandwidth", "Hz", 1e-3, 1e6, "0.032/current_sample_time",                               \
      "by which the gains are chosen where they are not given")                                              \
    X(kp_ohm, "current_kp", "ohm", 0.0, 1e9, "2 pi bandwidth L", "k_p of the PI loop, V/A")                  \
    X(ki_ohm_per_s, "current_ki", "V/(A*s)", 0.0, 1e12, "2 pi bandwidth R", "k_i of the PI loop")            \
    X(kp_q_ohm, "current_kp_q", "ohm", 0.0, 1e9, "current_kp", "k_p of q, where it is not that of d")        \
    X(ki_q_ohm_per_s, "current_ki_q", "V/(A*s)", 0.0, 1e12, "current_ki", "the same of k_i")                 \
    X(filter_s, "current_filter_time", "s", 0.0, 0.1, "0: none",                                             \
      "time constant of the low-pass that the PI sees i_d and i_q through")                                  \
    X(computing_delay_s, "computing_delay", "s", 0.0, 0.1, "current_sample_time",                            \
      "from a sample to the use of its voltage, which then holds for a sample")                              \
    X(dc_link_voltage_V, "dc_link_voltage", "V", 1e-9, 1e7, "machine.csv", "of the inverter")                \
    X(dead_time_s, "dead_time", "s", 0.0, 0.01, "0", "of a leg, once in each period of the PWM")             \
    X(pwm_frequency_Hz, "pwm_frequency", "Hz", 1.0, 1e7, "1/current_sample_time",                            \
      "how often a leg switches on: half of the sampling where that is at both edges")                       \
    X(dead_time_crossing_A, "dead_time_crossing", "A", 0.0, 1e6, "0",                                        \
      "current below which dead time acts in part: half the ripple of the PWM")                              \
    X(dead_time_compensation, "dead_time_compensation", "count", 0.0, 1.0, "0",                              \
      "1: the control adds what the dead time takes")                                                        \
    X(current_quantum_A, "current_quantum", "A", 0.0, 1e6, "0", "step of the current's reading")             \
    X(encoder_counts, "encoder_counts", "count", 0.0, 1e9, "0: not quantised", "in a mechanical turn")       \
    X(resistance_ohm, "resistance", "ohm", 0.0, 1e9, "machine.csv",                                          \
      "of a phase, where machine.csv has none")                                                              \
    X(inductance_d_H, "inductance_d", "H", 1e-12, 1e6, "machine.csv", "the same")                            \
    X(inductance_q_H, "inductance_q", "H", 1e-12, 1e6, "machine.csv", "the same")

/* What a drive adds so that d and q do not disturb each other: X(value, word). */
#define HCI_DECOUPLING_NAMES(X)                                                                              \
    X(HCI_DECOUPLING_TABLE, "table")                                                                         \
    X(HCI_DECOUPLING_CONSTANT, "constant")                                                                   \
    X(HCI_DECOUPLING_NONE, "none")

/* How a drive modulates: X(value, word). */
#define HCI_MODULATION_NAMES(X)                                                                              \
    X(HCI_MODULATION_SPACE_VECTOR, "space_vector")                                                           \
    X(HCI_MODULATION_SINUSOIDAL, "sinusoidal")                                                               \
    X(HCI_MODULATION_CIRCLE, "circle")

/* Which current a measured response is of: X(value, word). */
#define HCI_RESPONSE_OF_NAMES(X)                                                                             \
    X(HCI_RESPONSE_OF_SAMPLES, "samples")                                                                    \
    X(HCI_RESPONSE_OF_CURRENT, "current")

/* Decoupling by the measured current. */
typedef enum {
    HCI_DECOUPLING_TABLE,    /* ω (e + L'i) and ω L i a quarter turn on, of all tables of the machine */
    HCI_DECOUPLING_CONSTANT, /* ω L_q i_q, ω L_d i_d and the fundamental of the back-EMF */
    HCI_DECOUPLING_NONE      /* nothing */
} hci_decoupling;

/* Which current a measured response is of. */
typedef enum {
    HCI_RESPONSE_OF_SAMPLES, /* the readings of the drive itself, one each sample */
    HCI_RESPONSE_OF_CURRENT  /* that which flows, as an analyser sees it, of the same frequency */
} hci_response_of;

/* The closed loop's answer at one frequency: current by reference, in d and in q. */
typedef struct {
    double frequency_Hz; /* > 0 */
    double gain[2];      /* d, q; > 0 */
    double phase_rad[2]; /* below 0: the current is late */
} hci_loop_point;

/* Currents at one mean torque. */
typedef struct {
    double torque_Nm;      /* mean */
    const hci_wave *waves; /* without zero sequence, in A */
    size_t count;          /* entries of waves */
} hci_loop_level;

/* The largest departures of the torque between the levels from the straight line between what two of them
 * make, with currents that flow as they are, and the torques that were asked for there. */
typedef struct {
    double mean_off_Nm, mean_at_Nm; /* of the mean, with its sign */
    double ripple_Nm, ripple_at_Nm; /* peak to peak of the departure over the angle */
} hci_between_levels;

/* Levels that are read from solutions. Start with {0}. */
typedef struct {
    hci_loop_level *level;  /* ascending by torque */
    hci_currents *currents; /* that they point into */
    size_t count;           /* entries of both */
    uint64_t hash;          /* of all values that were read */
} hci_loop_levels;

/* Reads the currents of the folders that `solve` wrote, each a level at its own mean torque. per_torque: of
 * one folder the two parts, as levels at −T and +T. HCI_ERROR_INPUT, _ARGUMENT (two of the same torque),
 * _MEMORY. To be given to hci_loop_levels_release. */
hci_status hci_loop_levels_read(const char *const *folders, size_t count, bool per_torque,
                                hci_loop_levels *levels, hci_note *note);

/* Frees what levels hold and empties them. */
void hci_loop_levels_release(hci_loop_levels *levels);

/* Bytes of a path. */
enum { HCI_DRIVE_PATH_SIZE = 4096 };

/* A drive. Start with {0}. */
typedef struct {
#define HCI_DRIVE_FIELD(field, name, unit, low, high, fallback, what) double field;
    HCI_DRIVE_VALUES(HCI_DRIVE_FIELD)
#undef HCI_DRIVE_FIELD
    hci_decoupling decoupling;      /* what it adds */
    bool decoupling_is_given;       /* in the file */
    bool gains_are_given;           /* in the file: k_p, or a bandwidth */
    hci_modulation modulation;      /* what voltages it reaches */
    hci_response_of response_of;    /* which current it is of */
    hci_loop_point *response;       /* loop.csv, ascending; NULL with count 0: from the gains */
    size_t response_count;          /* entries of response */
    char path[HCI_DRIVE_PATH_SIZE]; /* of drive.csv, for messages; "" for none */
} hci_drive_data;

/* Reads drive.csv, and the loop.csv that it names. On success *drive is to be given to hci_drive_release; on
 * failure it is empty and the note says why. HCI_ERROR_INPUT, HCI_ERROR_MEMORY. */
hci_status hci_drive_read(const char *path, hci_drive_data *drive, hci_note *note);

/* Says what was taken for what the file does not say and drives differ in: the decoupling. */
void hci_drive_remark(const hci_drive_data *drive, hci_note *remark);

/* Says of L_d and L_q of a drive, as read or fitted, that differ, with a machine that has neither
 * inductance.csv nor effects with a reluctance torque: the currents of `solve` do not count on theirs.
 * folder: of the machine. */
void hci_drive_remark_saliency(const hci_drive_data *drive, const hci_machine_data *machine,
                               const char *folder, hci_note *remark);

/* Says of values, as read or fitted, that fit no motor, and of which unit they look: a `pwm_frequency` or a
 * bandwidth far from the sampling, an inductance whose time constant or flux no motor has. */
void hci_drive_remark_units(const hci_drive_data *drive, const hci_machine_data *machine, hci_note *remark);

/* Says of a drive that was fitted and has fewer counts in an electrical turn than twice the highest order of
 * a table, how many it takes, and what mean torque the table makes where it is read so. mean_Nm: that; NAN:
 * it is not known. */
void hci_drive_remark_counts(const hci_drive_data *drive, int pole_pairs, double highest_order,
                             double torque_Nm, double mean_Nm, hci_note *remark);

/* Nothing given: every number NAN. */
void hci_drive_init(hci_drive_data *drive);

/* From one sample of a drive's current loop to the next, its default where none is given. */
double hci_drive_sample_s(const hci_drive_data *drive);

/* Share of the dc link that dead time takes from the mean voltage of a leg, of a drive that was fitted: dead
 * time × frequency of the PWM. */
double hci_drive_dead_share(const hci_drive_data *drive);

/* Share of a new reading in the low-pass of the measured current, 1 − e^(−T/τ); 0: there is none. */
double hci_drive_filter_share(const hci_drive_data *drive);

/* The highest frequency in the rotor frame that references can make of a drive, 0.8 of half its sampling:
 * above it the ripple between the samples is as large as what it is to take away. */
double hci_drive_highest_rad_per_s(const hci_drive_data *drive);

/* Frees what a drive holds and empties it. */
void hci_drive_release(hci_drive_data *drive);

/* Joins drive and machine: what drive.csv leaves open gets its default, and R, L and the dc link that
 * machine.csv does not have come from drive.csv. fitted: out, a machine that shares the arrays of `machine`
 * and is not to be released. HCI_ERROR_INPUT where a value is missing or stands in both files, or where the
 * loop is not stable with these gains at standstill. */
hci_status hci_drive_fit(hci_drive_data *drive, const hci_machine_data *machine, hci_machine_data *fitted,
                         hci_note *note);

/* Whether the sampling of a drive that was fitted, and the stability of its loop, last up to a speed:
 * HCI_ERROR_INPUT for fewer than 10 samples in an electrical turn, or a loop that is not stable there. */
hci_status hci_drive_check_speed(const hci_drive_data *drive, const hci_machine_data *fitted,
                                 double speed_rad_per_s, hci_note *note);

/* Both for a drive as it was read, which stays so: HCI_ERROR_INPUT where its loop is not stable at standstill
 * or at the speed, or is sampled too seldom there. remark: where R or L are known to neither file, that
 * nothing was checked. */
hci_status hci_drive_check_loop(const hci_drive_data *drive, const hci_machine_data *machine,
                                double speed_rad_per_s, hci_note *remark, hci_note *note);

/* Resistance and inductances that the machine does not have, as the drive gives them. */
void hci_drive_complete(const hci_drive_data *drive, hci_machine_data *machine);

/* Whether the dc link, of the drive or where it has none of the machine, is known and, of a machine that was
 * completed, resistance and inductance too, so that the voltage of currents can be kept within it. link_V:
 * out, 0: not known. */
bool hci_drive_limits_voltage(const hci_drive_data *drive, const hci_machine_data *machine, double *link_V);

#ifdef __cplusplus
}
#endif

#endif
