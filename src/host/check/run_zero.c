#include "host/check/run_zero.h"

#include <math.h>

#include "host/check/relations.h"

/* Of the torque of a recording, beside what its currents make by the magnets: friction, iron, reluctance. */
#define TORQUE_UNKNOWN 0.04

/* Below this share of the largest the smaller half-axis of what the currents tell is none. */
#define LEAST_AXIS 0.15

/* ---- by the voltages */

/* What does not turn with the rotor is noise and harmonics, of each sample its own. */
static double noise_rad(const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_frame *frame = hci_check_frame_of(r, hci_check_scale_of(r, as, m));
    double most = 0.0;
    for (int way = CHECK_FORWARD; frame && way <= CHECK_BACKWARD; ++way)
        most = fmax(most, hci_check_length(frame->voltage[way]));
    const double rest = fmax(0.0, r->voltage_square - most * most);
    return most > 0.0 ? sqrt(0.5 * rest / (double)r->count) / most : HUGE_VAL;
}

static check_run_zero by_voltage(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_vector sum = {0.0, 0.0};
    check_run_zero zero = {.is_known = false};
    double weights = 0.0, square = 0.0;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        check_emf emf;
        if (!r->has_phase_voltage || !r->theta || !hci_check_has_emf(data, r, m)) continue;
        zero.is_known = true;
        hci_check_emf_of(data, r, as, m, &emf);
        const check_vector turn = hci_check_product(emf.found, hci_check_conjugate(emf.expected));
        const double own = hypot(noise_rad(r, as, m), emf.unknown), weight = 1.0 / (own * own + 1e-12);
        if (!(hci_check_length(turn) > 0.0) || !isfinite(weight)) continue;
        sum = hci_check_sum(sum, hci_check_scaled(turn, weight / hci_check_length(turn)));
        weights += weight, square += weight * weight;
    }
    const double length = weights > 0.0 ? hci_check_length(sum) / weights : 0.0;
    const double scatter = sqrt(fmax(0.0, 2.0 * (1.0 - length))) * sqrt(square) / fmax(weights, 1e-300);
    zero.zero_rad = weights > 0.0 ? atan2(sum.im, sum.re) : 0.0;
    zero.std_error_rad = weights > 0.0 ? hypot(1.0 / sqrt(weights), scatter) : HCI_PI;
    return zero;
}

/* ---- by the torque */

/* Normal equations of T = 3/2 |e| (Re(i e*) cos z + Im(i e*) sin z) / |e|. */
typedef struct {
    double cc, cs, ss, c, s;
    size_t count;
} torque_fit;

static void torque_add(torque_fit *x, const check_data *data, const check_run *r,
                       const check_interpretation *as, const check_model *m)
{
    if (!r->has_abc || !r->has_torque || !r->theta || !hci_check_has_vector_current(data, r)) return;
    const check_vector i = hci_check_current_of(r, as, m), e = hci_check_emf_expected(1.0, m);
    const check_vector p = hci_check_scaled(hci_check_product(i, hci_check_conjugate(e)), 1.5);
    const double y = r->torque_mean * as->torque, length = hci_check_length(p);
    if (!(length > 0.0)) return;
    const double weight = 1.0 / (length * length);
    x->cc += weight * p.re * p.re, x->cs += weight * p.re * p.im, x->ss += weight * p.im * p.im;
    x->c += weight * p.re * y, x->s += weight * p.im * y;
    ++x->count;
}

static check_run_zero by_torque(const check_data *data, const check_interpretation *as, const check_model *m)
{
    torque_fit x = {0};
    check_run_zero zero = {.is_known = false};
    for (size_t k = 0; k < data->runs; ++k)
        torque_add(&x, data, &data->run[k], as, m);
    const double half = 0.5 * (x.cc + x.ss), apart = hypot(0.5 * (x.cc - x.ss), x.cs);
    const double determinant = x.cc * x.ss - x.cs * x.cs;
    if (x.count < 2 || !(half - apart > LEAST_AXIS * (half + apart)) || !(determinant > 0.0)) return zero;
    const double c = (x.c * x.ss - x.s * x.cs) / determinant, s = (x.s * x.cc - x.c * x.cs) / determinant;
    zero.is_known = true;
    zero.zero_rad = atan2(s, c);
    zero.std_error_rad = TORQUE_UNKNOWN / sqrt(half - apart);
    return zero;
}

check_run_zero hci_check_run_zero(const check_data *data, const check_interpretation *as)
{
    check_interpretation at_zero = *as;
    at_zero.run_zero_rad = 0.0;
    const check_model m = hci_check_model_of(data, &at_zero);
    const check_run_zero zero = by_voltage(data, &at_zero, &m);
    return zero.is_known ? zero : by_torque(data, &at_zero, &m);
}

void hci_check_take_run_zero(const check_data *data, check_interpretation *as)
{
    if (as->run_zero_free > 0.0) as->run_zero_rad = hci_check_run_zero(data, as).zero_rad;
}
