/* Statistics of a run, without any model: means, rms, and how well the torque repeats from turn to turn.
 */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_RUN_STATISTICS_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_RUN_STATISTICS_H

#include "hci/host/recording/run.h"

enum { HCI_MOST_SWINGS = 4 };

/* A swing of the torque at a frequency that is no multiple of that of the turn. */
typedef struct {
    double frequency_Hz, error_Hz; /* error: standard error */
    double turn_Hz;                /* of the rotor */
    double cosine_Nm, sine_Nm;     /* cosine_Nm·cos ωt + sine_Nm·sin ωt, t as recorded */
} hci_swing;

enum { HCI_DRIFT_DEGREE = 3 };

/* A torque that creeps along the time of a run: powers of τ = (t - middle)/half, from −1 to 1 in it. */
typedef struct {
    int degree; /* 0: none */
    double middle_s, half_s;
    double at_middle_Nm, coefficient_Nm[HCI_DRIFT_DEGREE]; /* of τ, τ², τ³ */
} hci_drift;

typedef struct {
    double mean_torque_Nm, rms_torque_Nm;
    double speed_deviation;                 /* rad/s, about the mean */
    double mean_speed_rad_per_s, current_A; /* root mean square of the current vector's length */
    double pace_rad_per_s, pace_deviation;  /* the same of its size, where a shaft with a torque sensor turns
                                             * both ways; else as the mean, without its sign, and about it */
    bool both_ways;                         /* it does: an electrical turn or more each */
    double mean_id_A, mean_iq_A;
    double rms_id_A;      /* root mean square: of one that varies about 0, too */
    double standing_A[3]; /* means of the phase currents over ten electrical turns or more; 0: fewer */
    bool stands;          /* besides them the currents are noise */
    bool zeros_read;      /* and they are the zeros of the sensors: no current flowed */
    bool is_direct;       /* the phase currents stay as they are while the rotor is at other angles, as when
                           * direct current flows and the rotor is locked */
    bool is_loaded;       /* the size of i_q stays far above what it varies by, as against a brake */
    double rms_acceleration; /* rad/s², of a run with a torque sensor */
    bool no_current;         /* what was read as current is the noise of its sensors, and current_A is 0 */
    double repeat_Nm; /* rms departure of a sample from the mean over the turns at its angle; NAN: one turn */
    double angle_step_rad; /* smallest step of the mechanical angle: the encoder's resolution or finer */
    bool creeps;           /* the mean torque of a turn rises or falls from turn to turn */
    double turns;          /* of the mechanical angle, from the least to the largest */
    double temperature_C;  /* mean; NAN */
    double coldest_C, hottest_C;      /* of its samples; NAN */
    hci_swing swing[HCI_MOST_SWINGS]; /* taken out of the samples' torques; the largest first */
    size_t swings;                    /* entries of swing in use */
    hci_drift drift;                  /* taken out of the samples' torques */
} hci_run_statistics;

/* Of a run without an angle all is 0, but for what is not known (NAN). O(samples). */
hci_run_statistics hci_run_statistics_of(const hci_run *run, int pole_pairs);

/* Where all that was read as current stands still while the rotor turns and is small beside the largest
 * current of the runs and the rated one (A, peak; NAN: not known), no current flowed: zeros_read is set. */
void hci_run_statistics_zeros_find(hci_run_statistics *statistics, size_t runs, double rated_current_A);

#endif
