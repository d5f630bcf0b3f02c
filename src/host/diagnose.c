#include "hci/host/diagnose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "advise.h"
#include "attribute.h"
#include "hci/frames.h"
#include "lines.h"
#include "memory.h"
#include "slip.h"
#include "unknown.h"

#define RESOLUTION 5e-4

const char *hci_finding_verdict_name(hci_finding_verdict verdict)
{
    static const char *const NAMES[] = {"added", "ambiguous", "rejected"};
    return NAMES[verdict];
}

const char *hci_diagnosis_verdict_name(hci_diagnosis_verdict verdict)
{
    static const char *const NAMES[] = {"complete", "explained", "ambiguous", "unknown"};
    return NAMES[verdict];
}

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory in the diagnosis");
}

/* ---- evidence ---- */

typedef struct {
    hci_cells cells;
    hci_evidence evidence;
    bool *fit, *any; /* of each run */
    double resolution_Nm;
    double *slip_rad; /* of each run */
    double reference_current_A;
} bench;

/* Noise of i_a + i_b + i_c from its changes between samples; where it is nothing but rounding it was not
 * measured. */
static double sum_deviation(const hci_run *r)
{
    double square = 0.0, largest = 0.0;
    if (!r->has_sum || r->count < 16) return NAN;
    for (size_t k = 1; k < r->count; ++k) {
        const double *i = r->i_A + 3 * k, *j = i - 3;
        const double change = i[0] + i[1] + i[2] - j[0] - j[1] - j[2];
        square += change * change;
        largest = fmax(largest, fabs(i[0]) + fabs(i[1]) + fabs(i[2]));
    }
    const double deviation = sqrt(0.5 * square / (double)(r->count - 1));
    return deviation > 1e-6 * largest ? deviation : (double)NAN;
}

static hci_status bench_make(const hci_machine_data *machine, const hci_effects *declared,
                             const hci_runs *runs, double resolution, bench *b, hci_note *note)
{
    double largest = 0.0;
    hci_status status;
    memset(b, 0, sizeof *b);
    status = hci_cells_make(&machine->model, runs->run, runs->count, &b->cells, note);
    if (status) return status;
    b->fit = hci_memory_new(2 * runs->count + 1, sizeof *b->fit);
    b->evidence = (hci_evidence){&machine->model, declared, &b->cells, runs->run, b->fit, false, NULL, NULL};
    b->evidence.noise = hci_memory_new(b->cells.stretch_count + 1, sizeof *b->evidence.noise);
    b->evidence.sum_deviation_A = hci_memory_new(runs->count + 1, sizeof(double));
    if (!b->fit || !b->evidence.noise || !b->evidence.sum_deviation_A) return no_memory(note);
    b->any = b->fit + runs->count;
    for (size_t k = 0; k < runs->count; ++k) {
        b->any[k] = true;
        b->fit[k] = runs->role[k] == HCI_ROLE_FIT;
        b->evidence.sum_deviation_A[k] = machine->has_neutral ? (double)NAN : sum_deviation(&runs->run[k]);
        largest = fmax(largest, b->cells.figures[k].rms_torque_Nm);
    }
    b->resolution_Nm = resolution * largest;
    b->reference_current_A = machine->rated_current_A;
    return HCI_OK;
}

/* In a machine with several pole pairs the torque of a run must not change with the turn: what is turned are
 * the currents too, since they were read as i_d and i_q of the slipped angle. */
static void currents_turn(bench *b, size_t run, double angle_rad)
{
    for (size_t k = 0; k < b->cells.stretch_count; ++k) {
        const hci_stretch *s = &b->cells.stretch[k];
        for (size_t j = s->first; s->run == run && j < s->first + s->count; ++j) {
            hci_sample *x[] = {&b->cells.cell[j].reading, &b->cells.cell[j].raw};
            for (int n = 0; n < 2; ++n) {
                const hci_dq i = hci_park(hci_clarke(x[n]->i_abc), angle_rad);
                hci_clarke_inverse(hci_park_inverse(i, 0.0), x[n]->i_abc);
            }
        }
    }
}

static hci_status slips_undo(const hci_runs *runs, bench *b, hci_note *note)
{
    double *residual = hci_memory_new(b->cells.count + 1, sizeof *residual);
    hci_status status = residual ? HCI_OK : no_memory(note);
    b->slip_rad = hci_memory_new(runs->count + 1, sizeof *b->slip_rad);
    if (!b->slip_rad) status = no_memory(note);
    b->evidence.use = b->any;
    if (!status) status = hci_evidence_residual(&b->evidence, b->evidence.declared, residual, note);
    if (!status) status = hci_slip_find(&b->cells, runs->run, residual, b->slip_rad, note);
    for (size_t k = 0; k < runs->count && !status; ++k) {
        if (b->slip_rad[k] == 0.0) continue;
        hci_slip_undo(&b->cells, k, b->slip_rad[k]);
        currents_turn(b, k, b->evidence.machine->pole_pairs * b->slip_rad[k]);
    }
    b->evidence.use = b->fit;
    hci_memory_free(residual);
    return status;
}

static void bench_release(bench *b)
{
    hci_memory_free(b->slip_rad);
    hci_memory_free(b->fit);
    hci_memory_free(b->evidence.noise);
    hci_memory_free(b->evidence.sum_deviation_A);
    hci_cells_release(&b->cells);
    memset(b, 0, sizeof *b);
}

/* ---- errors of the runs ---- */

static double cells_rms(const bench *b, size_t run, const double *residual, const double *noise,
                        double *count)
{
    double sum = 0.0;
    *count = 0.0;
    for (size_t k = 0; k < b->cells.stretch_count; ++k) {
        const hci_stretch *s = &b->cells.stretch[k];
        for (size_t j = s->first; s->run == run && j < s->first + s->count; ++j) {
            const double within = s->turns > 0 && isfinite(*noise) ? *noise * *noise : 0.0;
            const double n = b->cells.cell[j].count;
            sum += n * residual[j] * residual[j] + (n - 1.0) * within;
            *count += n;
        }
    }
    return *count > 0.0 ? sqrt(sum / *count) : (double)NAN;
}

/* How far a sample's residual is from the mean of those at the same angle in other turns; NAN for fewer than
 * three turns. */
static double repeatability(const bench *b, size_t run, const double *residual, double turn_rad)
{
    enum { MOST_CELLS = 512 };
    double sum[MOST_CELLS] = {0.0}, square[MOST_CELLS] = {0.0}, count[MOST_CELLS] = {0.0};
    double total = 0.0, freedom = 0.0, samples = 0.0;
    for (size_t k = 0; k < b->cells.stretch_count; ++k)
        if (b->cells.stretch[k].run == run) samples += (double)b->cells.stretch[k].count;
    const size_t cells = samples < 8.0 * MOST_CELLS ? (size_t)(samples / 8.0) + 1 : MOST_CELLS;
    for (size_t k = 0; k < b->cells.stretch_count; ++k) {
        const hci_stretch *s = &b->cells.stretch[k];
        for (size_t j = s->first; s->run == run && j < s->first + s->count; ++j) {
            const double x = b->cells.cell[j].raw.theta_m_rad / turn_rad;
            const size_t at = (size_t)((x - floor(x)) * (double)cells) % cells;
            sum[at] += residual[j];
            square[at] += residual[j] * residual[j];
            count[at] += 1.0;
        }
    }
    for (size_t c = 0; c < cells; ++c) {
        if (count[c] < 2.0) continue;
        total += square[c] - sum[c] * sum[c] / count[c];
        freedom += count[c] - 1.0;
    }
    return freedom > 50.0 ? sqrt(fmax(total, 0.0) / freedom) : (double)NAN;
}

/* From the turns that a run has; with one turn from its spectrum between the orders. */
static double noise_floor(const bench *b, const hci_run *runs, size_t run, const double *residual)
{
    const hci_run_figures *f = &b->cells.figures[run];
    const double turn_rad = 2.0 * HCI_PI / (runs[run].turn_known ? 1.0 : b->evidence.machine->pole_pairs);
    for (size_t k = 0; k < b->cells.stretch_count; ++k)
        if (b->cells.stretch[k].run == run && b->cells.stretch[k].turns > 0) return f->repeat_Nm;
    if (f->turns * 2.0 * HCI_PI < 3.0 * turn_rad) return NAN;
    return repeatability(b, run, residual, turn_rad);
}

static double stretch_noise(const bench *b, size_t run)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < b->cells.stretch_count; ++k) {
        const hci_stretch *s = &b->cells.stretch[k];
        if (s->run != run) continue;
        sum += (double)s->count * b->evidence.noise[k].rms * b->evidence.noise[k].rms;
        count += (double)s->count;
    }
    return count > 0.0 ? sqrt(sum / count) : (double)NAN;
}

static hci_status lines_fill(const bench *b, const double *before, const double *after, hci_diagnosis *d,
                             hci_note *note)
{
    double *noise = hci_memory_new(b->cells.run_count + 1, sizeof *noise);
    hci_status status = noise ? HCI_OK : no_memory(note);
    for (size_t r = 0; r < b->cells.run_count && !status; ++r)
        noise[r] = stretch_noise(b, r);
    if (!status) status = hci_lines_make(&b->evidence, before, after, noise, &d->line, &d->lines, note);
    hci_memory_free(noise);
    return status;
}

static hci_status errors_fill(bench *b, const hci_runs *runs, size_t parameters, hci_diagnosis *d,
                              hci_note *note)
{
    const size_t cells = b->cells.count;
    double *before = hci_memory_new(2 * cells + 1, sizeof *before), *after = before + cells;
    hci_status status = before ? HCI_OK : no_memory(note);
    d->run = hci_memory_new(runs->count + 1, sizeof *d->run);
    if (!status && !d->run) status = no_memory(note);
    b->evidence.use = b->any;
    b->evidence.raw = true;
    if (!status) status = hci_evidence_residual(&b->evidence, b->evidence.declared, before, note);
    if (!status) status = hci_evidence_residual(&b->evidence, &d->effects.list, after, note);
    if (!status) status = hci_attribute_noise(&b->evidence, after, parameters, 0.0, note);
    if (!status) status = lines_fill(b, before, after, d, note);
    for (size_t k = 0; k < runs->count && !status; ++k) {
        const hci_run_figures *f = &b->cells.figures[k];
        hci_run_errors *e = &d->run[d->runs];
        double count;
        memset(e, 0, sizeof *e);
        e->file = runs->run[k].name;
        e->role = runs->role[k];
        e->mean_torque_Nm = f->mean_torque_Nm;
        e->slip_rad = b->slip_rad[k];
        e->rms_before_Nm = cells_rms(b, k, before, &f->repeat_Nm, &count);
        e->rms_after_Nm = cells_rms(b, k, after, &f->repeat_Nm, &count);
        e->noise_floor_Nm = noise_floor(b, runs->run, k, after);
        if (!isfinite(e->noise_floor_Nm)) e->noise_floor_Nm = stretch_noise(b, k);
        if (!(count > 0.0)) continue;
        const double spread = 1.96 / sqrt(2.0 * count);
        e->after_low_Nm = e->rms_after_Nm * fmax(0.0, 1.0 - spread);
        e->after_high_Nm = e->rms_after_Nm * (1.0 + spread);
        ++d->runs;
    }
    b->evidence.use = b->fit;
    hci_memory_free(before);
    return status;
}

static void totals_fill(hci_diagnosis *d)
{
    double sum[2][3] = {{0.0}}, count[2] = {0.0};
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        double *s = sum[e->role == HCI_ROLE_HOLDOUT];
        s[0] += e->rms_before_Nm * e->rms_before_Nm;
        s[1] += e->rms_after_Nm * e->rms_after_Nm;
        s[2] += e->noise_floor_Nm * e->noise_floor_Nm;
        count[e->role == HCI_ROLE_HOLDOUT] += 1.0;
    }
    d->rms_before_Nm = sqrt(sum[0][0] / count[0]);
    d->rms_after_Nm = sqrt(sum[0][1] / count[0]);
    d->noise_Nm = sqrt(sum[0][2] / count[0]);
    d->holdout_before_Nm = count[1] > 0.0 ? sqrt(sum[1][0] / count[1]) : (double)NAN;
    d->holdout_after_Nm = count[1] > 0.0 ? sqrt(sum[1][1] / count[1]) : (double)NAN;
    d->holdout_noise_Nm = count[1] > 0.0 ? sqrt(sum[1][2] / count[1]) : (double)NAN;
}

/* ---- findings ---- */

/* "sine_18 = 0.021 ± 0.0008 N·m, …" */
static void describe(const hci_suspects *s, const hci_effect_room *room, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < s->count; ++k) {
        const hci_suspect *x = &s->suspect[k];
        for (size_t j = 0; x->in && x->room == room && j < x->count; ++j) {
            const hci_effect_parameter *p = &room->parameter[x->term[j].parameter];
            char order[32] = "";
            if (used + 80 > size) {
                snprintf(text + used, size - used, "; …");
                return;
            }
            if (p->ordered) snprintf(order, sizeof order, "_%.6g", x->term[j].order);
            used += (size_t)snprintf(text + used, size - used, "%s%s%s = %.4g ± %.2g %s", used ? "; " : "",
                                     p->name, order, x->term[j].value, x->term[j].std_error,
                                     strcmp(p->unit, "1") == 0 ? "" : p->unit);
        }
    }
}

static void findings_fill(const hci_attribution *a, hci_diagnosis *d)
{
    const double whole = d->rms_before_Nm * d->rms_before_Nm;
    for (size_t r = 0; r < a->rooms; ++r) {
        const hci_verdict *v = &a->verdict[r];
        hci_finding f = {v->room->name, HCI_FINDING_REJECTED, v->gain, NAN, ""};
        if (v->ambiguous)
            f.verdict = HCI_FINDING_AMBIGUOUS;
        else if (v->in)
            f.verdict = HCI_FINDING_ADDED;
        if (v->in && whole > 0.0) f.residual_share = fmin(1.0, v->explained_Nm * v->explained_Nm / whole);
        if (v->in) describe(&a->suspects, v->room, f.detail, sizeof f.detail);
        if (!v->in && v->ambiguous) {
            const int n = snprintf(f.detail, sizeof f.detail, "in place of %s: ", v->rival_of->name);
            describe(&v->alternative, v->room, f.detail + n, sizeof f.detail - (size_t)n);
        }
        d->finding[d->findings++] = f;
    }
    for (size_t i = 1; i < d->findings; ++i) {
        const hci_finding f = d->finding[i];
        size_t j = i;
        for (;
             j > 0 && (d->finding[j - 1].verdict > f.verdict ||
                       (d->finding[j - 1].verdict == f.verdict && d->finding[j - 1].delta_bic < f.delta_bic));
             --j)
            d->finding[j] = d->finding[j - 1];
        d->finding[j] = f;
    }
}

/* What the search describes without knowing it, in words of growth. */
static void unexplained_fill(const bench *b, const hci_attribution *a, hci_diagnosis *d)
{
    double most_A = 0.0, most_speed = 0.0;
    for (size_t r = 0; r < b->cells.run_count; ++r) {
        most_A = fmax(most_A, b->cells.figures[r].current_A);
        most_speed = fmax(most_speed, fabs(b->cells.figures[r].mean_speed_rad_per_s));
    }
    d->wanders = a->unknown && (a->excess > 0.1 || a->clumps > 1.35);
    for (size_t k = 0; k < a->suspects.count && d->unexplained_count < HCI_MOST_UNEXPLAINED; ++k) {
        const hci_suspect *s = &a->suspects.suspect[k];
        if (!a->unknown || !s->in || s->room != &hci_unknown_room) continue;
        const size_t g = s->term[0].parameter / 2;
        const hci_growth growth = hci_growth_of(g);
        const double S = s->term[0].value, C = s->term[1].value;
        d->unexplained[d->unexplained_count++] =
            (hci_unexplained){s->term[0].order,
                              S,
                              C,
                              growth.current,
                              growth.speed,
                              growth.turns_sign,
                              hypot(S, C) * fabs(hci_growth_at(g, most_A, most_speed))};
    }
}

/* What no effect explains goes first. */
static void unknown_add(const hci_attribution *a, hci_diagnosis *d)
{
    hci_finding *f = &d->finding[0];
    size_t at = 0;
    while (at < d->findings && strcmp(d->finding[at].effect, "unknown") != 0)
        ++at;
    if (at == d->findings) ++d->findings;
    memmove(f + 1, f, at * sizeof *f);
    *f = (hci_finding){"unknown", HCI_FINDING_ADDED, NAN, NAN, ""};
    f->residual_share = a->unexplained_Nm * a->unexplained_Nm / (d->rms_before_Nm * d->rms_before_Nm);
    f->delta_bic = a->before.score - a->fit.score;
    snprintf(f->detail, sizeof f->detail, "rms %.3g N·m that grows as no known effect does",
             a->unexplained_Nm);
}

static hci_status effects_fill(const bench *b, hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    hci_model model;
    for (size_t k = 0; k < a->suspects.count; ++k)
        if (a->suspects.suspect[k].room == &hci_unknown_room) a->suspects.suspect[k].in = false;
    const hci_status status = hci_model_make(b->evidence.declared, &a->suspects, false, &model, note);
    if (status) return status;
    d->effects = (hci_effects_data){model.list, model.effect, model.term};
    hci_memory_free(model.column);
    return HCI_OK;
}

/* What would tell the ambiguous ones apart, one sentence for each. */
static hci_status advice_fill(const bench *b, const hci_attribution *a, hci_diagnosis *d, hci_note *note)
{
    hci_status status = HCI_OK;
    for (size_t r = 0; r < a->rooms && !status; ++r) {
        const hci_verdict *v = &a->verdict[r];
        const size_t used = strlen(d->advice);
        if (v->in || !v->ambiguous || !v->alternative.suspect || used + 200 > sizeof d->advice) continue;
        if (used > 0) memcpy(d->advice + used, "; ", 3);
        status = hci_advise(&b->evidence, &a->suspects, &v->alternative, v->rival_of->name, v->room->name,
                            d->advice + strlen(d->advice), sizeof d->advice - strlen(d->advice), note);
    }
    return status;
}

static hci_status diagnose(bench *b, const hci_runs *runs, const hci_diagnose_options *options,
                           hci_diagnosis *d, hci_note *note)
{
    const hci_attribute_options how = {runs->run, b->resolution_Nm, b->reference_current_A, options->progress,
                                       options->progress_context};
    hci_attribution a;
    hci_status status = hci_attribute(&b->evidence, &how, &a, note);
    if (status) return status;
    unexplained_fill(b, &a, d);
    status = effects_fill(b, &a, d, note);
    b->evidence.raw = false;
    if (!status) status = advice_fill(b, &a, d, note);
    if (!status) status = errors_fill(b, runs, a.fit.parameters, d, note);
    if (!status) {
        totals_fill(d);
        findings_fill(&a, d);
        if (a.unknown) unknown_add(&a, d);
        d->verdict = a.unknown ? HCI_DIAGNOSIS_UNKNOWN : HCI_DIAGNOSIS_COMPLETE;
        for (size_t k = 0; k < d->findings; ++k) {
            if (d->finding[k].verdict == HCI_FINDING_AMBIGUOUS && !a.unknown)
                d->verdict = HCI_DIAGNOSIS_AMBIGUOUS;
            if (d->finding[k].verdict == HCI_FINDING_ADDED && d->verdict == HCI_DIAGNOSIS_COMPLETE)
                d->verdict = HCI_DIAGNOSIS_EXPLAINED;
        }
    }
    hci_attribution_release(&a);
    return status;
}

hci_status hci_diagnose(const hci_machine_data *machine, const hci_effects *declared, const hci_runs *runs,
                        const hci_diagnose_options *options, hci_diagnosis *diagnosis, hci_note *note)
{
    bench b;
    size_t usable = 0;
    hci_status status;
    memset(diagnosis, 0, sizeof *diagnosis);
    for (size_t k = 0; k < runs->count; ++k)
        usable += runs->role[k] == HCI_ROLE_FIT && runs->run[k].torque_Nm && runs->run[k].theta_m_rad;
    if (usable == 0)
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "no run with the role `fit` has an angle and a torque; add torque_Nm (0 for a "
                            "holding test), or `inertia` to machine.csv for a free shaft");
    status = bench_make(machine, declared, runs, options->resolution > 0.0 ? options->resolution : RESOLUTION,
                        &b, note);
    if (!status) status = slips_undo(runs, &b, note);
    if (!status) status = diagnose(&b, runs, options, diagnosis, note);
    bench_release(&b);
    if (status) {
        hci_diagnosis_release(diagnosis);
        return status;
    }
    return diagnosis->verdict >= HCI_DIAGNOSIS_AMBIGUOUS ? HCI_NOT_REACHED : HCI_OK;
}

void hci_diagnosis_release(hci_diagnosis *d)
{
    hci_effects_release(&d->effects);
    hci_memory_free(d->run);
    hci_memory_free(d->line);
    memset(d, 0, sizeof *d);
}
