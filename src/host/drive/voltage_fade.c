#include "host/drive/voltage_fade.h"

#include <float.h>
#include <math.h>

enum { SPEEDS = 20, CHOICES = 8 };

/* Of the mean torque: less is not told apart. */
static const double LEAST_RIPPLE = 1e-3;

/* Of what is asked for: with less torque a ratio to the mean says nothing. */
static const double LEAST_MEAN = 0.05;

typedef struct {
    const hci_loop_range *given;
    hci_loop_range range[HCI_LOOP_MOST_ORDERS]; /* of the run that is made */
    uint32_t kept[CHOICES];                     /* orders of each choice, descending */
    int choices;
    double speed_rad_per_s[SPEEDS];
    double cost[SPEEDS][CHOICES]; /* logarithm of the ripple by the mean */
    int best[SPEEDS];             /* choice at each speed, ascending */
} fade;

/* All orders, and evenly fewer down to the mean alone. */
static void set_choices(uint32_t orders, fade *f)
{
    f->choices = orders < CHOICES ? (int)orders : CHOICES;
    for (int c = 0; c < f->choices; ++c)
        f->kept[c] = orders - (uint32_t)((double)(orders - 1u) * c / fmax(f->choices - 1, 1) + 0.5);
}

static double cost_of(const hci_sampled_torque *torque, double wanted_Nm)
{
    if (isnan(torque->mean_Nm)) return log(DBL_MAX);
    if (wanted_Nm == 0.0) return log(fmax(torque->ripple_Nm, DBL_MIN));
    const double along_Nm = wanted_Nm > 0.0 ? torque->mean_Nm : -torque->mean_Nm;
    return log(fmax(torque->ripple_Nm / fmax(along_Nm, LEAST_MEAN * fabs(wanted_Nm)), LEAST_RIPPLE));
}

/* Whether the choice before has no order more at a speed, since the sampling has ended them. */
static bool is_same(const fade *f, int choice, double speed_rad_per_s)
{
    if (choice == 0) return false;
    for (uint32_t k = f->kept[choice]; k < f->kept[choice - 1]; ++k)
        if ((double)f->given[k].none_rad_per_s > speed_rad_per_s) return false;
    return true;
}

static double try_choice(const hci_sampled_drive *drive, double speed_rad_per_s, uint32_t kept, fade *f)
{
    hci_loop_f32 loop = *drive->loop;
    hci_sampled_drive part = *drive;
    for (uint32_t k = 0; k < loop.order_count; ++k)
        f->range[k] = k < kept ? f->given[k] : (hci_loop_range){0.0f, 0.0f};
    loop.ranges = f->range;
    part.loop = &loop;
    const hci_sampled_torque torque = hci_sampled_run(&part, speed_rad_per_s);
    return cost_of(&torque, (double)loop.torque_low_Nm);
}

/* Times the ripple of all orders: where the mean alone leaves more, what is between is not looked at. */
static const double CLEAR = 3.0;

static void fill_costs(const hci_sampled_drive *drive, int direction, int j, fade *f)
{
    const double speed = f->speed_rad_per_s[j];
    const int last = f->choices - 1;
    double *cost = f->cost[j];
    cost[0] = try_choice(drive, direction * speed, f->kept[0], f);
    cost[last] = try_choice(drive, direction * speed, f->kept[last], f);
    for (int c = 1; c < last; ++c)
        cost[c] = cost[last] - cost[0] > log(CLEAR) ? cost[last]
                  : is_same(f, c, speed)            ? cost[c - 1]
                                                    : try_choice(drive, direction * speed, f->kept[c], f);
}

/* The choices with the least sum of costs, of those that never take an order back with the speed. */
static void choose(fade *f)
{
    double sum[SPEEDS][CHOICES];
    int before[SPEEDS][CHOICES] = {{0}}, best = 0;
    for (int j = 0; j < SPEEDS; ++j)
        for (int c = 0, least = 0; c < f->choices; ++c) {
            if (j > 0 && sum[j - 1][c] < sum[j - 1][least]) least = c;
            before[j][c] = least;
            sum[j][c] = f->cost[j][c] + (j > 0 ? sum[j - 1][least] : 0.0);
        }
    for (int c = 1; c < f->choices; ++c)
        if (sum[SPEEDS - 1][c] < sum[SPEEDS - 1][best]) best = c;
    for (int j = SPEEDS; j-- > 0; best = before[j][best])
        f->best[j] = best;
}

/* An order is whole up to the last speed at which it is kept, and gone at the next. */
static void end_order(const fade *f, uint32_t order, double from_rad_per_s, hci_loop_range *range)
{
    int j = 0;
    while (j < SPEEDS && f->kept[f->best[j]] > order)
        ++j;
    if (j == SPEEDS) return;
    const double whole = j > 0 ? f->speed_rad_per_s[j - 1] : from_rad_per_s;
    range->whole_rad_per_s = fminf(range->whole_rad_per_s, (float)whole);
    range->none_rad_per_s = fminf(range->none_rad_per_s, (float)f->speed_rad_per_s[j]);
}

/* A share of the highest speed, where the voltage does not do at a standstill. */
static const double LOW = 1.0 / 64.0;

void hci_voltage_fade(const hci_sampled_drive *drive, double from_rad_per_s, double to_rad_per_s,
                      int direction, hci_loop_range *ranges)
{
    const double low = fmax(from_rad_per_s, LOW * to_rad_per_s);
    fade f = {.given = ranges};
    if (!(low < to_rad_per_s) || drive->loop->order_count < 2) return;
    set_choices(drive->loop->order_count, &f);
    for (int j = 0; j < SPEEDS; ++j) {
        f.speed_rad_per_s[j] = low * pow(to_rad_per_s / low, (j + 1.0) / SPEEDS);
        fill_costs(drive, direction, j, &f);
    }
    choose(&f);
    for (uint32_t k = 1; k < drive->loop->order_count; ++k)
        end_order(&f, k, from_rad_per_s, &ranges[k]);
}
