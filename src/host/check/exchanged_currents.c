#include "host/check/own_parts.h"

#include <math.h>
#include <stdio.h>

#include "host/check/data/dead_torque.h"
#include "host/check/relations/relations.h"

/* i_q of that i_d, at most, of currents that lie along i_d. */
#define ALONG_D 0.1

/* Times, by which a torque is off that which a current makes, at most. */
#define SUCH 1.5

/* The torque is such as this current would make as i_q. */
static bool makes_it(const check_run *r, double constant_Nm_per_A, double current_A)
{
    const double as_q_Nm = fabs(constant_Nm_per_A * current_A), found_Nm = fabs(r->torque_mean);
    return found_Nm < SUCH * as_q_Nm && as_q_Nm < SUCH * found_Nm;
}

/* The torque of a load is that which i_d would make as i_q, and i_q makes none of it. */
static bool makes_it_as_q(const check_run *r, double constant_Nm_per_A)
{
    return fabs(r->dq.im) < ALONG_D * fabs(r->dq.re) && makes_it(r, constant_Nm_per_A, r->dq.re);
}

/* The first of the loads on a torque sensor, where all of them are so; NULL: they are not. */
static const check_run *load_along_d(const check_data *data)
{
    const check_interpretation as = hci_check_as_declared();
    const double constant = 1.5 * hci_check_model_of(data, &as).emf_Nm_per_A;
    const check_run *first = NULL;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!hci_check_torque_is_measured(r) || !hci_check_has_current(data, r)) continue;
        if (!r->has_dq || !makes_it_as_q(r, constant)) return NULL;
        if (!first) first = r;
    }
    return first;
}

static const check_run *slow_turn_along_d(const check_data *data)
{
    for (size_t k = 0; k < data->runs; ++k)
        if (data->run[k].currents_are_exchanged) return &data->run[k];
    return NULL;
}

void hci_check_add_exchanged_currents(const check_data *data, hci_check *check)
{
    const check_run *turn = slow_turn_along_d(data), *r = turn ? turn : load_along_d(data);
    if (!r || !r->d_cell.path) return;
    hci_check_finding f = hci_check_finding_at("currents_dq_exchanged", &r->current_cell,
                                               turn ? "which current turns round with the motion"
                                                    : "the torque of each current");
    snprintf(
        f.words, sizeof f.words,
        "%s %s goes with i_d (%.40s), and next to nothing is in i_q (%.40s), which alone makes a torque: "
        "each is in the other's place, or the angle of the drive is a quarter of an electrical turn off",
        turn ? "what overcomes friction in" : "the torque in", hci_check_name_of(r->path), r->d_cell.column,
        r->current_cell.column);
    snprintf(f.should_be, sizeof f.should_be, "--column 'iq=%.40s' --column 'id=%.40s'", r->d_cell.column,
             r->current_cell.column);
    check->findings = 0; /* of a current that is another one */
    hci_check_put_first(check, &f);
}

/* Of what a torque varies by, its mean: of currents that do not turn with the rotor the mean over a turn is
 * 0. */
#define ONE_SIGN 3.0

/* Zeros of sensors beside friction stand as well: their torque is another one, or other currents turn. */
static const check_run *standing_run(const check_data *data)
{
    const check_interpretation as = hci_check_as_declared();
    const double constant = 1.5 * hci_check_model_of(data, &as).emf_Nm_per_A;
    const check_run *first = NULL;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!r->has_abc || !hci_check_has_current(data, r)) continue;
        if (r->standing_phase < 0) return NULL;
        const bool is_one_sign = fabs(r->torque_mean) > ONE_SIGN * sqrt(r->torque_variance);
        if (!first && hci_check_torque_is_measured(r) && is_one_sign && makes_it(r, constant, r->standing_A))
            first = r;
    }
    return first;
}

void hci_check_add_standing_currents(const check_data *data, hci_check *check)
{
    const check_run *r = standing_run(data);
    if (!r || !r->phase_cell[r->standing_phase].path) return;
    const check_place *q = &r->phase_cell[r->standing_phase],
                      *d = &r->phase_cell[r->standing_phase == 0 ? 1 : 0];
    hci_check_finding f =
        hci_check_finding_at("currents_of_rotor_frame", q, "how the currents turn with the angle");
    snprintf(f.words, sizeof f.words,
             "the phase currents in %s stand while the rotor turns, and so does its torque, whose mean would "
             "then be "
             "0: they are i_d and i_q, or another current",
             hci_check_name_of(r->path));
    if (d->path)
        snprintf(f.should_be, sizeof f.should_be, "--column 'iq=%.40s' --column 'id=%.40s'", q->column,
                 d->column);
    else
        snprintf(f.should_be, sizeof f.should_be, "--column 'iq=%.40s'", q->column);
    check->findings = 0; /* of currents that are none of a phase */
    hci_check_put_first(check, &f);
}
