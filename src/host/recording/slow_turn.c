#include "host/recording/slow_turn.h"

#include <math.h>

#include "hci/host/base/note.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"

#define NEGLIGIBLE 0.2   /* inertia × acceleration beside the torque of the current */
#define LOAD       4.0   /* times what the size of a current varies by */
#define WORTH_WORD 0.005 /* inertia × acceleration of which nothing need be said, in the same measure */

#define MOVED_RAD 0.1 /* that a shaft at rest does not turn by */

#define COMMON 0.02 /* share of the mean square that neighbours have in common, of a current that flows … */
#define CHANCE 3.0  /* … beyond what they have by chance, in standard deviations */

#define NEAR_RAD (2.0 * HCI_PI / 48.0) /* electrical: four samples in a period of order 12 */

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

/* Samples from where the shaft has begun to move to where it has not yet come to rest. */
typedef struct {
    size_t first, count;
} span;

static span moving_span(const hci_run *run)
{
    const double *x = run->theta_m_rad;
    size_t first = 0, end = run->count;
    while (first + 1 < end && fabs(x[first] - x[0]) < MOVED_RAD)
        ++first;
    while (end > first + 1 && fabs(x[end - 1] - x[run->count - 1]) < MOVED_RAD)
        --end;
    return end - first < LEAST ? (span){0, run->count} : (span){first, end - first};
}

/* Of a shaft that no current flows in: white, so that neighbours have nothing in common, while a current that
 * holds is much the same from one sample to the next, where these are near each other. */
static bool has_no_current(const hci_run *run, int pole_pairs)
{
    double common = 0.0, square = 0.0, way_rad = 0.0;
    for (size_t k = 1; k < run->count; ++k)
        way_rad += fabs(run->theta_m_rad[k] - run->theta_m_rad[k - 1]);
    if (way_rad * pole_pairs > NEAR_RAD * (double)run->count) return false;
    hci_dq before = hci_run_dq(run, pole_pairs, 0);
    for (size_t k = 1; k < run->count; ++k) {
        const hci_dq i = hci_run_dq(run, pole_pairs, k);
        common += i.d * before.d + i.q * before.q;
        square += i.d * i.d + i.q * i.q;
        before = i;
    }
    return common < (COMMON + CHANCE / sqrt(2.0 * (double)run->count)) * square;
}

bool hci_is_slow_turn(const hci_run *run, int pole_pairs, double inertia_kgm2,
                      double torque_constant_Nm_per_A)
{
    if (!(torque_constant_Nm_per_A > 0.0) || run->count < LEAST || run->theta_m_rad == NULL) return false;
    const double rms_Nm = rms_of_current(run, pole_pairs, torque_constant_Nm_per_A);
    const double mean_Nm = hci_mean(run->torque_Nm, run->count);
    const double accelerating_Nm = sqrt(hci_mean_square_about(run->torque_Nm, run->count, mean_Nm));
    const span moving = moving_span(run);
    const double energy_J =
        0.5 * inertia_kgm2 * hci_mean_square_about(run->speed_rad_per_s + moving.first, moving.count, 0.0);
    if (has_no_current(run, pole_pairs)) return false;
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
    if (has_no_current(run, pole_pairs)) return false;
    const span moving = moving_span(run);
    for (size_t k = 0; k < moving.count; ++k)
        pace += fabs(run->speed_rad_per_s[moving.first + k]) / (double)moving.count;
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

/* ---- the way of rows without time ---- */

#define SLOWLY_RAD_PER_S 0.1
#define REVERSALS        0.05 /* of the rows, at which a shaft may turn back */

enum { LEAST_ROWS = 16 };

/* −1, 0 or 1: how the angle goes from a row to the next. */
static int step_of(const hci_run *run, size_t k)
{
    const double step = run->theta_m_rad[k + 1] - run->theta_m_rad[k];
    return (step > 0.0) - (step < 0.0);
}

static size_t reversals_of(const hci_run *run)
{
    size_t reversals = 0;
    int before = 0;
    for (size_t k = 0; k + 1 < run->count; ++k) {
        const int step = step_of(run, k);
        reversals += step * before < 0;
        before = step ? step : before;
    }
    return reversals;
}

bool hci_row_direction_set(hci_run *run)
{
    if (run->time_s || run->speed_rad_per_s || !run->theta_m_rad || run->count < LEAST_ROWS) return true;
    if ((double)reversals_of(run) > REVERSALS * (double)run->count) return true;
    run->speed_rad_per_s = hci_memory_new(run->count, sizeof *run->speed_rad_per_s);
    if (!run->speed_rad_per_s) return false;
    for (size_t k = 0, before = 0; k < run->count; before = k++) {
        const int step = step_of(run, k + 1 < run->count ? k : k - 1);
        run->speed_rad_per_s[k] = step ? step * SLOWLY_RAD_PER_S : run->speed_rad_per_s[before];
    }
    hci_note_add(&run->remark,
                 "no time and no speed: the shaft turned slowly, the way the angle goes from row to row");
    return true;
}
