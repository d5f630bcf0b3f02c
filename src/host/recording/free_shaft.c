#include "host/recording/free_shaft.h"

#include <math.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/machine/torque_constant.h"
#include "host/recording/rotor_frame.h"

#define OF_RATED 0.1  /* what bearings, iron and air take of a machine's rated torque at most */
#define OF_RMS   0.75 /* of the rms torque of i_q: a drag that is more leaves it hardly any variation */
#define TWICE    2.0  /* a shaft whose acceleration takes half of the torque is free */
#define HARDLY   0.1  /* of the current's torque that accelerates, which is next to none */

/* Mean torques, N·m. */
typedef struct {
    double made, accelerating; /* by the model; inertia × acceleration */
} balance;

typedef struct {
    balance plain, with_speed;      /* as they are, and times the sign of the speed */
    hci_drag drag, drag_with_speed; /* of the shaft, without drag_Nm */
    double rms_Nm;                  /* of the torque that i_q makes */
    double mean_Nm;                 /* of it, times the sign of the speed */
    double along_Nm2;               /* mean of its product with inertia × acceleration */
} figures;

static bool is_free(const hci_run *run)
{
    return run->torque_source == HCI_TORQUE_INERTIA && run->theta_m_rad != NULL;
}

static void add_speed(double speed, double share, figures *f)
{
    const double sign = (speed > 0.0) - (speed < 0.0);
    f->drag.sign += share * sign;
    f->drag.constant += share;
    f->drag.speed_rad_per_s += share * speed;
    f->drag.square += share * speed * fabs(speed);
    f->drag_with_speed.sign += share * fabs(sign);
    f->drag_with_speed.constant += share * sign;
    f->drag_with_speed.speed_rad_per_s += share * fabs(speed);
    f->drag_with_speed.square += share * speed * speed;
}

/* How many samples from the first one on are whole turns; all where the run is none of one. */
static size_t whole_turns_of(const hci_run *run)
{
    const double *theta = run->theta_m_rad, turn = 2.0 * HCI_PI;
    const double turns = floor(fabs(theta[run->count - 1] - theta[0]) / turn);
    size_t k = run->count;
    if (turns < 1.0) return k;
    while (k > 1 && fabs(theta[k - 1] - theta[0]) >= turns * turn)
        --k;
    return k;
}

/* What weights a sample: of what works over whole turns, as a weight off the axis, which swings the speed,
 * the mean over the angle is nothing and the mean over time is not. Where nothing turns: of each the same. */
static void shares_fill(const hci_run *run, size_t count, double *share)
{
    double sum = 0.0;
    for (size_t k = 0; k < run->count; ++k) {
        share[k] = k < count ? fabs(run->speed_rad_per_s[k]) : 0.0;
        sum += share[k];
    }
    for (size_t k = 0; k < count; ++k)
        share[k] = sum > 0.0 ? share[k] / sum : 1.0 / (double)count;
}

static hci_status figures_of(const hci_machine_data *machine, const hci_effects *effects, const hci_run *run,
                             figures *f, hci_note *note)
{
    const double even = 1.0 / (double)run->count;
    const double constant = hci_torque_constant(&machine->model, effects);
    double *model_Nm = hci_memory_new(2 * run->count, sizeof *model_Nm), square = 0.0;
    if (model_Nm == NULL) return hci_note_memory(note, NULL, "a free shaft");
    double *shares = model_Nm + run->count;
    shares_fill(run, whole_turns_of(run), shares);
    const hci_status status = hci_predict(machine, effects, run, model_Nm, note);
    *f = (figures){.rms_Nm = 0.0};
    for (size_t k = 0; k < run->count && !status; ++k) {
        const double share = shares[k], speed = run->speed_rad_per_s[k], sign = (speed > 0.0) - (speed < 0.0);
        f->plain.made += share * model_Nm[k];
        f->plain.accelerating += share * run->torque_Nm[k];
        f->with_speed.made += share * sign * model_Nm[k];
        f->with_speed.accelerating += share * sign * run->torque_Nm[k];
        const double made = constant * hci_run_dq(run, machine->model.pole_pairs, k).q;
        square += even * made * made;
        f->mean_Nm += share * sign * made;
        f->along_Nm2 += even * run->torque_Nm[k] * made;
        add_speed(speed, share, f);
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

/* Neither on average nor in what varies: the balance of such a run holds for a torque per ampere of any size.
 */
static bool hardly_accelerates(const figures *f)
{
    return fabs(f->with_speed.accelerating) < HARDLY * fabs(f->mean_Nm) &&
           fabs(f->along_Nm2) < HARDLY * f->rms_Nm * f->rms_Nm;
}

static hci_drag drag_at(const figures *f)
{
    const balance *b = balance_of(f);
    hci_drag drag = b == &f->plain ? f->drag : f->drag_with_speed;
    drag.drag_Nm = b->made - b->accelerating;
    return drag;
}

static void set_friction(hci_run *run, const hci_drag *drag)
{
    run->mean_is_unknown = true;
    hci_note_add(&run->remark,
                 "the current makes %.3g N·m on average by the declared torque per ampere, and nothing "
                 "accelerates: that is the "
                 "friction of the shaft and of what it drives",
                 drag->drag_Nm);
}

/* Sets drag, and *is_friction where it is one. */
static hci_status find_friction(hci_run *runs, const figures *f, size_t count, hci_drag *drag,
                                bool *is_friction, hci_note *note)
{
    hci_drag *known = hci_memory_new(count + 1, sizeof *known);
    size_t drags = 0;
    if (known == NULL) return hci_note_memory(note, NULL, "a free shaft");
    for (size_t k = 0; k < count; ++k) {
        drag[k] = (hci_drag){.drag_Nm = NAN};
        if (runs[k].hardly_accelerates) drag[k] = known[drags++] = drag_at(&f[k]);
    }
    const bool done = hci_drags_are_friction(known, drags, is_friction);
    hci_memory_free(known);
    for (size_t k = 0; k < count; ++k) {
        if (!*is_friction) drag[k].drag_Nm = NAN;
        if (!isnan(drag[k].drag_Nm)) set_friction(&runs[k], &drag[k]);
    }
    return done ? HCI_OK : hci_note_memory(note, NULL, "a free shaft");
}

hci_status hci_free_shafts_find(const hci_machine_data *machine, const hci_effects *effects, hci_run *runs,
                                size_t count, hci_drag *drag, hci_note *note)
{
    figures *f = hci_memory_new(count + 1, sizeof *f);
    hci_status status = HCI_OK;
    double most_Nm = OF_RATED * rated_torque_of(machine, effects);
    bool is_friction = false;
    if (f == NULL) return hci_note_memory(note, NULL, "a free shaft");
    for (size_t k = 0; k < count && !status; ++k) {
        if (!is_free(&runs[k])) continue;
        status = figures_of(machine, effects, &runs[k], &f[k], note);
        most_Nm = fmax(most_Nm, OF_RMS * f[k].rms_Nm);
        runs[k].hardly_accelerates = hardly_accelerates(&f[k]);
    }
    if (!status && drag != NULL) status = find_friction(runs, f, count, drag, &is_friction, note);
    if (!status && !is_friction) set_loads(runs, f, count, most_Nm);
    for (size_t k = 0; k < count; ++k) /* a mean that counts has a size */
        runs[k].hardly_accelerates = runs[k].hardly_accelerates && runs[k].mean_is_unknown;
    hci_memory_free(f);
    return status;
}
