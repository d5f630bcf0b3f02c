/* The steps of tune: each is an ordinary command that leaves an ordinary folder, and is noted as such. Uses
 * tune_options and the folder command. */
#ifndef HCI_CLI_TUNE_STEPS_H
#define HCI_CLI_TUNE_STEPS_H

#include "cli/command/reading.h"
#include "hci/host/check/check.h"
#include "hci/host/diagnose/diagnose.h"
#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"
#include "hci/host/report/tune/tuning.h"
#include "hci/host/waveform/waveform.h"

/* Bytes of a path; the largest orders of a waveform that are said. */
enum { CLI_TUNE_PATH = 2048, CLI_TUNE_ORDERS_SAID = 6 };

/* Commands that are run as they are. */
typedef struct {
    const cli_command *init, *harmonics, *emit;
} cli_tune_commands;

/* Sizes of what was solved for, beside what is rated or was taken for a load. */
typedef enum { CLI_TUNE_USUAL, CLI_TUNE_LARGE, CLI_TUNE_EXCESS } cli_tune_size;

/* What the steps hand on to each other. Start with zeros. */
typedef struct {
    const cli_arguments *arguments;
    cli_arguments kept; /* the same without the recordings that are left out */
    size_t left_out;    /* how many these are */
    cli_tune_commands commands;
    const char *out;
    char machine[CLI_TUNE_PATH]; /* folder of the machine that recordings are read with */
    char list[CLI_TUNE_PATH];    /* of the recordings */
    bool is_own;                 /* the machine was made here */
    char aside[CLI_TUNE_PATH];   /* where the results of an earlier call are until these are written; "" */
    cli_reading reading;
    hci_machine_data declared;
    hci_effects_data effects;
    hci_runs runs;
    hci_diagnosis diagnosis;
    hci_status diagnosed;
    size_t shown;                        /* recording in the report */
    bool has_slip, has_emf, has_cogging; /* check found one; they were measured without load */
    double drives_Nm;       /* mean torque with the motion, without current in one direction; 0: it brakes */
    bool has_sensor_zero;   /* drives_Nm is declared as the zero of the sensor */
    char slip[1024];        /* what was found first, in words; "" */
    bool emf_is_size_alone; /* has_emf: of a recording whose zero is not that of the others */
    bool has_diagnosis;     /* diagnose had something to do */
    bool has_unsteady;      /* a slow turn sticks and slips, and no other recording is of use */
    bool has_no_angle;      /* a recording has none, and no other is of use */
    bool needs_inertia; /* the current of a slow turn does not tell its cogging torque without the inertia */
    bool has_misfit;    /* angle, order or speed contradict each other, and no slip explains it */
    bool counts_pole_pairs; /* something in the recordings does */
    double
        inertia_share; /* of the recording where it is largest, as in hci_run; 0: the inertia is believable */
    char saliency[512];                  /* of a reluctance torque that nobody declared; "": none shows */
    bool has_standstill;                 /* the angle changes in none of the recordings */
    double turned_deg, turned_error_deg; /* --angle-offset that the torques ask for, electrical, and its
                                          * standard error; 0: none */
    double zero_deg,
        zero_error_deg; /* so as check finds it by torques or voltages; NAN: they do not tell it */
    bool zero_is_told;  /* and no saliency explains it as well */
    double drive_zero_deg, drive_zero_reach_deg; /* by the direction of the phase currents alone, if they lie
                                                  * beside q, and within what the torques confirm it */
    bool took_drive_zero;                        /* and it is the offset that was found */
    double open_turn_deg, open_turn_error_deg; /* by which the back-EMF is found turned, and a saliency would
                                                * do as well; 0: none */
    bool turn_is_of_dq;    /* open_turn_deg: against i_d and i_q, and not phase currents */
    double once_a_turn_Nm; /* cogging torque of once a turn that a load on the shaft may make; 0: none */
    double
        jump_rad; /* electrical, by which the angle of a recording jumps and stands between; 0: none does */
    double angle_to_speed; /* is_not_followed: the way of the angle to that of the speed */
    bool slip_is_of_poles; /* has_slip: of the number of pole pairs */
    bool slip_is_of_frame; /* has_slip: of angle, phases or poles, and of no size */
    bool slip_is_of_unit;  /* has_slip: a column of the recordings has another unit */
    bool slip_is_of_sheet; /* has_slip: a number of the sheet in another unit would do, and is said first */
    bool is_not_followed;  /* the angle of a recording does not go where its speed leads */
    size_t not_followed;   /* is_not_followed: which recording's */
    double stranger_order; /* the largest of the cogging torque found, where slots and poles make another one
                            * that was not found; 0: none */
    double mains_order,
        mains_Hz;            /* an order found that is a multiple of 50 or 60 Hz at the one speed; 0: none */
    double cogging_known_Nm; /* to which its orders are known, peak to peak, by their noise alone (95 %); 0:
                                not */
    double folded_order, folded_from,
        folded_Nm;  /* an order found, and one of slots and poles that the samples show as it; 0: none */
    double fast_Hz; /* the fastest of the larger orders by a torque sensor at one speed; 0: all are slow */
    double torque_to_sheet; /* torques of the recordings to those of the declared back-EMF, which check does
                             * not understand; 0: it does */
    bool has_doubt;         /* check does not understand something else */
    bool has_alias; /* samples lie too far apart for the order of slots and poles, which shows as another one
                     */
    bool tells_no_order;  /* not even an electrical turn is covered */
    double turns;         /* mechanical, that a recording over time covers; 0: none does */
    double highest_order; /* electrical, that the samples of their torque tell; 0: not told */
    bool has_offset;      /* recordings are read with an angle offset that was found here */
    char offset[32]; /* found here, or given with a unit: in degrees, as --angle-offset takes it; "": neither
                      */
    double emf_to_sheet;  /* has_emf: the measured back-EMF to that of the data sheet */
    double cogging_reach; /* order up to which a holding test was looked at; 0: none */
    hci_waveform cogging; /* of a holding test; empty: none */
    bool has_load;        /* a recording has a torque sensor and a mean torque */
    double mean_Nm;       /* that is solved for */
    bool keeps_angle;     /* all recorded currents have one direction in the rotor frame, and so have … */
    double current_angle_rad; /* … those that are solved for: β of hci_solve_options */
    hci_machine_data corrected;
    hci_effects_data found;
    hci_uncertainty uncertainty;
    hci_target target;
    hci_solution solution;
    bool is_solved, is_emitted;
    bool has_torque;                   /* there is one to be solved for: mean_Nm */
    char out_of_reach[HCI_NOTE_SIZE];  /* why the model has no currents for the torque, in words; "" */
    double cut_Nm;                     /* is_emitted: ripple that the cut to a table makes, peak to peak */
    double open_Nm[HCI_TUNING_POINTS]; /* torque without current */
    cli_tune_size size;                /* of an excess no table is written */
    double open_swing_Nm, usual_A;     /* of open_Nm, peak to peak; the load that size was judged by */
    hci_tuning tuning;
} cli_tuning;

/* In this order. Errors are those of the commands; what a recording does not hold is none. Recordings that a
 * table cannot be made of are left out where another one is of use; of a list that was given none is. */
hci_status cli_tune_begin(const cli_arguments *arguments, cli_tuning *tune, hci_note *note);
hci_status cli_tune_read(cli_tuning *tune, hci_note *note);
hci_status cli_tune_check(cli_tuning *tune, hci_note *note);
hci_status cli_tune_leave_out(cli_tuning *tune, hci_note *note);
hci_status cli_tune_waveforms(cli_tuning *tune, hci_note *note);
hci_status cli_tune_diagnose(cli_tuning *tune, hci_note *note);
hci_status cli_tune_solve(cli_tuning *tune, hci_note *note);
hci_status cli_tune_emit(cli_tuning *tune, hci_note *note);

/* Whether the recordings cannot be used as they are: nothing is found nor solved. */
bool cli_tune_is_blocked(const cli_tuning *tune);

/* The electrical order of the cogging torque of slots and poles; 0: the slots are not given. */
double cli_tune_order_of_slots(const cli_tuning *tune);

/* Whether that order is above all that are looked at, whatever the samples: so many slots for each pole that
 * little is left of it, and what cogging torque there is comes of magnets and teeth that are not alike. */
bool cli_tune_has_high_slots(const cli_tuning *tune);

/* Whether the torque of a recording was typed, and none is measured. */
bool cli_tune_is_typed(const cli_tuning *tune);

/* Whether there is anything to solve with: no slip, no slow turn that sticks, and something was measured. */
bool cli_tune_can_solve(const cli_tuning *tune);

/* Whether a recording tells where the electrical angle is 0: not by v_d and v_q, nor by i_d and i_q. */
bool cli_tune_knows_zero(const cli_tuning *tune);

void cli_tune_release(cli_tuning *tune);

#endif
