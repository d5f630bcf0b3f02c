#include "host/solution/expect.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/machine/expected_ripple.h"
#include "host/numeric/fft.h"

/* A turn, and a period of the highest order: peaks between samples are off by less than 1 − cos(π/10), 5 %,
 * of that order. */
enum { LEAST_PER_TURN = 1024, SAMPLES_PER_PERIOD = 10 };

static size_t samples_of(const hci_solution *s, const hci_effects *allowed)
{
    double top = fmax(s->order_count > 0 ? s->order[s->order_count - 1].torque_Nm.order : 0.0, 0.0);
    for (size_t k = 0; k < allowed->count; ++k)
        for (size_t j = 0; j < allowed->effect[k].count; ++j)
            top = fmax(top, allowed->effect[k].term[j].order);
    return hci_fft_size(fmax(LEAST_PER_TURN, SAMPLES_PER_PERIOD * top) * (double)s->period_turns);
}

/* Adds a harmonic to bins k and n − k of the transform of a real signal, of which it is half each; times i
 * where that is the imaginary part of a pair. */
static void bins_add(const hci_harmonic *h, size_t k, size_t n, bool times_i, double *re, double *im)
{
    const double cosine = 0.5 * h->cosine, sine = 0.5 * h->sine;
    const size_t mirrored = (n - k) % n;
    re[k] += times_i ? sine : cosine;
    im[k] += times_i ? cosine : -sine;
    re[mirrored] += times_i ? -sine : cosine;
    im[mirrored] += times_i ? cosine : sine;
}

/* The torque and what is wanted, [count] each over the period; none of 0. */
static void torques_fill(const hci_solution *s, size_t count, double *torque_Nm, double *wanted_Nm)
{
    memset(torque_Nm, 0, count * sizeof *torque_Nm);
    memset(wanted_Nm, 0, count * sizeof *wanted_Nm);
    for (size_t k = 0; k < s->order_count && count > 0; ++k) {
        const size_t periods = (size_t)llround(s->order[k].torque_Nm.order * (double)s->period_turns);
        bins_add(&s->order[k].torque_Nm, periods, count, false, torque_Nm, wanted_Nm);
        bins_add(&s->order[k].target_Nm, periods, count, true, torque_Nm, wanted_Nm);
    }
    if (count > 0) hci_fft(torque_Nm, wanted_Nm, count, 1);
}

static void path_fill(const hci_machine *machine, const hci_solve_options *o, const hci_solution *s,
                      size_t count, hci_sample *sample, double *torque_Nm)
{
    const double period_rad = 2.0 * HCI_PI * (double)s->period_turns;
    for (size_t k = 0; k < count; ++k) {
        const double theta_rad = period_rad * (double)k / (double)count;
        sample[k] = (hci_sample){.theta_m_rad = theta_rad / machine->pole_pairs,
                                 .speed_rad_per_s = o->speed_rad_per_s,
                                 .temperature_C = o->at_temperature ? o->temperature_C : (double)NAN};
        hci_waves_at(s->current.wave, s->current.count, theta_rad, sample[k].i_abc);
    }
    torques_fill(s, count, torque_Nm, torque_Nm + count);
}

hci_status hci_solution_expect(const hci_machine *machine, const hci_solve_options *options, hci_solution *s,
                               hci_note *note)
{
    const hci_uncertainty *u = options->uncertainty;
    const hci_effects none = {NULL, 0};
    const size_t count = u && u->machines > 0 ? samples_of(s, &u->effects.list) : 0;
    hci_sample *sample = hci_memory_new(count, sizeof *sample);
    double *torque_Nm = hci_memory_new(2 * count, sizeof *torque_Nm);
    hci_status status = sample && torque_Nm ? HCI_OK : hci_note_memory(note, NULL, "what to expect");
    if (!status) {
        const hci_ripple_path path = {
            .machine = machine,
            .effects = options->effects ? options->effects : &none,
            .sample = sample,
            .torque_Nm = torque_Nm,
            .wanted_Nm = torque_Nm + count,
            .count = count,
            .turns = s->period_turns,
            .speed_rad_per_s = options->speed_rad_per_s != 0.0 ? options->speed_rad_per_s : (double)NAN};
        path_fill(machine, options, s, count, sample, torque_Nm);
        status = hci_expected_ripple_find(&path, u, &s->expected, note);
    }
    hci_memory_free(sample);
    hci_memory_free(torque_Nm);
    return status;
}

bool hci_solution_is_boundless(const hci_solution *s)
{
    const bool has_mean = s->order_count > 0 && s->order[0].torque_Nm.order < HCI_ORDER_TOLERANCE;
    const double mean_Nm = has_mean ? fabs(s->order[0].torque_Nm.cosine) : 0.0;
    const double before_Nm = 0.01 * fabs(s->T_ripple_before_percent) * mean_Nm;
    return s->expected.state == HCI_RIPPLE_KNOWN && mean_Nm > s->tolerance_Nm &&
           hci_ripple_bound_as_said(s->expected.peak_to_peak_Nm) > fmax(mean_Nm, before_Nm);
}
