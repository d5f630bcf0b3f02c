#include "host/recording/computed_torque.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/recording/rotor_frame.h"
#include "host/recording/untold_torque.h"

#define DIGITS 1e-6 /* of the largest torque: numbers in files have seven digits or more */
#define VARIES 1e-2 /* of the largest current */

enum { LEAST = 16 };

static double largest_of(const double *x, size_t n)
{
    double most = 0.0;
    for (size_t k = 0; k < n; ++k)
        most = fmax(most, fabs(x[k]));
    return most;
}

#define STILL 1e-3 /* of the currents: less is rounding */

/* Other than 0, over the angle. */
static bool is_one_number(const hci_run *run)
{
    if (run->count < LEAST || run->theta_m_rad == NULL || !(fabs(run->torque_Nm[0]) > 0.0)) return false;
    for (size_t k = 1; k < run->count; ++k)
        if (run->torque_Nm[k] < run->torque_Nm[0] || run->torque_Nm[k] > run->torque_Nm[0]) return false;
    return true;
}

bool hci_torque_is_typed(const hci_run *run)
{
    double mean = 0.0, square = 0.0, size = 0.0;
    const double share = 1.0 / (double)run->count;
    if (!is_one_number(run)) return false;
    for (size_t k = 0; k < run->count; ++k) {
        const hci_dq i_A = hci_run_dq(run, run->pole_pairs, k);
        mean += share * i_A.q;
        square += share * i_A.q * i_A.q;
        size += share * (i_A.d * i_A.d + i_A.q * i_A.q);
    }
    return square - mean * mean > STILL * STILL * size;
}

#define SAME    1e-9 /* of a torque: one number */
#define ANOTHER 0.1  /* of the largest current of the list */

static double mean_size_of(const hci_run *run)
{
    double sum_A = 0.0;
    for (size_t k = 0; k < run->count; ++k)
        sum_A += hci_run_dq(run, run->pole_pairs, k).q;
    return fabs(sum_A) / (double)run->count;
}

static double largest_size_of(const hci_run *runs, size_t count)
{
    double most_A = 0.0;
    for (size_t k = 0; k < count; ++k)
        most_A = fmax(most_A, mean_size_of(&runs[k]));
    return most_A;
}

static bool is_at_another(const hci_run *a, const hci_run *b, double most_A)
{
    return fabs(mean_size_of(a) - mean_size_of(b)) > ANOTHER * most_A;
}

/* One number that another run has as well, where that was typed, or at another current. */
static bool is_typed_beside(const hci_run *a, const hci_run *b, double most_A)
{
    const double number_Nm = a->torque_Nm[0];
    const bool counts = b->torque_is_typed || (b->torque_Nm != NULL && is_one_number(b));
    if (!counts) return false;
    const double other_Nm = b->torque_is_typed ? b->torque_typed_Nm : b->torque_Nm[0];
    if (fabs(other_Nm - number_Nm) > SAME * fabs(number_Nm)) return false;
    return b->torque_is_typed || is_at_another(a, b, most_A);
}

static void typed_leave(hci_run *run)
{
    hci_note_add(&run->remark,
                 "the torque is %.6g N·m in every row, as in other recordings: typed, or of a sensor that "
                 "stands still, and not measured. It tells the mean alone and is not used",
                 run->torque_Nm[0]);
    run->torque_is_typed = true;
    run->torque_typed_Nm = run->torque_Nm[0];
    run->torque_source = HCI_TORQUE_NONE;
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
}

void hci_torques_typed_leave(hci_run *runs, size_t count)
{
    const double most_A = largest_size_of(runs, count);
    for (size_t k = 0; k < count; ++k) {
        bool typed = false;
        if (runs[k].torque_source != HCI_TORQUE_MEASURED || !is_one_number(&runs[k])) continue;
        for (size_t j = 0; j < count && !typed; ++j)
            typed = j != k && is_typed_beside(&runs[k], &runs[j], most_A);
        if (typed) typed_leave(&runs[k]);
    }
}

static bool is_at_one_end(const hci_run *a, const hci_run *b, double most_A)
{
    const double end_Nm = fabs(a->torque_typed_Nm);
    return a->torque_is_typed && b->torque_is_typed && end_Nm > 0.0 &&
           fabs(fabs(b->torque_typed_Nm) - end_Nm) <= SAME * end_Nm && is_at_another(a, b, most_A);
}

static const char *file_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void hci_torques_at_one_end_tell(hci_run *runs, size_t count)
{
    const double most_A = largest_size_of(runs, count);
    for (size_t k = 0; k < count; ++k)
        for (size_t j = 0; j < count && runs[k].torque_is_typed; ++j) {
            if (j == k || !is_at_one_end(&runs[k], &runs[j], most_A)) continue;
            runs[k].torque_is_clipped = true;
            hci_note_add(&runs[k].remark,
                         "%.60s has the torque %.6g N·m at another current: both are the end of the torque "
                         "sensor or of its input, and the torque was clipped",
                         file_of(runs[j].name), runs[j].torque_typed_Nm);
            break;
        }
}

bool hci_torque_is_of_current(const double *torque_Nm, const double *iq_A, size_t n, double *constant)
{
    if (n < LEAST) return false;
    const double most_Nm = largest_of(torque_Nm, n), most_A = largest_of(iq_A, n);
    double square = 0.0, product = 0.0;
    for (size_t k = 0; k < n; ++k) {
        square += iq_A[k] * iq_A[k];
        product += iq_A[k] * torque_Nm[k];
    }
    if (!(square > 0.0) || !(most_Nm > 0.0)) return false;
    *constant = product / square;
    const double step_A = hci_quantum(iq_A, n, DIGITS * most_A);
    const double rounding_Nm = 2.0 * (hci_quantum(torque_Nm, n, DIGITS * most_Nm) + fabs(*constant) * step_A);
    const double range_Nm = fabs(*constant) * hci_peak_to_peak(iq_A, n);
    if (range_Nm < VARIES * most_Nm || range_Nm < 4.0 * rounding_Nm) return false;
    for (size_t k = 0; k < n; ++k)
        if (fabs(torque_Nm[k] - *constant * iq_A[k]) > rounding_Nm) return false;
    return true;
}

/* ---- behind a filter ---- */

#define STEPS_OF_FILES 2.5e-5 /* of the rms: six digits or more, second differences two steps */
#define ROUNDING       1.5    /* times what rounding leaves, rms */
#define SHOWS          4.0    /* times what rounding leaves, by which the torque has to vary */
#define SHORTEST       0.1    /* of a sample, and … */
#define LONGEST        200.0  /* … so many: time constants that are tried */
#define STEPS          48
#define OF_NOISE       0.25 /* of the square of a torque that noise of the current describes */
#define WHITE          0.2  /* correlation of neighbouring samples that noise of sensors has at most */
#define IDLE           0.2  /* of its rms is the mean of such an i_q at most */
#define LEAST_FACTOR   0.7  /* of the declared torque constant … */
#define MOST_FACTOR    1.4  /* … between which that of an estimate is */

enum { LEAST_ROWS = 256, MOST = 16384, SETTLED = 32 };

/* Torque and i_q of the first samples of a run, and what a low pass makes of the one. */
typedef struct {
    const double *time_s;
    double *torque_Nm, *iq_A, *filtered_A; /* [count] */
    size_t count, first;                   /* the first one at which a low pass has settled */
    double step_s;
    double best, time_constant_s, constant;
} series;

/* ---- the low pass ---- */

/* i_q behind a low pass between whose samples it is straight; of no time constant: i_q. */
static void filter(series *s, double time_constant_s)
{
    double y = s->iq_A[0];
    memcpy(s->filtered_A, s->iq_A, s->count * sizeof *s->iq_A);
    if (!(time_constant_s > 0.0)) return;
    for (size_t k = 1; k < s->count; ++k) {
        const double step_s = s->time_s[k] - s->time_s[k - 1];
        const double before_A = s->iq_A[k - 1];
        const double lag_A = step_s > 0.0 ? (s->iq_A[k] - before_A) / step_s * time_constant_s : 0.0;
        y = s->iq_A[k] - lag_A + (y - before_A + lag_A) * exp(-step_s / time_constant_s);
        s->filtered_A[k] = y;
    }
}

/* Mean square of what is left of the torque less its share of the filtered current. constant: out. */
static double left_behind(const series *s, double *constant)
{
    double square = 0.0, product = 0.0, left = 0.0;
    for (size_t k = s->first; k < s->count; ++k) {
        square += s->filtered_A[k] * s->filtered_A[k];
        product += s->filtered_A[k] * s->torque_Nm[k];
    }
    *constant = square > 0.0 ? product / square : 0.0;
    for (size_t k = s->first; k < s->count; ++k) {
        const double x = s->torque_Nm[k] - *constant * s->filtered_A[k];
        left += x * x;
    }
    return left / (double)(s->count - s->first);
}

static double try_time(series *s, double time_constant_s)
{
    double constant;
    filter(s, time_constant_s);
    const double left = left_behind(s, &constant);
    if (left < s->best) {
        s->best = left;
        s->time_constant_s = time_constant_s;
        s->constant = constant;
    }
    return left;
}

/* The low pass that leaves least: on a grid, then between its neighbours, or none. */
static void fit(series *s)
{
    const double ratio = pow(LONGEST / SHORTEST, 1.0 / STEPS);
    s->best = INFINITY;
    for (int k = 0; k <= STEPS; ++k)
        try_time(s, SHORTEST * s->step_s * pow(ratio, k));
    double low = s->time_constant_s / ratio, high = s->time_constant_s * ratio;
    while (high > 1.002 * low) {
        const double third = pow(high / low, 1.0 / 3.0);
        if (try_time(s, low * third) < try_time(s, high / third))
            high /= third;
        else
            low *= third;
    }
    try_time(s, 0.0);
}

/* ---- a run ---- */

static void series_release(series *s)
{
    hci_memory_free(s->torque_Nm);
}

static bool has_all(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_MEASURED && run->torque_Nm && run->time_s && run->theta_m_rad &&
           run->i_A && run->count >= LEAST_ROWS;
}

static hci_status series_make(const hci_run *run, series *s, hci_note *note)
{
    memset(s, 0, sizeof *s);
    s->count = run->count < MOST ? run->count : MOST;
    s->first = SETTLED;
    s->time_s = run->time_s;
    s->step_s = (run->time_s[s->count - 1] - run->time_s[0]) / (double)(s->count - 1);
    s->torque_Nm = hci_memory_new(3 * s->count, sizeof *s->torque_Nm);
    if (!s->torque_Nm) return hci_note_memory(note, NULL, "a torque beside its current");
    s->iq_A = s->torque_Nm + s->count;
    s->filtered_A = s->iq_A + s->count;
    for (size_t k = 0; k < s->count; ++k) {
        s->torque_Nm[k] = run->torque_Nm[k];
        s->iq_A[k] = hci_run_dq(run, run->pole_pairs, k).q;
    }
    return HCI_OK;
}

static double rms_of(const double *x, size_t n)
{
    return sqrt(hci_mean_square_about(x, n, 0.0));
}

/* rms that rounding leaves: a step over √12. */
static double rounding_of(const double *x, size_t n)
{
    return hci_quantum(x, n, STEPS_OF_FILES * rms_of(x, n)) / sqrt(12.0);
}

#define OF_THREE 0.816 /* √(2/3): of the rounding of a phase in i_q, where all three were recorded … */
#define OF_TWO   1.155 /* … √(4/3): and where the third was made of two */

/* Of i_q, by its own steps or those of the phase currents that it was turned from. */
static double rounding_of_current(const hci_run *run, const series *s)
{
    const bool of_phases = run->has_sum || run->computed_phase > 0;
    double most_A = rounding_of(s->iq_A, s->count);
    for (size_t phase = 0; phase < 3 && of_phases; ++phase) {
        for (size_t k = 0; k < s->count; ++k)
            s->filtered_A[k] = run->i_A[3 * k + phase];
        most_A = fmax(most_A, (run->has_sum ? OF_THREE : OF_TWO) * rounding_of(s->filtered_A, s->count));
    }
    return most_A;
}

static bool is_near(double constant, double declared)
{
    return constant > 0.0 &&
           (!(declared > 0.0) || (constant > LEAST_FACTOR * declared && constant < MOST_FACTOR * declared));
}

/* Takes the mean and the part of an electrical order out, which zeros of sensors make. */
static void order_leave(const hci_run *run, double order, double *x, size_t n)
{
    double c = 0.0, s = 0.0, cc = 0.0, ss = 0.0;
    for (size_t k = 0; k < n; ++k) {
        const double angle = order * run->pole_pairs * run->theta_m_rad[k];
        c += x[k] * cos(angle), s += x[k] * sin(angle);
        cc += cos(angle) * cos(angle), ss += sin(angle) * sin(angle);
    }
    for (size_t k = 0; k < n; ++k) {
        const double angle = order * run->pole_pairs * run->theta_m_rad[k];
        x[k] -= c / cc * cos(angle) + (ss > 0.0 ? s / ss * sin(angle) : 0.0);
    }
}

/* Whether i_q is the noise of sensors: about no mean, and neighbouring samples have nothing in common. */
static bool is_noise(const double *x, size_t n, double mean)
{
    double square = 0.0, product = 0.0;
    for (size_t k = 1; k < n; ++k) {
        square += x[k] * x[k];
        product += x[k] * x[k - 1];
    }
    return square > 0.0 && fabs(product) < WHITE * square && mean * mean < IDLE * IDLE * square / (double)n;
}

/* What the noise of the current sensors describes of a torque without a current. */
static void judge_idle(const hci_run *run, series *s, double declared, hci_torque_estimate *e)
{
    const double mean_A = hci_mean(s->iq_A, s->count);
    for (int order = 0; order <= 2; ++order)
        order_leave(run, order, s->iq_A, s->count);
    if (!is_noise(s->iq_A, s->count, mean_A)) return;
    order_leave(run, 0.0, s->torque_Nm, s->count);
    const double all = hci_mean_square_about(s->torque_Nm + s->first, s->count - s->first, 0.0);
    e->tells = all > 0.0;
    if (!e->tells) return;
    fit(s);
    e->constant_Nm_per_A = s->constant;
    e->time_constant_s = s->time_constant_s;
    e->is_of_noise = is_near(s->constant, declared) && s->best < (1.0 - OF_NOISE) * all;
}

static void judge_rounding(const hci_run *run, series *s, double declared, hci_torque_estimate *e)
{
    const double torque_Nm = rounding_of(s->torque_Nm, s->count), current_A = rounding_of_current(run, s);
    fit(s);
    filter(s, s->time_constant_s);
    const double rounding_Nm = hypot(torque_Nm, s->constant * current_A);
    const double about = hci_mean(s->filtered_A, s->count);
    const double varies_Nm = s->constant * sqrt(hci_mean_square_about(s->filtered_A, s->count, about));
    e->constant_Nm_per_A = s->constant;
    e->time_constant_s = s->time_constant_s;
    e->within_rounding = is_near(s->constant, declared) && varies_Nm > SHOWS * rounding_Nm &&
                         sqrt(s->best) < ROUNDING * rounding_Nm;
    e->tells = varies_Nm > SHOWS * rounding_Nm;
}

hci_status hci_torque_estimate_of(const hci_run *run, double torque_constant, hci_torque_estimate *e,
                                  hci_note *note)
{
    series s;
    memset(e, 0, sizeof *e);
    if (!has_all(run)) return HCI_OK;
    const hci_status status = series_make(run, &s, note);
    if (status) return status;
    if (s.step_s > 0.0) judge_rounding(run, &s, torque_constant, e);
    if (s.step_s > 0.0 && !e->within_rounding) {
        hci_torque_estimate idle = {0};
        judge_idle(run, &s, torque_constant, &idle);
        if (idle.tells) *e = idle;
    }
    series_release(&s);
    return HCI_OK;
}

/* ---- a list ---- */

static bool is_shown(const hci_torque_estimate *e)
{
    return e->within_rounding || e->is_of_noise;
}

static hci_status leave(hci_run *run, const hci_torque_estimate *e, const hci_run_options *options,
                        hci_note *note)
{
    if (is_shown(e) && !(e->time_constant_s > 0.0))
        hci_note_add(&run->remark,
                     "the torque is %.4g N·m/A times i_q in every row%s: computed from the current and not "
                     "measured, it is not used",
                     e->constant_Nm_per_A, e->within_rounding ? "" : ", down to the noise of its sensors");
    else if (is_shown(e))
        hci_note_add(&run->remark,
                     "the torque is %.4g N·m/A times i_q behind a filter of %.3g ms%s: estimated from the "
                     "current and not measured, it is not used",
                     e->constant_Nm_per_A, 1e3 * e->time_constant_s,
                     e->within_rounding ? "" : ", down to the noise of the current sensors");
    else
        hci_note_add(&run->remark,
                     "the torque of the other recordings was estimated from the current and not "
                     "measured: that of this one is not used either");
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    run->torque_source = HCI_TORQUE_NONE;
    return hci_untold_torque_set(run, options, false, note);
}

hci_status hci_estimated_torques_leave(hci_run *runs, size_t count, const hci_run_options *options,
                                       hci_note *note)
{
    size_t tell = 0, shown = 0;
    hci_status status = HCI_OK;
    hci_torque_estimate *e = hci_memory_new(count + 1, sizeof *e);
    if (!e) return hci_note_memory(note, NULL, "%zu recordings", count);
    for (size_t k = 0; k < count && !status; ++k) {
        status = hci_torque_estimate_of(&runs[k], options->torque_constant_Nm_per_A, &e[k], note);
        tell += e[k].tells;
        shown += is_shown(&e[k]);
    }
    const bool all = 2 * shown > tell;
    for (size_t k = 0; k < count && !status; ++k)
        if (runs[k].torque_source == HCI_TORQUE_MEASURED && (all || is_shown(&e[k])))
            status = leave(&runs[k], &e[k], options, note);
    hci_memory_free(e);
    return status;
}
