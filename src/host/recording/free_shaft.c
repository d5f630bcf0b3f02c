#include "host/recording/free_shaft.h"

#include <math.h>

#include "host/base/memory.h"
#include "host/machine/torque_constant.h"
#include "host/recording/rotor_frame.h"

#define OF_RATED 0.1  /* what bearings, iron and air take of a machine's rated torque at most */
#define OF_RMS   0.75 /* of the rms torque of i_q: a drag that is more leaves it hardly any variation */
#define TWICE    2.0  /* a shaft whose acceleration takes half of the torque is free */

/* Mean torques, N·m. */
typedef struct {
    double made, accelerating; /* by the model; inertia × acceleration */
} balance;

typedef struct {
    balance plain, with_speed; /* as they are, and times the sign of the speed */
    double rms_Nm;             /* of the torque that i_q makes */
} figures;

static bool is_free(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_INERTIA && run->theta_m_rad != NULL;
}

static hci_status figures_of(const hci_machine_data *machine, const hci_effects *effects, const hci_run *run,
                             figures *f, hci_note *note)
{
    const double share = 1.0 / (double)run->count;
    const double constant = hci_torque_constant(&machine->model, effects);
    double *model_Nm = hci_memory_new(run->count, sizeof *model_Nm), square = 0.0;
    if (model_Nm == NULL) return hci_note_memory(note, NULL, "a free shaft");
    const hci_status status = hci_predict(machine, effects, run, model_Nm, note);
    *f = (figures){.rms_Nm = 0.0};
    for (size_t k = 0; k < run->count && !status; ++k) {
        const double speed = run->speed_rad_per_s[k], sign = (speed > 0.0) - (speed < 0.0);
        f->plain.made += share * model_Nm[k];
        f->plain.accelerating += share * run->torque_Nm[k];
        f->with_speed.made += share * sign * model_Nm[k];
        f->with_speed.accelerating += share * sign * run->torque_Nm[k];
        const double made = constant * hci_run_dq(run, machine->model.pole_pairs, k).q;
        square += share * made * made;
    }
    f->rms_Nm = sqrt(square);
    hci_memory_free(model_Nm);
    return status;
}

static double drag_of(const balance *b)
{
    return fabs(b->made) > TWICE * fabs(b->accelerating) ? fabs(b->made - b->accelerating) : 0.0;
}

static double rated_torque_of(const hci_machine_data *machine, const hci_effects *effects)
{
    if (machine->rated_torque_Nm > 0.0) return machine->rated_torque_Nm;
    if (!(machine->rated_current_A > 0.0)) return 0.0;
    return fabs(hci_torque_constant(&machine->model, effects)) * machine->rated_current_A;
}

/* The balance in which the drag is larger. */
static const balance *balance_of(const figures *f)
{
    return drag_of(&f->with_speed) > drag_of(&f->plain) ? &f->with_speed : &f->plain;
}

static void set_load(hci_run *run, const balance *b, double most_Nm)
{
    run->mean_is_unknown = true;
    hci_note_add(&run->remark,
                 "no free shaft: by the model the current makes %.3g N·m on average, but inertia x "
                 "acceleration is %.3g N·m, and a drag of its own is at most %.3g N·m (a tenth of the rated "
                 "torque, or 3/4 of the rms torque of i_q); its load is not known, so that only what varies "
                 "is used",
                 b->made, b->accelerating, most_Nm);
}

static void set_load_beside(hci_run *run)
{
    run->mean_is_unknown = true;
    hci_note_add(&run->remark, "another run drives a load that is not known, and this one hardly "
                               "accelerates: only what varies is used");
}

/* A shaft that drives something in one run does so in others too, unless they accelerate. */
static void set_loads(hci_run *runs, const figures *f, size_t count, double most_Nm)
{
    bool any = false;
    for (size_t k = 0; k < count; ++k) {
        if (!is_free(&runs[k]) || runs[k].mean_is_unknown) continue;
        if (drag_of(balance_of(&f[k])) > most_Nm) set_load(&runs[k], balance_of(&f[k]), most_Nm);
        any = any || runs[k].mean_is_unknown;
    }
    for (size_t k = 0; k < count && any; ++k)
        if (is_free(&runs[k]) && !runs[k].mean_is_unknown && drag_of(balance_of(&f[k])) > 0.0)
            set_load_beside(&runs[k]);
}

hci_status hci_free_shafts_find(const hci_machine_data *machine, const hci_effects *effects, hci_run *runs,
                                size_t count, hci_note *note)
{
    figures *f = hci_memory_new(count + 1, sizeof *f);
    hci_status status = HCI_OK;
    double most_Nm = OF_RATED * rated_torque_of(machine, effects);
    if (f == NULL) return hci_note_memory(note, NULL, "a free shaft");
    for (size_t k = 0; k < count && !status; ++k) {
        if (!is_free(&runs[k])) continue;
        status = figures_of(machine, effects, &runs[k], &f[k], note);
        most_Nm = fmax(most_Nm, OF_RMS * f[k].rms_Nm);
    }
    if (!status) set_loads(runs, f, count, most_Nm);
    hci_memory_free(f);
    return status;
}
