#include "host/diagnose/prepare/varying_load.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/numeric/normal_equations.h"
#include "host/recording/rotor_frame.h"

#define LEAST_TURNS 3.0 /* of a part */

enum { PARTS = 16, COLUMNS = 5 };

static size_t first_of(const hci_run *run, size_t part)
{
    return part * run->count / PARTS;
}

/* Whether each part turns that far, one way. */
static bool has_turns(const hci_run *run)
{
    if (run->count < PARTS * 4) return false;
    for (size_t p = 0; p < PARTS; ++p) {
        const double from = run->theta_m_rad[first_of(run, p)],
                     to = run->theta_m_rad[first_of(run, p + 1) - 1];
        if (fabs(to - from) < LEAST_TURNS * 2.0 * HCI_PI) return false;
    }
    return true;
}

/* Means over a part. row: [COLUMNS]. */
static void part_mean(const hci_run *run, int pole_pairs, const double *model_Nm, size_t part, double *row,
                      double *made_Nm)
{
    const size_t first = first_of(run, part), end = first_of(run, part + 1);
    const double share = 1.0 / (double)(end - first);
    *made_Nm = 0.0;
    for (size_t c = 0; c < COLUMNS; ++c)
        row[c] = 0.0;
    for (size_t k = first; k < end; ++k) {
        const hci_dq i = hci_run_dq(run, pole_pairs, k);
        const double speed = run->speed_rad_per_s[k];
        const double x[COLUMNS] = {run->torque_Nm[k], (speed > 0.0) - (speed < 0.0), speed, i.d * i.q,
                                   i.q * i.q * i.q};
        for (size_t c = 0; c < COLUMNS; ++c)
            row[c] += share * x[c];
        *made_Nm += share * model_Nm[k];
    }
}

static hci_status run_add(const hci_machine_data *machine, const hci_effects *effects, const hci_run *run,
                          hci_normal_equations *normal, hci_note *note)
{
    double row[COLUMNS], made_Nm;
    if (!has_turns(run)) return HCI_OK;
    double *model_Nm = hci_memory_new(run->count, sizeof *model_Nm);
    if (!model_Nm) return hci_note_memory(note, NULL, "the load of a shaft");
    const hci_status status = hci_predict(machine, effects, run, model_Nm, note);
    for (size_t p = 0; p < PARTS && !status; ++p) {
        part_mean(run, machine->model.pole_pairs, model_Nm, p, row, &made_Nm);
        hci_normal_equations_add(normal, row, &made_Nm, 1);
    }
    hci_memory_free(model_Nm);
    return status;
}

/* What is left of the parts, as rms with their degrees of freedom. False when memory is out. */
static bool rest_of(hci_normal_equations *normal, double *rest_Nm)
{
    hci_sweep sweep;
    double freedom = normal->rows;
    hci_normal_equations_finish(normal);
    if (!(freedom > COLUMNS)) return true;
    if (!hci_sweep_start(&sweep, normal)) return false;
    for (size_t c = 0; c < COLUMNS; ++c)
        freedom -= hci_sweep_in(&sweep, c) ? 1.0 : 0.0;
    *rest_Nm = sqrt(fmax(0.0, sweep.square) / freedom);
    hci_sweep_release(&sweep);
    return true;
}

hci_status hci_varying_load_find(const hci_machine_data *machine, const hci_effects *effects,
                                 const hci_runs *runs, const bool *use, double *load_Nm, hci_note *note)
{
    hci_normal_equations normal = {0};
    hci_status status = HCI_OK;
    *load_Nm = 0.0;
    if (!hci_normal_equations_start(&normal, COLUMNS))
        return hci_note_memory(note, NULL, "the load of a shaft");
    for (size_t k = 0; k < runs->count && !status; ++k)
        if (use[k]) status = run_add(machine, effects, &runs->run[k], &normal, note);
    if (!status && !rest_of(&normal, load_Nm)) status = hci_note_memory(note, NULL, "the load of a shaft");
    hci_normal_equations_release(&normal);
    return status;
}
