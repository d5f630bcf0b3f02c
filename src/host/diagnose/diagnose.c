#include "hci/host/diagnose/diagnose.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/attribute/attribute.h"
#include "host/diagnose/conclude.h"
#include "host/diagnose/fill_diagnosis.h"
#include "host/diagnose/fit/dataset.h"
#include "host/diagnose/fit/model.h"
#include "host/diagnose/free_friction.h"
#include "host/diagnose/next_points.h"
#include "host/diagnose/odd_run.h"
#include "host/diagnose/open_voltage.h"
#include "host/diagnose/origin.h"
#include "host/machine/torque_constant.h"

#define RESOLUTION 5e-4 /* of the largest rms torque */
#define FURTHER    4.0  /* times its limit, that a search takes next */
#define SUSPICION  0.35 /* of the limit of work, that a search without a run may take that is suspected */

/* What is to be diagnosed. */
typedef struct {
    const hci_machine_data *machine;
    const hci_effects *declared;
    const hci_runs *runs;
    const hci_diagnose_options *options;
    hci_dataset *dataset;        /* of these machine, effects and runs; NULL: to be made */
    hci_suspect *suspect;        /* that is not among the runs, and is tried on what they show; NULL: none */
    const hci_candidates *start; /* that the search goes on from; NULL: nothing */
    double work;                 /* of what the search may take, that counts as done before it begins */
} task;

/* With as much work as is wanted. */
static hci_status dataset_of(const task *t, const hci_effects *declared, hci_dataset *b, hci_note *note)
{
    const hci_status status = hci_dataset_make(t->machine, declared, t->runs, b, note);
    if (!status && t->options->work > 0.0) b->regression.work_times *= t->options->work;
    return status;
}

/* What is shown is kept: the search of all runs goes on from there. */
static hci_status look_at(void *context, const hci_candidates *model, const hci_effects *effects,
                          hci_note *note)
{
    hci_suspect *s = context;
    hci_candidates shown;
    const hci_status status = hci_candidates_copy(model, &shown, note);
    if (status) return status;
    hci_candidates_release(&s->shown);
    s->shown = shown;
    return hci_suspect_ask(s, effects, note);
}

/* What changes the torque by less than a share of its range is nothing. */
static double resolution_of(const hci_dataset *b, const task *t)
{
    const double share = t->options->resolution > 0.0 ? t->options->resolution : RESOLUTION;
    return share * hci_dataset_range_of(b).torque_Nm;
}

static hci_attribute_options how_to(const hci_dataset *b, const task *t, bool constant_is_known)
{
    return (hci_attribute_options){t->runs->run,
                                   resolution_of(b, t),
                                   t->machine->rated_current_A,
                                   t->machine->slots > 0.0 ? (size_t)t->machine->slots : 0,
                                   t->machine->has_neutral,
                                   constant_is_known,
                                   t->options->progress,
                                   t->options->progress_context,
                                   t->options->slip,
                                   t->options->slip_context,
                                   t->suspect ? look_at : NULL,
                                   t->suspect,
                                   t->suspect != NULL,
                                   constant_is_known ? NULL : t->start}; /* that may have what is excluded */
}

/* How to load a shaft that is held is not known. */
static hci_status propose_points(hci_dataset *b, const task *t, hci_diagnosis *d, hci_note *note)
{
    if (!hci_any_turns(b, t->runs)) return HCI_OK;
    const hci_status status = hci_next_points_unknown(&b->regression, t->machine, d, note);
    return status ? status : hci_next_points_left_open(&b->regression, t->machine, d, note);
}

/* Whether nothing is left to be confirmed of a run that is only suspected: the others are not understood, or
 * what they show in the end makes it agree. */
static hci_status suspicion_ends(const hci_dataset *b, hci_suspect *suspect, const hci_attribution *a,
                                 hci_note *note)
{
    hci_model model;
    if (a->unknown || a->ended != HCI_WORK_COMPLETE) return HCI_ERROR_STOPPED;
    hci_status status = hci_model_make(b->regression.declared, &a->model.candidates, false, &model, note);
    if (status) return status;
    status = hci_suspect_ask(suspect, &model.list, note);
    hci_model_release(&model);
    return status;
}

static hci_status answer(hci_dataset *b, const task *t, bool constant_is_known, hci_diagnosis *d,
                         hci_note *note)
{
    const hci_attribute_options how = how_to(b, t, constant_is_known);
    hci_watch watch = {t->options->stop, t->options->stop_context, how.progress, how.context, false};
    hci_attribution a;
    b->regression.watch = &watch;
    hci_status status = hci_attribute(&b->regression, &how, &a, note);
    if (t->suspect) t->suspect->work = b->work - t->work;
    if (status) return status;
    if (t->suspect) status = suspicion_ends(b, t->suspect, &a, note);
    d->resolution_Nm = resolution_of(b, t);
    if (!status) status = hci_conclude(b, t->machine, t->runs, &a, d, note);
    if (!status && !a.not_searched) status = propose_points(b, t, d, note);
    hci_attribution_release(&a);
    return status;
}

#define FAR_LESS 0.5 /* of what one answer leaves, that another one leaves */

/* Whether an answer says more than another one. */
static bool says_more(const hci_diagnosis *d, const hci_diagnosis *than)
{
    return d->search == HCI_WORK_COMPLETE && !d->against_voltages && d->verdict <= than->verdict &&
           (d->verdict <= HCI_DIAGNOSIS_AMBIGUOUS || d->rms_after_Nm < FAR_LESS * than->rms_after_Nm);
}

static bool any_is_free(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->run[k].torque_source == HCI_TORQUE_INERTIA) return true;
    return false;
}

/* Where what was found contradicts voltages that were recorded without a current, and had to leave for that,
 * it is looked for once more with the torque per ampere that they show. Of a free shaft its inertia may as
 * well be another one. */
static hci_status diagnose(hci_dataset *b, const task *t, hci_diagnosis *d, hci_note *note)
{
    hci_diagnosis known = {0};
    hci_status status = answer(b, t, false, d, note);
    if (status > HCI_NOT_REACHED || !d->against_voltages || t->suspect || any_is_free(t->runs)) return status;
    const hci_status again = answer(b, t, true, &known, note);
    if (again > HCI_NOT_REACHED || !says_more(&known, d)) {
        hci_diagnosis_release(&known);
        return again > HCI_NOT_REACHED ? again : status;
    }
    hci_diagnosis_release(d);
    *d = known;
    return again;
}

static bool is_usable(const hci_runs *runs, size_t k)
{
    const hci_run *r = &runs->run[k];
    return runs->role[k] == HCI_ROLE_FIT && r->torque_Nm && (r->theta_m_rad || r->only_mean) && r->i_A &&
           r->count > 0;
}

/* No run tells a torque: the machine stays as it is declared, and that is said. */
static hci_status nothing_measured(const hci_effects *declared, hci_diagnosis *d, hci_note *note)
{
    const hci_candidates none = {0};
    hci_model model;
    const hci_status status = hci_model_make(declared, &none, false, &model, note);
    if (status) return status;
    d->effects = (hci_effects_data){model.list, model.effect, model.term};
    hci_memory_free(model.column);
    d->verdict = HCI_DIAGNOSIS_UNKNOWN;
    d->nothing_measured = true;
    d->rms_before_Nm = d->rms_after_Nm = d->noise_Nm = NAN;
    d->holdout_before_Nm = d->holdout_after_Nm = d->holdout_noise_Nm = NAN;
    d->holdout_mean_before_Nm = d->holdout_mean_after_Nm = NAN;
    d->holdout_ripple_before_Nm = d->holdout_ripple_after_Nm = NAN;
    return HCI_NOT_REACHED;
}

static hci_status diagnose_with(hci_dataset *b, const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    b->work += t->work;
    const hci_status status = diagnose(b, t, diagnosis, note);
    if (status) hci_diagnosis_release(diagnosis);
    return status;
}

static hci_status diagnose_from(const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    hci_dataset b;
    if (t->dataset) return diagnose_with(t->dataset, t, diagnosis, note);
    hci_status status = dataset_of(t, t->declared, &b, note);
    if (status) return status;
    status = diagnose_with(&b, t, diagnosis, note);
    hci_dataset_release(&b);
    return status;
}

static hci_status tell(const hci_free_friction *friction, const hci_runs *runs, hci_diagnosis *diagnosis,
                       hci_note *note)
{
    const hci_status status = hci_free_friction_tell(friction, runs, diagnosis, note);
    if (status) hci_diagnosis_release(diagnosis);
    return status;
}

static bool any_usable(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (is_usable(runs, k)) return true;
    return false;
}

static bool are_measured(const hci_runs *runs)
{
    for (size_t k = 0; k < runs->count; ++k)
        if (runs->run[k].torque_source != HCI_TORQUE_MEASURED) return false;
    return true;
}

/* Of the runs that tell a torque; friction of free shafts comes first. */
static hci_status diagnose_measured(const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    hci_free_friction friction = {0};
    task rest = *t;
    hci_status status = hci_free_friction_find(t->machine, t->declared, t->runs, &friction, note);
    if (!status && !any_usable(&friction.rest)) { /* what accelerates them was a load */
        hci_free_friction_release(&friction);
        return nothing_measured(t->declared, diagnosis, note);
    }
    if (friction.law.terms > 0) rest.declared = &friction.effects.list;
    rest.runs = &friction.rest;
    if (!are_measured(t->runs)) rest.dataset = NULL; /* of runs that may be other ones now */
    if (!status) status = diagnose_from(&rest, diagnosis, note);
    if (!status) status = tell(&friction, t->runs, diagnosis, note);
    hci_free_friction_release(&friction);
    if (!status && hci_constant_is_held(t->runs))
        diagnosis->held_constant_Nm_per_A = hci_torque_constant(&t->machine->model, t->declared);
    return status;
}

static size_t unknown_loads_of(const hci_runs *runs)
{
    size_t count = 0;
    for (size_t k = 0; k < runs->count; ++k)
        count += runs->role[k] == HCI_ROLE_FIT && runs->run[k].torque_source == HCI_TORQUE_HOLDING &&
                 runs->run[k].mean_is_unknown;
    return count;
}

/* All but what a run that disagrees with the others says. */
static hci_status diagnose_all(const task *t, hci_diagnosis *diagnosis, hci_note *note)
{
    const hci_status status = any_usable(t->runs) ? diagnose_measured(t, diagnosis, note)
                                                  : nothing_measured(t->declared, diagnosis, note);
    if (status > HCI_NOT_REACHED) return status;
    diagnosis->open_voltage_off = hci_open_voltage_off(&t->machine->model, t->runs);
    if (diagnosis->open_voltage_off > HCI_OPEN_VOLTAGE_OFF && diagnosis->verdict == HCI_DIAGNOSIS_COMPLETE)
        diagnosis->verdict = HCI_DIAGNOSIS_UNKNOWN;
    diagnosis->unknown_loads = unknown_loads_of(t->runs);
    if (diagnosis->unknown_loads > 0 && diagnosis->verdict == HCI_DIAGNOSIS_COMPLETE)
        diagnosis->verdict = HCI_DIAGNOSIS_UNKNOWN; /* of the ripple alone nothing is missing */
    return HCI_OK;
}

/* ---- one run that disagrees ---- */

/* The runs without one, which stay those of `runs`. rest: arrays to be freed. Index of that one. */
static hci_status take_out(const hci_runs *runs, const char *file, hci_runs *rest, size_t *index,
                           hci_note *note)
{
    *rest = (hci_runs){.run = hci_memory_new(runs->count + 1, sizeof *rest->run),
                       .role = hci_memory_new(runs->count + 1, sizeof *rest->role),
                       .list = runs->list};
    for (size_t k = 0; rest->run && rest->role && k < runs->count; ++k) {
        if (runs->run[k].name == file) {
            *index = k;
            continue;
        }
        rest->run[rest->count] = runs->run[k];
        rest->role[rest->count++] = runs->role[k];
    }
    return rest->run && rest->role ? HCI_OK : hci_note_memory(note, NULL, "the recordings");
}

static bool saturates(const hci_diagnosis *d)
{
    for (size_t k = 0; k < d->effects.list.count; ++k)
        if (d->effects.list.effect[k].type->beyond_quadratic) return true;
    return false;
}

/* A slip with no value to choose. */
static bool is_plain_slip(const hci_odd_run *odd)
{
    return odd->mended && !(fabs(odd->angle_rad) > 0.0);
}

/* Whether the others are understood, and this run is the one that disagrees with them then too. */
static hci_status confirm(const task *t, const hci_diagnosis *d, hci_odd_run *odd, bool *certain,
                          hci_note *note)
{
    hci_odd_run again;
    hci_dataset b;
    if (*certain || d->search != HCI_WORK_COMPLETE || d->verdict > HCI_DIAGNOSIS_AMBIGUOUS) return HCI_OK;
    hci_status status = dataset_of(t, &d->effects.list, &b, note);
    if (status) return status;
    status = hci_odd_run_find(t->machine, &b, t->runs, &again, certain, note);
    *certain = *certain && again.file == odd->file;
    if (*certain && !is_plain_slip(&again) && saturates(d))
        *certain = !hci_odd_run_is_beyond(&b, t->runs, again.file);
    hci_dataset_release(&b);
    if (*certain) *odd = again;
    return status;
}

/* Of all runs but one. */
static hci_status diagnose_without(const task *t, const char *file, hci_diagnosis *d, hci_note *note)
{
    hci_runs rest;
    size_t index = 0;
    task others = *t;
    others.runs = &rest;
    others.dataset = NULL;
    hci_status status = take_out(t->runs, file, &rest, &index, note);
    if (!status) status = diagnose_all(&others, d, note);
    for (size_t k = 0; !status && k < d->lines; ++k)
        d->line[k].run += d->line[k].run >= index;
    hci_memory_free(rest.run);
    hci_memory_free(rest.role);
    return status;
}

/* Of the others, where one disagrees; *certain: it does. */
static hci_status diagnose_others(const task *t, hci_odd_run *odd, bool *certain, hci_diagnosis *d,
                                  hci_note *note)
{
    hci_status status = diagnose_without(t, odd->file, d, note);
    if (!status) status = confirm(t, d, odd, certain, note);
    if (!status && *certain) d->odd = *odd;
    if (status || !*certain) hci_diagnosis_release(d);
    return status;
}

/* Where a run is only suspected: as soon as what the others show makes it agree, no more is asked of them,
 * and the search of all of them goes on from there. */
static hci_status suspicion_try(const task *t, hci_odd_run *odd, hci_diagnosis *d, hci_note *note)
{
    hci_suspect suspect;
    bool certain = false;
    task others = *t, all = *t;
    hci_status status = hci_suspect_make(t->machine, t->declared, t->runs, odd->file, &suspect, note);
    if (status) return status;
    others.suspect = &suspect;
    others.work = (1.0 - SUSPICION) * HCI_MOST_WORK;
    status = diagnose_others(&others, odd, &certain, d, note);
    if (status == HCI_ERROR_STOPPED) status = HCI_OK;
    if (!suspect.untold) {
        all.start = &suspect.shown;
        all.work = suspect.work;
    }
    if (!status && !certain) status = diagnose_all(&all, d, note);
    hci_suspect_release(&suspect);
    return status;
}

/* ---- one run whose mean is off ---- */

static bool explains(const hci_diagnosis *d)
{
    return d->search == HCI_WORK_COMPLETE && !d->means_open && !d->odd.file &&
           (d->verdict == HCI_DIAGNOSIS_COMPLETE || d->verdict == HCI_DIAGNOSIS_EXPLAINED);
}

/* The one of these runs without which the others are explained, and how; NULL: none, or it is not decisive.
 */
static hci_status explained_without(const task *t, const char *const file[HCI_ODD_MEANS], size_t count,
                                    const char **odd, hci_diagnosis *others, hci_note *note)
{
    hci_status status = HCI_OK;
    size_t explained = 0;
    *odd = NULL;
    for (size_t k = 0; k < count && explained < 2 && !status; ++k) {
        hci_diagnosis d = {0};
        status = diagnose_without(t, file[k], &d, note);
        const bool is_it = !status && explains(&d);
        if (is_it && explained == 0) {
            *others = d;
            *odd = file[k];
        } else {
            hci_diagnosis_release(&d);
        }
        explained += is_it;
    }
    if (explained != 1 || status) *odd = NULL;
    if (!*odd && explained > 0) hci_diagnosis_release(others);
    return status;
}

/* Where the means of all runs are not explained: those of all but one may be, which is off by a constant. */
static hci_status odd_mean_try(const task *t, hci_diagnosis *d, hci_note *note)
{
    const char *file[HCI_ODD_MEANS], *name;
    hci_diagnosis others = {0};
    hci_odd_run odd = {0};
    if (d->verdict < HCI_DIAGNOSIS_PARTLY || d->odd.file || d->slip || d->search != HCI_WORK_COMPLETE)
        return HCI_OK;
    const size_t count = hci_odd_means_rank(t->dataset, t->runs, d, file);
    hci_status status = explained_without(t, file, count, &name, &others, note);
    if (!status && name)
        status = hci_odd_mean_judge(t->machine, t->dataset, t->runs, name, &others, &odd, note);
    if (status || !odd.file) {
        hci_diagnosis_release(&others);
        return status;
    }
    hci_diagnosis_release(d);
    *d = others;
    d->odd = odd;
    return HCI_OK;
}

/* ---- one run beside which nothing is explained ---- */

#define MUCH       2.0 /* times the noise, that is left */
#define AT_LEISURE 2.0 /* times the work */

static bool is_collapsed(const hci_diagnosis *d)
{
    return d->verdict >= HCI_DIAGNOSIS_PARTLY && d->search != HCI_WORK_INTERRUPTED && !d->odd.file &&
           !d->slip && !d->nothing_measured && d->rms_after_Nm > MUCH * d->noise_Nm;
}

static bool is_answer(const hci_diagnosis *d)
{
    return d->search == HCI_WORK_COMPLETE && !d->means_open && !d->odd.file &&
           d->verdict <= HCI_DIAGNOSIS_AMBIGUOUS && d->rms_after_Nm <= MUCH * d->noise_Nm &&
           !(d->holdout_after_Nm > MUCH * d->holdout_noise_Nm);
}

/* Without one of the runs, with work enough to come to an end, if the others have an answer then. taken: out,
 * whether it is the one that is given. */
static hci_status aside_take(const task *t, const char *file, hci_diagnosis *d, bool *taken, hci_note *note)
{
    hci_diagnosis others = {0};
    hci_odd_run odd = {0};
    hci_diagnose_options options = *t->options;
    task longer = *t;
    options.work = AT_LEISURE * (options.work > 0.0 ? options.work : 1.0);
    longer.options = &options;
    hci_status status = diagnose_without(&longer, file, &others, note);
    if (status <= HCI_NOT_REACHED && is_answer(&others))
        status = hci_odd_aside_judge(t->machine, t->dataset, t->runs, file, &others, &odd, note);
    *taken = status <= HCI_NOT_REACHED && odd.file;
    if (!*taken) {
        hci_diagnosis_release(&others);
        return status;
    }
    hci_diagnosis_release(d);
    *d = others;
    d->odd = odd;
    return HCI_OK;
}

/* One run more is not to take away what the others say: where all are not explained and those without it are,
 * that is the answer, and it is said which one is not described. */
static hci_status aside_try(const task *t, hci_diagnosis *d, hci_note *note)
{
    const char *file[HCI_ODD_MEANS];
    hci_status status = HCI_OK;
    bool taken = false;
    if (!is_collapsed(d)) return HCI_OK;
    const size_t count = hci_odd_aside_pick(&t->machine->model, t->dataset, t->runs, d, file);
    for (size_t k = 0; k < count && !taken && status <= HCI_NOT_REACHED; ++k)
        status = aside_take(t, file[k], d, &taken, note);
    return status;
}

static hci_status diagnose_any(const task *t, hci_diagnosis *d, hci_note *note)
{
    hci_odd_run odd;
    bool certain = false;
    hci_status status = hci_odd_run_find(t->machine, t->dataset, t->runs, &odd, &certain, note);
    if (status) return status;
    if (odd.file)
        status = certain ? diagnose_others(t, &odd, &certain, d, note) : suspicion_try(t, &odd, d, note);
    else
        status = diagnose_all(t, d, note);
    if (!status) status = odd_mean_try(t, d, note);
    if (!status) status = aside_try(t, d, note);
    if (status > HCI_NOT_REACHED) hci_diagnosis_release(d);
    return status;
}

/* Of all runs, or of all but one that disagrees. */
static hci_status diagnose_runs(const task *t, hci_diagnosis *d, hci_note *note)
{
    hci_dataset b;
    task all = *t;
    if (!hci_odd_run_is_asked(t->runs)) return diagnose_all(t, d, note);
    hci_status status = dataset_of(t, t->declared, &b, note);
    if (status) return status;
    all.dataset = &b;
    status = diagnose_any(&all, d, note);
    hci_dataset_release(&b);
    return status;
}

hci_status hci_diagnose(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                        const hci_diagnose_options *options, hci_diagnosis *diagnosis, hci_note *note)
{
    size_t fitted = 0;
    memset(diagnosis, 0, sizeof *diagnosis);
    for (size_t k = 0; k < runs->count; ++k)
        fitted += runs->role[k] == HCI_ROLE_FIT;
    if (fitted == 0)
        return hci_note_set(note, HCI_ERROR_INPUT, "no run has the role `fit`; give it to at least one");
    const task all = {machine, declared, runs, options, NULL, NULL, NULL, 0.0};
    hci_status status = diagnose_runs(&all, diagnosis, note);
    if (!status) status = hci_origin_fill(&machine->model, runs, diagnosis, note);
    diagnosis->further_work = FURTHER * fmax(1.0, options->work);
    if (status) {
        hci_diagnosis_release(diagnosis);
        return status;
    }
    return diagnosis->verdict >= HCI_DIAGNOSIS_AMBIGUOUS || diagnosis->search != HCI_WORK_COMPLETE ||
                   diagnosis->odd.file
               ? HCI_NOT_REACHED
               : HCI_OK;
}
