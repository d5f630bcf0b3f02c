#include "host/check/relation.h"

#include <math.h>

const check_value HCI_CHECK_NONE = {NAN, 1.0};

check_value hci_check_found(double found)
{
    return (check_value){found, 1.0};
}

check_value hci_check_ratio_of(double top, double bottom)
{
    return bottom > 0.0 ? hci_check_found(top / bottom) : HCI_CHECK_NONE;
}

double hci_check_or_zero(double x)
{
    return isnan(x) ? 0.0 : x;
}

void hci_check_fit_add(check_fit *x, double top, double bottom, double unknown)
{
    const double weight = bottom * bottom / (1.0 + unknown * unknown);
    if (!(weight > 0.0)) {
        x->other += top * top;
        return;
    }
    x->cross += weight * top / bottom;
    x->square += weight;
    x->unknown += weight * weight * unknown * unknown;
}

/* The usual tolerance is common to all recordings; what is unknown in each is its own. */
check_value hci_check_fit_value(const check_fit *x)
{
    if (!(x->square > 0.0)) return x->other > 0.0 ? hci_check_found(0.0) : HCI_CHECK_NONE;
    return (check_value){x->cross / x->square, sqrt(1.0 + x->unknown / (x->square * x->square))};
}

check_value hci_check_relation_value(const check_data *data, const check_relation *relation,
                                     const check_interpretation *as)
{
    const check_model model = hci_check_model_of(data, as);
    return relation->evaluate(data, as, &model);
}

/* Of a ratio: the tolerance is relative, by the logarithm; what is unknown adds to the denominator, and so
 * deviates by found − 1. The variances of both add. */
static double ratio_deviation(const check_relation *r, double found, double spread)
{
    const double unknown = r->tolerance * sqrt(fmax(0.0, spread * spread - 1.0));
    double distance = found > 0.0 ? fabs(log(found)) : HUGE_VAL;
    if (found < 1.0 && r->kind == CHECK_LOW) distance /= 1.5;
    if (found < 1.0 && r->kind == CHECK_HIGH) distance *= 2.0;
    const double known = distance / r->tolerance, beside = fabs(found - 1.0) / unknown;
    if (!(unknown > 0.0) || !(known > 0.0)) return known;
    return isinf(known) ? beside : known * beside / hypot(known, beside);
}

double hci_check_deviation(const check_relation *r, check_value x)
{
    const double relative = x.found / (r->expected > 0.0 ? r->expected : 1.0),
                 tolerance = r->tolerance * x.spread;
    if (isnan(x.found)) return HUGE_VAL;
    switch (r->kind) {
    case CHECK_ANGLE:
        return fabs(remainder(x.found - r->expected, 2.0 * HCI_PI)) / tolerance;
    case CHECK_SHARE:
        return fabs(x.found - r->expected) / tolerance;
    case CHECK_MOST:
        return relative > 1.0 ? log(relative) / tolerance : 0.0;
    default:
        return ratio_deviation(r, relative, x.spread);
    }
}

/* A Gaussian of the deviation on a floor: −ln(e^{−z²/2}/spread + e^{−cap}). */
double hci_check_loss(const check_relation *r, check_value x)
{
    const double z = hci_check_deviation(r, x);
    return -log(exp(-0.5 * z * z) / x.spread + exp(-r->cap));
}
