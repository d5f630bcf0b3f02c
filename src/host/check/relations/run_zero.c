#include "host/check/relations/run_zero.h"

#include <math.h>

#include "hci/math/dense.h"
#include "host/check/relations/drive_zero.h"
#include "host/check/relations/relations.h"

/* Of the torque of a recording, beside what its currents make by the magnets: iron, and what else. */
#define TORQUE_UNKNOWN 0.04

/* Of the torque at the largest current: friction, and the zero of the sensor, where runs without current have
 * told it and where they have not. */
#define FRICTION_UNKNOWN 0.05
#define OFFSET_TOLD      0.01
#define OFFSET_UNKNOWN   0.03

/* Below this share of the largest the smaller half-axis of what the currents tell is none, … */
#define LEAST_AXIS 0.005

/* … and a zero that is known no better than so is not. */
#define MOST_ERROR_RAD 0.25

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

/* L_d - L_q is not told by the tables: times the largest current, of the magnets' flux; and where it is, as
 * saturation leaves it. */
#define RELUCTANCE_UNKNOWN 0.3
#define RELUCTANCE_KNOWN   0.25
#define RELUCTANCE_LEAST   0.05

enum { COSINE, SINE, RELUCTANCE, FRICTION, OFFSET, UNKNOWNS };

/* Normal equations of T = Re(p) cos z + Im(p) sin z + reluctance - friction + the sensor's zero, p = 3/2 i
 * e*, each run by its own size. p is as the recording has it, turned by `from`. */
typedef struct {
    double from_rad, most; /* most: the largest |p| */
    double gram[UNKNOWNS * UNKNOWNS], moment[UNKNOWNS];
    double expected, unknown; /* of the reluctance, as its torque at the largest current over that of p */
    double offset_unknown;
    size_t count;
} torque_fit;

static void torque_add(torque_fit *x, const check_run *r, const check_interpretation *as,
                       const check_model *m)
{
    const check_vector read = hci_check_mutual_of(r, as, m), p = hci_check_turned(read, -x->from_rad);
    const double speed = hci_check_or_zero(hci_check_speed_of(r, as, m)), way = (speed > 0.0) - (speed < 0.0);
    const double column[UNKNOWNS] = {p.re, p.im, -p.re * p.im / x->most, -way * x->most, x->most};
    const double y = r->torque_mean * as->torque, length = hci_check_length(p);
    if (!(length > 0.0)) return;
    const double weight = 1.0 / (length * length);
    for (int k = 0; k < UNKNOWNS; ++k) {
        x->moment[k] += weight * column[k] * y;
        for (int j = 0; j < UNKNOWNS; ++j)
            x->gram[k + j * UNKNOWNS] += weight * column[k] * column[j];
    }
    ++x->count;
}

static torque_fit torque_fit_of(const check_data *data, const check_interpretation *as, const check_model *m,
                                double from_rad)
{
    torque_fit x = {.from_rad = from_rad,
                    .offset_unknown = data->torque_zero_is_told ? OFFSET_TOLD : OFFSET_UNKNOWN};
    const double k_Nm_per_A = 1.5 * hci_check_length(hci_check_emf_expected(1.0, m));
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_tells_torque(data, &data->run[k]))
            x.most = fmax(x.most, hci_check_length(hci_check_mutual_of(&data->run[k], as, m)));
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_tells_torque(data, &data->run[k])) torque_add(&x, &data->run[k], as, m);
    const bool is_known = !isnan(m->reluctance_Nm_per_A2);
    x.expected = is_known ? m->reluctance_Nm_per_A2 * x.most / (k_Nm_per_A * k_Nm_per_A) : 0.0;
    x.unknown = is_known ? RELUCTANCE_LEAST + RELUCTANCE_KNOWN * fabs(x.expected) : RELUCTANCE_UNKNOWN;
    return x;
}

/* Whether currents at several angles tell the cosine and the sine. */
static bool tells_zero(const torque_fit *x)
{
    const double cc = x->gram[COSINE], ss = x->gram[SINE + SINE * UNKNOWNS], cs = x->gram[SINE];
    const double half = 0.5 * (cc + ss), apart = hypot(0.5 * (cc - ss), cs);
    return x->count >= 2 && half - apart > LEAST_AXIS * (half + apart);
}

/* Of what is expected within so much, in the measure of the rows. */
static double precision_of(double unknown)
{
    return TORQUE_UNKNOWN * TORQUE_UNKNOWN / (unknown * unknown);
}

/* The reluctance is as uncertain as it is expected, and the zero with it as far as the runs do not tell them
 * apart. */
static check_run_zero solved(torque_fit *x)
{
    const double precision = precision_of(x->unknown);
    double sine[UNKNOWNS] = {[SINE] = 1.0};
    x->gram[RELUCTANCE + RELUCTANCE * UNKNOWNS] += precision;
    x->gram[FRICTION + FRICTION * UNKNOWNS] += precision_of(FRICTION_UNKNOWN);
    x->gram[OFFSET + OFFSET * UNKNOWNS] += precision_of(x->offset_unknown);
    x->moment[RELUCTANCE] += precision * x->expected;
    if (hci_cholesky_factor(UNKNOWNS, x->gram)) return (check_run_zero){.is_known = false};
    hci_cholesky_solve(UNKNOWNS, x->gram, x->moment);
    hci_cholesky_solve(UNKNOWNS, x->gram, sine);
    return (check_run_zero){true, x->from_rad + atan2(x->moment[SINE], x->moment[COSINE]),
                            TORQUE_UNKNOWN * sqrt(sine[SINE]), false};
}

/* Currents along d and q are those of the zero that is looked for. */
static check_run_zero by_torque(const check_data *data, const check_interpretation *as, const check_model *m)
{
    enum { PASSES = 4 };
    torque_fit x = torque_fit_of(data, as, m, 0.0);
    check_run_zero zero = {.is_known = false};
    if (!tells_zero(&x)) return zero;
    zero.zero_rad = atan2(x.moment[SINE] * x.gram[COSINE] - x.moment[COSINE] * x.gram[SINE],
                          x.moment[COSINE] * x.gram[SINE + SINE * UNKNOWNS] - x.moment[SINE] * x.gram[SINE]);
    for (int pass = 0; pass < PASSES; ++pass) {
        x = torque_fit_of(data, as, m, zero.zero_rad);
        zero = solved(&x);
        if (!zero.is_known) return zero;
    }
    zero.zero_rad = remainder(zero.zero_rad, 2.0 * HCI_PI);
    zero.is_known = zero.std_error_rad < MOST_ERROR_RAD;
    return zero;
}

/* ---- by what a drive wants */

static check_run_zero by_drive(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const check_drive_zero at = hci_check_drive_zero(data, as, m);
    return (check_run_zero){at.is_told, at.is_told ? at.zero_rad : 0.0,
                            at.is_told ? CHECK_DRIVE_ZERO_TOLERANCE : HCI_PI, at.is_told};
}

/* ---- whether a saliency does as well */

/* Standard deviations of what may stand beside the declared torque of the magnets, of the largest. A saliency
 * of twice the magnets' torque is that of a motor with weak magnets, and few have an L_d above L_q;
 * saturation takes a tenth of their flux, and half of a saliency as large as they. */
#define MAGNETS_UNKNOWN    0.1
#define SALIENCY_UNKNOWN   2.0
#define SALIENCY_ABOVE     0.3
#define SAGGING_FLUX       0.1
#define SAGGING_RELUCTANCE 0.5

/* Twice the standard error: by so much of χ² a zero has to explain more. */
#define TOLD 4.0

/* A quarter of a turn, by degrees. */
#define MOST_STEPS 90

enum { FREE_MAGNETS, FREE_RELUCTANCE, FREE_FRICTION, FREE_OFFSET, FLUX_SAGS, RELUCTANCE_SAGS, FREE_UNKNOWNS };

/* Normal equations of the torques at one zero, in the measure of their standard deviations. */
typedef struct {
    double zero_rad, most_Nm; /* most_Nm: the largest 3/2 |i e| */
    double gram[FREE_UNKNOWNS * FREE_UNKNOWNS], moment[FREE_UNKNOWNS], square;
} saliency_fit;

static void add_run(saliency_fit *x, const check_run *r, const check_interpretation *as, const check_model *m)
{
    const check_vector p = hci_check_turned(hci_check_mutual_of(r, as, m), -x->zero_rad);
    const double speed = hci_check_or_zero(hci_check_speed_of(r, as, m)), way = (speed > 0.0) - (speed < 0.0);
    const double length = hci_check_length(p), q = p.re / x->most_Nm, d = -p.im / x->most_Nm;
    const double column[FREE_UNKNOWNS] = {q, d * q, -way, 1.0, q * q * q, d * q * q * q};
    if (!(length > 0.0)) return;
    const double scale = x->most_Nm / (TORQUE_UNKNOWN * length), y = r->torque_mean * as->torque / x->most_Nm;
    x->square += scale * scale * y * y;
    for (int k = 0; k < FREE_UNKNOWNS; ++k) {
        x->moment[k] += scale * scale * column[k] * y;
        for (int j = 0; j < FREE_UNKNOWNS; ++j)
            x->gram[k + j * FREE_UNKNOWNS] += scale * scale * column[k] * column[j];
    }
}

static void expect(saliency_fit *x, int k, double value, double unknown)
{
    const double precision = 1.0 / (unknown * unknown);
    x->gram[k + k * FREE_UNKNOWNS] += precision;
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
    expect(&x, FREE_MAGNETS, 1.0, MAGNETS_UNKNOWN);
    expect(&x, FREE_FRICTION, 0.0, FRICTION_UNKNOWN);
    expect(&x, FREE_OFFSET, 0.0, data->torque_zero_is_told ? OFFSET_TOLD : OFFSET_UNKNOWN);
    expect(&x, FLUX_SAGS, 0.0, SAGGING_FLUX);
    expect(&x, RELUCTANCE_SAGS, 0.0, SAGGING_RELUCTANCE);
    return x;
}

/* χ² of what is left, infinite where it is not told; reluctance: out. */
static double left_of(saliency_fit x, double expected, double unknown, double *reluctance)
{
    double moment[FREE_UNKNOWNS];
    expect(&x, FREE_RELUCTANCE, expected, unknown);
    for (int k = 0; k < FREE_UNKNOWNS; ++k)
        moment[k] = x.moment[k];
    *reluctance = expected;
    if (!(x.most_Nm > 0.0) || hci_cholesky_factor(FREE_UNKNOWNS, x.gram)) return HUGE_VAL;
    hci_cholesky_solve(FREE_UNKNOWNS, x.gram, x.moment);
    for (int k = 0; k < FREE_UNKNOWNS; ++k)
        x.square -= moment[k] * x.moment[k];
    *reluctance = x.moment[FREE_RELUCTANCE];
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
    const double left = left_of(x, declared, SALIENCY_UNKNOWN, &reluctance);
    return reluctance > fmax(0.0, declared) ? left_of(x, fmax(0.0, declared), SALIENCY_ABOVE, &reluctance)
                                            : left;
}

check_run_zero hci_check_run_zero(const check_data *data, const check_interpretation *as)
{
    check_interpretation at_zero = *as;
    at_zero.run_zero_rad = 0.0;
    const check_model m = hci_check_model_of(data, &at_zero);
    check_run_zero zero = by_voltage(data, &at_zero, &m);
    if (!zero.is_known) zero = by_torque(data, &at_zero, &m);
    return zero.is_known ? zero : by_drive(data, &at_zero, &m);
}

void hci_check_take_run_zero(const check_data *data, check_interpretation *as)
{
    if (as->run_zero_free > 0.0) as->run_zero_rad = hci_check_run_zero(data, as).zero_rad;
}

/* Nats: of drives that turn a shaft at one angle of the current one in five weakens its field or uses a
 * saliency, by up to as much i_d as i_q, and one in thirty has an i_d of another kind. */
#define WEAKENED      1.5
#define SELDOM_BESIDE 3.5

/* Whether i_d is negative throughout, and no larger than i_q. */
static bool weakens_field(const check_data *data, const check_interpretation *as, const check_model *m)
{
    bool weakens = true;
    for (size_t k = 0; k < data->runs; ++k) {
        if (!hci_check_tells_torque(data, &data->run[k])) continue;
        const check_vector p = hci_check_mutual_of(&data->run[k], as, m);
        weakens = weakens && p.im > 0.0 && p.im < fabs(p.re);
    }
    return weakens;
}

double hci_check_beside_q_loss(const check_data *data, const check_interpretation *as)
{
    const check_run_zero zero = hci_check_run_zero(data, as);
    const check_model m = hci_check_model_of(data, as);
    const double beside = remainder(zero.zero_rad - as->run_zero_rad, HCI_PI) / CHECK_DRIVE_ZERO_TOLERANCE,
                 most = weakens_field(data, as, &m) ? WEAKENED : SELDOM_BESIDE;
    return zero.is_of_drive ? fmin(0.5 * beside * beside, most) : 0.0;
}

static bool has_voltage(const check_data *data, const check_model *m)
{
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].has_phase_voltage && data->run[k].theta && hci_check_has_emf(data, &data->run[k], m))
            return true;
    return false;
}

/* How far from a zero χ² stays within 1 of what it is there, in steps of a degree one way. */
static double reach(const check_data *data, const check_interpretation *as, const check_model *m,
                    double zero_rad, double step_rad)
{
    const double least = left_at(data, as, m, zero_rad);
    int steps = 0;
    while (steps < MOST_STEPS && left_at(data, as, m, zero_rad + (steps + 1) * step_rad) < least + 1.0)
        ++steps;
    return steps * fabs(step_rad);
}

double hci_check_zero_error(const check_data *data, const check_interpretation *as, check_run_zero zero)
{
    check_interpretation at_zero = *as;
    at_zero.run_zero_rad = 0.0;
    const check_model m = hci_check_model_of(data, &at_zero);
    const double step_rad = HCI_PI / 180.0;
    if (!zero.is_known || has_voltage(data, &m)) return zero.std_error_rad;
    if (zero.is_of_drive) return hci_check_drive_zero(data, &at_zero, &m).reach_rad;
    return fmax(zero.std_error_rad, fmax(reach(data, &at_zero, &m, zero.zero_rad, step_rad),
                                         reach(data, &at_zero, &m, zero.zero_rad, -step_rad)));
}

bool hci_check_zero_is_told(const check_data *data, const check_interpretation *as, double zero_rad)
{
    check_interpretation at_zero = *as;
    at_zero.run_zero_rad = 0.0;
    const check_model m = hci_check_model_of(data, &at_zero);
    if (has_voltage(data, &m)) return true;
    const double as_it_is = left_at(data, &at_zero, &m, 0.0);
    return isfinite(as_it_is) && as_it_is - left_at(data, &at_zero, &m, zero_rad) > TOLD;
}
