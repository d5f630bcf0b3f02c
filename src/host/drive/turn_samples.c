#include "host/drive/turn_samples.h"

#include <math.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "host/base/memory.h"
#include "host/drive/effect_winding.h"
#include "host/numeric/fft.h"

enum { SAMPLES_OF_A_TURN = 2048 };

/* ---- one angle ---- */

/* Current and its slope by the electrical angle, in the plane. */
static void current_at(const hci_loop_level *level, double theta_rad, hci_plane_current *i)
{
    double abc[3], sum[3] = {0.0, 0.0, 0.0}, one[3];
    hci_waves_at(level->waves, level->count, theta_rad, abc);
    for (size_t k = 0; k < level->count; ++k) {
        const hci_wave *w = &level->waves[k];
        const hci_wave derived = {w->order, w->sequence, -w->order * w->cosine, w->order * w->sine};
        hci_waves_at(&derived, 1, theta_rad, one);
        for (int s = 0; s < 3; ++s)
            sum[s] += one[s];
    }
    hci_plane_from_abc(abc, i->x);
    hci_plane_from_abc(sum, i->slope);
}

/* (e + L'i)/p, what both the machine needs and a decoupling adds. */
static void motional(const hci_plant_point *p, int pole_pairs, const double i[2], double v[2])
{
    const double *e = p->magnetic.e, *h = p->magnetic.slope;
    v[0] = (e[0] + h[0] * i[0] + h[1] * i[1]) / pole_pairs;
    v[1] = (e[1] + h[1] * i[0] + h[2] * i[1]) / pole_pairs;
}

static void put(hci_turn_samples *x, int first, size_t k, const double plane[2], double theta_rad)
{
    const double scale = sqrt(2.0 / 3.0), s = sin(theta_rad), c = cos(theta_rad);
    x->value[first][k] = scale * (-c * plane[0] - s * plane[1]);
    x->value[first + 1][k] = scale * (s * plane[0] - c * plane[1]);
}

/* ∂ψ/∂θ + L di/dθ, all effects included. */
static void terminal(const hci_machine_model *machine, double theta_rad, const hci_plane_current *i,
                     double v[2])
{
    const int p = machine->table.pole_pairs;
    const hci_plant_point at = hci_plant_table_at(&machine->table, theta_rad / p);
    const double *l = at.inductance_H;
    double more_Vs[2] = {0.0, 0.0}, ignored_H[3];
    motional(&at, p, i->x, v);
    v[0] += l[0] * i->slope[0] + l[1] * i->slope[1];
    v[1] += l[1] * i->slope[0] + l[2] * i->slope[1];
    hci_effects_add_flux_slope(&machine->machine, machine->effects, (double)NAN, theta_rad, i, more_Vs,
                               ignored_H);
    v[0] += more_Vs[0] / p;
    v[1] += more_Vs[1] / p;
}

/* What a decoupling adds at the current that is meant. */
static void decoupling(const hci_machine_model *own, double theta_rad, const double i[2], double v[2])
{
    const int p = own->table.pole_pairs;
    const hci_plant_point known = hci_plant_table_at(&own->table, theta_rad / p);
    const double *m = known.inductance_H;
    motional(&known, p, i, v);
    v[0] += m[1] * i[0] - m[0] * i[1];
    v[1] += m[2] * i[0] - m[1] * i[1];
}

static void sample(const hci_machine_model *machine, const hci_machine_model *own,
                   const hci_loop_level *level, size_t k, hci_turn_samples *x)
{
    const double theta = 2.0 * HCI_PI * (double)x->turns * (double)k / (double)x->samples;
    hci_plane_current i;
    double v[2];
    current_at(level, theta, &i);
    put(x, HCI_TURN_CURRENT, k, i.x, theta);
    terminal(machine, theta, &i, v);
    put(x, HCI_TURN_VOLTAGE, k, v, theta);
    if (!own) return;
    decoupling(own, theta, i.x, v);
    put(x, HCI_TURN_OWN, k, v, theta);
}

/* ---- the turn ---- */

static hci_status find_turns(const hci_machine_model *machine, const hci_loop_level *level, size_t *turns,
                             hci_note *note)
{
    const int p = machine->table.pole_pairs;
    *turns = (size_t)machine->table.turns;
    for (size_t k = 0; k < level->count; ++k) {
        const double order = level->waves[k].order;
        if (fabs(order * p - floor(order * p + 0.5)) > HCI_ORDER_TOLERANCE * p)
            return hci_note_set(
                note, HCI_ERROR_INPUT,
                "currents: order %g is no multiple of 1/%d, so that it does not repeat after a "
                "mechanical turn",
                order, p);
        if (fabs(order - floor(order + 0.5)) > HCI_ORDER_TOLERANCE) *turns = (size_t)p;
    }
    return HCI_OK;
}

static hci_status allocate(hci_turn_samples *x, hci_note *note)
{
    for (int v = 0; v < HCI_TURN_VALUES; ++v) {
        x->value[v] = hci_memory_new(x->samples, sizeof *x->value[v]);
        x->order[v] = hci_memory_new(x->samples / 2, sizeof *x->order[v]);
        if (!x->value[v] || !x->order[v]) return hci_note_memory(note, NULL, "%zu angles", x->samples);
    }
    return HCI_OK;
}

static hci_status transform(hci_turn_samples *x, hci_note *note)
{
    double *work = hci_memory_new(2 * x->samples, sizeof *work);
    if (!work) return hci_note_memory(note, NULL, "%zu angles", x->samples);
    for (int v = 0; v < HCI_TURN_VALUES; v += 2) {
        const hci_fft_pair pair = {work, work + x->samples, x->samples, x->turns};
        memcpy(work, x->value[v], x->samples * sizeof *work);
        memcpy(work + x->samples, x->value[v + 1], x->samples * sizeof *work);
        hci_fft(work, work + x->samples, x->samples, -1);
        for (size_t k = 0; k < x->samples / 2; ++k)
            hci_fft_bin(&pair, k, &x->order[v][k], &x->order[v + 1][k]);
    }
    hci_memory_free(work);
    return HCI_OK;
}

hci_status hci_turn_samples_make(const hci_machine_model *machine, const hci_machine_model *own,
                                 const hci_loop_level *level, hci_turn_samples *x, hci_note *note)
{
    hci_status status;
    memset(x, 0, sizeof *x);
    status = find_turns(machine, level, &x->turns, note);
    x->samples = hci_fft_size((double)x->turns * SAMPLES_OF_A_TURN);
    if (!status) status = allocate(x, note);
    for (size_t k = 0; k < x->samples && !status; ++k)
        sample(machine, own, level, k, x);
    return status ? status : transform(x, note);
}

void hci_turn_samples_release(hci_turn_samples *x)
{
    for (int v = 0; v < HCI_TURN_VALUES; ++v) {
        hci_memory_free(x->value[v]);
        hci_memory_free(x->order[v]);
    }
    memset(x, 0, sizeof *x);
}

/* The dc link that phase voltages take. */
static double link_of(hci_modulation modulation, const double abc[3])
{
    const double high = fmax(abc[0], fmax(abc[1], abc[2])), low = fmin(abc[0], fmin(abc[1], abc[2]));
    double plane[2];
    if (modulation == HCI_MODULATION_SINUSOIDAL) return 2.0 * fmax(high, -low);
    if (modulation == HCI_MODULATION_SPACE_VECTOR) return high - low;
    hci_plane_from_abc(abc, plane);
    return sqrt(2.0) * hypot(plane[0], plane[1]);
}

double hci_turn_samples_dc_link_V(const hci_turn_samples *x, double resistance_ohm, hci_modulation modulation,
                                  double speed_rad_per_s)
{
    double most = 0.0;
    for (size_t k = 0; k < x->samples; ++k) {
        const double theta = 2.0 * HCI_PI * (double)x->turns * (double)k / (double)x->samples;
        const hci_dq v = {.d = resistance_ohm * x->value[HCI_TURN_CURRENT][k] +
                               speed_rad_per_s * x->value[HCI_TURN_VOLTAGE][k],
                          .q = resistance_ohm * x->value[HCI_TURN_CURRENT + 1][k] +
                               speed_rad_per_s * x->value[HCI_TURN_VOLTAGE + 1][k]};
        double abc[3];
        hci_clarke_inverse(hci_park_inverse(v, theta), abc);
        most = fmax(most, link_of(modulation, abc));
    }
    return most;
}
