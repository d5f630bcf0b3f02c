#include "cli/tune/tune_recorded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"

/* ---- currents ---- */

/* Of the phase currents, beside those that another recording has or the machine is rated for. */
#define NO_CURRENT 0.01

/* Times what noise alone makes of a mean. */
#define NOISE_OF_MEAN 5.0

double cli_tune_rms_A(const hci_run *r)
{
    double sum = 0.0;
    for (size_t k = 0; k < 3 * r->count; ++k)
        sum += r->i_A[k] * r->i_A[k];
    return sqrt(sum / (3.0 * (double)r->count));
}

/* Of phase currents in the plane that turns with the angle: what a drive makes stands still there, and noise
 * and the offsets of sensors go to 0. */
static double mean_vector(const hci_run *r)
{
    double along = 0.0, across = 0.0;
    for (size_t k = 0; k < r->count && r->theta_m_rad; ++k)
        for (int s = 0; s < 3; ++s) {
            const double x = r->pole_pairs * r->theta_m_rad[k] - 2.0 * HCI_PI * s / 3.0;
            along += r->i_A[3 * k + (size_t)s] * cos(x);
            across += r->i_A[3 * k + (size_t)s] * sin(x);
        }
    return 2.0 / 3.0 * hypot(along, across) / (double)r->count;
}

/* Against a brake, whose current turns round with the motion, its mean may be 0. */
static bool is_braked(const hci_run *r)
{
    return r->torque_source == HCI_TORQUE_HOLDING && hci_run_is_loaded(r, r->pole_pairs);
}

#define TURNS 0.9 /* of the length of the current, that its mean in the rotor frame has */

double cli_tune_turning_A(const cli_tuning *t)
{
    double most_A = 0.0;
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        const double length_A = r->i_A ? mean_vector(r) : 0.0;
        if (length_A > most_A && length_A > TURNS * sqrt(2.0) * cli_tune_rms_A(r)) most_A = length_A;
    }
    return most_A;
}

/* Times the largest current that turned: a bench does not stay so far below what is rated. */
#define MUCH_RECORDED 100.0

bool cli_tune_is_overrated(const cli_tuning *t)
{
    const double most_A = cli_tune_turning_A(t);
    return most_A > 0.0 && t->declared.rated_current_A > MUCH_RECORDED * most_A;
}

bool cli_tune_has_no_current(const cli_tuning *t, const hci_run *r)
{
    const double rms_A = cli_tune_rms_A(r);
    const double rated_A = t->declared.rated_current_A;
    double most_A = rated_A > 0.0 && !cli_tune_is_overrated(t) ? rated_A : 0.0;
    for (size_t k = 0; k < t->runs.count; ++k)
        most_A = fmax(most_A, cli_tune_rms_A(&t->runs.run[k]));
    if (rms_A <= NO_CURRENT * most_A) return true;
    return r->theta_m_rad && !is_braked(r) && mean_vector(r) < NOISE_OF_MEAN * rms_A / sqrt((double)r->count);
}

/* ---- ripple ---- */

/* Parts of the turn at most, samples in each of them at least, on average, and those of which the median is
 * taken. */
enum { MOST_PARTS = 480, IN_A_PART = 8, LEAST_PARTS = 12, KEPT = 15 };

typedef struct {
    double kept_Nm[MOST_PARTS][KEPT]; /* from all along the recording, one in `stride` */
    size_t count[MOST_PARTS], parts, samples, stride;
} part_samples;

static double torque_of(const cli_tuning *t, const hci_run *r, size_t n)
{
    return r->torque_source == HCI_TORQUE_HOLDING
               ? t->reading.run.torque_constant_Nm_per_A *
                     hci_park(hci_clarke(r->i_A + 3 * n), r->pole_pairs * r->theta_m_rad[n]).q
               : r->torque_Nm[n];
}

static bool goes(const hci_run *r, size_t n, int way)
{
    return !r->speed_rad_per_s || (way > 0 ? r->speed_rad_per_s[n] >= 0.0 : r->speed_rad_per_s[n] < 0.0);
}

static double turns_of(const hci_run *r, size_t n)
{
    return r->theta_m_rad[n] * (r->turn_known ? 1.0 : r->pole_pairs) / (2.0 * HCI_PI);
}

/* Behind the samples that follow sample `from` within one turn. */
static size_t end_of_turn(const hci_run *r, size_t from)
{
    const double turn = floor(turns_of(r, from));
    size_t end = from + 1;
    while (end < r->count && fabs(floor(turns_of(r, end)) - turn) < 0.5)
        ++end;
    return end;
}

/* Of a turn, that its samples cover; and from how many such turns on the others are left out. */
#define A_WHOLE 0.8
enum { WHOLE_TURNS = 3 };

static bool is_whole(const hci_run *r, size_t from, size_t end)
{
    return fabs(turns_of(r, end - 1) - turns_of(r, from)) > A_WHOLE;
}

static bool has_whole_turns(const hci_run *r)
{
    size_t whole = 0;
    for (size_t from = 0, end; from < r->count; from = end) {
        end = end_of_turn(r, from);
        whole += is_whole(r, from, end);
    }
    return whole >= WHOLE_TURNS;
}

static void keep(part_samples *m, size_t part, double torque_Nm)
{
    const size_t k = m->count[part]++;
    if (k % m->stride == 0) m->kept_Nm[part][k / m->stride % KEPT] = torque_Nm;
}

/* Samples of one turn. */
typedef struct {
    size_t from, end;
    double mean_Nm, rms_Nm; /* the rms about the mean */
    bool is_whole;
} one_turn;

static one_turn turn_of(const cli_tuning *t, const hci_run *r, size_t from)
{
    one_turn x = {.from = from, .end = end_of_turn(r, from)};
    const double samples = (double)(x.end - from);
    for (size_t n = from; n < x.end; ++n)
        x.mean_Nm += torque_of(t, r, n) / samples;
    for (size_t n = from; n < x.end; ++n)
        x.rms_Nm += pow(torque_of(t, r, n) - x.mean_Nm, 2.0) / samples;
    x.rms_Nm = sqrt(x.rms_Nm);
    x.is_whole = is_whole(r, from, x.end);
    return x;
}

/* Of the rms, by which the means of turns at one load differ at most. */
#define ONE_LOAD 0.3

static bool is_of_load(const one_turn *x, const one_turn *other)
{
    return x->is_whole && other->is_whole && fabs(x->mean_Nm - other->mean_Nm) < ONE_LOAD * x->rms_Nm;
}

static void add_turn(const cli_tuning *t, const hci_run *r, int way, const one_turn *x, part_samples *m)
{
    for (size_t n = x->from; n < x->end; ++n) {
        const double turns = turns_of(r, n);
        const size_t part = (size_t)((turns - floor(turns)) * (double)m->parts) % m->parts;
        if (goes(r, n, way)) keep(m, part, torque_of(t, r, n) - x->mean_Nm);
    }
}

/* Each whole turn less its mean, where the turn before or behind it has the same: the loads of a file with
 * several tests, and the ramps between them, are no ripple. */
static void add_all(const cli_tuning *t, const hci_run *r, int way, part_samples *m)
{
    const bool by_turn = has_whole_turns(r);
    one_turn before = {0}, x = turn_of(t, r, 0);
    while (x.from < r->count) {
        one_turn behind = {.from = r->count, .end = r->count};
        if (x.end < r->count) behind = turn_of(t, r, x.end);
        if (!by_turn) x.mean_Nm = 0.0;
        if (!by_turn || is_of_load(&x, &before) || is_of_load(&x, &behind)) add_turn(t, r, way, &x, m);
        before = x;
        x = behind;
    }
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A few rows in which the shaft speeds up or turns round do not move it. */
static double median_of(part_samples *m, size_t part)
{
    const size_t all = (m->count[part] + m->stride - 1) / m->stride, count = all < KEPT ? all : KEPT;
    qsort(m->kept_Nm[part], count, sizeof(double), by_value);
    return 0.5 * (m->kept_Nm[part][(count - 1) / 2] + m->kept_Nm[part][count / 2]);
}

/* In one direction, since friction and a brake turn with it. 0: too few samples. */
static double swing_of(const cli_tuning *t, const hci_run *r, int way)
{
    static part_samples m;
    double least_Nm = HUGE_VAL, most_Nm = -HUGE_VAL;
    memset(&m, 0, sizeof m);
    for (size_t n = 0; n < r->count; ++n)
        m.samples += goes(r, n, way);
    m.parts = m.samples / IN_A_PART < MOST_PARTS ? m.samples / IN_A_PART : MOST_PARTS;
    if (m.parts < LEAST_PARTS) return 0.0;
    m.stride = 1 + m.samples / (m.parts * KEPT);
    add_all(t, r, way, &m);
    for (size_t k = 0; k < m.parts; ++k) {
        if (2 * m.count[k] < IN_A_PART) continue;
        const double median_Nm = median_of(&m, k);
        least_Nm = fmin(least_Nm, median_Nm);
        most_Nm = fmax(most_Nm, median_Nm);
    }
    return fmax(most_Nm - least_Nm, 0.0);
}

cli_tune_ripple cli_tune_recorded_ripple(const cli_tuning *t)
{
    cli_tune_ripple x = {t->runs.count, 0.0, 0.0};
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if ((r->torque_source != HCI_TORQUE_MEASURED && r->torque_source != HCI_TORQUE_HOLDING) ||
            !r->torque_Nm || !r->theta_m_rad)
            continue;
        const double swing_Nm = fmax(swing_of(t, r, 1), r->speed_rad_per_s ? swing_of(t, r, -1) : 0.0);
        if (!(swing_Nm > x.peak_to_peak_Nm)) continue;
        x.run = k;
        x.peak_to_peak_Nm = swing_Nm;
        x.current_A = cli_tune_has_no_current(t, r) ? 0.0 : sqrt(2.0) * cli_tune_rms_A(r);
    }
    return x;
}

/* ---- two motors ---- */

/* Of a mechanical turn: parts of it, and the orders that are looked at; those below are of loads and encoders
 * too. */
enum { PARTS_OF_TURN = 1024, LEAST_ORDER = 3, MOST_ORDER = 240, SAMPLES_OF_ORDER = 4 };

#define LEADS  0.5  /* of the rms of a ripple, that its largest order has */
#define ABSENT 0.15 /* of its amplitude there, that another motor's log has of it */

/* The ripple of a recording over the mechanical turn. */
typedef struct {
    double amplitude_Nm[MOST_ORDER + 1];
    int order; /* the largest; 0: none leads, or the recording tells none */
    int reach; /* the highest that its samples tell */
} turn_ripple;

static int way_of(const hci_run *r, size_t n)
{
    return goes(r, n, 1) ? 0 : 1;
}

/* Its torque less the mean of each direction, mean by mean of the parts; 0 where a part is empty. */
static size_t fill_parts(const cli_tuning *t, const hci_run *r, double sum_Nm[PARTS_OF_TURN])
{
    double count[PARTS_OF_TURN] = {0.0}, mean_Nm[2] = {0.0, 0.0}, samples[2] = {0.0, 0.0};
    size_t filled = 0;
    for (size_t n = 0; n < r->count; ++n) {
        mean_Nm[way_of(r, n)] += torque_of(t, r, n);
        samples[way_of(r, n)] += 1.0;
    }
    for (size_t n = 0; n < r->count; ++n) {
        const double turns = turns_of(r, n);
        const size_t part = (size_t)((turns - floor(turns)) * PARTS_OF_TURN) % PARTS_OF_TURN;
        sum_Nm[part] += torque_of(t, r, n) - mean_Nm[way_of(r, n)] / samples[way_of(r, n)];
        count[part] += 1.0;
    }
    for (size_t k = 0; k < PARTS_OF_TURN; ++k) {
        filled += count[k] > 0.0;
        sum_Nm[k] = count[k] > 0.0 ? sum_Nm[k] / count[k] : 0.0;
    }
    return filled;
}

/* Amplitude of one order of the turn. */
static double amplitude_of(const double part_Nm[PARTS_OF_TURN], int order)
{
    const double step = 2.0 * HCI_PI * order / PARTS_OF_TURN, by_cosine = cos(step), by_sine = sin(step);
    double c = 1.0, s = 0.0, sine = 0.0, cosine = 0.0;
    for (size_t k = 0; k < PARTS_OF_TURN; ++k) {
        const double turned = c * by_cosine - s * by_sine;
        sine += part_Nm[k] * s;
        cosine += part_Nm[k] * c;
        s = s * by_cosine + c * by_sine;
        c = turned;
    }
    return 2.0 / PARTS_OF_TURN * hypot(sine, cosine);
}

static void ripple_of(const cli_tuning *t, const hci_run *r, turn_ripple *x)
{
    double part_Nm[PARTS_OF_TURN] = {0.0}, square = 0.0;
    const bool is_used = r->torque_source == HCI_TORQUE_MEASURED || r->torque_source == HCI_TORQUE_HOLDING;
    memset(x, 0, sizeof *x);
    if (!is_used || !r->torque_Nm || !r->theta_m_rad || !r->turn_known || r->only_mean) return;
    const size_t filled = fill_parts(t, r, part_Nm);
    x->reach = (int)fmin(MOST_ORDER, (double)(filled / SAMPLES_OF_ORDER));
    for (int order = 1; order <= x->reach; ++order) {
        x->amplitude_Nm[order] = amplitude_of(part_Nm, order);
        square += 0.5 * pow(x->amplitude_Nm[order], 2.0);
        if (order >= LEAST_ORDER && x->amplitude_Nm[order] > x->amplitude_Nm[x->order]) x->order = order;
    }
    if (sqrt(0.5) * x->amplitude_Nm[x->order] < LEADS * sqrt(square)) x->order = 0;
}

static bool lacks(const turn_ripple *x, const turn_ripple *of)
{
    return of->order > 0 && of->order <= x->reach &&
           x->amplitude_Nm[of->order] < ABSENT * of->amplitude_Nm[of->order];
}

bool cli_tune_two_motors(const cli_tuning *t, cli_tune_two_ripples *two)
{
    turn_ripple a, b;
    for (size_t k = 0; k < t->runs.count; ++k) {
        ripple_of(t, &t->runs.run[k], &a);
        for (size_t j = k + 1; a.order > 0 && j < t->runs.count; ++j) {
            ripple_of(t, &t->runs.run[j], &b);
            if (!lacks(&a, &b) || !lacks(&b, &a)) continue;
            *two = (cli_tune_two_ripples){k, j, a.order, b.order};
            return true;
        }
    }
    return false;
}
