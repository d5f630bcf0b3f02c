#include "host/check/own_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/data/dead_torque.h"
#include "host/check/data/ripple_shift.h"
#include "host/check/relations/relations.h"

/* A torque falls short of k_t |i| by the cosine of the angle of the current, beside so much of other causes.
 */
#define BESIDE 0.04

/* By torques alone: a salient machine is turned by up to 45 degrees for the most torque. */
#define SALIENT_rad (HCI_PI / 4.0)
#define VOLTAGE_rad 0.25

/* Of the largest current: in less, friction is much of the torque, unless turns without current tell it. */
#define LOADED      0.3
#define LOADED_TOLD 0.1

typedef struct {
    const check_run *run; /* NULL: none */
    double zero_rad, error_rad;
    double salient_rad; /* to be added where nothing else says that the zero is another one */
} run_zero;

typedef struct {
    const check_data *data;
    const check_interpretation *as;
    const check_model *model;
    double drag_Nm; /* of friction, which stands against the motion */
    double loaded;  /* of the largest current */
    double most_A, most_Nm_per_A;
} run_zeros;

static double way_of(const run_zeros *z, const check_run *r)
{
    const double speed = hci_check_or_zero(hci_check_speed_of(r, z->as, z->model));
    return (speed > 0.0) - (speed < 0.0);
}

/* By recordings without current, forward and back: the zero of the sensor is in both. */
static double drag_of(const run_zeros *z)
{
    double torque_Nm[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
    for (size_t k = 0; k < z->data->runs; ++k) {
        const check_run *r = &z->data->run[k];
        const double way = way_of(z, r);
        if (!r->has_torque || hci_check_has_current(z->data, r) || !(fabs(way) > 0.0)) continue;
        torque_Nm[way < 0.0] += r->torque_mean * z->as->torque;
        count[way < 0.0] += 1.0;
    }
    return count[0] * count[1] > 0.0 ? 0.5 * (torque_Nm[1] / count[1] - torque_Nm[0] / count[0]) : 0.0;
}

static double torque_per_ampere(const run_zeros *z, const check_run *r)
{
    const double i_A = hci_check_length(hci_check_current_of(r, z->as, z->model));
    const bool is_of_use = r->has_abc && r->has_torque && r->theta &&
                           hci_check_has_vector_current(z->data, r) && i_A > z->loaded * z->most_A;
    return is_of_use ? (r->torque_mean * z->as->torque + way_of(z, r) * z->drag_Nm) / i_A : (double)NAN;
}

static bool by_voltage(const run_zeros *z, const check_run *r, run_zero *out)
{
    check_emf emf;
    if (!r->has_phase_voltage || !r->theta || !hci_check_has_emf(z->data, r, z->model)) return false;
    hci_check_emf_of(z->data, r, z->as, z->model, &emf);
    const check_vector turn = hci_check_product(emf.found, hci_check_conjugate(emf.expected));
    *out = (run_zero){r, atan2(turn.im, turn.re), VOLTAGE_rad + emf.unknown, 0.0};
    return hci_check_length(turn) > 0.0;
}

/* The torque says how far from q the current flows at most, in the true frame: so far the angle in the
 * recorded one is that of the zero. */
static bool by_torque(const run_zeros *z, const check_run *r, run_zero *out)
{
    const double per_A = torque_per_ampere(z, r), share = fabs(per_A) / z->most_Nm_per_A - BESIDE;
    if (isnan(per_A) || !hci_check_torque_stands_out(r)) return false;
    const check_vector i = hci_check_current_of(r, z->as, z->model), q = {0.0, per_A > 0.0 ? 1.0 : -1.0},
                       turn = hci_check_product(i, hci_check_conjugate(q));
    *out = (run_zero){r, atan2(turn.im, turn.re), acos(fmax(0.0, share)), 0.5 * SALIENT_rad};
    return share > 0.0;
}

static run_zero zero_of(const run_zeros *z, const check_run *r)
{
    run_zero zero = {NULL, 0.0, 0.0, 0.0};
    const bool is_told = by_voltage(z, r, &zero) || by_torque(z, r, &zero);
    if (!is_told) zero.run = NULL;
    return zero;
}

static void scale_zeros(run_zeros *z)
{
    z->drag_Nm = drag_of(z);
    z->loaded = fabs(z->drag_Nm) > 0.0 && z->data->torque_zero_is_told ? LOADED_TOLD : LOADED;
    for (size_t k = 0; k < z->data->runs; ++k)
        z->most_A =
            fmax(z->most_A, hci_check_length(hci_check_current_of(&z->data->run[k], z->as, z->model)));
    for (size_t k = 0; k < z->data->runs; ++k) /* of NAN and a number the number */
        z->most_Nm_per_A = fmax(z->most_Nm_per_A, fabs(torque_per_ampere(z, &z->data->run[k])));
}

/* ---- by the ripple, which belongs to the machine */

/* Ripples that are one another's at a shift, and as they stand not. */
#define ALIKE     0.9
#define UNLIKE    0.7 /* of turns without load, whose ripple is the same, … */
#define NOT_ALIKE 0.9 /* … and of those under load, where the orders of the currents are left */

/* Of a mechanical turn, what no restart is needed for, and what a torque sensor that reads late makes of two
 * speeds. */
#define LEAST_SHIFT_rad 0.05
#define LATE_s          0.02

static double speed_of(const run_zeros *z, const check_run *r)
{
    return hci_check_or_zero(hci_check_speed_of(r, z->as, z->model));
}

/* The ripple of a torque without current, or of the current that balances it. */
static bool is_without_load(const run_zeros *z, const check_run *r)
{
    return r->is_held || r->turns_steadily || (r->has_torque && !hci_check_has_current(z->data, r));
}

/* False where a late sensor, or the direction, may make the shift. */
static bool is_shifted(const run_zeros *z, check_run *a, check_run *b, int leave, double unlike,
                       check_ripple_shift *shift)
{
    const double apart = speed_of(z, a) - speed_of(z, b);
    if (strcmp(a->path, b->path) == 0 || a->has_torque != b->has_torque || way_of(z, a) * way_of(z, b) < 0.0)
        return false;
    *shift = hci_check_ripple_shift(a, b, leave);
    return shift->at_best > ALIKE && shift->at_zero < unlike &&
           fabs(shift->shift_rad) > (leave > 0 ? 0.0 : LEAST_SHIFT_rad) + LATE_s * fabs(apart);
}

/* Electrical, by which the place of a ripple is off. */
#define PLACE_rad 0.35

/* Whether the ripple lies as far on as the zeros do: one order alone, such as that of an eccentric rotor,
 * which goes with the load, fits at any place. */
static bool is_as_far(const run_zero *a, const run_zero *b, const check_ripple_shift *shift,
                      double pole_pairs)
{
    const double apart = fabs(remainder(a->zero_rad - b->zero_rad, 2.0 * HCI_PI));
    const double on = fabs(remainder(pole_pairs * shift->shift_rad, 2.0 * HCI_PI));
    return !shift->is_unique || fabs(on - apart) < PLACE_rad + a->error_rad + b->error_rad;
}

/* Whether orders that no current makes lie elsewhere in the turn. What a torque makes of them, one the other
 * way makes with the other sign, which looks like a place half a period on. */
static bool lie_elsewhere(const run_zeros *z, const run_zero *a, const run_zero *b)
{
    check_ripple_shift shift;
    check_run *run = z->data->run;
    const double pole_pairs = z->data->value[CHECK_pole_pairs];
    if (torque_per_ampere(z, a->run) * torque_per_ampere(z, b->run) < 0.0) return false;
    return is_shifted(z, &run[a->run - run], &run[b->run - run], (int)pole_pairs, NOT_ALIKE, &shift) &&
           is_as_far(a, b, &shift, pole_pairs);
}

/* Half a turn is a sign as well, and a third the columns of other phases. */
static const char *instead(double degrees)
{
    return fabs(degrees - 180.0) < 20.0   ? ", or the sign of its currents or torque"
           : fabs(degrees - 120.0) < 20.0 ? ", or other phases in its columns"
                                          : "";
}

/* ", and so that in n others": of those that tell their zero, nearer to b than to a. */
static void say_others(const run_zeros *z, const run_zero *a, const run_zero *b, char text[64])
{
    const char *path = "";
    size_t count = 0;
    for (size_t k = 0; k < z->data->runs; ++k) {
        const check_run *r = &z->data->run[k];
        const run_zero at = zero_of(z, r);
        if (!at.run || strcmp(r->path, path) == 0 || strcmp(r->path, a->run->path) == 0 ||
            strcmp(r->path, b->run->path) == 0)
            continue;
        path = r->path;
        count += fabs(remainder(at.zero_rad - b->zero_rad, 2.0 * HCI_PI)) <
                 fabs(remainder(at.zero_rad - a->zero_rad, 2.0 * HCI_PI));
    }
    text[0] = '\0';
    if (count > 0) snprintf(text, 64, ", and so is that in %zu other%s", count, count > 1 ? "s" : "");
}

static hci_check_finding moved_finding(const check_run *b)
{
    hci_check_finding f = hci_check_finding_at(
        "angle_zero_moved", &b->theta_cell, "voltages of the open machine in each recording, with its angle");
    snprintf(f.should_be, sizeof f.should_be,
             "an angle that is counted on through all recordings; give those of one zero alone");
    return f;
}

static void say_moved(const run_zeros *z, const run_zero *a, const run_zero *b, hci_check *check)
{
    const double degrees = fabs(remainder(a->zero_rad - b->zero_rad, 2.0 * HCI_PI)) * 180.0 / HCI_PI;
    hci_check_finding f = moved_finding(b->run);
    char others[64];
    say_others(z, a, b, others);
    snprintf(f.words, sizeof f.words,
             "the electrical zero of the angle in %.32s is some %.0f degrees from that in %.32s, as after a "
             "restart of the encoder%.40s%.39s",
             hci_check_name_of(b->run->path), degrees, hci_check_name_of(a->run->path), instead(degrees),
             others);
    hci_check_put_first(check, &f);
}

static void say_shifted(const check_run *a, const check_run *b, const check_ripple_shift *shift,
                        hci_check *check)
{
    hci_check_finding f = moved_finding(b);
    char by[64] = "";
    if (shift->is_unique)
        snprintf(by, sizeof by, ", some %.0f degrees of a turn on", fabs(shift->shift_rad) * 180.0 / HCI_PI);
    snprintf(
        f.words, sizeof f.words,
        "the ripple in %.32s is that in %.32s, but at other places of the turn%.40s: the zero of the angle "
        "has moved between them, as after a restart of the encoder",
        hci_check_name_of(b->path), hci_check_name_of(a->path), by);
    hci_check_put_first(check, &f);
}

static double beyond_errors(const run_zeros *z, const run_zero *a, const run_zero *b)
{
    const double beyond =
        fabs(remainder(a->zero_rad - b->zero_rad, 2.0 * HCI_PI)) - a->error_rad - b->error_rad;
    const double salient = a->salient_rad + b->salient_rad;
    return beyond > 0.0 && beyond <= salient && lie_elsewhere(z, a, b) ? beyond : beyond - salient;
}

/* What a current that is read late, or behind a filter, turns by at the largest speed. */
#define MOST_LATE_rad 1.0

enum { LATE_STEPS = 20 };

/* Whether all zeros are one within their errors, but for what is late by so much at the largest speed. */
static bool are_one(const run_zeros *z, double late_rad, double most_speed)
{
    for (size_t k = 0; k < z->data->runs; ++k)
        for (size_t j = 0; j < k; ++j) {
            const run_zero a = zero_of(z, &z->data->run[j]), b = zero_of(z, &z->data->run[k]);
            if (!a.run || !b.run) continue;
            const double late = late_rad * (speed_of(z, a.run) - speed_of(z, b.run)) / most_speed;
            const double apart = fabs(remainder(a.zero_rad - b.zero_rad - late, 2.0 * HCI_PI));
            if (apart > a.error_rad + b.error_rad + a.salient_rad + b.salient_rad) return false;
        }
    return true;
}

/* Whether zeros that are apart turn with the speed, as no restart of an encoder makes them. */
static bool turn_with_speed(const run_zeros *z)
{
    double most = 0.0;
    for (size_t k = 0; k < z->data->runs; ++k)
        most = fmax(most, fabs(speed_of(z, &z->data->run[k])));
    for (int k = -LATE_STEPS; most > 0.0 && k <= LATE_STEPS; ++k)
        if (are_one(z, MOST_LATE_rad * k / LATE_STEPS, most)) return true;
    return false;
}

/* The two that are furthest apart. */
static bool find_moved(const run_zeros *z, hci_check *check)
{
    double most = 0.0;
    run_zero first = {NULL, 0.0, 0.0, 0.0}, second = first;
    for (size_t k = 0; k < z->data->runs; ++k)
        for (size_t j = 0; j < k; ++j) {
            const run_zero a = zero_of(z, &z->data->run[j]), b = zero_of(z, &z->data->run[k]);
            if (!a.run || !b.run || strcmp(a.run->path, b.run->path) == 0) continue;
            const double beyond = beyond_errors(z, &a, &b);
            if (!(beyond > most)) continue;
            most = beyond;
            first = a, second = b;
        }
    if (!first.run) return false;
    if (!lie_elsewhere(z, &first, &second) && turn_with_speed(z)) return false;
    check->findings = 0; /* of one zero for all */
    say_moved(z, &first, &second, check);
    return true;
}

static void find_shifted(const run_zeros *z, hci_check *check)
{
    check_run *run = z->data->run;
    check_ripple_shift shift;
    for (size_t k = 0; k < z->data->runs; ++k)
        for (size_t j = 0; j < k; ++j) {
            if (!is_without_load(z, &run[j]) || !is_without_load(z, &run[k]) ||
                !is_shifted(z, &run[j], &run[k], 0, UNLIKE, &shift))
                continue;
            check->findings = 0;
            say_shifted(&run[j], &run[k], &shift, check);
            return;
        }
}

void hci_check_add_moved(const check_posterior *p, hci_check *check)
{
    const check_interpretation as = hci_check_interpretation_of(p->data, &p->list[p->best]);
    const check_model model = hci_check_model_of(p->data, &as);
    run_zeros z = {.data = p->data, .as = &as, .model = &model};
    scale_zeros(&z);
    if (!find_moved(&z, check)) find_shifted(&z, check);
}
