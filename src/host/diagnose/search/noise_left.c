#include "host/diagnose/search/noise_left.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"

#define EXCESS       0.1  /* variance over that of the noise that tells of something that does not repeat */
#define CLUMPS       1.35 /* the same of how uneven the errors are; noise makes 1 … */
#define SPREAD       4.0  /* … give or take a deviation, of which so many are still noise */
#define FOLLOWS      0.1 /* share of a residual that the rate of the modelled torque describes, which noise … */
#define LATE         1.0  /* … and an acceleration that is taken between samples do not, in samples */
#define OUTLYING     6.0  /* times the noise */
#define OF_SLOPES    8.0  /* the same where that is of a slope, and has not the same size all along */
#define FEW          5e-4 /* share of outliers that may be left out */
#define LEAST_BLOCKS 50.0 /* to tell from how uneven errors are */

enum { BLOCK = 24 }; /* samples */

/* Sums over the segments by which the residual is compared with the noise. */
typedef struct {
    double square, noise, rows;         /* residual and noise, N²·m² */
    double block, block_square, blocks; /* sums of whitened squares over short blocks */
    double left, follows, rate; /* of free shafts: residual², × rate of the modelled torque, rate² */
    double time_s, steps;       /* of them */
    double few_square, few_noise, few_rows; /* of segments that are too short for a spectrum */
} goodness;

static void blocks_add(const double *whitened, size_t n, goodness *g)
{
    for (size_t j = HCI_NOISE_MEMORY; j + BLOCK <= n; j += BLOCK) {
        double sum = 0.0;
        for (size_t k = j; k < j + BLOCK; ++k)
            sum += whitened[k] * whitened[k];
        g->block += sum;
        g->block_square += sum * sum;
        g->blocks += 1.0;
    }
}

/* Leaves out single samples that no noise explains, unless they are many. */
static void outliers_drop(double *whitened, double *residual, size_t n, double outlying)
{
    size_t count = 0;
    for (size_t j = 0; j < n; ++j)
        count += fabs(whitened[j]) > outlying;
    for (size_t j = 0; j < n && (double)count <= FEW * (double)n + 1.0; ++j)
        if (fabs(whitened[j]) > outlying) whitened[j] = residual[j] = 0.0;
}

/* How much the size of the errors varies along a run, over what noise does: the variance of a block's sum
 * relative to its mean is 2/BLOCK for noise. */
static double clumps_of(const goodness *g)
{
    if (g->blocks < LEAST_BLOCKS) return 1.0;
    const double mean = g->block / g->blocks;
    return (g->block_square / g->blocks - mean * mean) / (mean * mean) * 0.5 * BLOCK;
}

/* Whether noise has the same size all along a run: that of an acceleration, a slope of readings, has not,
 * where the speed changes. */
static bool has_even_noise(const hci_search *s, const hci_segment *x)
{
    return s->regression->runs[x->run].torque_source != HCI_TORQUE_INERTIA;
}

/* How the residual of a free shaft goes with the rate of the modelled torque, as where a current was read
 * late or behind a filter: its noise is that of a slope, and long misfits at steps of the current pass for
 * it. */
static void following_add(const hci_search *s, const hci_segment *x, const double *residual, goodness *g)
{
    const hci_binned_sample *b = s->regression->samples->sample + x->first;
    for (size_t k = 1; k + 1 < x->count; ++k) {
        const double time_s = b[k + 1].time_s - b[k - 1].time_s;
        const double rise_Nm = b[k + 1].torque_Nm - residual[k + 1] - b[k - 1].torque_Nm + residual[k - 1];
        const double rate = time_s > 0.0 ? rise_Nm / time_s : 0.0;
        g->left += residual[k] * residual[k];
        g->follows += residual[k] * rate;
        g->rate += rate * rate;
        g->time_s += 0.5 * time_s;
        g->steps += 1.0;
    }
}

static bool is_late(const goodness *g)
{
    return g->follows * g->follows > FOLLOWS * g->left * g->rate &&
           fabs(g->follows) * g->steps > LATE * g->time_s * g->rate;
}

/* Means of many samples have less noise than those of few: as if all were of as many. */
static void counts_even(const hci_search *s, const hci_segment *x, double *whitened)
{
    const hci_binned_sample *sample = s->regression->samples->sample + x->first;
    double sum = 0.0, telling = 0.0;
    for (size_t j = 0; j < x->count; ++j) {
        if (!(sample[j].count > 0.0)) continue;
        sum += 1.0 / sample[j].count;
        telling += 1.0;
    }
    for (size_t j = 0; j < x->count && x->turns > 0; ++j)
        whitened[j] *= sqrt(sample[j].count * sum / telling);
}

/* A segment that has less than its noise, as where that was estimated too large, is none of uneven errors for
 * that. */
static void noise_even(const hci_segment *x, double *whitened)
{
    double square = 0.0;
    for (size_t j = 0; j < x->count; ++j)
        square += whitened[j] * whitened[j];
    const double mean = square / (double)x->count;
    for (size_t j = 0; j < x->count && mean < 1.0 && mean > 0.0; ++j)
        whitened[j] /= sqrt(mean);
}

static void goodness_add(const hci_search *s, const hci_segment *x, double *whitened, goodness *g)
{
    const hci_noise *noise = hci_regression_noise(s->regression, x);
    const double telling = (double)hci_segment_telling(s->regression->samples, x);
    const double square = telling * noise->rms * noise->rms, joined = hci_segment_joined(x);
    double *residual = s->residual_Nm + x->first;
    memcpy(whitened, residual, x->count * sizeof *whitened);
    hci_noise_whiten(noise, whitened, x->count, 1);
    counts_even(s, x, whitened);
    outliers_drop(whitened, residual, x->count, has_even_noise(s, x) ? OUTLYING : OF_SLOPES);
    for (size_t j = 0; j < x->count; ++j)
        g->square += residual[j] * residual[j];
    g->square += (joined - 1.0) * square;
    g->noise += joined * square;
    g->rows += telling;
    noise_even(x, whitened);
    if (has_even_noise(s, x))
        blocks_add(whitened, x->count, g);
    else if (x->timed)
        following_add(s, x, residual, g);
}

/* Of few samples the noise is in what neighbours differ by; what they have in common is not. */
static void few_add(const hci_search *s, const hci_segment *x, goodness *g)
{
    const double *residual = s->residual_Nm + x->first;
    const double own = hypot(hci_noise_of_neighbours(residual, x->count), s->resolution_Nm);
    if (!isfinite(own) || x->turns > 0) return;
    for (size_t j = 0; j < x->count; ++j)
        g->few_square += residual[j] * residual[j];
    g->few_noise += (double)x->count * own * own;
    g->few_rows += (double)x->count;
}

static hci_status goodness_of(hci_search *s, const hci_candidates *model, goodness *g, hci_note *note)
{
    double *whitened = hci_memory_new(hci_segment_longest(s->regression->samples), sizeof *whitened);
    memset(g, 0, sizeof *g);
    if (!whitened) return hci_note_memory(note, NULL, "judging the residual");
    const hci_status status = hci_search_noise(s, model, note);
    for (const hci_segment *x = NULL; !status && (x = hci_regression_next(s->regression, x)) != NULL;)
        if (x->count >= HCI_NOISE_LEAST)
            goodness_add(s, x, whitened, g);
        else
            few_add(s, x, g);
    hci_memory_free(whitened);
    return status;
}

/* How uneven noise may be in so many blocks: the variance of a sum of k squares of noise, from n of them, is
 * known to √((2 + 12/k)/n). */
static double most_clumps(const goodness *g)
{
    return fmax(CLUMPS, 1.0 + SPREAD * sqrt((2.0 + 12.0 / BLOCK) / fmax(1.0, g->blocks)));
}

static bool is_long_noise(const goodness *g)
{
    return !(g->rows > 0.0) ||
           (g->square < (1.0 + EXCESS) * g->noise && clumps_of(g) < most_clumps(g) && !is_late(g));
}

/* The ratio of both is 1 ± √(3/n) for noise. */
static bool is_few_noise(const goodness *g)
{
    return !(g->few_rows > 0.0) || g->few_square < (1.0 + SPREAD * sqrt(3.0 / g->few_rows)) * g->few_noise;
}

static bool is_noise(const goodness *g)
{
    return is_long_noise(g) && is_few_noise(g);
}

hci_status hci_noise_left_find(hci_search *s, const hci_candidates *model, hci_noise_left *left,
                               hci_note *note)
{
    goodness g;
    const hci_status status = goodness_of(s, model, &g, note);
    *left = (hci_noise_left){.rows = g.rows + g.few_rows,
                             .square_Nm2 = g.square + g.few_square,
                             .noise_Nm2 = g.noise + g.few_noise,
                             .wanders = !is_long_noise(&g),
                             .is_noise = is_noise(&g)};
    return status;
}

hci_status hci_search_is_noise(hci_search *s, const hci_candidates *model, bool *noise, hci_note *note)
{
    hci_noise_left left;
    const hci_status status = hci_noise_left_find(s, model, &left, note);
    *noise = !status && left.is_noise;
    return status;
}
