#include "host/recording/rotor_frame.h"

#include <math.h>

#include "hci/math/harmonic.h"

hci_dq hci_run_dq(const hci_run *run, int pole_pairs, size_t k)
{
    const double theta_m_rad = run->theta_m_rad ? run->theta_m_rad[k] : 0.0;
    return hci_park(hci_clarke(run->i_A + 3 * k), pole_pairs * theta_m_rad);
}

hci_dq hci_sample_dq(const hci_sample *sample, int pole_pairs)
{
    return hci_park(hci_clarke(sample->i_abc), pole_pairs * sample->theta_m_rad);
}

void hci_phases_of_dq(hci_dq x, double theta_e_rad, double abc[3])
{
    hci_clarke_inverse(hci_park_inverse(x, theta_e_rad), abc);
}

/* ---- one line ---- */

#define ACROSS 0.25 /* of the mean square along it, that offsets of sensors and noise may make */

bool hci_run_currents_in_line(const hci_run *run, double *angle_rad)
{
    double dd = 0.0, dq = 0.0, qq = 0.0;
    for (size_t k = 0; k < run->count && run->theta_m_rad; ++k) {
        const hci_dq i = hci_run_dq(run, run->pole_pairs, k);
        dd += i.d * i.d, dq += i.d * i.q, qq += i.q * i.q;
    }
    const double half = 0.5 * (dd + qq), spread = hypot(0.5 * (dd - qq), dq);
    *angle_rad = -0.5 * atan2(2.0 * dq, qq - dd);
    return half > 0.0 && half - spread < ACROSS * (half + spread);
}

/* ---- how often they go round ---- */

#define STEADY_SHARE 0.2  /* of the mean length of the current, rms about it */
#define FAR_RAD      2.0  /* of a step of the current: from one row to the next */
#define FAR_SHARE    0.02 /* of the rows, that may be further */
#define OF_A_TURN    0.03 /* by which a number of times is whole */

static bool is_steady(const hci_run *run)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const hci_alpha_beta i = hci_clarke(run->i_A + 3 * k);
        sum += hypot(i.alpha, i.beta) / (double)run->count;
        square += (i.alpha * i.alpha + i.beta * i.beta) / (double)run->count;
    }
    return sum > 0.0 && square - sum * sum < STEADY_SHARE * STEADY_SHARE * sum * sum;
}

bool hci_run_currents_go_otherwise(const hci_run *run, double *turns)
{
    double way_rad = 0.0, turned_rad = 0.0;
    size_t far = 0;
    if (!run->i_A || !run->theta_m_rad || !run->turn_known || run->is_electrical || run->count < 2)
        return false;
    if (!(run->has_sum || run->computed_phase > 0) || !is_steady(run)) return false;
    for (size_t k = 1; k < run->count; ++k) {
        const hci_alpha_beta a = hci_clarke(run->i_A + 3 * (k - 1)), b = hci_clarke(run->i_A + 3 * k);
        const double step_rad =
            atan2(a.alpha * b.beta - a.beta * b.alpha, a.alpha * b.alpha + a.beta * b.beta);
        const double moved_rad = run->theta_m_rad[k] - run->theta_m_rad[k - 1];
        far += fabs(step_rad) > FAR_RAD;
        turned_rad += moved_rad < 0.0 ? -step_rad : step_rad;
        way_rad += fabs(moved_rad);
    }
    *turns = way_rad > HCI_PI ? turned_rad / way_rad : (double)run->pole_pairs;
    const double whole = round(*turns);
    return (double)far < FAR_SHARE * (double)run->count && fabs(*turns - whole) < OF_A_TURN * fabs(whole) &&
           fabs(whole) >= 1.0 && fabs(fabs(whole) - run->pole_pairs) > 0.5;
}

/* ---- crests ---- */

#define ALIKE 1e-6 /* of the extreme value: the same number, turned to phases and back */
#define NEAR  0.05 /* of it: the values beside its crests, where it is not rounded more coarsely */
#define SHARE 0.01 /* of the samples */
#define HALF  0.5  /* of them: more is a current that is constant */
#define TIMES 5.0  /* as often as all values near it together; a coarse sine has 2.4 at most */

enum { PHASES = 3, LEAST = 200 };

/* i_a, i_b, i_c, i_q */
static double value_of(const hci_run *run, int which, size_t k)
{
    return which < PHASES ? run->i_A[PHASES * k + (size_t)which] : hci_run_dq(run, run->pole_pairs, k).q;
}

/* Of the crests of one sign. */
static bool is_cut(const hci_run *run, int which, double sign, hci_run_crests *crests)
{
    double most_A = 0.0, at = 0.0, near = 0.0;
    for (size_t k = 0; k < run->count; ++k)
        most_A = fmax(most_A, sign * value_of(run, which, k));
    for (size_t k = 0; k < run->count && most_A > 0.0; ++k) {
        const double below = 1.0 - sign * value_of(run, which, k) / most_A;
        at += below < ALIKE;
        near += below >= ALIKE && below < NEAR;
    }
    *crests = (hci_run_crests){sign * most_A, (size_t)at, which == PHASES};
    return at > SHARE * (double)run->count && at < HALF * (double)run->count && at > TIMES * near &&
           near > 0.0;
}

bool hci_run_is_clipped(const hci_run *run, hci_run_crests *crests)
{
    if (!run->i_A || !run->theta_m_rad || run->count < LEAST) return false;
    for (int which = 0; which <= PHASES; ++which)
        if (is_cut(run, which, 1.0, crests) || is_cut(run, which, -1.0, crests)) return true;
    return false;
}
