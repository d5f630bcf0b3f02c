#include "host/diagnose/free_friction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/prepare/varying_load.h"
#include "host/diagnose/run_errors.h"
#include "host/machine/torque_constant.h"
#include "host/numeric/statistics.h"
#include "host/recording/free_shaft.h"

#define COARSE 24.0 /* samples in an electrical period, from which its order 12 shows */

/* The type that every motor of a make has of Coulomb's friction and one that grows with the speed. */
static const hci_effect_type *friction(void)
{
    size_t k = 0;
    while (hci_effect_type_at(k) &&
           !(hci_effect_type_at(k)->coulomb_Nm && hci_effect_type_at(k)->propose_alike))
        ++k;
    return hci_effect_type_at(k);
}

#define LEFT 0.1 /* of the means, beyond which their friction is not the one of the machine */

bool hci_constant_is_held(const hci_runs *runs)
{
    bool any = false;
    for (size_t k = 0; k < runs->count; ++k) {
        const hci_run *r = &runs->run[k];
        if (runs->role[k] != HCI_ROLE_FIT || r->torque_source == HCI_TORQUE_NONE) continue;
        if (r->torque_source != HCI_TORQUE_HOLDING && !r->hardly_accelerates) return false;
        any = true;
    }
    return any;
}

/* ---- the law ---- */

static bool any_measured(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->role[k] == HCI_ROLE_FIT && runs->run[k].torque_source == HCI_TORQUE_MEASURED) return true;
    return false;
}

/* Of the drags of the runs to be fitted, moved to the front of `work`. */
static hci_status fit_law(const hci_runs *runs, hci_free_friction *f, hci_note *note)
{
    hci_drag *work = hci_memory_new(runs->count + 1, sizeof *work);
    size_t count = 0;
    if (!work) return hci_note_memory(note, NULL, "the friction of free shafts");
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->role[k] == HCI_ROLE_FIT && !isnan(f->drag[k].drag_Nm)) work[count++] = f->drag[k];
    const bool done = hci_drag_law_find(work, count, &f->law);
    hci_memory_free(work);
    return done ? HCI_OK : hci_note_memory(note, NULL, "the friction of free shafts");
}

/* Whether the means of the runs held out are no less with the law than without it. */
static bool is_denied(const hci_runs *runs, const hci_free_friction *f)
{
    double before = 0.0, after = 0.0;
    for (size_t k = 0; k < runs->count; ++k) {
        if (runs->role[k] == HCI_ROLE_FIT || isnan(f->drag[k].drag_Nm)) continue;
        before += pow(f->drag[k].drag_Nm, 2.0);
        after += pow(f->drag[k].drag_Nm - hci_drag_law_at(&f->law, &f->drag[k]), 2.0);
    }
    return before > 0.0 && !(after < before);
}

static double declared_value(const hci_effects *declared, const hci_effect_type *type, size_t parameter)
{
    double sum = 0.0;
    for (size_t k = 0; k < declared->count; ++k)
        for (size_t j = 0; declared->effect[k].type == type && j < declared->effect[k].count; ++j)
            if (declared->effect[k].term[j].parameter == parameter) sum += declared->effect[k].term[j].value;
    return sum;
}

/* The declared effects with the law beside what they have of friction. */
static hci_status add_law(const hci_effects *declared, hci_free_friction *f, hci_note *note)
{
    hci_candidate law = {.type = friction(), .count = f->law.terms, .in = true};
    const hci_candidates list = {&law, 1, 0.0};
    hci_model model;
    for (size_t k = 0; k < HCI_DRAG_TERMS; ++k)
        f->declared[k] = declared_value(declared, law.type, k);
    for (size_t k = 0; k < law.count; ++k)
        law.term[k] = (hci_effect_term){k, 0.0, f->declared[k] + f->law.value[k], f->law.std_error[k]};
    const hci_status status = hci_model_make(declared, &list, false, &model, note);
    if (status) return status;
    f->effects = (hci_effects_data){model.list, model.effect, model.term};
    hci_memory_free(model.column);
    return HCI_OK;
}

/* ---- runs that tell their mean alone ---- */

static bool is_coarse_at(const hci_run *run, double speed_rad_per_s)
{
    const double step_s = (run->time_s[run->count - 1] - run->time_s[0]) / (double)(run->count - 1);
    return run->pole_pairs * fabs(speed_rad_per_s) * step_s * COARSE > 2.0 * HCI_PI;
}

static bool is_coarse(const hci_run *run, const hci_drag *drag)
{
    return is_coarse_at(run, drag->speed_rad_per_s);
}

/* ---- a load that is not known ---- */

/* Of the rated torque, that friction and iron may differ by from the law that they are fitted with: half of
 * what bearings, iron and air take at most. */
#define OF_RATED 0.05

static double rated_Nm_of(const hci_machine_data *machine, const hci_effects *declared)
{
    if (machine->rated_torque_Nm > 0.0) return machine->rated_torque_Nm;
    return fabs(hci_torque_constant(&machine->model, declared)) * fmax(0.0, machine->rated_current_A);
}

/* Beside a load that varies, such as a road, samples too far apart for the ripple tell nothing of the motor:
 * the run has no torque. */
static void torque_leave(hci_run *run, double load_Nm)
{
    hci_memory_free(run->torque_Nm);
    run->torque_Nm = NULL;
    run->torque_source = HCI_TORQUE_NONE;
    hci_note_add(
        &run->remark,
        "no free shaft: what the current makes beside inertia x acceleration varies by %.3g N·m rms as "
        "neither friction nor the motor does, such as on a road; that load is not known, and the samples "
        "are too far apart for the ripple, so that no torque is known",
        load_Nm);
}

static bool may_be_loaded(const hci_run *run)
{
    const double turned =
        run->theta_m_rad && run->count > 2 ? run->theta_m_rad[run->count - 1] - run->theta_m_rad[0] : 0.0;
    return run->torque_source == HCI_TORQUE_INERTIA && run->time_s && run->speed_rad_per_s && run->i_A &&
           turned != 0.0 && is_coarse_at(run, turned / (run->time_s[run->count - 1] - run->time_s[0]));
}

static hci_status loads_leave(const hci_machine_data *machine, const hci_effects *declared,
                              const hci_runs *runs, hci_note *note)
{
    const double allowed_Nm = OF_RATED * rated_Nm_of(machine, declared);
    double load_Nm = 0.0;
    bool *use = hci_memory_new(runs->count + 1, sizeof *use);
    if (!use) return hci_note_memory(note, NULL, "the load of a shaft");
    for (size_t k = 0; k < runs->count; ++k)
        use[k] = allowed_Nm > 0.0 && may_be_loaded(&runs->run[k]);
    const hci_status status = hci_varying_load_find(machine, declared, runs, use, &load_Nm, note);
    for (size_t k = 0; k < runs->count && !status && load_Nm > allowed_Nm; ++k)
        if (use[k]) torque_leave(&runs->run[k], load_Nm);
    hci_memory_free(use);
    return status;
}

static bool is_fitted(const hci_runs *runs, size_t k)
{
    const hci_run *r = &runs->run[k];
    return runs->role[k] == HCI_ROLE_FIT && r->torque_Nm && (r->theta_m_rad || r->only_mean) && r->i_A &&
           r->count > 0;
}

/* Sets is_apart, and none where nothing to be fitted would be left. */
static void set_apart(const hci_runs *runs, hci_free_friction *f)
{
    size_t left = 0;
    for (size_t k = 0; k < runs->count; ++k) {
        f->is_apart[k] = !isnan(f->drag[k].drag_Nm) && is_coarse(&runs->run[k], &f->drag[k]);
        left += !f->is_apart[k] && is_fitted(runs, k) ? 1 : 0;
    }
    if (left == 0) memset(f->is_apart, 0, runs->count * sizeof *f->is_apart);
}

static hci_status take_rest(const hci_runs *runs, hci_free_friction *f, hci_note *note)
{
    f->is_apart = hci_memory_new(runs->count + 1, sizeof *f->is_apart);
    f->rest.run = hci_memory_new(runs->count + 1, sizeof *f->rest.run);
    f->rest.role = hci_memory_new(runs->count + 1, sizeof *f->rest.role);
    if (!f->is_apart || !f->rest.run || !f->rest.role)
        return hci_note_memory(note, NULL, "the friction of free shafts");
    f->rest.list = runs->list;
    if (f->drag) set_apart(runs, f);
    for (size_t k = 0; k < runs->count; ++k) {
        if (f->is_apart[k]) continue;
        f->rest.run[f->rest.count] = runs->run[k];
        f->rest.role[f->rest.count++] = runs->role[k];
    }
    return HCI_OK;
}

hci_status hci_free_friction_find(const hci_machine_data *machine, const hci_effects *declared,
                                  const hci_runs *runs, hci_free_friction *f, hci_note *note)
{
    memset(f, 0, sizeof *f);
    if (!any_measured(runs)) {
        f->drag = hci_memory_new(runs->count + 1, sizeof *f->drag);
        if (!f->drag) return hci_note_memory(note, NULL, "the friction of free shafts");
    }
    hci_status status = loads_leave(machine, declared, runs, note);
    if (!status) status = hci_free_shafts_find(machine, declared, runs->run, runs->count, f->drag, note);
    if (!status && f->drag) status = fit_law(runs, f, note);
    if (!status && f->drag && is_denied(runs, f)) f->law.terms = 0;
    if (!status) status = take_rest(runs, f, note);
    return status || f->law.terms == 0 ? status : add_law(declared, f, note);
}

void hci_free_friction_release(hci_free_friction *f)
{
    hci_memory_free(f->drag);
    hci_memory_free(f->is_apart);
    hci_memory_free(f->rest.run);
    hci_memory_free(f->rest.role);
    hci_effects_release(&f->effects);
    memset(f, 0, sizeof *f);
}

/* ---- what is told of it ---- */

static void describe(const hci_free_friction *f, hci_finding *finding)
{
    const hci_effect_type *type = friction();
    size_t used = 0;
    for (size_t k = 0; k < f->law.terms && used < sizeof finding->detail; ++k)
        used += (size_t)snprintf(finding->detail + used, sizeof finding->detail - used,
                                 "%s%s = %.4g ± %.2g %s", k > 0 ? "; " : "", type->parameter[k].name,
                                 f->law.value[k], f->law.std_error[k], type->parameter[k].unit);
    if (used < sizeof finding->detail)
        snprintf(finding->detail + used, sizeof finding->detail - used,
                 ", times the declared torque per ampere");
}

/* Behind what is not known, which stands first. */
static void put_finding(const hci_free_friction *f, hci_diagnosis *d)
{
    size_t at = 0, to = d->findings > 0 && strcmp(d->finding[0].effect, "unknown") == 0;
    while (at < d->findings && strcmp(d->finding[at].effect, friction()->name) != 0)
        ++at;
    if (at == d->findings || d->finding[at].verdict != HCI_FINDING_REJECTED) return;
    hci_finding finding = {.effect = friction()->name,
                           .verdict = HCI_FINDING_ADDED,
                           .delta_bic = f->law.gain,
                           .residual_share = NAN};
    describe(f, &finding);
    memmove(&d->finding[to + 1], &d->finding[to], (at - to) * sizeof finding);
    d->finding[to] = finding;
}

/* An error before and after, by the mean alone. */
static void put_mean(double before_Nm, double after_Nm, hci_run_errors *e)
{
    const double rms_Nm = hypot(e->ripple_after_Nm, after_Nm);
    const double share = e->rms_after_Nm > 0.0 ? rms_Nm / e->rms_after_Nm : 1.0;
    e->error_mean_before_Nm = before_Nm;
    e->error_mean_after_Nm = after_Nm;
    e->rms_before_Nm = hypot(e->ripple_before_Nm, before_Nm);
    e->rms_after_Nm = rms_Nm;
    e->after_low_Nm *= share;
    e->after_high_Nm *= share;
}

/* Of a run apart: what of its torque varies stays as it was measured. */
static hci_run_errors errors_apart(const hci_runs *runs, size_t run)
{
    const hci_run *r = &runs->run[run];
    const double mean_Nm = hci_mean(r->torque_Nm, r->count),
                 ripple_Nm = sqrt(hci_mean_square_about(r->torque_Nm, r->count, mean_Nm));
    return (hci_run_errors){.file = r->name,
                            .role = runs->role[run],
                            .source = r->torque_source,
                            .mean_torque_Nm = mean_Nm,
                            .rms_after_Nm = ripple_Nm,
                            .ripple_before_Nm = ripple_Nm,
                            .ripple_after_Nm = ripple_Nm,
                            .after_low_Nm = ripple_Nm,
                            .after_high_Nm = ripple_Nm,
                            .noise_floor_Nm = ripple_Nm};
}

static bool has_errors(const hci_diagnosis *d, size_t at, const hci_run *run)
{
    return at < d->runs && d->run[at].file == run->name;
}

/* The errors of all runs in the order of the list, with the numbers that lines have of them. */
static hci_status join_errors(const hci_free_friction *f, const hci_runs *runs, hci_diagnosis *d,
                              hci_note *note)
{
    hci_run_errors *all = hci_memory_new(runs->count + 1, sizeof *all);
    size_t *moved = hci_memory_new(runs->count + 1, sizeof *moved);
    size_t count = 0, from = 0;
    for (size_t k = 0; all && moved && k < runs->count; ++k) {
        if (f->is_apart[k]) all[count++] = errors_apart(runs, k);
        if (f->is_apart[k] || !has_errors(d, from, &runs->run[k])) continue;
        moved[from] = count;
        all[count++] = d->run[from++];
    }
    for (size_t k = 0; all && moved && k < d->lines; ++k)
        d->line[k].run = moved[d->line[k].run];
    hci_memory_free(moved);
    if (!all || !moved) {
        hci_memory_free(all);
        return hci_note_memory(note, NULL, "the errors of the recordings");
    }
    hci_memory_free(d->run);
    d->run = all;
    d->runs = count;
    return HCI_OK;
}

/* What the corrected machine has of it beyond what is declared. */
static hci_drag_law corrected_law(const hci_free_friction *f, const hci_diagnosis *d)
{
    hci_drag_law law = {.terms = HCI_DRAG_TERMS};
    for (size_t k = 0; k < law.terms; ++k)
        law.value[k] = declared_value(&d->effects.list, friction(), k) - f->declared[k];
    return law;
}

/* Adds the means of the drags. Whether the friction of the corrected machine makes them. */
static bool add_means(const hci_free_friction *f, const hci_runs *runs, hci_diagnosis *d)
{
    const hci_drag_law law = corrected_law(f, d);
    double before = 0.0, after = 0.0;
    size_t at = 0;
    for (size_t k = 0; k < runs->count; ++k) {
        if (!has_errors(d, at, &runs->run[k])) continue;
        hci_run_errors *e = &d->run[at++];
        if (isnan(f->drag[k].drag_Nm)) continue;
        put_mean(-f->drag[k].drag_Nm, hci_drag_law_at(&law, &f->drag[k]) - f->drag[k].drag_Nm, e);
        before += e->error_mean_before_Nm * e->error_mean_before_Nm;
        after += e->error_mean_after_Nm * e->error_mean_after_Nm;
        ++d->of_mean_currents;
    }
    return after <= LEFT * LEFT * before;
}

hci_status hci_free_friction_tell(const hci_free_friction *f, const hci_runs *runs, hci_diagnosis *d,
                                  hci_note *note)
{
    if (f->law.terms == 0) return HCI_OK;
    const hci_status status = join_errors(f, runs, d, note);
    if (status) return status;
    put_finding(f, d);
    if (d->verdict == HCI_DIAGNOSIS_COMPLETE) d->verdict = HCI_DIAGNOSIS_EXPLAINED;
    if (d->verdict == HCI_DIAGNOSIS_UNKNOWN) d->verdict = HCI_DIAGNOSIS_PARTLY;
    if (!add_means(f, runs, d)) d->verdict = HCI_DIAGNOSIS_PARTLY;
    hci_run_errors_total(d);
    return HCI_OK;
}
