#include "host/diagnose/fit/unlike_iron.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "host/recording/rotor_frame.h"

#define MOST 0.25 /* of the square that turns its sign, that angles read a little wrong leave as it is */

#define ALONG_Q 0.2  /* i_d beside i_q, up to which a current is one along q */
#define RISE    0.03 /* of the torque per ampere: up to 2 % is cross-saturation as of data/fem_c */

/* A torque at i_d, i_q in two parts: what turns its sign with i_q and what does not. */
typedef struct {
    double turns_Nm, keeps_Nm;
} parts;

static bool is_of_mean(const hci_candidate *x)
{
    return x->in && x->type->propose_coenergy && x->count == 1 && x->term[0].order == 0.0;
}

/* The mean torque of a term. */
static double torque_Nm(const hci_machine *machine, const hci_candidate *x, double reference_A, double d,
                        double q)
{
    hci_effect_term term[2] = {x->term[0]};
    const hci_effect effect = {x->type, term, 2};
    const hci_effects list = {&effect, 1};
    hci_sample truth = {0};
    for (size_t k = 0; k < x->type->parameter_count; ++k)
        if (x->type->parameter[k].traits & HCI_PARAMETER_REFERENCE_CURRENT)
            term[1] = (hci_effect_term){k, 0.0, reference_A, NAN};
    hci_phases_of_dq((hci_dq){d, q, 0.0}, 0.0, truth.i_abc);
    return hci_effects_torque(machine, &list, &truth, NULL).torque_Nm;
}

static parts parts_of(const hci_regression *e, const hci_candidates *c, size_t k, size_t run)
{
    const hci_run_statistics *x = &e->samples->statistics[run];
    const double d = x->mean_id_A, q = x->mean_iq_A;
    const double there = torque_Nm(e->machine, &c->candidate[k], c->reference_current_A, d, q);
    const double back = torque_Nm(e->machine, &c->candidate[k], c->reference_current_A, d, -q);
    return (parts){0.5 * (there - back), 0.5 * (there + back)};
}

/* Squares over the runs of what one candidate, or all of them, make. */
static parts squares_of(const hci_regression *e, const hci_candidates *c, size_t first, size_t end)
{
    parts square = {0.0, 0.0};
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        parts sum = {0.0, 0.0};
        for (size_t k = first; k < end && e->use[r]; ++k) {
            if (!is_of_mean(&c->candidate[k])) continue;
            const parts one = parts_of(e, c, k, r);
            sum.turns_Nm += one.turns_Nm;
            sum.keeps_Nm += one.keeps_Nm;
        }
        square.turns_Nm += sum.turns_Nm * sum.turns_Nm;
        square.keeps_Nm += sum.keeps_Nm * sum.keeps_Nm;
    }
    return square;
}

/* Whether a run in use is of direct current, whose mean is no current that flowed. */
static bool any_is_direct(const hci_regression *e)
{
    for (size_t r = 0; r < e->samples->run_count; ++r)
        if (e->use[r] && e->samples->statistics[r].is_direct) return true;
    return false;
}

bool hci_mirror_is_broken(const hci_regression *e, const hci_candidates *candidates, size_t k)
{
    if (e->machine->slope_count > 0 || !is_of_mean(&candidates->candidate[k])) return false;
    const parts own = squares_of(e, candidates, k, k + 1);
    if (!(own.keeps_Nm > own.turns_Nm)) return false;
    const parts all = squares_of(e, candidates, 0, candidates->count);
    return all.keeps_Nm > (any_is_direct(e) ? 1.0 : MOST) * all.turns_Nm;
}

/* ---- more torque per ampere ---- */

/* The run in use with the largest mean current along q; the number of runs: none has one. */
static size_t largest_along_q(const hci_regression *e)
{
    size_t largest = e->samples->run_count;
    double most_A = 0.0;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *x = &e->samples->statistics[r];
        const double q_A = fabs(x->mean_iq_A);
        if (!e->use[r] || x->is_direct || fabs(x->mean_id_A) > ALONG_Q * q_A || q_A <= most_A) continue;
        most_A = q_A;
        largest = r;
    }
    return largest;
}

static bool is_of_powers(const hci_candidate *x)
{
    return is_of_mean(x) && x->type->beyond_quadratic;
}

bool hci_iron_would_rise(const hci_regression *e, const hci_candidates *candidates, size_t k)
{
    const size_t run = largest_along_q(e);
    double more_Nm = 0.0;
    if (!(e->declared_constant > 0.0) || run == e->samples->run_count ||
        !is_of_powers(&candidates->candidate[k]))
        return false;
    for (size_t c = 0; c < candidates->count; ++c)
        if (is_of_powers(&candidates->candidate[c])) more_Nm += parts_of(e, candidates, c, run).turns_Nm;
    const double iq_A = e->samples->statistics[run].mean_iq_A;
    return copysign(1.0, iq_A) * more_Nm > RISE * e->declared_constant * fabs(iq_A);
}
