/* The rate at which a recorded quantity changes, from samples at uneven times with noise and with the steps
 * of an encoder: the derivative of a parabola that is fitted to a window around each sample. The window is
 * the same for the whole record, and is chosen from the record itself. */
#include "host/numeric/derivative.h"

#include <math.h>
#include <stdbool.h>

/* Noise of a slope that is let pass, as a share of its rms. */
#define NOISE_SHARE 0.02

/* Slopes may change by so many times what noise explains (mean squares, of few independent samples). */
#define UNEXPLAINED 2.0

/* Samples that are so many usual steps apart are no neighbours. */
#define GAP 20.0

enum { WINDOW_LEAST = 5, STEPS_LEAST = 20, STILL_SHARE = 5, PROBES = 512, OVERLAP = 4 };

/* Blocks that a record is summed up in, and of how many of them a window is at least put together. */
enum { BLOCKS = 512, BLOCKS_LEAST = 4 };

/* ---- steps in time ---- */

/* The mean of the steps but for those that are more than `most` times as long. */
static double usual_step(const double *t, size_t n, double most)
{
    double usual = (t[n - 1] - t[0]) / (double)(n - 1), before;
    do {
        double sum = 0.0, count = 0.0;
        before = usual;
        for (size_t k = 1; k < n; ++k) {
            if (t[k] - t[k - 1] > most * before) continue;
            sum += t[k] - t[k - 1];
            count += 1.0;
        }
        usual = sum / count;
    } while (usual < before);
    return usual;
}

/* ---- noise ---- */

/* x[k] less the cubic through its four neighbours, over the standard deviation that has for unit noise. */
static double interpolation_residual(const double *t, const double *x, size_t k)
{
    const size_t at[4] = {k - 2, k - 1, k + 1, k + 2};
    double residual = x[k], variance = 1.0;
    for (int i = 0; i < 4; ++i) {
        double weight = 1.0;
        for (int j = 0; j < 4; ++j)
            if (j != i) weight *= (t[k] - t[at[j]]) / (t[at[i]] - t[at[j]]);
        residual -= weight * x[at[i]];
        variance += weight * weight;
    }
    return residual / sqrt(variance);
}

/* step_s: the usual one; what stands beside a gap says nothing of noise. */
static double noise_rms(const double *t, const double *x, size_t n, double step_s)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 2; k + 2 < n; ++k) {
        if (t[k + 2] - t[k - 2] > 4.0 * GAP * step_s) continue;
        const double residual = interpolation_residual(t, x, k);
        sum += residual * residual;
        count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

/* The step of an encoder that is slow against the sampling; 0 where x does not stand still between steps. */
static double quantum_of(const double *x, size_t n)
{
    double quantum = INFINITY;
    size_t still = 0;
    for (size_t k = 1; k < n; ++k) {
        const double step = fabs(x[k] - x[k - 1]);
        if (step > 0.0) quantum = fmin(quantum, step);
        still += !(step > 0.0);
    }
    return still * STILL_SHARE > n && isfinite(quantum) ? quantum : 0.0;
}

/* ---- the parabola ---- */

/* Sums about an origin near the samples, so that little cancels. */
typedef struct {
    double t0, x0, scale_s;
    double moment[5], product[3]; /* Σ u^j, Σ u^j v */
} sums_about;

/* Of a record, block by block. */
typedef struct {
    size_t size; /* samples of a block; 0: none are summed up */
    sums_about sum[BLOCKS];
} record_blocks;

/* Sums over the samples first … end − 1. */
typedef struct {
    const double *t, *x;
    const record_blocks *blocks; /* NULL: none */
    size_t first, end;
    sums_about sum;
} window_sums;

static inline void add_to(sums_about *s, double t, double x, double sign)
{
    const double u = (t - s->t0) / s->scale_s, v = x - s->x0;
    double power = sign;
    for (int j = 0; j < 5; ++j, power *= u) {
        s->moment[j] += power;
        if (j < 3) s->product[j] += power * v;
    }
}

static void add(window_sums *s, size_t k, double sign)
{
    add_to(&s->sum, s->t[k], s->x[k], sign);
}

/* Nothing yet, about the middle of so many samples. */
static sums_about sums_for(const double *t, const double *x, size_t first, size_t end)
{
    return (sums_about){.t0 = 0.5 * (t[first] + t[end - 1]),
                        .x0 = x[(first + end) / 2],
                        .scale_s = 0.5 * (t[end - 1] - t[first])};
}

/* Adds sums about another origin: with u = a u' + b and v = v' + d, by the binomial theorem. */
static void add_block(sums_about *s, const sums_about *block)
{
    static const double BINOMIAL[5][5] = {
        {1.0}, {1.0, 1.0}, {1.0, 2.0, 1.0}, {1.0, 3.0, 3.0, 1.0}, {1.0, 4.0, 6.0, 4.0, 1.0}};
    const double a = block->scale_s / s->scale_s, b = (block->t0 - s->t0) / s->scale_s, d = block->x0 - s->x0;
    double of_a[5] = {1.0}, of_b[5] = {1.0};
    for (int j = 1; j < 5; ++j) {
        of_a[j] = of_a[j - 1] * a;
        of_b[j] = of_b[j - 1] * b;
    }
    for (int j = 0; j < 5; ++j)
        for (int k = 0; k <= j; ++k) {
            const double weight = BINOMIAL[j][k] * of_a[k] * of_b[j - k];
            s->moment[j] += weight * block->moment[k];
            if (j < 3) s->product[j] += weight * (block->product[k] + d * block->moment[k]);
        }
}

static void blocks_make(const double *t, const double *x, size_t n, record_blocks *blocks)
{
    blocks->size = n / BLOCKS;
    for (size_t b = 0; b < BLOCKS && blocks->size > 1; ++b) {
        const size_t first = b * blocks->size, end = first + blocks->size;
        sums_about sum = sums_for(t, x, first, end);
        for (size_t k = first; k < end; ++k)
            add_to(&sum, t[k], x[k], 1.0);
        blocks->sum[b] = sum;
    }
}

/* Sums over samples about an origin; those that are added to are none of the samples, which the compiler does
 * not know. */
static sums_about range_add(const window_sums *s, sums_about sum, size_t first, size_t end)
{
    for (size_t k = first; k < end; ++k)
        add_to(&sum, s->t[k], s->x[k], 1.0);
    return sum;
}

static void start(window_sums *s, size_t first, size_t end)
{
    const size_t size = s->blocks ? s->blocks->size : 0, blocks_end = size * BLOCKS;
    sums_about sum = sums_for(s->t, s->x, first, end);
    s->first = first;
    s->end = end;
    if (size > 1 && end - first >= BLOCKS_LEAST * size) {
        const size_t from = (first + size - 1) / size * size;
        size_t k = from;
        sum = range_add(s, sum, first, from);
        for (; k + size <= end && k < blocks_end; k += size)
            add_block(&sum, &s->blocks->sum[k / size]);
        first = k;
    }
    s->sum = range_add(s, sum, first, end);
}

static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
}

/* Slope at time t of v = c_0 + c_1 u + c_2 u²; a straight line where the samples bear no parabola. */
static double rate_at(const window_sums *s, double t)
{
    const double *m = s->sum.moment, *v = s->sum.product, scale_s = s->sum.scale_s;
    const double u = (t - s->sum.t0) / scale_s;
    const double whole = determinant(m, m + 1, m + 2), line = m[0] * m[2] - m[1] * m[1];
    if (whole > 1e-9 * m[0] * m[2] * m[4]) {
        const double c1 = determinant(m, v, m + 2) / whole, c2 = determinant(m, m + 1, v) / whole;
        return (c1 + 2.0 * c2 * u) / scale_s;
    }
    return (m[0] * v[1] - m[1] * v[0]) / line / scale_s;
}

/* ---- how long a window must be ---- */

/* rms of the way over `window` samples. */
static double way_over(const double *x, size_t n, size_t window)
{
    double square = 0.0;
    for (size_t k = window - 1; k < n; ++k)
        square += (x[k] - x[k - window + 1]) * (x[k] - x[k - window + 1]);
    return sqrt(square / (double)(n - window + 1));
}

/* Slopes at some samples spread over the record; returns their mean square. */
static double probe(window_sums *s, size_t n, size_t window, size_t count, double *rate)
{
    double square = 0.0;
    for (size_t p = 0; p < count; ++p) {
        const size_t first = count > 1 ? p * (n - window) / (count - 1) : 0;
        start(s, first, first + window);
        rate[p] = rate_at(s, s->t[first + window / 2]);
        square += rate[p] * rate[p] / (double)count;
    }
    return square;
}

/* The next longer windows at the same samples: mean square of how the slopes change. */
static double change_by(window_sums *s, size_t n, size_t window, size_t next, size_t count,
                        const double *rate)
{
    double square = 0.0, used = 0.0;
    for (size_t p = 0; p < count; ++p) {
        const size_t first = count > 1 ? p * (n - window) / (count - 1) : 0, centre = first + window / 2;
        if (centre < next / 2 || centre - next / 2 + next > n) continue;
        start(s, centre - next / 2, centre - next / 2 + next);
        const double change = rate_at(s, s->t[centre]) - rate[p];
        square += change * change;
        used += 1.0;
    }
    return used > 0.0 ? square / used : 0.0;
}

/* Longer windows share their samples: so few of them that each sample is in OVERLAP. */
static size_t probes_of(size_t n, size_t window)
{
    const size_t most = n < PROBES ? n : PROBES, distinct = OVERLAP * n / window;
    return distinct < most ? distinct : most;
}

static size_t most_of(size_t n)
{
    return n / 4 > WINDOW_LEAST ? n / 4 : n < WINDOW_LEAST ? n : WINDOW_LEAST;
}

/* How the variance of a slope falls with the samples of a window: factor × noise² / samples^power. */
typedef struct {
    double noise, factor, power;
} noise_law;

/* Windows grow until the noise is small against the slope, or until the slopes change by more than noise
 * explains: then a longer one would smooth away what is to be seen (Lepski 1991). */
static size_t window_grow(window_sums *s, size_t n, size_t window, const noise_law *law)
{
    double rate[PROBES];
    record_blocks blocks;
    blocks_make(s->t, s->x, n, &blocks);
    s->blocks = &blocks;
    for (size_t next = window + window / 2; next <= most_of(n); window = next, next += next / 2) {
        const double length = (double)window, longer = (double)next;
        const size_t probes = probes_of(n, window);
        const double variance = law->factor * law->noise * law->noise / pow(length, law->power);
        const double square = probe(s, n, window, probes, rate) - variance;
        if (variance <= NOISE_SHARE * NOISE_SHARE * square) break;
        const double explained = variance * (1.0 - pow(length / longer, law->power));
        if (change_by(s, n, window, next, probes, rate) > UNEXPLAINED * explained) break;
    }
    s->blocks = NULL;
    return window;
}

/* The shortest window that bridges the steps of an encoder; at least `most`: none does. */
static size_t bridging(const window_sums *s, size_t n, double quantum)
{
    const size_t most = most_of(n);
    size_t window = most < WINDOW_LEAST ? most : WINDOW_LEAST;
    while (window < most && way_over(s->x, n, window) < STEPS_LEAST * quantum)
        window += window / 2;
    return window;
}

/* Noise of a sample. Quantum after quantum is noise that lasts for as many samples as a quantum does. */
static double noise_of(const window_sums *s, size_t n, size_t window, double quantum, double step_s)
{
    const double lasting = quantum > 0.0 ? (double)window * quantum / way_over(s->x, n, window) : 0.0;
    return fmax(noise_rms(s->t, s->x, n, step_s), quantum * sqrt(lasting / 12.0));
}

static size_t window_of(window_sums *s, size_t n)
{
    const double quantum = quantum_of(s->x, n), step_s = usual_step(s->t, n, GAP);
    const size_t window = bridging(s, n, quantum);
    if (window >= most_of(n)) return most_of(n);
    const noise_law law = {noise_of(s, n, window, quantum, step_s) / step_s, 12.0, 3.0};
    return window_grow(s, n, window, &law);
}

/* ---- pieces without a gap ---- */

/* Behind the last sample of the piece that begins with `first`. */
static size_t end_of_piece(const double *t, size_t n, size_t first, double most_s)
{
    size_t end = first + 1;
    while (end < n && t[end] - t[end - 1] <= most_s)
        ++end;
    return end;
}

/* Slopes at the samples from … end − 1 by windows between low and high. */
typedef struct {
    size_t from, end, low, high;
} range_of_slopes;

static void find_slopes(window_sums *s, range_of_slopes r, size_t window, double *rate)
{
    if (window > r.high - r.low) window = r.high - r.low;
    const size_t half = window / 2;
    size_t since_start = window;
    for (size_t k = r.from; k < r.end; ++k, ++since_start) {
        const size_t centred = k > r.low + half ? k - half : r.low;
        const size_t first = centred + window < r.high ? centred : r.high - window;
        if (since_start >= window) {
            start(s, first, first + window);
            since_start = 0;
        }
        if (first > s->first) {
            add(s, s->end++, 1.0);
            add(s, s->first++, -1.0);
        }
        rate[k] = rate_at(s, s->t[k]);
    }
}

size_t hci_derivative_window(const double *time_s, const double *x, size_t n)
{
    window_sums sums = {.t = time_s, .x = x};
    return window_of(&sums, n);
}

/* A parabola that is fitted to w samples with noise σ a step h apart has a second derivative with the
 * variance 720 σ²/(h⁴ w⁵). */
size_t hci_derivative_window_of_slope(const double *time_s, const double *x, const double *slope, size_t n)
{
    const window_sums read = {.t = time_s, .x = x};
    window_sums sums = {.t = time_s, .x = slope};
    const double quantum = quantum_of(x, n), step_s = usual_step(time_s, n, GAP);
    const size_t window = window_of(&sums, n), bridged = bridging(&read, n, quantum);
    const noise_law law = {noise_of(&read, n, bridged, quantum, step_s) / (step_s * step_s), 720.0, 5.0};
    return window_grow(&sums, n, window, &law);
}

void hci_derivative_over(const double *time_s, const double *x, size_t n, size_t window, double *rate)
{
    window_sums sums = {.t = time_s, .x = x};
    const double gap = fmax((double)window, GAP), gap_s = gap * usual_step(time_s, n, gap);
    for (size_t first = 0, end; first < n; first = end) {
        end = end_of_piece(time_s, n, first, gap_s);
        const bool is_long = end - first >= WINDOW_LEAST;
        find_slopes(&sums, (range_of_slopes){first, end, is_long ? first : 0, is_long ? end : n}, window,
                    rate);
    }
}

void hci_derivative(const double *time_s, const double *x, size_t n, double *rate)
{
    hci_derivative_over(time_s, x, n, hci_derivative_window(time_s, x, n), rate);
}
