#include "host/check/data/run_parts.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/statistics.h"

/* A way back that is shorter than this share of the whole is no turning round. */
#define TURNED 0.1

/* Nor is a part of so few samples, or of so small a share of them. */
enum { LEAST_SAMPLES = 8 };
#define LEAST_SHARE 0.05

/* Steps between these shares of the range of an angle are neither small nor a wrap. */
#define SMALL     0.3
#define MOST_TORN 0.1

/* i_q has two signs when few samples are between them, within this share of the largest; where there is an
 * angle, a wave over it is not what is looked for. */
#define BETWEEN              0.1
#define MOST_BETWEEN         0.2
#define BETWEEN_OF_WAVE      0.3
#define MOST_BETWEEN_OF_WAVE 0.1

bool hci_check_angle_is_torn(const double *angle, size_t n)
{
    const double range = hci_peak_to_peak(angle, n);
    size_t torn = 0;
    for (size_t k = 1; k < n; ++k) {
        const double step = fabs(angle[k] - angle[k - 1]);
        torn += step > SMALL * range && step < (1.0 - SMALL) * range;
    }
    return (double)torn > MOST_TORN * (double)n;
}

/* ---- the direction */

/* The angle without its wraps, whatever a turn is in its unit. */
static void unwrap(const double *angle, size_t n, double *path)
{
    const double range = hci_peak_to_peak(angle, n);
    path[0] = angle[0];
    for (size_t k = 1; k < n; ++k) {
        const double step = angle[k] - angle[k - 1];
        path[k] = path[k - 1] + (step > 0.5 * range    ? step - range
                                 : step < -0.5 * range ? step + range
                                                       : step);
    }
}

/* From turning point to turning point: a sample is of part 0 where the path rises and of 1 where it falls. */
static void follow(const double *path, size_t n, signed char *part)
{
    const double back = TURNED * hci_peak_to_peak(path, n);
    size_t begin = 0, extreme = 0;
    int way = 0;
    for (size_t k = 1; k < n; ++k) {
        const double gone = path[k] - path[extreme];
        if (way == 0 && fabs(path[k] - path[0]) > back) way = path[k] > path[0] ? 1 : -1;
        if (way == 0 || way * gone >= 0.0) {
            extreme = k;
            continue;
        }
        if (!(-way * gone > back)) continue;
        memset(part + begin, way > 0 ? 0 : 1, extreme - begin);
        begin = extreme;
        extreme = k;
        way = -way;
    }
    memset(part + begin, way < 0 ? 1 : 0, n - begin);
}

static void follow_speed(const double *speed, size_t n, signed char *part)
{
    signed char way = 0;
    for (size_t k = 0; k < n; ++k) {
        if (fabs(speed[k]) > 0.0) way = speed[k] < 0.0;
        part[k] = way;
    }
}

/* ---- parts */

static bool has_two_signs(const double *q, size_t n, bool may_be_a_wave)
{
    const double near = may_be_a_wave ? BETWEEN_OF_WAVE : BETWEEN,
                 most_near = may_be_a_wave ? MOST_BETWEEN_OF_WAVE : MOST_BETWEEN;
    double most = 0.0, sum[2] = {0.0, 0.0};
    size_t between = 0;
    for (size_t k = 0; k < n; ++k) {
        most = fmax(most, fabs(q[k]));
        sum[q[k] < 0.0] += fabs(q[k]);
    }
    for (size_t k = 0; k < n; ++k)
        between += fabs(q[k]) < near * most;
    return (double)between < most_near * (double)n && fmin(sum[0], sum[1]) > LEAST_SHARE * (sum[0] + sum[1]);
}

/* Numbers them without gaps; those that are too short get -1, unless all of them are. */
static int count_parts(signed char *part, size_t n)
{
    size_t size[CHECK_MOST_PARTS] = {0};
    signed char number[CHECK_MOST_PARTS];
    int count = 0;
    for (size_t k = 0; k < n; ++k)
        ++size[(int)part[k]];
    for (int j = 0; j < CHECK_MOST_PARTS; ++j) {
        const bool is_long = size[j] >= LEAST_SAMPLES && (double)size[j] >= LEAST_SHARE * (double)n;
        number[j] = is_long ? (signed char)count++ : -1;
    }
    for (size_t k = 0; k < n; ++k)
        part[k] = count > 0 ? number[(int)part[k]] : 0;
    return count > 0 ? count : 1;
}

int hci_check_parts_find(const check_samples *s, bool is_held, signed char *part)
{
    const size_t n = s->count;
    memset(part, 0, n);
    if (is_held) return 1;
    if (s->theta && !hci_check_angle_is_torn(s->theta, n)) {
        double *path = hci_memory_new(n, sizeof *path);
        if (!path) return 0;
        unwrap(s->theta, n, path);
        follow(path, n, part);
        hci_memory_free(path);
    } else if (s->speed) {
        follow_speed(s->speed, n, part);
    }
    const bool of_current = s->q && has_two_signs(s->q, n, s->theta != NULL);
    for (size_t k = 0; of_current && k < n; ++k)
        part[k] = (signed char)(part[k] + (s->q[k] < 0.0 ? 2 : 0));
    return count_parts(part, n);
}

/* ---- the samples of one */

/* What stands in the memory of a part, one after the other. */
typedef struct {
    const signed char *part;
    int which;
    size_t count, size; /* of the file; of the part */
    double *next;
} gathering;

static const double *gather(gathering *g, const double *values)
{
    double *out = g->next;
    if (!values) return NULL;
    for (size_t k = 0; k < g->count; ++k)
        if (g->part[k] == g->which) *g->next++ = values[k];
    return out;
}

static const double *const *gather_phases(gathering *g, const double *const *from, const double *to[3])
{
    for (int s = 0; from && s < 3; ++s)
        to[s] = gather(g, from[s]);
    return from ? to : NULL;
}

static bool gather_vectors(const gathering *g, const check_vector *from, check_vector **to)
{
    size_t used = 0;
    *to = NULL;
    if (!from) return true;
    *to = hci_memory_new(g->size, sizeof **to);
    for (size_t k = 0; *to && k < g->count; ++k)
        if (g->part[k] == g->which) (*to)[used++] = from[k];
    return *to != NULL;
}

/* Which samples follow the one before them in the file, too. */
static void gather_joints(const gathering *g, bool *follows)
{
    size_t used = 0;
    for (size_t k = 0; k < g->count; ++k)
        if (g->part[k] == g->which) follows[used++] = k > 0 && g->part[k - 1] == g->which;
}

static void gather_columns(gathering *g, const check_samples *s, check_samples *out)
{
    out->time = gather(g, s->time);
    out->theta = gather(g, s->theta);
    out->other = gather(g, s->other);
    out->speed = gather(g, s->speed);
    out->d = gather(g, s->d);
    out->q = gather(g, s->q);
    out->vd = gather(g, s->vd);
    out->vq = gather(g, s->vq);
    out->torque = s->torque ? g->next : NULL;
    gather(g, s->torque);
    out->phase = gather_phases(g, s->phase, out->of_phase);
    out->volt = gather_phases(g, s->volt, out->of_volt);
}

enum { MOST_COLUMNS = 15 };

bool hci_check_part_take(const check_samples *s, const signed char *part, int which, check_samples *out)
{
    gathering g = {.part = part, .which = which, .count = s->count};
    memset(out, 0, sizeof *out);
    for (size_t k = 0; k < s->count; ++k)
        g.size += part[k] == which;
    out->count = g.size;
    out->gap_s = s->gap_s;
    g.next = out->memory = hci_memory_new(MOST_COLUMNS * g.size, sizeof *out->memory);
    out->follows = hci_memory_new(g.size, sizeof *out->follows);
    if (!g.next || !out->follows) return false;
    gather_columns(&g, s, out);
    gather_joints(&g, out->follows);
    return gather_vectors(&g, s->current, &out->current) && gather_vectors(&g, s->voltage, &out->voltage);
}

void hci_check_part_release(check_samples *part)
{
    hci_memory_free(part->memory);
    hci_memory_free(part->follows);
    hci_memory_free(part->current);
    hci_memory_free(part->voltage);
}
