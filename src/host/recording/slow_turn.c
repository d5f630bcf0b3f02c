#include "host/recording/slow_turn.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define NEGLIGIBLE 0.2   /* inertia × acceleration beside the torque of the current */
#define LOAD       4.0   /* times what the size of a current varies by */
#define WORTH_WORD 0.005 /* inertia × acceleration of which nothing need be said, in the same measure */

enum { LEAST = 16 };

/* rms about the mean of torque_constant·i_q. */
static double rms_of_current(const hci_run *run, int pole_pairs, double constant)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        const double made = constant * hci_run_dq(run, pole_pairs, k).q;
        sum += made;
        square += made * made;
    }
    const double share = 1.0 / (double)run->count;
    return sqrt(fmax(0.0, share * square - share * sum * share * sum));
}

bool hci_is_slow_turn(const hci_run *run, int pole_pairs, double inertia_kgm2,
                      double torque_constant_Nm_per_A)
{
    if (!(torque_constant_Nm_per_A > 0.0) || run->count < LEAST || run->theta_m_rad == NULL) return false;
    const double rms_Nm = rms_of_current(run, pole_pairs, torque_constant_Nm_per_A);
    const double mean_Nm = hci_mean(run->torque_Nm, run->count);
    const double accelerating_Nm = sqrt(hci_mean_square_about(run->torque_Nm, run->count, mean_Nm));
    const double energy_J = 0.5 * inertia_kgm2 * hci_mean_square_about(run->speed_rad_per_s, run->count, 0.0);
    return accelerating_Nm < NEGLIGIBLE * rms_Nm && energy_J < rms_Nm / pole_pairs;
}

/* The longest ways up and down; noise of the angle is in neither. */
static void ways_of(const double *theta_m_rad, size_t count, double *up_rad, double *down_rad)
{
    double least = theta_m_rad[0], most = theta_m_rad[0];
    *up_rad = *down_rad = 0.0;
    for (size_t k = 0; k < count; ++k) {
        least = fmin(least, theta_m_rad[k]);
        most = fmax(most, theta_m_rad[k]);
        *up_rad = fmax(*up_rad, theta_m_rad[k] - least);
        *down_rad = fmax(*down_rad, most - theta_m_rad[k]);
    }
}

bool hci_is_slow(const hci_run *run, int pole_pairs)
{
    double pace = 0.0;
    if (run->theta_m_rad == NULL || run->time_s == NULL || run->speed_rad_per_s == NULL) return false;
    if (run->count < LEAST || !(rms_of_current(run, pole_pairs, 1.0) > 0.0)) return false;
    for (size_t k = 0; k < run->count; ++k)
        pace += fabs(run->speed_rad_per_s[k]) / (double)run->count;
    return pace < HCI_SLOW_TURN_RAD_PER_S;
}

bool hci_is_slow_turn_both_ways(const hci_run *run, int pole_pairs)
{
    double up_rad, down_rad;
    if (!hci_is_slow(run, pole_pairs)) return false;
    ways_of(run->theta_m_rad, run->count, &up_rad, &down_rad);
    return fmin(up_rad, down_rad) > HCI_PI / pole_pairs;
}

void hci_slow_turn_correct(hci_run *run, int pole_pairs, double torque_constant_Nm_per_A)
{
    const double made_Nm = rms_of_current(run, pole_pairs, torque_constant_Nm_per_A);
    const double rms_Nm = sqrt(hci_mean_square_about(run->torque_Nm, run->count, 0.0));
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq off = {.d = 0.0, .q = run->torque_Nm[k] / torque_constant_Nm_per_A};
        double phases_A[3];
        hci_phases_of_dq(off, pole_pairs * run->theta_m_rad[k], phases_A);
        for (size_t s = 0; s < 3; ++s)
            run->i_A[3 * k + s] -= phases_A[s];
    }
    run->inertia_share = made_Nm > 0.0 ? rms_Nm / made_Nm : 0.0;
    if (rms_Nm > WORTH_WORD * made_Nm)
        hci_note_add(&run->remark,
                     "inertia x acceleration, %.3g N·m rms, is taken out of the %.3g N·m that i_q makes",
                     rms_Nm, made_Nm);
}

bool hci_run_is_loaded(const hci_run *run, int pole_pairs)
{
    double size_A = 0.0, square = 0.0;
    if (run->count == 0 || !run->i_A || !run->theta_m_rad) return false;
    for (size_t k = 0; k < run->count; ++k) {
        const double iq_A = hci_run_dq(run, pole_pairs, k).q;
        size_A += fabs(iq_A) / (double)run->count;
        square += iq_A * iq_A / (double)run->count;
    }
    return size_A * size_A > LOAD * LOAD * (square - size_A * size_A);
}
