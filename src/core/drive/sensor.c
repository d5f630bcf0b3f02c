#include "hci/drive/sensor.h"

#include <math.h>

size_t hci_sensor_workspace(const hci_sensor *sensor)
{
    return sensor->delay_steps;
}

void hci_sensor_start(const hci_sensor *sensor, hci_sensor_state *state, double *ring, uint64_t seed,
                      double first)
{
    state->random = seed;
    state->spare = 0.0;
    state->has_spare = false;
    state->ring = ring;
    state->next = 0;
    for (size_t k = 0; k < sensor->delay_steps; ++k)
        ring[k] = first;
}

/* SplitMix64 (Steele, Lea and Flood 2014): a counter of odd step through a mixing function, so that any seed
 * will do. */
static uint64_t next_bits(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/* Uniform in (−1, 1), symmetric, never 0. */
static double uniform(uint64_t *state)
{
    return ((double)(int64_t)(next_bits(state) >> 11) + 0.5) * 0x1p-52 - 1.0;
}

/* Normal deviates by Marsaglia's polar method: exact to rounding, two for one logarithm. */
static double normal(hci_sensor_state *state)
{
    double x, y, square;
    if (state->has_spare) {
        state->has_spare = false;
        return state->spare;
    }
    do {
        x = uniform(&state->random);
        y = uniform(&state->random);
        square = x * x + y * y;
    } while (square >= 1.0);
    const double scale = sqrt(-2.0 * log(square) / square);
    state->spare = scale * y;
    state->has_spare = true;
    return scale * x;
}

static double delayed(const hci_sensor *sensor, hci_sensor_state *state, double value)
{
    const double oldest = state->ring[state->next];
    state->ring[state->next] = value;
    state->next = state->next + 1 == sensor->delay_steps ? 0 : state->next + 1;
    return oldest;
}

double hci_sensor_read(const hci_sensor *sensor, hci_sensor_state *state, double value, double theta_m_rad)
{
    double y = sensor->modify ? sensor->modify(sensor->context, value, theta_m_rad) : value;
    y += sensor->gain_error * y + sensor->offset;
    if (sensor->noise > 0.0) y += sensor->noise * normal(state);
    if (sensor->quantum > 0.0) y = sensor->quantum * floor(y / sensor->quantum + 0.5);
    return sensor->delay_steps > 0 ? delayed(sensor, state, y) : y;
}
