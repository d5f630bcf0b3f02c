/* What a current loop makes of the torque of currents that it is asked for. */
#ifndef HCI_HOST_SOLVE_LOOP_REACH_H
#define HCI_HOST_SOLVE_LOOP_REACH_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of a loop of first order in the rotor frame, i/i* = 1/(1 + jν/ω_b), whose mean is right. Where the machine
 * declares inductances the harmonics of the back-EMF drive currents through it, too; where not, they are left
 * out. Torques from peak to peak, of the torque less that of currents that flow as they are. */
typedef struct {
    double bandwidth_Hz, speed_rpm; /* that were asked for, speed of any sign; 0: none */
    double allowed_Nm; /* a tenth of the ripple of a plain sine; NAN: not looked at, as all numbers then */
    double rpm_per_Hz; /* mechanical speed over bandwidth, up to which the loop adds that; HUGE_VAL: any */
    double lead_rpm_per_Hz;   /* the same of a table that is read ahead by the delay of the loop, 1/ω_b */
    double added_Nm;          /* at bandwidth_Hz and speed_rpm; NAN: one of both is not given */
    double lead_added_Nm;     /* the same, read ahead */
    bool leaves_out_back_emf; /* the back-EMF has harmonics, and the machine no inductance */
} hci_loop_reach;

/* In plain words, without a capital at the beginning and a point at the end; "" where not looked at. text:
 * out; size: of it, 512 will do. */
void hci_loop_reach_words(const hci_loop_reach *loop, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
