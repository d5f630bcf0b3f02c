#include "host/check/relations/drive_zero.h"

#include <math.h>

#include "host/check/relations/relations.h"

/* Directions that are one: cos 2x of the mean, which is 4 degrees. */
#define ONE_DIRECTION 0.99

/* Of the magnets' torque at the largest current: what makes a drive want an i_d. */
#define SALIENT 0.1

/* Of the torque at the largest current: iron, friction and the zero of the sensor, beside the tolerance of
 * the back-EMF. */
#define BESIDE 0.05

/* Over the recordings, of p = 3/2 i e*: each by its own square. */
typedef struct {
    double square, most; /* Σ |p|², the largest |p| */
    check_vector twice;  /* Σ p² */
    check_vector torque; /* Σ T p */
    bool has_frame;      /* i_d and i_q of the drive, which no zero turns */
} directions;

static void add_run(directions *x, const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_vector p = hci_check_mutual_of(r, as, m);
    const double length = hci_check_length(p);
    x->square += length * length;
    x->most = fmax(x->most, length);
    x->twice = hci_check_sum(x->twice, hci_check_product(p, p));
    x->torque = hci_check_sum(x->torque, hci_check_scaled(p, r->torque_mean * as->torque));
    x->has_frame = x->has_frame || r->has_dq;
}

static bool is_salient(const check_model *m, double most_Nm)
{
    const double k_Nm_per_A = 1.5 * hci_check_length(hci_check_emf_expected(1.0, m));
    return fabs(hci_check_or_zero(m->reluctance_Nm_per_A2)) * most_Nm > SALIENT * k_Nm_per_A * k_Nm_per_A;
}

/* p lies at the zero that is looked for, or half a turn from it where its torque is the other way. */
static check_drive_zero zero_of(const directions *x)
{
    const double along = 0.5 * atan2(x->twice.im, x->twice.re),
                 torque = hci_check_turned(x->torque, -along).re / x->square,
                 unknown = hypot(CHECK_TORQUE_TOLERANCE, BESIDE);
    return (check_drive_zero){true, remainder(torque < 0.0 ? along + HCI_PI : along, 2.0 * HCI_PI),
                              acos(fmax(0.0, fmin(1.0, fabs(torque)) - unknown))};
}

check_drive_zero hci_check_drive_zero(const check_data *data, const check_interpretation *as,
                                      const check_model *m)
{
    check_interpretation at_zero = *as;
    directions x = {0.0, 0.0, {0.0, 0.0}, {0.0, 0.0}, false};
    at_zero.run_zero_rad = 0.0;
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_tells_torque(data, &data->run[k])) add_run(&x, &data->run[k], &at_zero, m);
    const bool is_one = x.square > 0.0 && hci_check_length(x.twice) > ONE_DIRECTION * x.square;
    return is_one && !x.has_frame && !is_salient(m, x.most) ? zero_of(&x)
                                                            : (check_drive_zero){false, 0.0, HCI_PI};
}
