/* The torque of all machines that recordings allow, along one current. */
#ifndef HCI_SRC_HOST_MACHINE_EXPECTED_RIPPLE_H
#define HCI_SRC_HOST_MACHINE_EXPECTED_RIPPLE_H

#include "hci/effects/effect.h"
#include "hci/host/machine/expected_ripple.h"

/* Of fewer recordings parts were left out in turn, which tell nothing of other currents. */
enum { HCI_RIPPLE_LEAST_RECORDINGS = 3 };

/* Samples of a current, and what the model makes of it. */
typedef struct {
    const hci_machine *machine; /* declared */
    const hci_effects *effects; /* that it has beside that */
    const hci_sample *sample;   /* [count], true ones */
    const double *torque_Nm;    /* [count], of the machine with its effects */
    const double *wanted_Nm;    /* [count]; NULL: nothing but the mean */
    size_t count;
    size_t turns; /* electrical turns that they cover evenly, count a power of two; 0: any samples */
    double speed_rad_per_s; /* mechanical; NAN: not known */
} hci_ripple_path;

/* uncertainty: of the machine; NULL: nothing is known. *expected: out. HCI_ERROR_MEMORY.
 * O(count·terms·machines).
 */
hci_status hci_expected_ripple_find(const hci_ripple_path *path, const hci_uncertainty *uncertainty,
                                    hci_expected_ripple *expected, hci_note *note);

/* Whether currents lie further outside of what was recorded than a bound has been checked for. */
bool hci_expected_ripple_is_far(const hci_expected_ripple *expected);

#endif
