/* What drags of several runs have in common.
 *
 * In: the drag of each run on average, and its speed. Out: whether Coulomb's friction and one that grows with
 * the speed make all of them, in both directions, and that friction: a load that is constant, or another one
 * in each run, is none. */
#ifndef HCI_SRC_HOST_RECORDING_DRAG_LAW_H
#define HCI_SRC_HOST_RECORDING_DRAG_LAW_H

#include <stdbool.h>
#include <stddef.h>

/* Means over a run, all of them times the sign of the speed or none. */
typedef struct {
    double drag_Nm;  /* what the current's torque has to overcome; NAN: not known */
    double sign;     /* of the speed */
    double constant; /* a load of 1 N·m */
    double speed_rad_per_s;
    double square; /* ω |ω|, rad²/s² */
} hci_drag;

/* T = T_c sign ω + B ω + Q ω |ω| */
enum { HCI_DRAG_COULOMB, HCI_DRAG_VISCOUS, HCI_DRAG_QUADRATIC, HCI_DRAG_TERMS };

typedef struct {
    double value[HCI_DRAG_TERMS], std_error[HCI_DRAG_TERMS];
    size_t terms; /* the first of them, as many as the speeds tell; 0: no law */
    double gain;  /* fall of the Bayesian information criterion by it */
} hci_drag_law;

/* *is_friction: the law, Q where there are five drags or more, leaves up to a tenth of the rms drag, beside
 * it a constant load has up to a tenth, and the drags brake. False in one direction. False returned: memory
 * is out. */
bool hci_drags_are_friction(const hci_drag *drag, size_t count, bool *is_friction);

/* The law of least squares with as many terms as there are speeds that differ by 15 %, and T_c of 0 or more.
 * Errors by what it leaves; where that is nothing, of a tenth of the rms drag. False: memory is out. */
bool hci_drag_law_find(const hci_drag *drag, size_t count, hci_drag_law *law);

/* Of the run. */
double hci_drag_law_at(const hci_drag_law *law, const hci_drag *drag);

#endif
