/* The pointwise limit: at each angle the shortest current that makes the wanted torque,
 *     i(θ) = (T*(θ) − T_cog(θ)) e⊥ / (e⊥·e⊥)        e⊥ = e − mean(e) in a star connection. */
#include <math.h>

#include "balance.h"
#include "hci/fourier.h"
#include "hci/frames.h"
#include "memory.h"

enum { SAMPLES_PER_TURN = 2048, TOP_ORDER = 512 };

/* e⊥ and the torque that currents must make in two parts: per N·m of mean torque (1) and the rest. Returns e⊥·e⊥. */
static double wanted_at(const hci_task *t, double theta_rad, double e[3], double *rest_Nm)
{
    double mean;
    hci_waves_at(t->machine->back_emf, t->machine->back_emf_count, theta_rad, e);
    mean = t->has_neutral ? 0.0 : (e[0] + e[1] + e[2]) / 3.0;
    for (int s = 0; s < 3; ++s) e[s] -= mean;
    *rest_Nm = -hci_harmonics_at(t->machine->cogging, t->machine->cogging_count, theta_rad);
    for (size_t k = 0; k < t->target->count; ++k) {
        const hci_harmonic h = t->target->order[k].torque_Nm;
        if (h.order >= HCI_ORDER_TOLERANCE) *rest_Nm += hci_harmonics_at(&h, 1, theta_rad);
    }
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
}

/* e⊥·e⊥ is called zero below this share of the fundamental's. */
static double vanishing(const hci_task *t)
{
    double largest = 0.0;
    for (size_t k = 0; k < t->machine->back_emf_count; ++k)
        largest = fmax(largest, hci_amplitude(t->machine->back_emf[k].sine, t->machine->back_emf[k].cosine));
    return 1e-6 * largest * largest;
}

double hci_pointwise_mean_square_A2(const hci_task *task)
{
    const size_t count = SAMPLES_PER_TURN * task->period_turns;
    const double mean_Nm = hci_target_mean_Nm(task->target), floor_value = vanishing(task);
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        double e[3], rest_Nm;
        const double square = wanted_at(task, 2.0 * HCI_PI * (double)k / SAMPLES_PER_TURN, e, &rest_Nm);
        if (square <= floor_value) return NAN;
        sum += (mean_Nm + rest_Nm) * (mean_Nm + rest_Nm) / square;
    }
    return sum / (double)count;
}

/* Samples of α, β, zero of both parts: six rows of `count`. False where e⊥ vanishes. */
static bool sample(const hci_task *t, size_t count, double *row)
{
    const double floor_value = vanishing(t);
    for (size_t k = 0; k < count; ++k) {
        double e[3], rest_Nm;
        const double square = wanted_at(t, 2.0 * HCI_PI * (double)k / SAMPLES_PER_TURN, e, &rest_Nm);
        const hci_alpha_beta x = hci_clarke(e);
        if (square <= floor_value) return false;
        for (size_t part = 0; part < 2; ++part) {
            const double scale = (part == 0 ? 1.0 : rest_Nm) / square;
            row[(3 * part + 0) * count + k] = scale * x.alpha;
            row[(3 * part + 1) * count + k] = scale * x.beta;
            row[(3 * part + 2) * count + k] = scale * x.zero;
        }
    }
    return true;
}

/* Coordinates of the three sequences at one order from those of α, β and zero. With x_s = A sin(nθ − σ2πs/3 + γ), α has (S, C) and β
 * has (C, −S) for σ = +1 and (−C, S) for σ = −1; at order 0 the positive sequence alone spans the plane. */
static void sequences(const hci_harmonic a, const hci_harmonic b, const hci_harmonic zero, double x[3][2])
{
    const bool mean = a.order < HCI_ORDER_TOLERANCE;
    x[0][0] = mean ? -b.cosine : 0.5 * (a.sine - b.cosine);
    x[0][1] = mean ? a.cosine : 0.5 * (a.cosine + b.sine);
    x[1][0] = mean ? 0.0 : 0.5 * (a.sine + b.cosine);
    x[1][1] = mean ? 0.0 : 0.5 * (a.cosine - b.sine);
    x[2][0] = zero.sine;
    x[2][1] = zero.cosine;
}

/* The three components of one order go to positions 3k, 3k+1, 3k+2. */
static hci_status analyse(const hci_task *t, size_t count, const double *row, size_t k, size_t total,
                          hci_component_set *set, double *x)
{
    const double order = (double)k / (double)t->period_turns;
    static const hci_set NAME[3] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_ZERO};
    static const int SEQUENCE[3] = {1, -1, 0};
    for (size_t part = 0; part < 2; ++part) {
        hci_harmonic h[3];
        double coordinate[3][2];
        for (size_t q = 0; q < 3; ++q) {
            const hci_status status =
                hci_fourier_uniform(row + (3 * part + q) * count, count, t->period_turns, order, &h[q]);
            if (status) return status;
        }
        sequences(h[0], h[1], h[2], coordinate);
        for (size_t q = 0; q < 3; ++q) {
            set->component[3 * k + q] = (hci_component){order, SEQUENCE[q]};
            set->set[3 * k + q] = NAME[q];
            x[2 * total * part + 2 * (3 * k + q)] = coordinate[q][0];
            x[2 * total * part + 2 * (3 * k + q) + 1] = coordinate[q][1];
        }
    }
    return HCI_OK;
}

hci_status hci_pointwise_waves(const hci_task *task, hci_component_set *set, double **x, hci_note *note)
{
    const size_t count = SAMPLES_PER_TURN * task->period_turns, orders = TOP_ORDER * task->period_turns + 1;
    double *row = hci_memory_new(6 * count, sizeof *row);
    hci_status status = HCI_OK;
    *x = hci_memory_new(12 * orders, sizeof **x);
    set->component = hci_memory_new(3 * orders, sizeof *set->component);
    set->set = hci_memory_new(3 * orders, sizeof *set->set);
    if (!row || !*x || !set->component || !set->set)
        status = hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for %zu samples", count);
    if (!status && !sample(task, count, row))
        status = hci_note_set(note, HCI_ERROR_NUMERIC,
                              "the back-EMF of all phases vanishes at some angle, so no current makes torque there; "
                              "check back_emf.csv or solve with a set of harmonics");
    for (size_t k = 0; k < orders && !status; ++k) {
        status = analyse(task, count, row, k, 3 * orders, set, *x);
        if (task->progress) task->progress(task->progress_context, "Fourier analysis", (double)(k + 1) / (double)orders);
    }
    set->count = status ? 0 : 3 * orders;
    hci_memory_free(row);
    return status;
}
