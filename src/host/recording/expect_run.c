#include "host/recording/expect_run.h"

#include <math.h>

#include "hci/host/recording/predict.h"
#include "host/base/memory.h"
#include "host/machine/expected_ripple.h"

enum { MOST_SAMPLES = 4096 };

/* In place: every stride-th reading to the true sample, and its torque. Returns how many. */
static size_t path_fill(const hci_machine *machine, const hci_effects *effects, size_t count,
                        hci_sample *sample, double *torque_Nm)
{
    const size_t stride = (count + MOST_SAMPLES - 1) / MOST_SAMPLES;
    size_t taken = 0;
    for (size_t k = 0; k < count; k += stride, ++taken) {
        const hci_sample x = hci_effects_undo(effects, machine->pole_pairs, &sample[k]);
        const double theta_rad = machine->pole_pairs * x.theta_m_rad;
        sample[taken] = x;
        torque_Nm[taken] = hci_torque_at(machine, theta_rad, x.i_abc) +
                           hci_effects_torque(machine, effects, &x, NULL).torque_Nm;
    }
    return taken;
}

static double speed_of(const hci_run *run)
{
    double most = 0.0;
    for (size_t k = 0; run->speed_rad_per_s && k < run->count; ++k)
        if (fabs(run->speed_rad_per_s[k]) > fabs(most)) most = run->speed_rad_per_s[k];
    return run->speed_rad_per_s ? most : (double)NAN;
}

hci_status hci_expect_run(const hci_machine_data *machine, const hci_effects *effects,
                          const hci_uncertainty *uncertainty, const hci_run *run,
                          hci_expected_ripple *expected, hci_note *note)
{
    hci_sample *sample = hci_memory_new(run->count, sizeof *sample);
    double *torque_Nm = hci_memory_new(run->count, sizeof *torque_Nm);
    hci_status status =
        sample && torque_Nm ? HCI_OK : hci_note_memory(note, run->name, "%zu samples", run->count);
    if (!status)
        status =
            hci_predict_readings(run, machine->model.pole_pairs, hci_effects_needs(effects), sample, note);
    if (!status) {
        hci_ripple_path path = {.machine = &machine->model,
                                .effects = effects,
                                .sample = sample,
                                .torque_Nm = torque_Nm,
                                .speed_rad_per_s = speed_of(run)};
        path.count = path_fill(&machine->model, effects, run->count, sample, torque_Nm);
        status = hci_expected_ripple_find(&path, uncertainty, expected, note);
    }
    hci_memory_free(sample);
    hci_memory_free(torque_Nm);
    return status;
}
