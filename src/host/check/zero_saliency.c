#include "host/check/zero_saliency.h"

#include <math.h>

#include "hci/math/dense.h"
#include "host/check/relations.h"
#include "host/check/run_zero.h"

/* Standard deviations: of the torque of a recording, of itself; of what may stand beside the declared torque
 * of the magnets, of the largest. A saliency of twice the magnets' torque is that of a motor with weak
 * magnets, and few have an L_d above L_q; saturation takes a tenth of their flux, and half of a saliency as
 * large as they. */
#define TORQUE_UNKNOWN     0.04
#define MAGNETS_UNKNOWN    0.1
#define RELUCTANCE_UNKNOWN 2.0
#define RELUCTANCE_ABOVE   0.3
#define FRICTION_UNKNOWN   0.05
#define OFFSET_TOLD        0.01
#define OFFSET_UNKNOWN     0.03
#define SAGGING_FLUX       0.1
#define SAGGING_RELUCTANCE 0.5

/* Twice the standard error: by so much of χ² a zero has to explain more. */
#define TOLD 4.0

enum { MAGNETS, RELUCTANCE, FRICTION, OFFSET, FLUX_SAGS, RELUCTANCE_SAGS, UNKNOWNS };

/* Normal equations of the torques at one zero, in the measure of their standard deviations. */
typedef struct {
    double zero_rad, most_Nm; /* most_Nm: the largest 3/2 |i e| */
    double gram[UNKNOWNS * UNKNOWNS], moment[UNKNOWNS], square;
} saliency_fit;

static void add_run(saliency_fit *x, const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_vector p = hci_check_turned(hci_check_mutual_of(r, as, m), -x->zero_rad);
    const double speed = hci_check_or_zero(hci_check_speed_of(r, as, m)), way = (speed > 0.0) - (speed < 0.0);
    const double length = hci_check_length(p), q = p.re / x->most_Nm, d = -p.im / x->most_Nm;
    const double column[UNKNOWNS] = {q, d * q, -way, 1.0, q * q * q, d * q * q * q};
    if (!(length > 0.0)) return;
    const double scale = x->most_Nm / (TORQUE_UNKNOWN * length), y = r->torque_mean * as->torque / x->most_Nm;
    x->square += scale * scale * y * y;
    for (int k = 0; k < UNKNOWNS; ++k) {
        x->moment[k] += scale * scale * column[k] * y;
        for (int j = 0; j < UNKNOWNS; ++j)
            x->gram[k + j * UNKNOWNS] += scale * scale * column[k] * column[j];
    }
}

static void expect(saliency_fit *x, int k, double value, double unknown)
{
    const double precision = 1.0 / (unknown * unknown);
    x->gram[k + k * UNKNOWNS] += precision;
    x->moment[k] += precision * value;
    x->square += precision * value * value;
}

/* The torques of all recordings, and what is expected but of the reluctance. */
static saliency_fit fit_of(const check_data *data, const check_interpretation *as, const check_model *m,
                           double zero_rad)
{
    saliency_fit x = {.zero_rad = zero_rad};
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_tells_torque(data, &data->run[k]))
            x.most_Nm = fmax(x.most_Nm, hci_check_length(hci_check_mutual_of(&data->run[k], as, m)));
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_tells_torque(data, &data->run[k])) add_run(&x, &data->run[k], as, m);
    expect(&x, MAGNETS, 1.0, MAGNETS_UNKNOWN);
    expect(&x, FRICTION, 0.0, FRICTION_UNKNOWN);
    expect(&x, OFFSET, 0.0, data->torque_zero_is_told ? OFFSET_TOLD : OFFSET_UNKNOWN);
    expect(&x, FLUX_SAGS, 0.0, SAGGING_FLUX);
    expect(&x, RELUCTANCE_SAGS, 0.0, SAGGING_RELUCTANCE);
    return x;
}

/* χ² of what is left, infinite where it is not told; reluctance: out. */
static double left_of(saliency_fit x, double expected, double unknown, double *reluctance)
{
    double moment[UNKNOWNS];
    expect(&x, RELUCTANCE, expected, unknown);
    for (int k = 0; k < UNKNOWNS; ++k)
        moment[k] = x.moment[k];
    *reluctance = expected;
    if (!(x.most_Nm > 0.0) || hci_cholesky_factor(UNKNOWNS, x.gram)) return HUGE_VAL;
    hci_cholesky_solve(UNKNOWNS, x.gram, x.moment);
    for (int k = 0; k < UNKNOWNS; ++k)
        x.square -= moment[k] * x.moment[k];
    *reluctance = x.moment[RELUCTANCE];
    return x.square;
}

/* At a zero, with the saliency that does best there. */
static double left_at(const check_data *data, const check_interpretation *as, const check_model *m,
                      double zero_rad)
{
    const saliency_fit x = fit_of(data, as, m, zero_rad);
    const double k_Nm_per_A = 1.5 * hci_check_length(hci_check_emf_expected(1.0, m));
    const double declared =
        hci_check_or_zero(m->reluctance_Nm_per_A2) * x.most_Nm / (k_Nm_per_A * k_Nm_per_A);
    double reluctance;
    const double left = left_of(x, declared, RELUCTANCE_UNKNOWN, &reluctance);
    return reluctance > fmax(0.0, declared) ? left_of(x, fmax(0.0, declared), RELUCTANCE_ABOVE, &reluctance)
                                            : left;
}

bool hci_check_zero_is_told(const check_data *data, const check_interpretation *as, double zero_rad)
{
    check_interpretation at_zero = *as;
    at_zero.run_zero_rad = 0.0;
    const check_model m = hci_check_model_of(data, &at_zero);
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].has_phase_voltage && data->run[k].theta &&
            hci_check_has_emf(data, &data->run[k], &m))
            return true;
    const double as_it_is = left_at(data, &at_zero, &m, 0.0);
    return isfinite(as_it_is) && as_it_is - left_at(data, &at_zero, &m, zero_rad) > TOLD;
}
