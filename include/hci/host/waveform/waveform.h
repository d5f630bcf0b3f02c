/* From a recording to the orders of a waveform: cogging torque and back-EMF, with their standard errors. */
#ifndef HCI_HOST_WAVEFORM_WAVEFORM_H
#define HCI_HOST_WAVEFORM_WAVEFORM_H

#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is looked for. */
typedef enum {
    HCI_WAVEFORM_BACK_EMF, /* phase voltages of an open machine, by speed */
    HCI_WAVEFORM_COGGING   /* torque without current, or less what the current makes */
} hci_waveform_quantity;

/* How to look for it. */
typedef struct {
    hci_waveform_quantity quantity; /* what for */
    int pole_pairs;                 /* of the machine, >= 1 */
    const double *orders; /* electrical, ascending, above 0, these and no others; NULL: what stands out */
    size_t order_count;   /* entries of orders */
    double max_order;     /* electrical; NAN: 60, or what the samples bear */
    double torque_constant_Nm_per_A; /* of i_q, for a run with currents; NAN: not given */
} hci_waveform_options;

/* One order: amplitude·sin(order·θ + phase). Amplitudes in N·m (cogging) or V·s/rad = N·m/A (back-EMF, phase
 * a to the star point). */
typedef struct {
    double order;                /* electrical */
    double amplitude, phase_rad; /* peak, and phase at θ = 0 */
    double std_error;            /* of the amplitude; that of the phase is std_error/amplitude */
    double chance;               /* that noise alone makes so much */
    bool kept;                   /* stands out of the noise, or was asked for */
} hci_waveform_order;

/* How one voltage channel compares with the other two. */
typedef struct {
    const char *name;                    /* va, vb, vc */
    double offset_V, offset_error_V;     /* of the channel, and its standard error */
    double ratio, ratio_error;           /* of its fundamental to the mean of the others that count */
    double phase_error_rad, phase_error; /* beyond its third of a turn, and the standard error of that */
    bool left_out;                       /* does not count: its scale is another, or it shows nothing */
} hci_waveform_channel;

/* The orders of a waveform. Start with {0}. */
typedef struct {
    hci_waveform_quantity quantity;       /* what was looked for */
    hci_waveform_order *order;            /* ascending, all that were looked at */
    size_t count, kept;                   /* entries of order, and how many of them are kept */
    double step;                          /* between orders that were looked at; 0: they were given */
    double largest_left;                  /* largest order that was not kept, 0: none */
    size_t turns_forward, turns_backward; /* that were averaged, each 1/step electrical turns long */
    bool between_turns; /* errors are from how turns differ; else from the orders around, or the residual */
    double mean_Nm;     /* cogging: what does not change with the angle; forward and
                         * backward in equal parts */
    double friction_Nm, friction_error_Nm; /* half the difference of the directions; NAN without both */
    double frequency_Hz, drift_Hz_per_s;   /* back-EMF without an angle, else NAN: electrical, at the middle
                                            * of the record; negative: turned backward */
    double speed_rad_per_s;                /* back-EMF: mean, mechanical */
    hci_waveform_channel channel[3];       /* back-EMF */
    double
        zero_rad; /* back-EMF: phase of the fundamental at θ = 0 where that is clearly not 0: the electrical
                   * angle to be added to that of the recording, to which what is written is turned; else 0 */
    hci_note remark; /* what the reader should know, or "" */
} hci_waveform;

/* Finds the orders of a recording.
 *
 * Cogging: torque_Nm − torque_constant·i_q over the angle. A holding run, whose torque is 0, needs the
 * constant. The angle is cut into turns, mechanical where they are known and gone round, else electrical;
 * each is fitted by all orders at once, forward and backward are averaged, so that friction drops out.
 *
 * Back-EMF: phase voltages over speed, as it is with orders 1, 2, …; without an angle the electrical
 * frequency and its drift come from the voltages by nonlinear least squares, and θ = 0 is where phase a's
 * fundamental crosses zero upward; a speed that ripples with order 6 of the turn then shows as orders 5
 * and 7. Given is the balanced part, e_s = A sin(n(θ − 2πs/3) + γ), without channels whose scale is not that
 * of the others.
 *
 * An order is kept when noise alone would make any as large in one of a hundred recordings (F-test against
 * the orders around, or against how the turns differ, divided by the number of orders looked at), and when it
 * is three times its standard error and a millionth of the largest. Standard errors: from four turns or more
 * by how these differ, allowing for turns that resemble the next; else by the median of the orders around.
 * HCI_ERROR_INPUT with a note for a run that does not bear the analysis, HCI_ERROR_ARGUMENT for orders that
 * it cannot tell, HCI_ERROR_MEMORY. On failure *waveform is empty. */
hci_status hci_waveform_find(const hci_run *run, const hci_waveform_options *options, hci_waveform *waveform,
                             hci_note *note);

/* Frees what a waveform holds and empties it. */
void hci_waveform_release(hci_waveform *waveform);

#ifdef __cplusplus
}
#endif

#endif
