/* The true torque of given currents. In: a task and star waves; out: the torque at every order that can
 * differ from nothing. (e + ½L'i)·i + T_cog is a list of products of waves (theory.md, sections 2 and 4), and
 * torque of a higher degree is sampled. */
#include "host/solve/torque_spectrum.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/machine/sampled_torque.h"
#include "host/numeric/fft.h"

#define NEGLIGIBLE 1e-12 /* waves of e + ½L'i below this share of the largest make no torque that matters */

/* A current with e + ½L'i, whose product with it is the mutual and reluctance torque, and the torque of a
 * higher degree. */
typedef struct {
    hci_wave_view current;
    hci_wave_list secant;
    hci_harmonic_list higher;
} acting;

static hci_status act(const hci_task *t, hci_wave_view current, acting *a, hci_note *note)
{
    const hci_torque_path path = {t->higher, t->period_turns, current.wave, current.count};
    hci_status status =
        hci_torque_secant(t->machine, current.wave, current.count, NEGLIGIBLE, &a->secant, note);
    a->current = current;
    if (!status && t->higher && current.count > 0) status = hci_sampled_torque(&path, &a->higher, note);
    return status;
}

static void release_acting(acting *a)
{
    hci_memory_free(a->secant.wave);
    hci_memory_free(a->higher.harmonic);
}

/* ---- orders ---- */

static size_t most_orders(const acting *a)
{
    return 2 * a->secant.count * a->current.count + a->higher.count;
}

static size_t orders_of(const acting *a, double *order)
{
    size_t n = 0;
    for (size_t k = 0; k < a->current.count; ++k) {
        const hci_wave *w = &a->current.wave[k];
        n += hci_component_orders(a->secant.wave, a->secant.count, (hci_component){w->order, w->sequence},
                                  order + n);
    }
    for (size_t k = 0; k < a->higher.count; ++k)
        order[n++] = a->higher.harmonic[k].order;
    return n;
}

static hci_status find_orders(const hci_task *t, const acting *first, const acting *second,
                              hci_torque_spectra *s, hci_note *note)
{
    const hci_machine *m = t->machine;
    s->order = hci_memory_new(
        1 + m->cogging_count + t->target->count + most_orders(first) + most_orders(second), sizeof *s->order);
    if (!s->order) return hci_note_memory(note, NULL, "the torque spectrum");
    s->order[s->count++] = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k)
        s->order[s->count++] = m->cogging[k].order;
    for (size_t k = 0; k < t->target->count; ++k)
        s->order[s->count++] = t->target->order[k].torque_Nm.order;
    s->count += orders_of(first, s->order + s->count);
    s->count += orders_of(second, s->order + s->count);
    s->count = hci_orders_sort(s->order, s->count);
    return HCI_OK;
}

/* ---- torque ---- */

static void add_harmonic(const hci_torque_spectra *s, hci_harmonic term, hci_harmonic *torque)
{
    const size_t at = hci_orders_find(s->order, s->count, term.order);
    torque[at].sine += term.sine;
    torque[at].cosine += term.cosine;
}

/* T = T_cog + T_x + (e + ½L'i)·i at every order. */
static void fill_torque(const hci_task *t, const hci_torque_spectra *s, const acting *a, hci_harmonic *torque)
{
    for (size_t k = 0; k < s->count; ++k)
        torque[k] = (hci_harmonic){s->order[k], 0.0, 0.0};
    for (size_t k = 0; k < t->machine->cogging_count; ++k)
        add_harmonic(s, t->machine->cogging[k], torque);
    for (size_t k = 0; k < a->higher.count; ++k)
        add_harmonic(s, a->higher.harmonic[k], torque);
    hci_system_add_torque(&(hci_mutual_torque){a->secant.wave, a->secant.count, s->order, s->count},
                          a->current.wave, a->current.count, torque);
}

/* *torque: the spectrum of one current, or NULL where memory is out. */
static bool make_torque(const hci_task *t, const hci_torque_spectra *s, const acting *a,
                        hci_harmonic **torque)
{
    *torque = hci_memory_new(s->count, sizeof **torque);
    if (*torque) fill_torque(t, s, a, *torque);
    return *torque != NULL;
}

hci_status hci_torque_spectra_make(const hci_task *task, hci_wave_view first, hci_wave_view second,
                                   hci_torque_spectra *s, hci_note *note)
{
    acting a = {0}, b = {0};
    hci_status status = act(task, first, &a, note);
    memset(s, 0, sizeof *s);
    if (!status) status = act(task, second, &b, note);
    if (!status) status = find_orders(task, &a, &b, s, note);
    if (!status &&
        (!make_torque(task, s, &a, &s->first) || (second.count > 0 && !make_torque(task, s, &b, &s->second))))
        status = hci_note_memory(note, NULL, "the torque spectrum");
    release_acting(&a);
    release_acting(&b);
    return status;
}

void hci_torque_spectra_release(hci_torque_spectra *s)
{
    hci_memory_free(s->order);
    hci_memory_free(s->first);
    hci_memory_free(s->second);
    memset(s, 0, sizeof *s);
}

hci_status hci_torque_spectrum_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                        hci_harmonic_list *torque, hci_note *note)
{
    const hci_wave_view all = {wave, count}, none = {wave, 0};
    hci_torque_spectra s;
    const hci_status status = hci_torque_spectra_make(task, all, none, &s, note);
    memset(torque, 0, sizeof *torque);
    if (!status) {
        *torque = (hci_harmonic_list){s.first, s.count};
        s.first = NULL;
    }
    hci_torque_spectra_release(&s);
    return status;
}

/* ---- error ---- */

double hci_torque_distance_Nm(hci_harmonic a, hci_harmonic b)
{
    return hci_amplitude(a.sine - b.sine, a.cosine - b.cosine);
}

hci_status hci_torque_error_evaluate(const hci_task *task, const hci_wave *wave, size_t count,
                                     hci_torque_error *error, hci_note *note)
{
    hci_harmonic_list torque;
    const hci_status status = hci_torque_spectrum_evaluate(task, wave, count, &torque, note);
    *error = (hci_torque_error){0.0, 0.0};
    for (size_t k = 0; k < torque.count; ++k) {
        const hci_harmonic h = torque.harmonic[k];
        const hci_target_order wanted = hci_target_at(task->target, h.order);
        const double amplitude_Nm = wanted.weight * hci_torque_distance_Nm(h, wanted.torque_Nm);
        error->worst_Nm = fmax(error->worst_Nm, amplitude_Nm);
        error->square_sum += amplitude_Nm * amplitude_Nm;
    }
    hci_memory_free(torque.harmonic);
    return status;
}

/* Samples in the period of the highest order: peaks between them are off by less than 1 − cos(π/16) of that
 * order. */
enum { SAMPLES_PER_PERIOD = 16, LEAST_SAMPLES = 1024 };

hci_status hci_torque_swing(const hci_harmonic_list *torque, size_t turns, double *swing_Nm, hci_note *note)
{
    const double top = torque->count > 0 ? torque->harmonic[torque->count - 1].order : 0.0;
    const size_t n = hci_fft_size(fmax(LEAST_SAMPLES, SAMPLES_PER_PERIOD * (top + 1.0)) * (double)turns);
    double *re = hci_memory_new(2 * n, sizeof *re), most, least;
    *swing_Nm = NAN;
    if (!re) return hci_note_memory(note, NULL, "the torque over the angle");
    double *const im = re + n;
    for (size_t k = 0; k < torque->count; ++k) {
        const size_t at = (size_t)floor(torque->harmonic[k].order * (double)turns + 0.5);
        re[at] += torque->harmonic[k].cosine; /* the real part of (C − jS) e^(jnθ) */
        im[at] -= torque->harmonic[k].sine;
    }
    hci_fft(re, im, n, 1);
    most = least = re[0];
    for (size_t k = 1; k < n; ++k) {
        most = fmax(most, re[k]);
        least = fmin(least, re[k]);
    }
    hci_memory_free(re);
    *swing_Nm = most - least;
    return HCI_OK;
}

double hci_percent_of_mean(double value_Nm, double mean_Nm)
{
    return mean_Nm == 0.0 ? (double)NAN : 100.0 * value_Nm / fabs(mean_Nm);
}
