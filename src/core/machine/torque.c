#include "hci/machine/torque.h"

#include <math.h>

#include "core/math/phases.h"
#include "core/math/turning.h"
#include "hci/machine/system.h"

/* Row and column of each stored entry of a phase matrix; entries off the diagonal stand for two. */
static const unsigned char ROW[HCI_PHASE_MATRIX] = {0, 1, 2, 0, 1, 2};
static const unsigned char COLUMN[HCI_PHASE_MATRIX] = {0, 1, 2, 1, 2, 0};

/* L' of the phase matrix, and its derivative by θ_m. */
static void slope_at(const hci_machine *m, double theta_rad, double slope[HCI_PHASE_MATRIX],
                     double by_angle[HCI_PHASE_MATRIX])
{
    for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q)
        slope[q] = by_angle[q] = 0.0;
    hci_turning at = HCI_TURNING;
    for (size_t k = 0; k < m->slope_count; ++k) {
        const hci_inductance_slope *t = &m->slope[k];
        hci_turning_to(&at, t->order, theta_rad);
        const double s = at.s, c = at.c;
        for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q) {
            slope[q] += t->sine[q] * s + t->cosine[q] * c;
            by_angle[q] += m->pole_pairs * t->order * (t->sine[q] * c - t->cosine[q] * s);
        }
    }
}

/* y = M i of a symmetric phase matrix; returns ½ i·y. */
static double form(const double matrix[HCI_PHASE_MATRIX], const double i[3], double y[3])
{
    y[0] = matrix[HCI_AA] * i[0] + matrix[HCI_AB] * i[1] + matrix[HCI_CA] * i[2];
    y[1] = matrix[HCI_AB] * i[0] + matrix[HCI_BB] * i[1] + matrix[HCI_BC] * i[2];
    y[2] = matrix[HCI_CA] * i[0] + matrix[HCI_BC] * i[1] + matrix[HCI_CC] * i[2];
    return 0.5 * (i[0] * y[0] + i[1] * y[1] + i[2] * y[2]);
}

void hci_torque_back_emf_at(const hci_machine *machine, double theta_rad, double e[3], double by_angle[3])
{
    for (size_t s = 0; s < 3; ++s)
        e[s] = by_angle[s] = 0.0;
    hci_turning at = HCI_TURNING;
    for (size_t k = 0; k < machine->back_emf_count; ++k) {
        const hci_wave *w = &machine->back_emf[k];
        const double n = machine->pole_pairs * w->order;
        hci_turning_to(&at, w->order, theta_rad);
        const double x = w->sine * at.s + w->cosine * at.c, y = w->sine * at.c - w->cosine * at.s;
        hci_phases_add(x, y, w->sequence, e);
        hci_phases_add(n * y, -n * x, w->sequence, by_angle);
    }
}

/* T_cog and its derivative by θ_m. */
static void cogging_at(const hci_machine *m, double theta_rad, double *torque_Nm, double *by_angle)
{
    hci_turning at = HCI_TURNING;
    *torque_Nm = *by_angle = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k) {
        const hci_harmonic *h = &m->cogging[k];
        hci_turning_to(&at, h->order, theta_rad);
        *torque_Nm += h->sine * at.s + h->cosine * at.c;
        *by_angle += m->pole_pairs * h->order * (h->sine * at.c - h->cosine * at.s);
    }
}

void hci_torque_parts_at(const hci_machine *machine, double theta_rad, hci_torque_parts *parts)
{
    parts->theta_rad = theta_rad;
    hci_torque_back_emf_at(machine, theta_rad, parts->e, parts->e_by_angle);
    slope_at(machine, theta_rad, parts->slope, parts->slope_by_angle);
    cogging_at(machine, theta_rad, &parts->cogging_Nm, &parts->cogging_by_angle);
}

hci_torque_slopes hci_torque_slopes_of(const hci_torque_parts *parts, const double i_abc[3])
{
    double y[3], unused[3];
    hci_torque_slopes sum = {.torque_Nm = 0.0};
    const double reluctance_Nm = form(parts->slope, i_abc, y);
    for (size_t s = 0; s < 3; ++s) {
        sum.torque_Nm += parts->e[s] * i_abc[s];
        sum.by_current[s] = parts->e[s] + y[s];
        sum.by_angle += parts->e_by_angle[s] * i_abc[s];
    }
    sum.torque_Nm += parts->cogging_Nm;
    sum.by_angle += parts->cogging_by_angle;
    sum.torque_Nm += reluctance_Nm;
    sum.by_angle += form(parts->slope_by_angle, i_abc, unused);
    return sum;
}

hci_torque_slopes hci_torque_slopes_at(const hci_machine *machine, double theta_rad, const double i_abc[3])
{
    hci_torque_parts parts;
    hci_torque_parts_at(machine, theta_rad, &parts);
    return hci_torque_slopes_of(&parts, i_abc);
}

/* e, and y = L'i. */
static void parts_at(const hci_machine *m, double theta_rad, const double i_abc[3], double e[3], double y[3])
{
    double slope[HCI_PHASE_MATRIX], unused[HCI_PHASE_MATRIX];
    hci_waves_at(m->back_emf, m->back_emf_count, theta_rad, e);
    slope_at(m, theta_rad, slope, unused);
    form(slope, i_abc, y);
}

double hci_torque_at(const hci_machine *machine, double theta_rad, const double i_abc[3])
{
    double e[3], y[3], torque = hci_harmonics_at(machine->cogging, machine->cogging_count, theta_rad);
    parts_at(machine, theta_rad, i_abc, e, y);
    for (size_t s = 0; s < 3; ++s)
        torque += (e[s] + 0.5 * y[s]) * i_abc[s];
    return torque;
}

void hci_torque_gradient_at(const hci_machine *machine, double theta_rad, const double i_abc[3],
                            double gradient[3])
{
    double e[3], y[3];
    parts_at(machine, theta_rad, i_abc, e, y);
    for (size_t s = 0; s < 3; ++s)
        gradient[s] = e[s] + y[s];
}

size_t hci_torque_orders_capacity(const hci_machine *machine, size_t current_count)
{
    const size_t pairs = current_count * (current_count + 1) / 2;
    return 1 + machine->cogging_count + 2 * machine->back_emf_count * current_count +
           4 * machine->slope_count * pairs;
}

/* A product of orders m, n, k has the orders |m ± (n ± k)|. */
static size_t reluctance_orders(double m, double n, double k, double *orders)
{
    orders[0] = fabs(m + (n + k));
    orders[1] = fabs(m - (n + k));
    orders[2] = fabs(m + (n - k));
    orders[3] = fabs(m - (n - k));
    return 4;
}

hci_status hci_torque_orders(const hci_machine *machine, const hci_wave *currents, size_t current_count,
                             double *orders, size_t capacity, size_t *count)
{
    size_t n = 0;
    if (capacity < hci_torque_orders_capacity(machine, current_count)) return HCI_ERROR_CAPACITY;
    orders[n++] = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k)
        orders[n++] = machine->cogging[k].order;
    for (size_t k = 0; k < current_count; ++k) {
        const hci_component c = {currents[k].order, currents[k].sequence};
        n += hci_component_orders(machine->back_emf, machine->back_emf_count, c, orders + n);
    }
    for (size_t t = 0; t < machine->slope_count; ++t)
        for (size_t j = 0; j < current_count; ++j)
            for (size_t k = 0; k <= j; ++k)
                n += reluctance_orders(machine->slope[t].order, currents[j].order, currents[k].order,
                                       orders + n);
    *count = hci_orders_sort(orders, n);
    return HCI_OK;
}

/* S sin x + C cos x is the imaginary part of (S + jC) e^{jx}. */
typedef struct {
    double re, im;
} phasor;

static phasor times(phasor a, phasor b)
{
    const phasor p = {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    return p;
}

static phasor conjugate(phasor a)
{
    const phasor p = {a.re, -a.im};
    return p;
}

/* Phasor of phase s of a wave: (S + jC) e^{−jσ2πs/3}. */
static phasor phase_phasor(const hci_wave *w, unsigned s)
{
    const phasor p = {w->sine, w->cosine};
    const phasor turn = {HCI_COS_THIRD, s == 1 ? -w->sequence * HCI_SIN_THIRD : w->sequence * HCI_SIN_THIRD};
    return s == 0 || w->sequence == 0 ? p : times(p, turn);
}

/* Adds Im(p e^{jmθ}) to the spectrum; a negative order folds onto −m with the phasor −p*. */
static void spectrum_add(const double *orders, size_t order_count, hci_harmonic *spectrum, double m, phasor p)
{
    const size_t at = hci_orders_find(orders, order_count, fabs(m));
    if (at == order_count) return;
    if (fabs(m) >= HCI_ORDER_TOLERANCE) spectrum[at].sine += m < 0.0 ? -p.re : p.re;
    spectrum[at].cosine += p.im;
}

/* The phasors of three phases at one order as waves of the three sequences: W_σ = ⅓ Σ_s Y_s e^{jσ2πs/3}. A
 * negative order folds onto the positive one: Im(Y e^{−jmθ}) = Im(−Y* e^{jmθ}). */
static void add_sequences(double order, const phasor y[3], hci_wave waves[3])
{
    for (int sequence = -1; sequence <= 1; ++sequence) {
        const phasor back = {HCI_COS_THIRD, sequence * HCI_SIN_THIRD},
                     ahead = {HCI_COS_THIRD, -sequence * HCI_SIN_THIRD};
        const phasor one = {1.0, 0.0};
        phasor sum = {0.0, 0.0};
        for (unsigned s = 0; s < 3; ++s) {
            const phasor folded = {order < 0.0 ? -y[s].re : y[s].re, y[s].im};
            const phasor turned = times(folded, s == 0 || sequence == 0 ? one : s == 1 ? back : ahead);
            sum.re += turned.re / 3.0;
            sum.im += turned.im / 3.0;
        }
        waves[sequence + 1] = (hci_wave){fabs(order), sequence, sum.re, sum.im};
        if (fabs(order) < HCI_ORDER_TOLERANCE && sequence == 0) waves[sequence + 1].sine = 0.0;
    }
}

/* One order of L' times one wave. Im(Λ e^{jmθ}) Im(I e^{jnθ}) = ½ Re(Λ I* e^{j(m−n)θ} − Λ I e^{j(m+n)θ}), and
 * Re(Z e^{jkθ}) = Im(jZ e^{jkθ}). */
static void slope_times_wave(const hci_inductance_slope *t, const hci_wave *i, hci_wave waves[6])
{
    phasor difference[3] = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}},
           sum[3] = {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    for (unsigned q = 0; q < HCI_PHASE_MATRIX; ++q) {
        for (unsigned mirrored = 0; mirrored <= (ROW[q] != COLUMN[q]); ++mirrored) {
            const unsigned row = mirrored ? COLUMN[q] : ROW[q], column = mirrored ? ROW[q] : COLUMN[q];
            const phasor slope = {0.5 * t->sine[q], 0.5 * t->cosine[q]}, current = phase_phasor(i, column);
            const phasor beat = times(slope, conjugate(current)), product = times(slope, current);
            difference[row].re += -beat.im;
            difference[row].im += beat.re;
            sum[row].re += product.im;
            sum[row].im += -product.re;
        }
    }
    add_sequences(t->order - i->order, difference, waves);
    add_sequences(t->order + i->order, sum, waves + 3);
}

size_t hci_slope_waves_capacity(const hci_machine *machine, size_t current_count)
{
    return 6 * machine->slope_count * current_count;
}

size_t hci_slope_waves(const hci_machine *machine, const hci_wave *currents, size_t current_count,
                       hci_wave *waves)
{
    size_t n = 0;
    for (size_t t = 0; t < machine->slope_count; ++t)
        for (size_t k = 0; k < current_count; ++k, n += 6)
            slope_times_wave(&machine->slope[t], &currents[k], waves + n);
    return hci_waves_join(waves, n, 1e-15);
}

/* ½ xᵀ L' y for one order of L' and two waves, closed form. With x = Im(X e^{jnθ}), y = Im(Y e^{jkθ}):  xy =
 * ½ Re(X Y* e^{j(n−k)θ} − X Y e^{j(n+k)θ}), and Im(Λ e^{jmθ}) Re(Z e^{jqθ}) = ½ Im(Λ Z e^{j(m+q)θ} + Λ Z*
 * e^{j(m−q)θ}). */
static void reluctance_pair(const hci_inductance_slope *t, const hci_wave *x, const hci_wave *y,
                            double weight, const double *orders, size_t order_count, hci_harmonic *spectrum)
{
    const double m = t->order, difference = x->order - y->order, sum = x->order + y->order;
    for (unsigned q = 0; q < HCI_PHASE_MATRIX; ++q) {
        for (unsigned mirrored = 0; mirrored <= (ROW[q] != COLUMN[q]); ++mirrored) {
            const phasor slope = {0.125 * weight * t->sine[q], 0.125 * weight * t->cosine[q]};
            const phasor minus = {-slope.re, -slope.im};
            const phasor a = phase_phasor(x, mirrored ? COLUMN[q] : ROW[q]);
            const phasor b = phase_phasor(y, mirrored ? ROW[q] : COLUMN[q]);
            const phasor beat = times(a, conjugate(b)), product = times(a, b);
            spectrum_add(orders, order_count, spectrum, m + difference, times(slope, beat));
            spectrum_add(orders, order_count, spectrum, m - difference, times(slope, conjugate(beat)));
            spectrum_add(orders, order_count, spectrum, m + sum, times(minus, product));
            spectrum_add(orders, order_count, spectrum, m - sum, times(minus, conjugate(product)));
        }
    }
}

void hci_torque_spectrum(const hci_machine *machine, const hci_wave *currents, size_t current_count,
                         const double *orders, size_t order_count, hci_harmonic *spectrum)
{
    for (size_t k = 0; k < order_count; ++k)
        spectrum[k] = (hci_harmonic){orders[k], 0.0, 0.0};
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const hci_harmonic *c = &machine->cogging[k];
        spectrum_add(orders, order_count, spectrum, c->order, (phasor){c->sine, c->cosine});
    }
    hci_system_add_torque(
        &(hci_mutual_torque){machine->back_emf, machine->back_emf_count, orders, order_count}, currents,
        current_count, spectrum);
    for (size_t t = 0; t < machine->slope_count; ++t)
        for (size_t j = 0; j < current_count; ++j)
            for (size_t k = 0; k <= j; ++k)
                reluctance_pair(&machine->slope[t], &currents[j], &currents[k], j == k ? 1.0 : 2.0, orders,
                                order_count, spectrum);
}
