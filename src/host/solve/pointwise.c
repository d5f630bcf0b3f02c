/* Currents found angle by angle. In: a task; out: the currents of a strategy as waves, and the copper of the
 * shortest, by which every other solution is measured. Without reluctance torque the shortest that make the
 * wanted torque are
 *
 *     i(θ) = (T*(θ) − T_cog(θ)) e⊥ / (e⊥·e⊥)        e⊥ = e − mean(e) in a star connection, else e
 *
 * which is linear in the torque (theory.md, section 6); where the current keeps its angle in the rotor frame,
 * with what of e⊥ lies along it. All else is left to hci_strategy_current (section 8) and kept_angle.c.
 */
#include "host/solve/pointwise.h"

#include <math.h>
#include <string.h>

#include "core/math/vector.h"
#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/numeric/fft.h"
#include "host/solve/kept_angle.h"

enum { SAMPLES_PER_TURN = 2048, TOP_ORDER = 512 };

#define VANISHING 1e-6 /* share of the square of the largest harmonic, below which e⊥·e⊥ is called zero */
#define SHORTER   1e-6 /* share by which a current has to be shorter to be taken instead */

/* The ripple that is wanted beside the mean. */
static double wanted_ripple_Nm(const hci_task *t, double theta_rad)
{
    double sum_Nm = 0.0;
    for (size_t k = 0; k < t->target->count; ++k) {
        const hci_harmonic h = t->target->order[k].torque_Nm;
        if (h.order >= HCI_ORDER_TOLERANCE) sum_Nm += hci_harmonics_at(&h, 1, theta_rad);
    }
    return sum_Nm;
}

/* e⊥ and the torque that currents must make beside the mean. Returns e⊥·e⊥. */
static double wanted_at(const hci_task *t, double theta_rad, double e[3], double *rest_Nm)
{
    double mean;
    hci_waves_at(t->machine->back_emf, t->machine->back_emf_count, theta_rad, e);
    mean = t->has_neutral ? 0.0 : (e[0] + e[1] + e[2]) / 3.0;
    for (int s = 0; s < 3; ++s)
        e[s] -= mean;
    *rest_Nm = wanted_ripple_Nm(t, theta_rad) -
               hci_harmonics_at(t->machine->cogging, t->machine->cogging_count, theta_rad);
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
}

/* e⊥·e⊥ is called zero below this, in (N·m/A)². */
static double vanishing(const hci_task *t)
{
    double largest = 0.0;
    for (size_t k = 0; k < t->machine->back_emf_count; ++k)
        largest = fmax(largest, hci_amplitude(t->machine->back_emf[k].sine, t->machine->back_emf[k].cosine));
    return VANISHING * largest * largest;
}

/* Angles at which a period is looked at: at least SAMPLES_PER_TURN a turn, and a power of two. */
static size_t samples_of(const hci_task *t)
{
    return hci_fft_size((double)(SAMPLES_PER_TURN * t->period_turns));
}

/* Sample k of a period. */
static double angle_rad(const hci_task *t, size_t k)
{
    return 2.0 * HCI_PI * (double)t->period_turns * (double)k / (double)samples_of(t);
}

/* Whether the currents are (T* − T_cog) e⊥/(e⊥·e⊥), which is linear in the torque. */
static bool is_linear(const hci_task *t)
{
    return hci_task_is_linear(t) && (t->strategy == HCI_STRATEGY_MTPA || t->current_angle_rad);
}

static double linear_mean_square_A2(const hci_task *t)
{
    const size_t count = samples_of(t);
    const double mean_Nm = hci_target_mean_Nm(t->target), floor_value = vanishing(t);
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        double e[3], rest_Nm;
        const double square = wanted_at(t, angle_rad(t, k), e, &rest_Nm);
        if (square <= floor_value) return NAN;
        sum += (mean_Nm + rest_Nm) * (mean_Nm + rest_Nm) / square;
    }
    return sum / (double)count;
}

/* The torque at one angle, and what of it is above the second degree. */
typedef struct {
    hci_machine_point point;
    const hci_effects_plant *higher;
    double theta_rad;
} angle;

static double smooth_torque(const void *context, const double x[2], double gradient[2])
{
    const angle *a = context;
    const double *h = a->point.slope;
    double by[2];
    hci_sample s = {0};
    gradient[0] = a->point.e[0] + h[0] * x[0] + h[1] * x[1];
    gradient[1] = a->point.e[1] + h[1] * x[0] + h[2] * x[1];
    if (!a->higher) return hci_point_torque_Nm(&a->point, x);
    s.theta_m_rad = a->theta_rad / a->higher->machine->pole_pairs;
    s.temperature_C = a->higher->temperature_C;
    hci_plane_to_abc(x, s.i_abc);
    const hci_effect_torque t = hci_effects_torque(a->higher->machine, a->higher->effects, &s, NULL);
    hci_plane_from_abc(t.by_current, by);
    gradient[0] += by[0];
    gradient[1] += by[1];
    return hci_point_torque_Nm(&a->point, x) + t.torque_Nm;
}

/* Angles a turn at which the shortest of all currents is looked for afresh. */
enum { SEARCHES_PER_TURN = 32 };

/* Along the range of the angle before, and now and then in all directions, since another range may have
 * become the shorter one. x: in and out. */
static hci_status shortest_smooth(const hci_smooth_torque *torque, const hci_machine_point *point, size_t k,
                                  double wanted_Nm, double x[2])
{
    const double before[2] = {x[0], x[1]};
    double found[2];
    hci_status status = HCI_NOT_REACHED, searched;
    if (k > 0) status = hci_strategy_smooth_current(torque, point, HCI_STRATEGY_MTPA, wanted_Nm, before, x);
    if (!status && k % (SAMPLES_PER_TURN / SEARCHES_PER_TURN) != 0) return HCI_OK;
    searched = hci_strategy_smooth_current(torque, point, HCI_STRATEGY_MTPA, wanted_Nm, NULL, found);
    if (k == 0 ||
        (!searched && (status || hypot(found[0], found[1]) < (1.0 - SHORTER) * hypot(x[0], x[1])))) {
        x[0] = found[0];
        x[1] = found[1];
    }
    return status && searched ? HCI_NOT_REACHED : HCI_OK;
}

/* x: in the current of sample k − 1, out that of sample k. least_iq_A: out, may be NULL; NAN where it is not
 * known. */
static hci_status current_at(const hci_task *t, hci_strategy strategy, size_t k, double wanted_Nm,
                             double x[2], double *least_iq_A)
{
    const angle a = {hci_machine_at(t->machine, angle_rad(t, k)), t->higher, angle_rad(t, k)};
    const hci_smooth_torque torque = {smooth_torque, &a};
    const double before[2] = {x[0], x[1]};
    if (!t->higher)
        return hci_strategy_current(&a.point, strategy, wanted_Nm, k > 0 ? before : NULL, x, least_iq_A);
    if (least_iq_A) *least_iq_A = 0.0;
    if (least_iq_A && strategy == HCI_STRATEGY_CANCEL) *least_iq_A = NAN;
    if (strategy == HCI_STRATEGY_MTPA) return shortest_smooth(&torque, &a.point, k, wanted_Nm, x);
    return hci_strategy_smooth_current(&torque, &a.point, strategy, wanted_Nm, k > 0 ? before : NULL, x);
}

/* The same where the current keeps its angle in the rotor frame. */
static hci_status kept_at(const hci_task *t, size_t k, double wanted_Nm, double x[2])
{
    const angle a = {hci_machine_at(t->machine, angle_rad(t, k)), t->higher, angle_rad(t, k)};
    const hci_smooth_torque torque = {smooth_torque, &a};
    return hci_kept_angle_current(&torque, a.theta_rad, *t->current_angle_rad, wanted_Nm, x);
}

/* ---- a sine along a kept angle ---- */

enum { STEPS = 30 };

#define ENOUGH 1e-12 /* of the mean torque */

/* Mean torque of a sine over a period, and its slope by the length in the plane. */
static double mean_along(const hci_task *t, double length, double *slope)
{
    const size_t count = samples_of(t);
    double sum_Nm = 0.0;
    *slope = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const angle a = {hci_machine_at(t->machine, angle_rad(t, k)), t->higher, angle_rad(t, k)};
        double u[2], gradient[2];
        hci_kept_angle_direction(a.theta_rad, *t->current_angle_rad, u);
        const double x[2] = {length * u[0], length * u[1]};
        sum_Nm += smooth_torque(&a, x, gradient) / (double)count;
        *slope += (gradient[0] * u[0] + gradient[1] * u[1]) / (double)count;
    }
    return sum_Nm;
}

hci_wave hci_pointwise_kept_sine(const hci_task *t)
{
    const double wanted_Nm = hci_target_mean_Nm(t->target);
    double length = 0.0, slope, error_Nm = mean_along(t, 0.0, &slope) - wanted_Nm;
    for (int k = 0; k < STEPS && fabs(error_Nm) > ENOUGH * fabs(wanted_Nm); ++k) {
        length -= error_Nm / slope;
        error_Nm = mean_along(t, length, &slope) - wanted_Nm;
    }
    const bool found = fabs(error_Nm) <= ENOUGH * fabs(wanted_Nm);
    const double amplitude_A = found ? sqrt(2.0 / 3.0) * length : 0.0;
    return (hci_wave){1.0, 1, amplitude_A * cos(*t->current_angle_rad),
                      amplitude_A * sin(*t->current_angle_rad)};
}

/* ---- the shortest currents ---- */

double hci_pointwise_mean_square_A2(const hci_task *task)
{
    const size_t count = samples_of(task);
    const double mean_Nm = hci_target_mean_Nm(task->target);
    double sum = 0.0, x[2] = {0.0, 0.0};
    if (hci_task_is_linear(task)) return linear_mean_square_A2(task);
    for (size_t k = 0; k < count; ++k) {
        const double wanted_Nm = mean_Nm + wanted_ripple_Nm(task, angle_rad(task, k));
        if (current_at(task, HCI_STRATEGY_MTPA, k, wanted_Nm, x, NULL)) return NAN;
        sum += x[0] * x[0] + x[1] * x[1];
    }
    return sum / (double)count;
}

static void store(double *row, size_t count, size_t k, size_t part, double scale, const double abc[3])
{
    const hci_alpha_beta x = hci_clarke(abc);
    row[(3 * part + 0) * count + k] = scale * x.alpha;
    row[(3 * part + 1) * count + k] = scale * x.beta;
    row[(3 * part + 2) * count + k] = scale * x.zero;
}

/* Samples of α, β, zero of both parts: six rows of `count`. False where e⊥ vanishes. */
static bool sample_linear(const hci_task *t, size_t count, double *row)
{
    const double floor_value = vanishing(t);
    for (size_t k = 0; k < count; ++k) {
        double e[3], rest_Nm;
        double square = wanted_at(t, angle_rad(t, k), e, &rest_Nm);
        if (t->current_angle_rad) square = hci_kept_angle_project(angle_rad(t, k), *t->current_angle_rad, e);
        if (square <= floor_value) return false;
        store(row, count, k, 0, 1.0 / square, e);
        store(row, count, k, 1, rest_Nm / square, e);
    }
    return true;
}

/* An angle has no answer: it lengthens the last gap or, after an angle that has one, opens a new one. */
static void note_gap(hci_solution *s, double theta_rad, bool is_new)
{
    if (is_new && s->gap_count < HCI_MOST_GAPS) s->gap[s->gap_count].from_rad = theta_rad;
    if (is_new) ++s->gap_count;
    if (s->gap_count <= HCI_MOST_GAPS) s->gap[s->gap_count - 1].to_rad = theta_rad;
}

/* The same for any strategy and machine; everything is in the second part. */
static void sample_strategy(const hci_task *t, size_t count, double *row, hci_solution *s)
{
    const double mean_Nm = hci_target_mean_Nm(t->target), to_amplitude = sqrt(2.0 / 3.0);
    const double nothing[3] = {0.0, 0.0, 0.0};
    double x[2] = {0.0, 0.0};
    bool in_gap = false;
    for (size_t k = 0; k < count && !hci_task_goes_on(t, NULL); ++k) {
        const double wanted_Nm = mean_Nm + wanted_ripple_Nm(t, angle_rad(t, k));
        double abc[3], least_iq_A = 0.0;
        const hci_status found = t->current_angle_rad
                                     ? kept_at(t, k, wanted_Nm, x)
                                     : current_at(t, t->strategy, k, wanted_Nm, x, &least_iq_A);
        const bool is_missing = found != HCI_OK;
        if (is_missing) note_gap(s, angle_rad(t, k), !in_gap);
        in_gap = is_missing;
        s->least_iq_A = fmax(s->least_iq_A, to_amplitude * least_iq_A);
        if (isnan(least_iq_A)) s->least_iq_A = least_iq_A;
        hci_plane_to_abc(x, abc);
        store(row, count, k, 0, 0.0, nothing);
        store(row, count, k, 1, 1.0, abc);
        if (t->progress)
            t->progress(t->progress_context, "currents at each angle", (double)(k + 1) / (double)count);
    }
}

/* Coordinates of the three sequences at one order from those of α, β and zero. With x_s = A sin(nθ − σ2πs/3 +
 * γ), α has (S, C) and β has (C, −S) for σ = +1 and (−C, S) for σ = −1; at order 0 the positive sequence
 * alone spans the plane. */
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

/* Samples of α, β, zero of both parts, and where their waves go. */
typedef struct {
    const hci_task *task;
    size_t count, orders; /* samples of a row, orders that are taken */
    double *row;          /* six rows of `count` */
    hci_answer *answer;   /* three components for each order */
} analysis;

/* The rows that are transformed together: α and β of either part, zero of both. */
static const size_t PAIR[3][2] = {{0, 1}, {3, 4}, {2, 5}};

static void transform(const analysis *a)
{
    for (size_t q = 0; q < 3; ++q)
        hci_fft(a->row + PAIR[q][0] * a->count, a->row + PAIR[q][1] * a->count, a->count, -1);
}

/* The three components of one order go to positions 3k, 3k+1, 3k+2. Expects rows that are transformed. */
static void analyse(const analysis *a, size_t k)
{
    static const hci_set NAME[3] = {HCI_SET_POS, HCI_SET_NEG, HCI_SET_ZERO};
    static const int SEQUENCE[3] = {1, -1, 0};
    const size_t turns = a->task->period_turns;
    hci_harmonic h[6];
    for (size_t q = 0; q < 3; ++q) {
        const hci_fft_pair pair = {a->row + PAIR[q][0] * a->count, a->row + PAIR[q][1] * a->count, a->count,
                                   turns};
        hci_fft_bin(&pair, k, &h[PAIR[q][0]], &h[PAIR[q][1]]);
    }
    for (size_t part = 0; part < 2; ++part) {
        double coordinate[3][2], *x = a->answer->x + 6 * a->orders * part + 6 * k;
        sequences(h[3 * part], h[3 * part + 1], h[3 * part + 2], coordinate);
        memcpy(x, coordinate, sizeof coordinate);
    }
    for (size_t q = 0; q < 3; ++q) {
        a->answer->set.component[3 * k + q] = (hci_component){(double)k / (double)turns, SEQUENCE[q]};
        a->answer->set.set[3 * k + q] = NAME[q];
    }
}

/* A sample that is not finite makes each order not finite. */
static hci_status analyse_all(const analysis *a)
{
    transform(a);
    for (size_t k = 0; k < a->orders; ++k)
        analyse(a, k);
    return hci_vector_finite(12 * a->orders, a->answer->x) ? HCI_OK : HCI_ERROR_NOT_FINITE;
}

/* Along one direction there is nothing else to be had: the torque turns round before. */
static hci_status refuse_gaps(const hci_task *t, const hci_solution *s, hci_note *note)
{
    return hci_note_set(
        note, HCI_ERROR_NUMERIC,
        "no current of this direction makes %.4g N·m in the model, at %zu range%s of angle, the first from "
        "%.4g electrical degrees: with more current its torque falls again, as that of no motor does; ask "
        "for "
        "less torque, or find the model from recordings at several loads up to there",
        hci_target_mean_Nm(t->target), s->gap_count, s->gap_count == 1 ? "" : "s",
        s->gap[0].from_rad * 180.0 / HCI_PI);
}

static hci_status sample(const hci_task *t, size_t count, double *row, hci_solution *s, hci_note *note)
{
    if (!is_linear(t)) {
        sample_strategy(t, count, row, s);
        const hci_status status = hci_task_goes_on(t, note);
        return status || !t->current_angle_rad || s->gap_count == 0 ? status : refuse_gaps(t, s, note);
    }
    if (sample_linear(t, count, row)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_NUMERIC,
        "the back-EMF of all phases vanishes at some angle, so no current makes torque there; check "
        "back_emf.csv or solve with a set of harmonics");
}

hci_status hci_pointwise_answer(const hci_task *task, hci_answer *answer, hci_solution *solution,
                                hci_note *note)
{
    analysis a = {.task = task,
                  .count = samples_of(task),
                  .orders = TOP_ORDER * task->period_turns + 1,
                  .answer = answer};
    hci_status status = hci_answer_reserve(3 * a.orders, answer);
    a.row = hci_memory_new(6 * a.count, sizeof *a.row);
    if (status || !a.row) status = hci_note_memory(note, NULL, "%zu samples", a.count);
    if (!status) status = sample(task, a.count, a.row, solution, note);
    if (!status) status = analyse_all(&a);
    if (status) answer->set.count = 0;
    solution->method = HCI_METHOD_POINTWISE;
    solution->condition = NAN;
    hci_memory_free(a.row);
    return status;
}
