/* What must hold for power and torque of the recordings under load. */
#include <math.h>

#include "host/check/relations/relations.h"
#include "host/recording/slow_turn.h"

#define SQRT3 1.7320508075688772

/* ---- effects that a machine folder may lack, one standard deviation each */

/* K i_d i_q where L_d and L_q are not declared: as much as the magnets make and half as much again, at i_d of
 * the largest current; where they are, saturation makes a quarter of it uncertain. */
#define RELUCTANCE_UNKNOWN 1.5
#define RELUCTANCE_KNOWN   0.25

/* A machine with weak magnets and iron that saturates: so much of a saliency that keeps, and of one that
 * sags. Where an i_d flows it is as likely as not, in nats. */
#define RELUCTANCE_STRONG 2.5
#define STRONG_COST       0.7

/* Friction, iron and windage by the torque that the rated current makes; without a rating by the most that is
 * recorded, which may be little. */
#define FRICTION_OF_RATED    0.03
#define FRICTION_OF_RECORDED 0.08

/* The iron yields with the square of the current: at the rated one, or at the most that is recorded. */
#define SATURATION_AT_RATED 0.025
#define SATURATION_AT_MOST  0.05

/* The zero of a torque sensor. */
#define ZERO_OF_RATED 0.01

/* What an inertia takes while the speed changes by itself. */
#define ACCELERATION 0.6

/* What is each recording's own. */
#define OWN 0.02

/* Copper gets warm, and leads and switches are in its circuit. */
#define COPPER_UNKNOWN 0.3

/* ---- */

/* Coulomb and viscous friction, where machine.csv has them. */
static double friction_Nm(const check_data *data, double speed)
{
    return hci_check_or_zero(data->value[CHECK_coulomb_friction_Nm]) +
           hci_check_or_zero(data->value[CHECK_viscous_friction_Nms_per_rad]) *
               fabs(hci_check_or_zero(speed));
}

/* The machine folder has a rated current, or not: then the largest of the recordings, in A. */
typedef struct {
    bool is_rated;
    double current_A, torque_Nm;
} check_reference;

static double length_A(const check_run *r, const check_interpretation *as)
{
    return sqrt(r->current_square) * fabs(as->current) * (r->has_dq ? as->dq : 1.0);
}

static check_reference reference_of(const check_data *data, const check_interpretation *as,
                                    const check_model *m)
{
    check_reference x = {.is_rated = m->rated_current_A > 0.0};
    for (size_t k = 0; k < data->runs && !x.is_rated; ++k)
        x.current_A = fmax(x.current_A, length_A(&data->run[k], as));
    if (x.is_rated) x.current_A = m->rated_current_A;
    x.torque_Nm = 1.5 * m->emf_Nm_per_A * x.current_A;
    return x;
}

/* Loss of torque by friction and by inertia, in N·m: what stands against the motion. */
static double friction_unknown_Nm(const check_data *data, const check_reference *x, double speed)
{
    const double usual = (x->is_rated ? FRICTION_OF_RATED : FRICTION_OF_RECORDED) * x->torque_Nm;
    return hypot(usual, friction_Nm(data, speed));
}

/* Of v_q alone it is whole where no i_d flows. */
static bool knows_power(const check_run *r)
{
    if (r->has_dq_voltage) return r->has_dq && (!r->lacks_d_voltage || r->lacks_d_current);
    return r->has_voltage && !hci_check_is_unbalanced(r->voltage_balance) && (r->has_abc || r->theta);
}

static bool has_power(const check_data *data, const check_run *r)
{
    return knows_power(r) && r->has_torque && hci_check_has_speed(r) && hci_check_has_vector_current(data, r);
}

static double shaft_power_W(const check_run *r, const check_interpretation *as, const check_model *m)
{
    return r->torque_at_speed * as->torque * hci_check_speed_of(r, as, m);
}

/* 3/2 i² */
static double square_A2(const check_run *r, const check_interpretation *as)
{
    const double dq = r->has_dq ? as->dq : 1.0;
    return 1.5 * r->current_square * as->current * as->current * dq * dq;
}

/* A resistance that is not given is what the recordings miss in their power, each as much as it has: least
 * squares of 3/2 R i² = v·i − T ω, relative to v·i. It is neither negative nor above the largest |v|/|i|.
 */
static double resistance_of(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const double line = as->voltage_is_line > 0.0 ? SQRT3 : 1.0;
    double cross = 0.0, square = 0.0, most = 0.0;
    if (!isnan(m->resistance_ohm)) return m->resistance_ohm;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!has_power(data, r)) continue;
        const double power = hci_check_power_of(r, as, m), share = square_A2(r, as) / power;
        cross += share * (power - shaft_power_W(r, as, m)) / power;
        square += share * share;
        most = fmax(most, sqrt(r->voltage_square / r->current_square) / line / fabs(as->current));
    }
    return square > 0.0 && isfinite(square) ? fmin(most, fmax(0.0, cross / square)) : 0.0;
}

/* The effects that take power between v·i and the shaft. */
static void power_add(check_effects_fit *x, const check_data *data, const check_run *r,
                      const check_interpretation *as, const check_model *m)
{
    const check_reference reference = reference_of(data, as, m);
    const double power = hci_check_power_of(r, as, m), speed = hci_check_speed_of(r, as, m),
                 copper = resistance_of(data, as, m) * square_A2(r, as), shaft = shaft_power_W(r, as, m);
    const double z[CHECK_MOST_EFFECTS] = {
        -friction_unknown_Nm(data, &reference, speed) * fabs(speed),
        -ACCELERATION * r->speed_change * fabs(power),
        -(r->has_dq_voltage ? CHECK_SWITCHES_UNKNOWN : COPPER_UNKNOWN) * copper,
        [CHECK_ONE_SIDED] = r->has_dq_voltage ? CHECK_COMMAND_UNKNOWN * power : 0.0,
    };
    hci_check_effects_add(x, shaft + copper, power, z, OWN * hypot(power, 0.3 * reference.torque_Nm * speed));
}

/* T ω_m + 3/2 R i² over v·i */
static check_value power_balance(const check_data *data, const check_interpretation *as, const check_model *m)
{
    check_effects_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k)
        if (has_power(data, &data->run[k])) power_add(&x, data, &data->run[k], as, m);
    return hci_check_effects_value(&x, CHECK_POWER_TOLERANCE);
}

/* K i_d i_q, 0 where K is not known. */
static double reluctance_Nm(const check_run *r, const check_interpretation *as, const check_model *m,
                            check_vector i)
{
    const double product =
        r->has_dq ? r->product_dq * as->current * as->current * as->dq * as->dq : i.re * i.im;
    return hci_check_or_zero(m->reluctance_Nm_per_A2) * product;
}

/* What is left of L_d - L_q where i_q saturates the iron: half at seven tenths of the largest current. */
static double sagging(double share_q)
{
    return 1.0 / (1.0 + 2.0 * share_q * share_q);
}

/* One recording: what the magnets and the declared saliency make of its current, and its i_d and i_q as
 * shares of the largest current. */
typedef struct {
    double mutual_Nm, reluctance_Nm, d, q;
} check_makes;

static check_makes makes_of(const check_run *r, const check_interpretation *as, const check_model *m,
                            const check_reference *reference)
{
    const check_vector i = hci_check_current_of(r, as, m), e = hci_check_emf_expected(1.0, m);
    return (check_makes){1.5 * hci_check_product(i, hci_check_conjugate(e)).re, reluctance_Nm(r, as, m, i),
                         i.re / reference->current_A, i.im / reference->current_A};
}

/* A saliency that is not declared. */
static double saliency_Nm(const check_makes *x, bool is_strong)
{
    return -(is_strong ? RELUCTANCE_STRONG : RELUCTANCE_UNKNOWN) * x->mutual_Nm * x->d;
}

/* T = 3/2 Re(e* i) + K i_d i_q, and what may come to it. */
static void torque_add(check_effects_fit *fit, const check_data *data, const check_run *r,
                       const check_interpretation *as, const check_model *m, bool is_strong)
{
    const bool is_known = !isnan(m->reluctance_Nm_per_A2);
    const check_reference reference = reference_of(data, as, m);
    const check_makes x = makes_of(r, as, m, &reference);
    const double share = length_A(r, as) / reference.current_A, model = x.mutual_Nm + x.reluctance_Nm;
    const double speed = hci_check_or_zero(hci_check_speed_of(r, as, m)), way = (speed > 0.0) - (speed < 0.0);
    const double saliency = is_known ? x.reluctance_Nm : saliency_Nm(&x, is_strong), left = sagging(x.q);
    const double z[CHECK_MOST_EFFECTS] = {
        is_known ? 0.0 : saliency,
        is_strong ? saliency * (is_known ? left - 1.0 : left) : 0.0,
        -way * friction_unknown_Nm(data, &reference, speed),
        -model * share * share * (reference.is_rated ? SATURATION_AT_RATED : SATURATION_AT_MOST),
        -ACCELERATION * r->speed_change * way * fabs(model),
        [CHECK_ONE_SIDED] = ZERO_OF_RATED * reference.torque_Nm,
        is_known ? RELUCTANCE_KNOWN * x.reluctance_Nm : 0.0,
    };
    hci_check_effects_add(fit, r->torque_mean * as->torque, model, z,
                          OWN * hypot(model, 0.3 * reference.torque_Nm));
}

static check_effects_fit torque_fit(const check_data *data, const check_interpretation *as,
                                    const check_model *m, bool is_strong)
{
    check_effects_fit x = {0};
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].has_torque && hci_check_has_vector_current(data, &data->run[k]))
            torque_add(&x, data, &data->run[k], as, m, is_strong);
    return x;
}

/* Of the usual saliency or of a strong one, whichever agrees better. */
static check_value torque_size(const check_data *data, const check_interpretation *as, const check_model *m)
{
    static const check_relation SIZE = {
        .kind = CHECK_FLUX, .expected = 1.0, .tolerance = CHECK_TORQUE_TOLERANCE, .cap = 9.0};
    const check_effects_fit usual_fit = torque_fit(data, as, m, false),
                            strong_fit = torque_fit(data, as, m, true);
    const check_value usual = hci_check_effects_value(&usual_fit, CHECK_TORQUE_TOLERANCE);
    check_value strong = hci_check_effects_value(&strong_fit, CHECK_TORQUE_TOLERANCE);
    strong.cost = STRONG_COST;
    return isnan(usual.found) || hci_check_loss(&SIZE, usual) <= hci_check_loss(&SIZE, strong) ? usual
                                                                                               : strong;
}

check_saliency hci_check_saliency(const check_data *data, const check_interpretation *as)
{
    const check_model m = hci_check_model_of(data, as);
    const check_reference reference = reference_of(data, as, &m);
    const check_effects_fit fit = torque_fit(data, as, &m, true);
    check_saliency found = {.left_open = CHECK_TORQUE_TOLERANCE *
                                         hci_check_effects_value(&fit, CHECK_TORQUE_TOLERANCE).spread};
    double b[CHECK_MOST_EFFECTS], magnets_Nm = 0.0, reluctance = 0.0, most_q = 0.0;
    if (!isnan(m.reluctance_Nm_per_A2) || !hci_check_effects_beside_one(&fit, b)) return found;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!r->has_torque || !hci_check_has_vector_current(data, r)) continue;
        const check_makes x = makes_of(r, as, &m, &reference);
        magnets_Nm = fmax(magnets_Nm, fabs(x.mutual_Nm));
        reluctance = fmax(reluctance, fabs((b[0] + b[1] * sagging(x.q)) * saliency_Nm(&x, true)));
        most_q = fmax(most_q, fabs(x.q));
    }
    const double unit_H = RELUCTANCE_STRONG * m.emf_Nm_per_A / m.pole_pairs / reference.current_A;
    found.share = magnets_Nm > 0.0 ? reluctance / magnets_Nm : 0.0;
    found.small_H = unit_H * (b[0] + b[1]);
    found.large_H = unit_H * (b[0] + b[1] * sagging(most_q));
    return found;
}

/* ---- how large the currents are */

/* That a shaft turned slowly without a load asks for: a small motor some tenths of one, a large one more. Of
 * what is rated, any recording. */
#define UNLOADED_A 6.0

static check_value current_size(const check_data *data, const check_interpretation *as, const check_model *m)
{
    const bool is_rated = m->rated_current_A > 0.0;
    double most = NAN;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double length = length_A(r, as) / (is_rated ? m->rated_current_A : UNLOADED_A);
        const bool is_slow =
            fabs(hci_check_speed_of(r, as, m)) < HCI_SLOW_TURN_RAD_PER_S && (r->is_held || !r->has_torque);
        if ((r->has_abc || r->has_dq) && (is_rated || is_slow)) most = fmax(most, length);
    }
    return hci_check_found(most);
}

/* ---- without a torque sensor */

/* Of the rms of the current: a friction that stands out from what cogging torque and a weight leave in means
 * of parts of a turn. */
#define STANDS_OUT 0.2

static bool is_of_friction(const check_data *data, const check_run *r)
{
    return !r->has_torque && !r->is_held && hci_check_has_speed(r) && hci_check_has_current(data, r) &&
           (r->has_dq || hci_check_has_vector_current(data, r));
}

/* i_q forward less that back, half: a weight is in both alike, and friction takes power, as a brake does. As
 * a share of what would be plain: 1, and -1 where friction would drive. */
static check_value friction_way(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double iq_A[2] = {0.0, 0.0}, square = 0.0, count[2] = {0.0, 0.0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double speed = is_of_friction(data, r) ? hci_check_speed_of(r, as, m) : 0.0,
                     n = (double)r->count;
        if (!(fabs(speed) > 0.0 && fabs(speed) < HCI_SLOW_TURN_RAD_PER_S)) continue;
        iq_A[speed < 0.0] += n * hci_check_current_of(r, as, m).im;
        square += n * length_A(r, as) * length_A(r, as);
        count[speed < 0.0] += n;
    }
    if (!(count[0] > 0.0 && count[1] > 0.0)) return HCI_CHECK_NONE;
    const double friction_A = 0.5 * (iq_A[0] / count[0] - iq_A[1] / count[1]);
    const double rms_A = sqrt(square / (count[0] + count[1]));
    return hci_check_found(fmax(-1.0, fmin(1.0, friction_A / (STANDS_OUT * rms_A))));
}

/* The sign with which i_q accelerates and overcomes friction, of every file without a torque: their mean. */
static check_value motion_way(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double way = 0.0, count = 0.0;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double speed = hci_check_speed_of(r, as, m);
        if (r->current_way == 0 || !is_of_friction(data, r) || !(fabs(r->speed * speed) > 0.0)) continue;
        const double turned = speed * r->speed < 0.0 ? -1.0 : 1.0;
        way += turned * (as->current * as->dq < 0.0 ? -1.0 : 1.0) * r->current_way;
        count += 1.0;
    }
    return count > 0.0 ? hci_check_found(way / count) : HCI_CHECK_NONE;
}

/* ---- a torque without current */

/* Of the rms about the mean of both directions: less is what the ends of the turns leave of a ripple. */
#define DRAG_OF_RIPPLE 0.2

/* Torque back less that forward, half: friction brakes a shaft that another machine turns, and the zero of
 * the sensor is in both alike. 1, and -1 where friction would drive. */
static check_value drag_way(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double torque_Nm[2] = {0.0, 0.0}, square = 0.0, count[2] = {0.0, 0.0};
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        const double speed = hci_check_speed_of(r, as, m), n = (double)r->count;
        if (!r->has_torque || hci_check_has_current(data, r) || !hci_check_has_speed(r)) continue;
        torque_Nm[speed < 0.0] += n * r->torque_mean * as->torque;
        square += n * r->torque_variance * as->torque * as->torque;
        count[speed < 0.0] += n;
    }
    if (!(count[0] > 0.0 && count[1] > 0.0)) return HCI_CHECK_NONE;
    const double drag_Nm = 0.5 * (torque_Nm[1] / count[1] - torque_Nm[0] / count[0]),
                 least_Nm = DRAG_OF_RIPPLE * sqrt(square / (count[0] + count[1]));
    return fabs(drag_Nm) > least_Nm ? hci_check_found(drag_Nm > 0.0 ? 1.0 : -1.0) : HCI_CHECK_NONE;
}

/* ---- the list */

static const check_relation LIST[] = {
    {"current_size",
     "largest rms current over the rated one, or where none is rated over 6 A, of a shaft turned slowly",
     CHECK_MOST, 5.0, 0.35, 9.0, current_size,
     "a recording of currents, and rated_current in machine.csv or a shaft turned slowly", ""},
    {"power_balance", "torque x speed and copper loss over v.i", CHECK_RATIO, 1.0, CHECK_POWER_TOLERANCE, 9.0,
     power_balance, "a recording of voltages, currents, torque and speed", ""},
    {"torque_size", "torque over 3/2 k_e i_q and the reluctance torque", CHECK_FLUX, 1.0,
     CHECK_TORQUE_TOLERANCE, 9.0, torque_size, "a recording of currents, angle and torque", ""},
    {"drag_way", "torque without current back less that forward, 1 where friction brakes", CHECK_SHARE, 1.0,
     0.4, 9.0, drag_way, "recordings of torque without current, turned forward and back by another machine",
     ""},
    {"friction_way", "i_q of a slow turn forward less that back, 1 where friction brakes", CHECK_SHARE, 1.0,
     0.4, 9.0, friction_way, "recordings of currents, slowly turned forward and back, without torque", ""},
    {"motion_way", "sign of i_q that accelerates the shaft and overcomes its friction", CHECK_SHARE, 1.0, 0.4,
     9.0, motion_way,
     "recordings of i_q, time and speed, forward and back or at several speeds, without torque",
     "friction_way"},
};
const check_relation_list HCI_CHECK_TORQUE_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
