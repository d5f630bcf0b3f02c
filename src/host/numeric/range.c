#include "host/numeric/range.h"

void hci_range_include(hci_range *r, double value)
{
    if (!isfinite(value)) return;
    r->low = fmin(r->low, value);
    r->high = fmax(r->high, value);
}
