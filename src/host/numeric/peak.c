#include "host/numeric/peak.h"

#include <math.h>

enum { MOST_PARABOLAS = 12 };

#define BETWEEN 0.5  /* share of the width within which the top of a parabola is trusted */
#define CLOSER  0.1  /* by which the points then draw together */
#define FINEST  1e-3 /* share of the first width at which it ends */

/* Where the parabola through three values has its top, in widths from the middle one; where it has none, the
 * higher side. */
static double top_of(double before, double middle, double after)
{
    const double bend = before - 2.0 * middle + after;
    if (!(bend < 0.0)) return after > before ? 1.0 : before > after ? -1.0 : 0.0;
    return fmax(-1.0, fmin(1.0, 0.5 * (before - after) / bend));
}

double hci_peak_refine(const hci_peak_function *f, double width, double *x)
{
    const double finest = FINEST * width;
    double most = f->at(f->context, *x);
    for (int k = 0; k < MOST_PARABOLAS && width > finest; ++k) {
        const double shift = top_of(f->at(f->context, *x - width), most, f->at(f->context, *x + width));
        const double there = f->at(f->context, *x + shift * width);
        if (there > most) {
            *x += shift * width;
            most = there;
        }
        if (fabs(shift) < BETWEEN || there < most) width *= CLOSER;
    }
    return most;
}
