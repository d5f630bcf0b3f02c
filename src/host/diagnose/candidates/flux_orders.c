#include "host/diagnose/candidates/flux_orders.h"

#include <math.h>

#include "host/base/memory.h"

#define STANDS_OUT 20.0 /* fall of χ² of the cogging torque alone */
#define SAME_GAIN  0.3  /* relative difference of two gains that could be one; magnets make it 1 */
#define AGREES     0.8  /* share of what the two explain apart that they explain together */

enum { LOAD, TEETH, KINDS };

/* Sums over all samples. */
typedef struct {
    size_t count;          /* periods 1 … count */
    double *wave;          /* [count][KINDS][2]: cosine and sine */
    double square[KINDS];  /* Σ w x² */
    double product[KINDS]; /* Σ w r x */
    double square_of_both; /* Σ w (x + x)² */
} sums;

static bool shows(const hci_candidates_source *s, size_t run)
{
    const hci_run *r = &s->runs[run];
    return s->use[run] && !r->only_mean && r->torque_source != HCI_TORQUE_HOLDING;
}

/* The torque with the currents, and twice the cogging torque. */
static void torques_at(const hci_machine *machine, const hci_sample *x, double torque_Nm[KINDS])
{
    static const double none[3] = {0.0, 0.0, 0.0};
    const double theta_rad = machine->pole_pairs * x->theta_m_rad;
    double e[3], slope[3];
    hci_torque_back_emf_at(machine, theta_rad, e, slope);
    torque_Nm[LOAD] = e[0] * x->i_abc[0] + e[1] * x->i_abc[1] + e[2] * x->i_abc[2];
    torque_Nm[TEETH] = 2.0 * hci_torque_at(machine, theta_rad, none);
}

/* weighted: residual. */
static void sample_add(sums *sum, double theta_m_rad, double weighted, const double torque_Nm[KINDS])
{
    const double c = cos(theta_m_rad), s = sin(theta_m_rad);
    double x = 1.0, y = 0.0;
    for (size_t k = 0; k < sum->count; ++k) {
        const double next = c * x - s * y;
        y = s * x + c * y;
        x = next;
        for (size_t kind = 0; kind < KINDS; ++kind) {
            sum->wave[2 * (KINDS * k + kind)] += weighted * torque_Nm[kind] * x;
            sum->wave[2 * (KINDS * k + kind) + 1] += weighted * torque_Nm[kind] * y;
        }
    }
}

static void segment_add(const hci_candidates_source *s, const hci_segment *segment, sums *sum)
{
    double mean = 0.0, whole = 0.0;
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        mean += s->residual_Nm[j] / s->variance[j];
        whole += 1.0 / s->variance[j];
    }
    for (size_t j = segment->first; j < segment->first + segment->count; ++j) {
        const hci_sample *x = &s->samples->sample[j].reading;
        const double w = 1.0 / s->variance[j];
        double torque_Nm[KINDS];
        torques_at(s->machine, x, torque_Nm);
        sample_add(sum, x->theta_m_rad, w * (s->residual_Nm[j] - mean / whole), torque_Nm);
        for (int kind = 0; kind < KINDS; ++kind) {
            sum->square[kind] += w * torque_Nm[kind] * torque_Nm[kind];
            sum->product[kind] += w * torque_Nm[kind] * s->residual_Nm[j];
        }
        sum->square_of_both += w * pow(torque_Nm[LOAD] + torque_Nm[TEETH], 2.0);
    }
}

static double fall_of(double cosine, double sine, double square)
{
    return square > 0.0 ? 2.0 * (cosine * cosine + sine * sine) / square : 0.0;
}

/* What unequal magnets of one order would explain; 0 where cogging and load do not tell the same. */
static double strength(const sums *sum, size_t k)
{
    const double *load = sum->wave + 2 * (KINDS * k + LOAD), *teeth = sum->wave + 2 * (KINDS * k + TEETH);
    const double by_load = fall_of(load[0], load[1], sum->square[LOAD]);
    const double by_teeth = fall_of(teeth[0], teeth[1], sum->square[TEETH]);
    const double both = fall_of(load[0] + teeth[0], load[1] + teeth[1], sum->square_of_both);
    return by_teeth > STANDS_OUT && both > AGREES * (by_load + by_teeth) ? both : 0.0;
}

/* The strongest first. */
static size_t strongest(const sums *sum, int pole_pairs, size_t most, double *order)
{
    double under = INFINITY;
    for (size_t n = 0; n < most; ++n) {
        size_t best = sum->count;
        double above = 0.0;
        for (size_t k = 0; k < sum->count; ++k) {
            const double x = strength(sum, k);
            if (x >= under || x <= above) continue;
            above = x;
            best = k;
        }
        if (best == sum->count) return n;
        under = above;
        order[n] = (double)(best + 1) / pole_pairs;
    }
    return most;
}

/* The share of a gain that both torques show: by the same, and each plainly. */
static bool is_one_gain(const sums *sum)
{
    double share[KINDS];
    for (int kind = 0; kind < KINDS; ++kind) {
        if (!(sum->square[kind] > 0.0)) return false;
        share[kind] = sum->product[kind] / sum->square[kind];
        if (share[kind] * sum->product[kind] < STANDS_OUT) return false;
    }
    share[TEETH] *= 2.0;
    return fabs(share[TEETH] - share[LOAD]) < SAME_GAIN * fabs(share[LOAD]);
}

bool hci_flux_orders_find(const hci_candidates_source *s, bool has_turn, hci_flux_orders *x)
{
    sums sum = {.count = has_turn ? (size_t)s->machine->pole_pairs - 1 : 0};
    x->count = 0;
    x->one_gain = false;
    if (s->machine->cogging_count == 0) return true;
    sum.wave = hci_memory_new(2 * KINDS * sum.count + 1, sizeof *sum.wave);
    if (!sum.wave) return false;
    for (size_t k = 0; k < s->samples->segment_count; ++k)
        if (shows(s, s->samples->segment[k].run)) segment_add(s, &s->samples->segment[k], &sum);
    x->count = strongest(&sum, s->machine->pole_pairs, HCI_FLUX_ORDERS, x->order);
    x->one_gain = is_one_gain(&sum);
    hci_memory_free(sum.wave);
    return true;
}
