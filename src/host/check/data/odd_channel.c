#include "host/check/data/odd_channel.h"

#include <math.h>

/* rms of the sum over that of the currents, from which on one of them is wrong; with the channel that is
 * taken out less than this share of that is left. */
#define LEAST_SUM 0.25
#define LEFT      0.2

/* Gains between 1 over it and it are those of a sensor, and the business of diagnose. */
#define A_SENSOR 1.5

/* A channel with less than this share of the others reads nothing. */
#define NOTHING 0.02

/* Times, by which two channels of one machine differ at most: where they do more, the larger one is odd, and
 * what is little beside it reads what it should. */
#define LIKE 5.0

/* Two columns that differ by less than this share hold the same. */
#define THE_SAME 0.1

/* Currents whose rms about their means is less than this share of the whole stand, as of a rotor that is
 * held: how they vary is noise and rounding, and b and c in parallel are the same. */
#define STANDS 0.05

static bool stand(const double *const column[3], size_t count, double gram[3][3])
{
    double whole = 0.0;
    for (int s = 0; s < 3; ++s)
        for (size_t k = 0; k < count; ++k)
            whole += column[s][k] * column[s][k] / (double)count;
    return gram[0][0] + gram[1][1] + gram[2][2] < STANDS * STANDS * whole;
}

/* Mean products about the means, so that an offset of a sensor does not count. */
static void products(const double *const column[3], size_t count, double gram[3][3])
{
    double mean[3] = {0.0, 0.0, 0.0};
    for (int s = 0; s < 3; ++s)
        for (size_t k = 0; k < count; ++k)
            mean[s] += column[s][k] / (double)count;
    for (int s = 0; s < 3; ++s)
        for (int j = 0; j < 3; ++j) {
            gram[s][j] = 0.0;
            for (size_t k = 0; k < count; ++k)
                gram[s][j] += (column[s][k] - mean[s]) * (column[j][k] - mean[j]) / (double)count;
        }
}

/* Mean square of x_a/gain_a + x_b/gain_b + x_c/gain_c, over that of the three. */
static double sum_with(double gram[3][3], int phase, double gain)
{
    double sum = 0.0, square = 0.0;
    for (int s = 0; s < 3; ++s)
        for (int j = 0; j < 3; ++j) {
            const double x = gram[s][j] / (s == phase ? gain : 1.0) / (j == phase ? gain : 1.0);
            sum += x;
            square += s == j ? x : 0.0;
        }
    return square > 0.0 ? sqrt(fmax(0.0, sum) / square) : 0.0;
}

/* How often the two others' sum, taken from nothing, a channel reads: least squares. */
static double gain_of(double gram[3][3], int phase)
{
    const int a = (phase + 1) % 3, b = (phase + 2) % 3;
    const double cross = -(gram[phase][a] + gram[phase][b]);
    return cross / (gram[a][a] + gram[b][b] + 2.0 * gram[a][b]);
}

static bool is_nothing(double gram[3][3], int phase)
{
    const double a = gram[(phase + 1) % 3][(phase + 1) % 3], b = gram[(phase + 2) % 3][(phase + 2) % 3];
    const bool are_like = a < LIKE * LIKE * b && b < LIKE * LIKE * a;
    return are_like && gram[phase][phase] < NOTHING * NOTHING * 0.5 * (a + b);
}

/* The two others than `phase`, unless they share the way back of its current: then it is a multiple of their
 * sum. */
static bool are_twins(double gram[3][3], int phase)
{
    const int a = (phase + 1) % 3, b = (phase + 2) % 3;
    const double both = gram[a][a] + gram[b][b];
    const bool alike = both > 0.0 && both - 2.0 * gram[a][b] < THE_SAME * THE_SAME * both;
    return alike && !(sum_with(gram, phase, gain_of(gram, phase)) < LEFT);
}

static bool is_a_sensor(double gain)
{
    return gain > 1.0 / A_SENSOR && gain < A_SENSOR;
}

check_odd_channel hci_check_odd_channel(const double *const column[3], size_t count)
{
    check_odd_channel best = {CHECK_CHANNELS_AGREE, 0, 1.0};
    double gram[3][3];
    products(column, count, gram);
    if (stand(column, count, gram)) return best;
    const double sum = sum_with(gram, 0, 1.0);
    double least = LEFT * sum;
    if (!(sum > LEAST_SUM)) return best;
    for (int s = 0; s < 3; ++s)
        if (are_twins(gram, s)) return (check_odd_channel){CHECK_CHANNELS_TWINS, s, 1.0};
    for (int s = 0; s < 3; ++s) {
        if (is_nothing(gram, s)) return (check_odd_channel){CHECK_CHANNEL_DEAD, s, 0.0};
        const double gain = gain_of(gram, s), left = sum_with(gram, s, gain);
        if (!isfinite(gain) || is_a_sensor(gain) || !(left < least)) continue;
        least = left;
        best = (check_odd_channel){CHECK_CHANNEL_ODD, s, gain};
    }
    return best;
}
