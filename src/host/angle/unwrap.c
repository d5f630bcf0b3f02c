#include "host/angle/unwrap.h"

#include <math.h>
#include <stdbool.h>

#include "hci/math/harmonic.h"
#include "host/numeric/statistics.h"

#define TURN (2.0 * HCI_PI)

/* A path may have one step in twenty that is longer than a third of a turn. */
enum { ODD_SHARE = 20 };

/* A step in time that is so many times the one before it is a gap. */
#define GAP 1.5

typedef struct {
    const double *time_s, *rate_rad_per_s;
    size_t odd, jumps;
    hci_unwrapping result;
} unwrapper;

/* Within half a turn; remainder() would be exact, and slow. */
static double shortest_of(double step)
{
    return fabs(step) <= 0.5 * TURN ? step : step - TURN * round(step / TURN);
}

static bool is_still(const double *rate, size_t n)
{
    for (size_t k = 0; k < n; ++k)
        if (fabs(rate[k]) > 0.0) return false;
    return true;
}

/* The step to sample k by the speed. */
static double expected_step(const unwrapper *u, size_t k)
{
    return 0.5 * (u->rate_rad_per_s[k - 1] + u->rate_rad_per_s[k]) * (u->time_s[k] - u->time_s[k - 1]);
}

/* Are samples missing before this one, as many as make the step uncertain? */
static bool is_gap(const unwrapper *u, size_t k)
{
    return u->time_s != NULL && k > 1 &&
           u->time_s[k] - u->time_s[k - 1] > GAP * (u->time_s[k - 1] - u->time_s[k - 2]);
}

/* The step across missing samples at the speed before them; step: the one before. */
static double step_over_gap(const unwrapper *u, size_t k, double step)
{
    return step * (u->time_s[k] - u->time_s[k - 1]) / (u->time_s[k - 1] - u->time_s[k - 2]);
}

/* The step to sample k of an angle that is kept within a turn: the shortest, or for a long one that which the
 * speed tells. */
static double step_within_turn(unwrapper *u, size_t k, double recorded, double before)
{
    const double shortest = shortest_of(recorded);
    if (u->rate_rad_per_s == NULL && is_gap(u, k)) {
        const double expected = step_over_gap(u, k, before);
        return fabs(expected) > TURN / 4.0 ? recorded + TURN * round((expected - recorded) / TURN) : shortest;
    }
    if (u->rate_rad_per_s == NULL) {
        u->odd += fabs(shortest) > TURN / 3.0;
        return shortest;
    }
    const double expected = expected_step(u, k);
    if (fabs(expected) <= TURN / 4.0 && fabs(shortest) <= TURN / 4.0) return shortest;
    const double step = recorded + TURN * round((expected - recorded) / TURN);
    u->odd += fabs(step - expected) > TURN / 4.0;
    u->result.predicted += fabs(step - shortest) > 1.0;
    return step;
}

/* Of an angle that is beyond a turn: as recorded, unless it jumps back by whole turns against its own way. */
static double step_beyond_turn(const unwrapper *u, size_t k, double recorded, double before)
{
    const double shortest = shortest_of(recorded);
    double expected = before;
    if (u->rate_rad_per_s != NULL) expected = expected_step(u, k);
    const bool back = recorded * expected < 0.0 && fabs(recorded) > 0.5 * TURN;
    return back && fabs(shortest - expected) < 0.1 * TURN ? shortest : recorded;
}

static void note_jump(unwrapper *u, double taken_out, bool gap)
{
    const double turns = fabs(taken_out) / TURN;
    if (turns < 0.5) return;
    u->jumps++;
    if (u->result.turns == 0 && !gap) u->result.turns = (size_t)(turns + 0.5);
}

/* Takes the turns out, or with write = false only counts. */
static void walk(unwrapper *u, double *angle, size_t n, bool within, bool write)
{
    double last = angle[0], turns = 0.0, before = n > 1 ? angle[1] - angle[0] : 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double recorded = angle[k] - last;
        const double step =
            within ? step_within_turn(u, k, recorded, before) : step_beyond_turn(u, k, recorded, before);
        note_jump(u, step - recorded, is_gap(u, k));
        turns += round((step - recorded) / TURN);
        last = angle[k];
        if (fabs(step) > 0.0 && !(within && is_gap(u, k))) before = step;
        if (write) angle[k] += TURN * turns;
    }
}

/* An angle within a turn may read a little more than one, of noise or of the scale of an analogue output,
 * which is off by a percent or two, where it jumps by one; a path that is a little longer does not. */
#define A_LITTLE 0.03
#define A_JUMP   0.9 /* turns */

static bool is_within_turn(const double *angle, size_t n)
{
    const double span = hci_peak_to_peak(angle, n);
    bool jumps = false;
    for (size_t k = 1; k < n && !jumps; ++k)
        jumps = fabs(angle[k] - angle[k - 1]) > A_JUMP * TURN;
    return span <= TURN * (1.0 + (jumps ? A_LITTLE : 1e-6));
}

static hci_angle_path path_of(const unwrapper *u, size_t n, bool within, bool separate)
{
    if (u->odd * ODD_SHARE > n) return separate ? HCI_ANGLE_SCATTERED : HCI_ANGLE_UNCLEAR;
    if (u->jumps > 0) return HCI_ANGLE_UNWRAPPED;
    return within ? HCI_ANGLE_WITHIN : HCI_ANGLE_WHOLE;
}

hci_unwrapping hci_unwrap(double *angle_rad, size_t n, const double *time_s, const double *rate_rad_per_s)
{
    const bool within = is_within_turn(angle_rad, n);
    const bool still = rate_rad_per_s != NULL && is_still(rate_rad_per_s, n);
    const bool has_rate = time_s != NULL && rate_rad_per_s != NULL && !still;
    unwrapper u = {.time_s = time_s, .rate_rad_per_s = has_rate ? rate_rad_per_s : NULL};
    walk(&u, angle_rad, n, within, false);
    u.result.path = path_of(&u, n, within, time_s == NULL || still);
    const hci_unwrapping result = u.result;
    if (result.path == HCI_ANGLE_UNWRAPPED) walk(&u, angle_rad, n, within, true);
    return result;
}
