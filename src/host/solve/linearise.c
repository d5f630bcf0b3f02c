/* A task made linear at some currents. T = e·i + ½iᵀL'i + T_cog is quadratic; at i_k
 *
 *     (e + L'i_k)·i = T* − T_cog + ½ i_kᵀ L' i_k                              theory.md, section 7
 *
 * is the linear problem with e + L'i_k in place of the back-EMF and the reluctance torque of i_k added to the
 * wanted one. A torque T_x of a higher degree is linearised alike: ∂T_x/∂i joins the gradient and ∂T_x/∂i·i_k
 * − T_x what is added. */
#include "host/solve/linearise.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/machine/sampled_torque.h"

#define NEGLIGIBLE_GRADIENT 1e-10 /* share of the largest wave of e + L'i */
#define NEGLIGIBLE_TORQUE                                                                                    \
    1e-13 /* share of the largest order: rounding, which would only blow up the system */

/* Orders that the currents have with the waves L'i. order: out, to be freed; NULL when memory is out. */
static double *reluctance_orders(const hci_wave_list *slope, const hci_wave *i, size_t count, size_t *orders)
{
    double *order = hci_memory_new(2 * slope->count * count + 1, sizeof *order);
    size_t n = 0;
    if (!order) return NULL;
    for (size_t k = 0; k < count; ++k)
        n += hci_component_orders(slope->wave, slope->count, (hci_component){i[k].order, i[k].sequence},
                                  order + n);
    *orders = hci_orders_sort(order, n);
    return order;
}

/* ½ i·(L'i) at every order that it has. slope: L'i. */
static hci_status half_product(const hci_wave_list *slope, const hci_wave *i, size_t count,
                               hci_harmonic_list *torque, hci_note *note)
{
    size_t n = 0;
    double *order = reluctance_orders(slope, i, count, &n);
    torque->harmonic = order ? hci_memory_new(n, sizeof *torque->harmonic) : NULL;
    torque->count = torque->harmonic ? n : 0;
    for (size_t k = 0; k < torque->count; ++k)
        torque->harmonic[k] = (hci_harmonic){order[k], 0.0, 0.0};
    if (torque->harmonic)
        hci_system_add_torque(&(hci_mutual_torque){slope->wave, slope->count, order, n}, i, count,
                              torque->harmonic);
    for (size_t k = 0; k < torque->count; ++k) {
        torque->harmonic[k].sine *= 0.5;
        torque->harmonic[k].cosine *= 0.5;
    }
    hci_memory_free(order);
    return torque->harmonic ? HCI_OK : hci_note_memory(note, NULL, "Newton's method");
}

static hci_status reluctance_torque(const hci_machine *m, const hci_wave *i, size_t count,
                                    hci_harmonic_list *torque, hci_note *note)
{
    hci_wave_list slope = {hci_memory_new(hci_slope_waves_capacity(m, count), sizeof *slope.wave), 0};
    hci_status status;
    if (!slope.wave) return hci_note_memory(note, NULL, "Newton's method");
    slope.count = hci_slope_waves(m, i, count, slope.wave);
    status = half_product(&slope, i, count, torque, note);
    hci_memory_free(slope.wave);
    return status;
}

static void drop_small(hci_harmonic_list *torque)
{
    double largest = 0.0;
    size_t kept = 0;
    for (size_t k = 0; k < torque->count; ++k)
        largest = fmax(largest, hci_amplitude(torque->harmonic[k].sine, torque->harmonic[k].cosine));
    for (size_t k = 0; k < torque->count; ++k) {
        const hci_harmonic h = torque->harmonic[k];
        if (hci_amplitude(h.sine, h.cosine) > NEGLIGIBLE_TORQUE * largest) torque->harmonic[kept++] = h;
    }
    torque->count = kept;
}

/* Appends gradient and offset of x to those of `to`. */
static hci_status append(const hci_linear_torque *x, hci_linear_torque *to, hci_note *note)
{
    hci_wave_list *g = &to->gradient;
    hci_harmonic_list *o = &to->offset;
    hci_wave *wave = hci_memory_resize(g->wave, g->count + x->gradient.count, sizeof *wave);
    if (wave) g->wave = wave;
    hci_harmonic *harmonic = hci_memory_resize(o->harmonic, o->count + x->offset.count, sizeof *harmonic);
    if (harmonic) o->harmonic = harmonic;
    if (!wave || !harmonic) return hci_note_memory(note, NULL, "Newton's method");
    memcpy(wave + g->count, x->gradient.wave, x->gradient.count * sizeof *wave);
    memcpy(harmonic + o->count, x->offset.harmonic, x->offset.count * sizeof *harmonic);
    g->count = hci_waves_join(wave, g->count + x->gradient.count, NEGLIGIBLE_GRADIENT);
    o->count += x->offset.count;
    return HCI_OK;
}

static hci_status append_higher(const hci_task *t, const hci_wave *i, size_t count, hci_linear_torque *at,
                                hci_note *note)
{
    const hci_torque_path path = {t->higher, t->period_turns, i, count};
    hci_linear_torque x;
    hci_status status = hci_sampled_torque_linearise(&path, &x, note);
    if (status) return status;
    status = append(&x, at, note);
    hci_linear_torque_release(&x);
    return status;
}

hci_status hci_task_linearise(hci_task *t, const hci_wave *i, size_t count, hci_linear_torque *at,
                              hci_note *note)
{
    hci_status status;
    hci_linear_torque_release(at);
    status = hci_torque_gradient(t->machine, i, count, NEGLIGIBLE_GRADIENT, &at->gradient, note);
    if (!status) status = reluctance_torque(t->machine, i, count, &at->offset, note);
    if (!status && t->higher) status = append_higher(t, i, count, at, note);
    if (status) return status;
    drop_small(&at->offset);
    t->gradient = at->gradient.wave;
    t->gradient_count = at->gradient.count;
    t->offset = at->offset.harmonic;
    t->offset_count = at->offset.count;
    return HCI_OK;
}
