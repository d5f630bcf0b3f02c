#include "host/solution/expect.h"

#include <math.h>

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

/* One sample of the currents, of the torque and of what is wanted. */
static void sample_fill(const hci_solution *s, double theta_rad, hci_sample *sample, double *torque_Nm,
                        double *wanted_Nm)
{
    hci_waves_at(s->current.wave, s->current.count, theta_rad, sample->i_abc);
    *torque_Nm = *wanted_Nm = 0.0;
    for (size_t k = 0; k < s->order_count; ++k) {
        *torque_Nm += hci_harmonics_at(&s->order[k].torque_Nm, 1, theta_rad);
        *wanted_Nm += hci_harmonics_at(&s->order[k].target_Nm, 1, theta_rad);
    }
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
        sample_fill(s, theta_rad, &sample[k], &torque_Nm[k], &torque_Nm[count + k]);
    }
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
