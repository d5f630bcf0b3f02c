#include "host/check/relations/pole_pairs.h"

#include <math.h>

/* So near is a count to a whole number. */
#define WHOLE 0.02

static double whole(double x)
{
    const double n = floor(fabs(x) + 0.5);
    return n > 1.0 && n <= CHECK_MOST_PAIRS && fabs(fabs(x) - n) < WHOLE * n ? n : 0.0;
}

/* Waves of a recording over its mechanical angle, in radians; or its electrical angle over that. */
static double of_run(const check_run *r)
{
    const double of_wave = isfinite(r->current_order) ? r->current_order : r->voltage_order;
    if (isfinite(r->angle_ratio)) return whole(r->angle_ratio);
    return !r->is_electrical && isfinite(of_wave) ? whole(of_wave) : 0.0;
}

/* An order that an angle has in degrees or turns for radians, or in radians for degrees. */
static bool is_of_unit(double order, double pole_pairs)
{
    const double in_degrees = order * 180.0 / HCI_PI, in_radians = order * HCI_PI / 180.0,
                 in_turns = order / (2.0 * HCI_PI);
    return fabs(in_degrees / pole_pairs - 1.0) < WHOLE || fabs(2.0 * in_degrees / pole_pairs - 1.0) < WHOLE ||
           fabs(in_degrees - 1.0) < WHOLE || fabs(in_radians / pole_pairs - 1.0) < WHOLE ||
           fabs(in_turns / pole_pairs - 1.0) < WHOLE;
}

/* Turns for one of the angle by its speed: a whole number, or one over it, that is not of an electrical angle
 * or speed. */
static double gear_by_speed(const check_run *r, double pole_pairs)
{
    const double ratio = r->angle_rate / r->speed_over_time, gear = fabs(fmax(ratio, 1.0 / ratio));
    const bool is_known = isfinite(ratio) && ratio > 0.0 && !r->is_electrical && !r->speed_is_electrical;
    if (!is_known || !(whole(gear) > 0.0) || fabs(gear / pole_pairs - 1.0) < WHOLE) return 0.0;
    return is_of_unit(1.0 / gear, 1.0) ? 0.0 : 1.0 / ratio;
}

/* Electrical turns for one of the angle that no number of pole pairs makes: 1 is an electrical angle. */
static double gear_of(const check_run *r, double pole_pairs)
{
    const double order = fabs(isfinite(r->current_order) ? r->current_order : r->voltage_order);
    if (!isfinite(order)) return gear_by_speed(r, pole_pairs);
    if (r->is_electrical || isfinite(r->angle_ratio)) return 0.0;
    if (whole(order) > 0.0 || fabs(order - 1.0) < WHOLE || is_of_unit(order, pole_pairs)) return 0.0;
    return fabs(order / pole_pairs - 1.0) < WHOLE ? 0.0 : order / pole_pairs;
}

bool hci_check_pole_pairs_count(check_data *data)
{
    double counted = 0.0;
    for (size_t k = 0; k < data->runs && !(counted > 0.0); ++k)
        counted = of_run(&data->run[k]);
    for (size_t k = 0; k < data->runs; ++k)
        data->run[k].gear = gear_of(&data->run[k], data->value[CHECK_pole_pairs]);
    if (!hci_check_pole_pairs_of_ripple(data)) return false;
    data->counted_pole_pairs = counted > 0.0 ? counted : whole(data->pole_pairs_of_ripple);
    return true;
}
