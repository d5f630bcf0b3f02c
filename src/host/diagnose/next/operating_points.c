#include "host/diagnose/next/operating_points.h"

#include <math.h>

#define SLOWEST_RAD_PER_S 0.1  /* a turn a minute */
#define STANDS            1e-3 /* share of the largest speed below which a shaft stands */
#define UNKNOWN_RAD_PER_S 10.0 /* where no recording tells a speed */
#define APART             2.0  /* ratio of speeds that are different */
#define FURTHER           4.0  /* ratio to a further one where all are the same */

/* A recording of fewer turns may be repeated. */
enum { LEAST_RECORDED_TURNS = 10 };

/* ---- what may be played ---- */

static double mean_noise_Nm(const hci_regression *e)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_regression_next(e, s)) != NULL; count += 1.0)
        sum += hci_regression_noise(e, s)->rms * sqrt(hci_segment_joined(s));
    return sum / fmax(1.0, count);
}

/* A torque sensor, where one of the recordings had it, is there for the next one. */
static hci_torque_source source_of(const hci_regression *e)
{
    hci_torque_source source = HCI_TORQUE_HOLDING;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        if (e->use[r] && e->runs[r].torque_source == HCI_TORQUE_MEASURED) return HCI_TORQUE_MEASURED;
        if (e->use[r] && e->runs[r].torque_source == HCI_TORQUE_INERTIA) source = HCI_TORQUE_INERTIA;
    }
    return source;
}

double hci_run_speed(const hci_regression *e, size_t run)
{
    double sum = 0.0, count = 0.0;
    for (const hci_segment *s = NULL; (s = hci_segment_next(e->samples, run, s)) != NULL;)
        for (size_t j = s->first; j < s->first + s->count; ++j) {
            sum += fabs(e->samples->sample[j].reading.speed_rad_per_s);
            count += 1.0;
        }
    return count > 0.0 ? sum / count : 0.0;
}

/* Speeds of recordings whose shaft turned. */
static void speeds_take(const hci_regression *e, hci_playable *x)
{
    for (size_t r = 0; r < e->samples->run_count; ++r)
        x->most_rad_per_s = fmax(x->most_rad_per_s, hci_run_speed(e, r));
    const double least = fmax(SLOWEST_RAD_PER_S, STANDS * x->most_rad_per_s);
    x->least_rad_per_s = INFINITY;
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const double speed = hci_run_speed(e, r);
        if (speed >= least) x->least_rad_per_s = fmin(x->least_rad_per_s, speed);
    }
}

/* At least two speeds that differ, within what is rated. */
static void speeds_spread(hci_playable *x, double rated_rad_per_s)
{
    const bool rated = rated_rad_per_s > SLOWEST_RAD_PER_S;
    if (!isfinite(x->least_rad_per_s)) x->least_rad_per_s = x->most_rad_per_s = UNKNOWN_RAD_PER_S;
    if (rated) x->most_rad_per_s = fmin(x->most_rad_per_s, rated_rad_per_s);
    x->least_rad_per_s = fmin(x->least_rad_per_s, x->most_rad_per_s);
    if (x->most_rad_per_s >= APART * x->least_rad_per_s) return;
    if (rated && rated_rad_per_s >= APART * x->least_rad_per_s)
        x->most_rad_per_s = fmin(FURTHER * x->least_rad_per_s, rated_rad_per_s);
    else
        x->least_rad_per_s = fmax(SLOWEST_RAD_PER_S, x->most_rad_per_s / FURTHER);
}

hci_playable hci_playable_of(const hci_regression *e, const hci_machine_data *machine)
{
    hci_playable x = {.source = source_of(e), .noise_Nm = mean_noise_Nm(e), .temperature_C = NAN};
    for (size_t r = 0; r < e->samples->run_count; ++r) {
        const hci_run_statistics *f = &e->samples->statistics[r];
        x.most_A = fmax(x.most_A, f->current_A);
        if (isfinite(f->temperature_C)) x.temperature_C = f->temperature_C;
    }
    if (machine->rated_current_A > 0.0) x.most_A = machine->rated_current_A;
    speeds_take(e, &x);
    speeds_spread(&x, machine->rated_speed_rad_per_s);
    x.most_V = machine->dc_link_voltage_V > 0.0 ? machine->dc_link_voltage_V / sqrt(3.0) : (double)INFINITY;
    x.volts_s = hci_machine_torque_constant(machine) / 1.5;
    x.ohm = machine->resistance_ohm > 0.0 ? machine->resistance_ohm : 0.0;
    x.recorded = e->samples->statistics;
    x.use = e->use;
    x.recorded_count = e->samples->run_count;
    return x;
}

/* ---- what was recorded ---- */

#define SAME_CURRENT 0.05 /* of the largest current */
#define SAME_SPEED   0.1  /* of the speed */

static bool is_recorded_by(const hci_playable *x, const hci_run_statistics *run,
                           const hci_operating_point *at)
{
    const double near_A = SAME_CURRENT * x->most_A;
    const double flowing_A = hypot(run->mean_id_A, run->mean_iq_A);
    return run->turns >= LEAST_RECORDED_TURNS && isfinite(at->iq_A) &&
           fabs(run->mean_speed_rad_per_s - at->speed_rad_per_s) <= SAME_SPEED * fabs(at->speed_rad_per_s) &&
           hypot(run->mean_id_A - at->id_A, run->mean_iq_A - at->iq_A) <= near_A &&
           run->current_A - flowing_A <= near_A;
}

static bool is_recorded(const hci_playable *x, const hci_operating_point *at)
{
    for (size_t r = 0; r < x->recorded_count; ++r)
        if (x->use[r] && is_recorded_by(x, &x->recorded[r], at)) return true;
    return false;
}

/* Leaves those that are not recorded yet, in their order. Returns how many. */
static size_t leave_new(const hci_playable *x, hci_operating_point *point, size_t count)
{
    size_t left = 0;
    for (size_t k = 0; k < count; ++k)
        left += !is_recorded(x, &point[k]);
    if (left == 0) return count;
    left = 0;
    for (size_t k = 0; k < count; ++k)
        if (!is_recorded(x, &point[k])) point[left++] = point[k];
    return left;
}

/* ---- the grid ---- */

static bool is_within_voltage(const hci_playable *x, double current_A, double speed_rad_per_s)
{
    return speed_rad_per_s * fabs(x->volts_s) + current_A * x->ohm <= x->most_V;
}

/* Three digits, so that nobody has to type more; never further from 0. */
static double neat(double x)
{
    if (!(fabs(x) > 0.0)) return isnan(x) ? x : 0.0;
    const double digits = 2.0 - floor(log10(fabs(x))), scale = pow(10.0, fabs(digits));
    const double whole = trunc((digits > 0.0 ? x * scale : x / scale) * (1.0 + 1e-12));
    return digits > 0.0 ? whole / scale : whole * scale;
}

/* One current at the slow and the fast speed, where that is another one, forward and backward. Returns how
 * many points there are then.
 */
static size_t both_ways(const hci_playable *x, double id_A, double iq_A, size_t count,
                        hci_operating_point *point)
{
    const double current_A = hypot(id_A, isfinite(iq_A) ? iq_A : 0.0);
    const double speed[] = {neat(x->least_rad_per_s), neat(x->most_rad_per_s)};
    for (int k = 0; k < 2; ++k) {
        if (k == 1 && (x->source == HCI_TORQUE_HOLDING || !(speed[1] > speed[0]) ||
                       !is_within_voltage(x, current_A, speed[1])))
            break;
        point[count++] = (hci_operating_point){neat(id_A), neat(iq_A), speed[k]};
        point[count++] = (hci_operating_point){neat(id_A), neat(iq_A), -speed[k]};
    }
    return count;
}

static size_t without_torque_sensor(const hci_playable *x, hci_operating_point *point)
{
    static const double SHARE[] = {0.0, 0.5, -0.5, 1.0, -1.0};
    size_t count = 0;
    for (size_t k = 0; k < (x->most_A > 0.0 ? 5 : 1); ++k)
        count = both_ways(x, SHARE[k] * x->most_A, NAN, count, point);
    return count;
}

size_t hci_operating_points(const hci_playable *x, hci_operating_point *point)
{
    static const double SHARE[] = {0.25, 0.5, 1.0}, AHEAD_RAD[] = {0.0, 0.6, -0.6};
    if (x->source != HCI_TORQUE_MEASURED) return without_torque_sensor(x, point);
    size_t count = both_ways(x, 0.0, 0.0, 0, point);
    for (size_t k = 0; k < 3 && x->most_A > 0.0; ++k) {
        const double current_A = SHARE[k] * x->most_A;
        for (size_t a = 0; a < 3; ++a)
            count = both_ways(x, -current_A * sin(AHEAD_RAD[a]), current_A * cos(AHEAD_RAD[a]), count, point);
        count = both_ways(x, 0.0, -current_A, count, point);
    }
    return leave_new(x, point, count);
}
