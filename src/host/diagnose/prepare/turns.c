#include "host/diagnose/prepare/turns.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/recording/rotor_frame.h"

#define STEADY   0.02 /* change of current and speed within a mean, as a share of their largest */
#define SWINGS   0.02 /* change of current in a part of a turn, as a share of the largest of the run */
#define CHANCE   4.0  /* or of current, standard deviations of what its noise makes of two means */
#define STEADY_K 1.0  /* and of temperature, in kelvin */
#define STEEP    6.0  /* standard errors of a line along the turns, and … */
#define LIFT     0.2  /* … share of the scatter by which it rises or falls, that are no noise */
#define EVEN     0.5  /* change of speed within a turn of a free shaft, as a share of the largest */
#define NEARLY   0.02 /* of a turn: turning back by more ends a turn, falling short by less does not count */

enum { LEAST_OF_LINE = 6 /* turns */, OFTEN = 4 /* one in so many */ };

double hci_turn_rad(const hci_run *run, int pole_pairs)
{
    return 2.0 * HCI_PI * (run->turn_known ? 1.0 : 1.0 / pole_pairs);
}

double hci_turn_direction(const hci_run *r, size_t from, size_t to)
{
    return r->theta_m_rad[to] >= r->theta_m_rad[from] ? 1.0 : -1.0;
}

static double direction_of_turn(const hci_run *r, const hci_turn *x)
{
    return hci_turn_direction(r, x->first, x->first + x->count - 1);
}

static void part_add(const hci_dq *i, hci_turn_part *part)
{
    const double w = 1.0 / (part->count += 1.0);
    part->d += w * (i->d - part->d);
    part->q += w * (i->q - part->q);
}

/* last: in and out, the current of the sample before; anything at the first one. */
static void sample_add(const hci_run *r, int pole_pairs, size_t k, hci_dq *last, hci_turn *sum)
{
    const hci_dq i = hci_run_dq(r, pole_pairs, k), before = k > sum->first ? *last : i;
    const double turns = r->theta_m_rad[k] / hci_turn_rad(r, pole_pairs);
    part_add(&i, &sum->part[(size_t)((turns - floor(turns)) * HCI_TURN_PARTS) % HCI_TURN_PARTS]);
    sum->noise_A2 += 0.5 * ((i.d - before.d) * (i.d - before.d) + (i.q - before.q) * (i.q - before.q));
    sum->d += i.d;
    sum->q += i.q;
    const double speed = r->speed_rad_per_s ? r->speed_rad_per_s[k] : 0.0;
    sum->speed += speed;
    sum->least_speed = fmin(sum->least_speed, speed);
    sum->most_speed = fmax(sum->most_speed, speed);
    sum->temperature += r->temperature_C ? r->temperature_C[k] : 0.0;
    sum->torque += r->torque_Nm ? r->torque_Nm[k] : 0.0;
    *last = i;
}

/* The next turn from a sample on: until the angle has gone once round, or turns back. */
static hci_turn turn_from(const hci_run *run, int pole_pairs, size_t first)
{
    const double *theta = run->theta_m_rad, turn = hci_turn_rad(run, pole_pairs);
    hci_turn sum = {.first = first, .least_speed = INFINITY, .most_speed = -INFINITY};
    double farthest = 0.0;
    hci_dq last = {0.0, 0.0, 0.0};
    size_t k = first;
    for (; k < run->count; ++k) {
        const double gone = fabs(theta[k] - theta[first]);
        if (gone >= turn || gone < farthest - NEARLY * turn) break;
        farthest = fmax(farthest, gone);
        sample_add(run, pole_pairs, k, &last, &sum);
    }
    sum.count = k - first;
    sum.ends_run = k == run->count && farthest >= (1.0 - NEARLY) * turn;
    sum.whole = k < run->count && farthest >= (1.0 - NEARLY) * turn;
    sum.d /= (double)sum.count;
    sum.q /= (double)sum.count;
    sum.noise_A2 /= (double)sum.count;
    sum.speed /= (double)sum.count;
    sum.temperature /= (double)sum.count;
    sum.torque /= (double)sum.count;
    return sum;
}

static bool is_even(const hci_run *run, const hci_turn *x)
{
    const double most = fmax(fabs(x->most_speed), fabs(x->least_speed));
    return run->torque_source != HCI_TORQUE_INERTIA || x->most_speed - x->least_speed <= EVEN * most;
}

static bool are_currents_alike(const hci_run_statistics *statistics, const hci_turn *a, const hci_turn *b)
{
    const double by_chance_A = CHANCE * sqrt(a->noise_A2 / (double)a->count + b->noise_A2 / (double)b->count);
    return statistics->no_current ||
           hypot(a->d - b->d, a->q - b->q) <= fmax(STEADY * statistics->current_A, by_chance_A) + 1e-12;
}

bool hci_turns_alike(const hci_run *run, const hci_run_statistics *statistics, const hci_turn *a,
                     const hci_turn *b)
{
    const double most_speed = statistics->pace_rad_per_s;
    return a->whole && b->whole && is_even(run, a) && is_even(run, b) &&
           direction_of_turn(run, a) == direction_of_turn(run, b) && are_currents_alike(statistics, a, b) &&
           fabs(a->speed - b->speed) <= STEADY * most_speed + 1e-12 &&
           fabs(a->temperature - b->temperature) < STEADY_K;
}

/* Whether the current of each part is the same, but for noise. */
static bool are_parts_alike(const hci_run_statistics *statistics, const hci_turn *a, const hci_turn *b)
{
    for (size_t k = 0; k < HCI_TURN_PARTS; ++k) {
        const hci_turn_part *x = &a->part[k], *y = &b->part[k];
        if (!(x->count > 1.0 && y->count > 1.0)) continue;
        const double by_chance_A = CHANCE * sqrt(a->noise_A2 / x->count + b->noise_A2 / y->count);
        const double change_A = hypot(x->d - y->d, x->q - y->q);
        if (change_A > fmax(SWINGS * statistics->current_A, by_chance_A) + 1e-12) return false;
    }
    return true;
}

/* In a holding test the current is what is measured, and is not smoothed. */
bool hci_turns_swing(const hci_run *run, const hci_run_statistics *statistics, const hci_turn *turns,
                     size_t count)
{
    size_t asked = 0, swinging = 0, first = 0;
    if (run->torque_source != HCI_TORQUE_MEASURED || statistics->no_current) return false;
    for (size_t k = 1; k < count; ++k) {
        const bool alike = hci_turns_alike(run, statistics, &turns[first], &turns[k]);
        asked += alike;
        swinging += alike && !are_parts_alike(statistics, &turns[first], &turns[k]);
        first = alike ? first : k;
    }
    return swinging * OFTEN > asked;
}

bool hci_turns_creep(const hci_run_statistics *statistics, const hci_turn *turns, size_t count)
{
    const double n = (double)count, middle = 0.5 * (n - 1.0), about = n * (n * n - 1.0) / 12.0;
    double mean = 0.0, slope = 0.0, square = 0.0;
    if (count < LEAST_OF_LINE) return false;
    for (size_t k = 0; k < count; ++k)
        mean += turns[k].torque / n;
    for (size_t k = 0; k < count; ++k) {
        slope += ((double)k - middle) * turns[k].torque / about;
        square += (turns[k].torque - mean) * (turns[k].torque - mean);
    }
    const double rest = fmax(0.0, square - slope * slope * about) / (n - 2.0);
    return slope * slope * about > STEEP * STEEP * rest &&
           fabs(slope) * (n - 1.0) > LIFT * statistics->repeat_Nm;
}

bool hci_turns_find(const hci_run *run, int pole_pairs, hci_turn **turns, size_t *count)
{
    size_t capacity = 64;
    *count = 0;
    *turns = hci_memory_new(capacity, sizeof **turns);
    for (size_t at = 0; *turns && at < run->count;) {
        if (*count == capacity) {
            hci_turn *grown = hci_memory_resize(*turns, capacity *= 2, sizeof *grown);
            if (!grown) return false;
            *turns = grown;
        }
        (*turns)[*count] = turn_from(run, pole_pairs, at);
        at += (*turns)[(*count)++].count;
    }
    return *turns != NULL;
}
