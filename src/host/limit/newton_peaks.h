/* The peaks of Newton's method: their quantities with gradients, and the search for them. */
#ifndef HCI_SRC_HOST_LIMIT_NEWTON_PEAKS_H
#define HCI_SRC_HOST_LIMIT_NEWTON_PEAKS_H

#include "host/limit/newton_state.h"

/* Whether it is of the torque, whose limits are its highest and its lowest. */
bool hci_newton_is_torque(const hci_newton_peak *p);

/* The rows of a peak's quantity, as shares of the limit, with the currents as they are: in w->row and v. */
void hci_newton_rows_at(const hci_newton *w, const hci_newton_peak *p, double theta_rad, double v[2]);

/* out = one[0]·row of the first part + one[1]·row of the second. out: n. */
void hci_newton_combine(const hci_newton *w, const double one[2], double *out);

/* The size of a quantity as a share of its limit, of a torque what it is beyond its end of the range; g: out,
 * its gradient. The rows are left in w->row. */
double hci_newton_size_at(hci_newton *w, const hci_newton_peak *p, double theta_rad, double *g);

/* How far a size is beyond what is kept. */
double hci_newton_beyond(const hci_newton_peak *p, double size);

/* The peak that is nearest to a point of the program, or NULL. */
hci_newton_peak *hci_newton_peak_of(hci_newton *w, const hci_limit_point *at);

/* Between what a quantity has to stay, but for a share: of the limit, of the torque's range. */
void hci_newton_range_of(const hci_newton *w, const hci_limit_grid *g, double share, double range[2]);

/* Whether this stage asks for a grid's quantity. */
bool hci_newton_is_asked(const hci_newton *w, const hci_limit_grid *g);

/* The peaks of a grid that are beyond a range; to be released. */
hci_status hci_newton_peaks_beyond(hci_newton *w, const hci_limit_grid *g, const double range[2],
                                   hci_limit_points *found);

/* Adds the peaks that are beyond their limits but for a share and not known yet; *added: out, how many.
 * HCI_ERROR_MEMORY, without a note. */
hci_status hci_newton_search(hci_newton *w, double share, size_t *added);

#endif
