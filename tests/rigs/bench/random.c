#include "rig.h"

#include <math.h>

/* splitmix64 of Steele, Lea and Flood: any seed is a good one. */
static uint64_t mixed(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static uint64_t next(rig_random *r)
{
    return mixed(r->state += UINT64_C(0x9e3779b97f4a7c15));
}

static double unit_of(uint64_t bits)
{
    return (double)(bits >> 11) * 0x1p-53;
}

rig_random rig_random_of(const char *text, uint64_t seed)
{
    rig_random r = {UINT64_C(14695981039346656037)};
    for (; *text; ++text)
        r.state = (r.state ^ (uint64_t)(unsigned char)*text) * UINT64_C(1099511628211);
    r.state ^= mixed(seed + UINT64_C(0x9e3779b97f4a7c15));
    return r;
}

double rig_uniform(rig_random *r, double from, double to)
{
    return from + (to - from) * unit_of(next(r));
}

double rig_log_uniform(rig_random *r, double from, double to)
{
    return from * pow(to / from, rig_uniform(r, 0.0, 1.0));
}

double rig_normal(rig_random *r)
{
    const double radius = sqrt(-2.0 * log(1.0 - rig_uniform(r, 0.0, 1.0)));
    return radius * cos(rig_uniform(r, 0.0, 2.0 * RIG_PI));
}

int rig_pick(rig_random *r, int from, int to)
{
    return from + (int)rig_uniform(r, 0.0, (double)(to - from) + 1.0);
}

bool rig_chance(rig_random *r, double share)
{
    return rig_uniform(r, 0.0, 1.0) < share;
}

double rig_hash(uint64_t seed, int64_t a, int64_t b)
{
    return unit_of(mixed(mixed(mixed(seed) ^ (uint64_t)a) + (uint64_t)b));
}
