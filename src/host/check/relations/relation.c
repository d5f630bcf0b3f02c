#include "host/check/relations/relation.h"

#include <math.h>
#include <string.h>

#include "hci/math/dense.h"

/* Magnets of another day are within 3.5 %, which is half of the variance of 5 %; warm ferrite, a batch of
 * weak ones or some that have lost flux are a fifth weaker, cold ones an eighth stronger: once in fifty
 * machines, wherever in this range. */
#define MAGNETS_USUAL   0.035
#define MAGNETS_WEAK    0.72
#define MAGNETS_STRONG  1.15
#define MAGNETS_UNUSUAL 4.0

const check_value HCI_CHECK_NONE = {NAN, 1.0, 0.0};

check_value hci_check_found(double found)
{
    return (check_value){found, 1.0, 0.0};
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
    return (check_value){x->cross / x->square, sqrt(1.0 + x->unknown / (x->square * x->square)), 0.0};
}

void hci_check_effects_add(check_effects_fit *fit, double y, double x, const double z[], double sigma)
{
    double row[CHECK_UNKNOWNS] = {x};
    const double weight = 1.0 / (sigma * sigma);
    for (int k = 1; k < CHECK_UNKNOWNS; ++k)
        row[k] = z[k - 1];
    for (int k = 0; k < CHECK_UNKNOWNS; ++k) {
        for (int j = 0; j < CHECK_UNKNOWNS; ++j)
            fit->matrix[k * CHECK_UNKNOWNS + j] += weight * row[k] * row[j];
        fit->right[k] += weight * row[k] * y;
    }
    ++fit->recordings;
}

/* A + 1, the 1 for the effects alone; an effect that is left out has no other. */
static void matrix_of(const check_effects_fit *fit, const bool left_out[], double *matrix)
{
    for (int k = 0; k < CHECK_UNKNOWNS; ++k)
        for (int j = 0; j < CHECK_UNKNOWNS; ++j)
            matrix[k * CHECK_UNKNOWNS + j] =
                (left_out[k] || left_out[j] ? 0.0 : fit->matrix[k * CHECK_UNKNOWNS + j]) + (k == j && k > 0);
}

/* Of the standard deviation of an effect. */
#define ROUNDING 1e-6

/* The effects for which the factor is 1, b[0] being none of them, without those that are left out. False:
 * they are not told. */
static bool beside_one(const check_effects_fit *fit, const bool left_out[], double b[])
{
    bool without[CHECK_UNKNOWNS] = {true};
    double matrix[CHECK_UNKNOWNS * CHECK_UNKNOWNS];
    b[0] = 0.0;
    for (int k = 1; k < CHECK_UNKNOWNS; ++k) {
        without[k] = left_out[k];
        b[k] = left_out[k] ? 0.0 : fit->right[k] - fit->matrix[k * CHECK_UNKNOWNS];
    }
    matrix_of(fit, without, matrix);
    matrix[0] = 1.0;
    if (hci_cholesky_factor(CHECK_UNKNOWNS, matrix)) return false;
    hci_cholesky_solve(CHECK_UNKNOWNS, matrix, b);
    return true;
}

/* Which of the one-sided effects would have to be negative for the factor to be 1. */
static void leave_out(const check_effects_fit *fit, bool left_out[])
{
    double b[CHECK_UNKNOWNS];
    if (!beside_one(fit, left_out, b)) return;
    for (int k = 1; k <= CHECK_ONE_SIDED; ++k)
        left_out[k] = b[k] < -ROUNDING;
}

bool hci_check_effects_beside_one(const check_effects_fit *fit, double b[])
{
    bool left_out[CHECK_UNKNOWNS] = {false};
    double all[CHECK_UNKNOWNS];
    if (fit->recordings == 0) return false;
    leave_out(fit, left_out);
    if (!beside_one(fit, left_out, all)) return false;
    for (int k = 0; k < CHECK_MOST_EFFECTS; ++k)
        b[k] = all[k + 1];
    return true;
}

/* (A + 1)⁻¹ b by Cholesky; the variance of the factor stands at the first place of the inverse. */
check_value hci_check_effects_value(const check_effects_fit *fit, double tolerance)
{
    double matrix[CHECK_UNKNOWNS * CHECK_UNKNOWNS], x[CHECK_UNKNOWNS], unit[CHECK_UNKNOWNS] = {1.0};
    bool left_out[CHECK_UNKNOWNS] = {false};
    if (fit->recordings == 0) return HCI_CHECK_NONE;
    leave_out(fit, left_out);
    matrix_of(fit, left_out, matrix);
    for (int k = 0; k < CHECK_UNKNOWNS; ++k)
        x[k] = left_out[k] ? 0.0 : fit->right[k];
    if (!(matrix[0] > 0.0) || hci_cholesky_factor(CHECK_UNKNOWNS, matrix)) return hci_check_found(0.0);
    hci_cholesky_solve(CHECK_UNKNOWNS, matrix, x);
    hci_cholesky_solve(CHECK_UNKNOWNS, matrix, unit);
    return (check_value){x[0], hypot(1.0, sqrt(unit[0]) / tolerance), 0.0};
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
    if (r->kind == CHECK_HIGH) distance *= found < 1.0 ? 2.0 : 1.0 / 3.0;
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

/* A Gaussian of the deviation on a floor: −ln(e^{−z²/2 − cost}/spread + e^{−cap}). */
double hci_check_loss(const check_relation *r, check_value x)
{
    const double z = hci_check_deviation(r, x);
    return -log(exp(-0.5 * z * z - x.cost) / x.spread + exp(-r->cap));
}

/* What is left of the tolerance of 5 %. */
#define BESIDE_MAGNETS 0.7

double hci_check_loss_beside_magnets(const check_relation *r, check_value x, double share)
{
    check_relation beside = *r;
    beside.tolerance *= BESIDE_MAGNETS;
    return hci_check_loss(
        &beside,
        (check_value){x.found / share,
                      hypot(1.0, sqrt(fmax(0.0, x.spread * x.spread - 1.0)) / BESIDE_MAGNETS), x.cost});
}

double hci_check_magnets_loss(double share)
{
    const double z = log(share) / MAGNETS_USUAL;
    const bool is_possible = share > MAGNETS_WEAK && share < MAGNETS_STRONG;
    return is_possible ? fmin(0.5 * z * z, MAGNETS_UNUSUAL) : HUGE_VAL;
}
