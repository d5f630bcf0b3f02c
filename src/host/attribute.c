#include "attribute.h"

#include <math.h>
#include <string.h>

#include "memory.h"
#include "unknown.h"

#define DECISIVE        10.0 /* fall of the score that makes an effect believed: odds of 150 to 1 */
#define EQUAL           6.0  /* models whose scores differ by less fit as well as each other */
#define PAIR_MARGIN     0.02 /* what two effects at once must explain more than one, as a share */
#define EXCESS          0.1 /* variance over that of the noise that tells of something that does not repeat */
#define CLUMPS          1.35 /* the same of how uneven the errors are; noise makes 1.0 ± 0.1 */
#define SMALL           0.6  /* what is not understood is no finding below this share of what is */
#define UNTOUCHED       1.5 /* a known effect this much larger than what is not understood stands beside it */
#define RESONANCE_PRICE 12.0 /* of having looked at so many frequencies */
#define WORTH           2.0  /* least fall for one more order of an effect */
#define MUCH            3.0  /* times the resolution: worth high powers of the currents */
#define LITTLE          1e-3 /* and its least share of what noise is in all samples */
#define NOTICEABLE      0.05 /* least torque of an effect, as a share of the noise of a sample */

enum { TRIALS = 3, MOST_EFFECTS = 6, MOST_ROUNDS = 14, MOST_ORDERS = 12, MOST_POWERS = 80 };

static hci_status no_memory(hci_note *note)
{
    return hci_note_set(note, HCI_ERROR_MEMORY, "out of memory for the search of effects");
}

/* ---- copies ---- */

static bool copy(const hci_suspects *from, hci_suspects *to)
{
    *to = *from;
    to->suspect = hci_memory_new(from->count + 1, sizeof *to->suspect);
    if (to->suspect) memcpy(to->suspect, from->suspect, from->count * sizeof *to->suspect);
    return to->suspect != NULL;
}

static void replace(hci_suspects *old, hci_suspects *by)
{
    hci_suspects_release(old);
    *old = *by;
    memset(by, 0, sizeof *by);
}

/* ---- rooms ---- */

static size_t room_index(const hci_effect_room *room)
{
    size_t k = 0;
    while (hci_suspect_room(k) != room)
        ++k;
    return k;
}

static size_t room_count(void)
{
    size_t k = 0;
    while (hci_suspect_room(k))
        ++k;
    return k;
}

static bool room_in(const hci_suspects *s, const hci_effect_room *room)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->suspect[k].in && s->suspect[k].room == room) return true;
    return false;
}

static size_t rooms_in(const hci_suspects *s)
{
    size_t sum = 0;
    for (size_t r = 0; hci_suspect_room(r); ++r)
        sum += room_in(s, hci_suspect_room(r));
    return sum;
}

static void room_out(hci_suspects *s, const hci_effect_room *room)
{
    for (size_t k = 0; k < s->count; ++k)
        if (s->suspect[k].room == room) s->suspect[k].in = false;
}

/* ---- noise ---- */

/* Whether the angles of a stretch are whole electrical periods, evenly spaced. */
static bool is_closed(const hci_evidence *e, const hci_stretch *s)
{
    const hci_cell *cell = e->cells->cell + s->first;
    const double n = (double)s->count, p = e->machine->pole_pairs;
    if (s->turns > 0) return true;
    const double span = fabs(cell[s->count - 1].reading.theta_m_rad - cell[0].reading.theta_m_rad);
    const double periods = span * n / (n - 1.0) * p / (2.0 * HCI_PI);
    const double step = span / (n - 1.0);
    for (size_t k = 1; k < s->count; ++k)
        if (fabs(fabs(cell[k].reading.theta_m_rad - cell[k - 1].reading.theta_m_rad) - step) > 0.02 * step)
            return false;
    return fabs(periods - floor(periods + 0.5)) < 0.1 / n && periods > 0.5;
}

hci_status hci_attribute_noise(hci_evidence *e, const double *residual_Nm, size_t parameters, double floor_Nm,
                               hci_note *note)
{
    double square = 0.0, rows = 0.0, *work;
    size_t most = HCI_NOISE_LEAST;
    for (size_t k = 0; k < e->cells->stretch_count; ++k)
        most = e->cells->stretch[k].count > most ? e->cells->stretch[k].count : most;
    work = hci_memory_new(hci_noise_workspace(most), sizeof *work);
    if (!work) return no_memory(note);
    for (size_t k = 0; k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        if (!e->use[s->run]) continue;
        if (s->count >= HCI_NOISE_LEAST) {
            hci_noise_find(residual_Nm + s->first, s->count, is_closed(e, s), floor_Nm, &e->noise[k], work);
            continue;
        }
        for (size_t j = s->first; j < s->first + s->count; ++j)
            square += residual_Nm[j] * residual_Nm[j];
        rows += (double)s->count;
    }
    const double freedom = fmax(rows - (double)parameters, 0.25 * rows);
    for (size_t k = 0; k < e->cells->stretch_count; ++k) {
        const hci_stretch *s = &e->cells->stretch[k];
        if (e->use[s->run] && s->count < HCI_NOISE_LEAST)
            e->noise[k] = hci_noise_white(hypot(sqrt(square / freedom), floor_Nm));
    }
    hci_memory_free(work);
    return HCI_OK;
}

/* ---- where a model stands ---- */

typedef struct {
    hci_evidence *evidence;
    const hci_attribute_options *options;
    double *residual, *variance; /* of each cell */
    double rows;
    int richness; /* of saturation */
} search;

static hci_status residual_of(search *s, const hci_suspects *suspects, hci_note *note)
{
    hci_model model;
    hci_status status = hci_model_make(s->evidence->declared, suspects, false, &model, note);
    if (!status) status = hci_evidence_residual(s->evidence, &model.list, s->residual, note);
    hci_model_release(&model);
    return status;
}

/* Root mean square of the residual over the runs in use. */
static double residual_rms(const search *s)
{
    const hci_cells *cells = s->evidence->cells;
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < cells->stretch_count; ++k) {
        const hci_stretch *x = &cells->stretch[k];
        for (size_t j = x->first; s->evidence->use[x->run] && j < x->first + x->count; ++j) {
            sum += s->residual[j] * s->residual[j];
            count += 1.0;
        }
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

static double noise_rms(const search *s)
{
    const hci_cells *cells = s->evidence->cells;
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < cells->stretch_count; ++k) {
        if (!s->evidence->use[cells->stretch[k].run]) continue;
        sum += s->evidence->noise[k].rms * s->evidence->noise[k].rms * (double)cells->stretch[k].count;
        count += (double)cells->stretch[k].count;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

static size_t parameters_in(const hci_suspects *s)
{
    size_t sum = 0;
    for (size_t k = 0; k < s->count; ++k)
        if (s->suspect[k].in) sum += s->suspect[k].count;
    return sum;
}

/* A fresh list of suspects for what the model leaves, the model in it. */
static hci_status suspects_renew(search *s, const hci_suspects *model, hci_suspects *list, hci_note *note)
{
    const hci_cells *cells = s->evidence->cells;
    hci_status status = residual_of(s, model, note);
    for (size_t k = 0; k < cells->stretch_count; ++k) {
        const hci_stretch *x = &cells->stretch[k];
        const double rms = s->evidence->noise[k].rms;
        for (size_t j = x->first; j < x->first + x->count; ++j)
            s->variance[j] = s->evidence->use[x->run] && rms > 0.0 ? rms * rms : 1e300;
    }
    if (status) return status;
    const hci_suspects_source source = {s->evidence->machine,
                                        cells,
                                        s->options->runs,
                                        s->residual,
                                        s->variance,
                                        s->options->reference_current_A,
                                        room_in(model, hci_effect_room_find("saturation")) ? s->richness : 0};
    return hci_suspects_make(&source, model, list, note);
}

/* ---- greedy choice within some rooms ---- */

typedef struct {
    const hci_suspects *list;
    const size_t *column; /* first column of each suspect */
    double rows;
} choice;

static bool allowed(const hci_suspect *x, size_t a, size_t b)
{
    const size_t r = room_index(x->room);
    return r == a || r == b;
}

static bool enter(hci_sweep *sweep, const choice *c, size_t k, bool in)
{
    bool any = false;
    for (size_t j = 0; j < c->list->suspect[k].count; ++j) {
        if (in)
            any = hci_sweep_in(sweep, c->column[k] + j) || any;
        else
            hci_sweep_out(sweep, c->column[k] + j);
    }
    return any;
}

/* What one more suspect of an effect must bring: of many orders there is always one that brings a little. */
static double worth_of(const hci_suspect *x, double rows)
{
    return x->room->parameter[x->term[0].parameter].ordered ? fmax(WORTH, LITTLE * rows) : WORTH;
}

/* A set of suspects that grows: those of rooms a and b that are not in the model yet. */
typedef struct {
    hci_sweep *sweep;
    const choice *choice;
    size_t a, b;
    bool *in; /* of each suspect */
    double cost;
} growing;

static bool is_open(const growing *g, size_t k)
{
    const hci_suspect *x = &g->choice->list->suspect[k];
    return !g->in[k] && !x->in && allowed(x, g->a, g->b);
}

static double cost_of(const growing *g, size_t k)
{
    return hci_suspect_cost(&g->choice->list->suspect[k], g->choice->rows);
}

static double worth(const growing *g, size_t k)
{
    return hci_sweep_worth(g->sweep, g->choice->column[k], g->choice->list->suspect[k].count);
}

static bool take(growing *g, size_t k)
{
    if (!enter(g->sweep, g->choice, k, true)) return false;
    g->in[k] = true;
    g->cost += cost_of(g, k);
    return true;
}

/* Takes in the one that is worth most over its cost. */
static bool take_best(growing *g, bool first)
{
    const size_t n = g->choice->list->count;
    size_t best = n;
    double most = 0.0;
    for (size_t k = 0; k < n; ++k) {
        if (!is_open(g, k)) continue;
        const double gain = worth(g, k) - cost_of(g, k);
        if (gain > most && (first || gain > worth_of(&g->choice->list->suspect[k], g->choice->rows))) {
            most = gain;
            best = k;
        }
    }
    return best < n && take(g, best);
}

/* Takes out those that are no longer worth their cost, the least worthy first. */
static void leave_worthless(growing *g)
{
    for (;;) {
        const size_t n = g->choice->list->count;
        size_t worst = n;
        double least = 0.0;
        for (size_t k = 0; k < n; ++k) {
            if (!g->in[k]) continue;
            const double gain = worth(g, k) - cost_of(g, k);
            if (gain < least) {
                least = gain;
                worst = k;
            }
        }
        if (worst == n) return;
        enter(g->sweep, g->choice, worst, false);
        g->in[worst] = false;
        g->cost -= cost_of(g, worst);
    }
}

/* Takes suspects in while they are worth it, and those out that are no more. Returns the fall of the score.
 */
static double grow(growing *g, double before)
{
    const bool powers = hci_suspect_room(g->a) == hci_effect_room_find("saturation");
    for (int step = 0; step < (powers ? MOST_POWERS : MOST_ORDERS); ++step) {
        if (!take_best(g, step == 0 && g->cost == 0.0)) break;
        leave_worthless(g);
    }
    return before - g->sweep->square - g->cost;
}

/* The mean torque of an iron that saturates takes several powers of the currents at once, none of which is
 * worth much alone: all of them first. */
static bool seed_powers(growing *g)
{
    const hci_effect_room *saturation = hci_effect_room_find("saturation");
    bool any = false;
    for (size_t k = 0; k < g->choice->list->count; ++k) {
        const hci_suspect *x = &g->choice->list->suspect[k];
        if (x->room == saturation && x->term[0].order == 0.0 && is_open(g, k)) any = take(g, k) || any;
    }
    if (any) leave_worthless(g);
    return any;
}

/* What suspects of rooms a and b are worth beside the model; in: out, those that are. */
static double trial_gain(hci_sweep *sweep, const hci_sweep *base, const choice *c, size_t a, size_t b,
                         bool *in, bool *seeded)
{
    growing g = {sweep, c, a, b, in, 0.0};
    hci_sweep_copy(sweep, base);
    const double plain = grow(&g, base->square);
    g.in = seeded;
    g.cost = 0.0;
    hci_sweep_copy(sweep, base);
    memset(seeded, 0, c->list->count * sizeof *seeded);
    if (!seed_powers(&g)) return plain;
    const double gain = grow(&g, base->square);
    if (gain <= plain) return plain;
    memcpy(in, seeded, c->list->count * sizeof *in);
    return gain;
}

/* ---- trials ---- */

/* One or two rooms that could come in together, and what the linearised problem promises. */
typedef struct {
    size_t a, b; /* equal for one */
    double gain;
    bool *in; /* of each suspect */
} trial;

typedef struct {
    trial trial[HCI_MOST_ROOMS * (HCI_MOST_ROOMS + 1) / 2];
    size_t count;
    hci_suspects list;
    bool *flags;
} trials;

static void trials_release(trials *t)
{
    hci_suspects_release(&t->list);
    hci_memory_free(t->flags);
    memset(t, 0, sizeof *t);
}

static hci_status trials_fill(search *s, trials *t, const hci_normal *normal, bool pairs, hci_note *note)
{
    const size_t n = t->list.count, rooms = room_count();
    hci_sweep base = {0}, sweep = {0};
    size_t *column = hci_memory_new(n + 1, sizeof *column);
    bool made = column && hci_sweep_start(&base, normal) && hci_sweep_start(&sweep, normal);
    const choice c = {&t->list, column, normal->rows};
    s->rows = normal->rows;
    t->flags = hci_memory_new((n + 1) * (sizeof t->trial / sizeof t->trial[0] + 1), sizeof *t->flags);
    made = made && t->flags;
    bool *seeded = t->flags + (n + 1) * (sizeof t->trial / sizeof t->trial[0]);
    for (size_t k = 0, at = 0; made && k < n; ++k) {
        column[k] = at;
        at += t->list.suspect[k].count;
        if (t->list.suspect[k].in) enter(&base, &c, k, true);
    }
    for (size_t a = 0; made && a < rooms; ++a) {
        for (size_t b = a; b < (pairs ? rooms : a + 1); ++b) {
            trial *x = &t->trial[t->count];
            *x = (trial){a, b, 0.0, t->flags + t->count * (n + 1)};
            x->gain = trial_gain(&sweep, &base, &c, a, b, x->in, seeded);
            ++t->count;
        }
    }
    hci_sweep_release(&base);
    hci_sweep_release(&sweep);
    hci_memory_free(column);
    return made ? HCI_OK : no_memory(note);
}

/* What one more effect, or two, would be worth on top of a model. */
static hci_status trials_make(search *s, const hci_suspects *model, bool pairs, trials *t, hci_note *note)
{
    hci_normal normal;
    hci_status status;
    memset(t, 0, sizeof *t);
    status = suspects_renew(s, model, &t->list, note);
    if (status) return status;
    status = hci_evidence_normal(s->evidence, &t->list, true, &normal, note);
    if (!status) status = trials_fill(s, t, &normal, pairs, note);
    hci_normal_release(&normal);
    if (status) trials_release(t);
    return status;
}

/* The model with the suspects of a trial, fitted. */
static hci_status trial_fit(search *s, const trials *t, const trial *x, hci_suspects *model, hci_fit *fit,
                            hci_note *note)
{
    if (!copy(&t->list, model)) return no_memory(note);
    for (size_t k = 0; k < model->count; ++k)
        model->suspect[k].in = model->suspect[k].in || x->in[k];
    const hci_status status = hci_evidence_fit(s->evidence, model, fit, note);
    if (status) hci_suspects_release(model);
    return status;
}

/* ---- forward ---- */

static bool uses(const trial *x, size_t room)
{
    return x->a == room || x->b == room;
}

/* The best single effects, and the best pair where it beats what begins with the best of them. */
static size_t trials_pick(const trials *t, const trial *picked[TRIALS + 1])
{
    const trial *best_pair = NULL, *with_first = NULL;
    size_t count = 0;
    while (count < TRIALS) {
        const trial *best = NULL;
        for (size_t k = 0; k < t->count; ++k) {
            const trial *x = &t->trial[k];
            bool taken = x->a != x->b || x->gain < 0.5 * DECISIVE;
            for (size_t j = 0; j < count; ++j)
                taken = taken || picked[j] == x;
            if (!taken && (!best || x->gain > best->gain)) best = x;
        }
        if (!best || (count > 0 && best->gain < picked[0]->gain - 0.3 * picked[0]->gain - 60.0)) break;
        picked[count++] = best;
    }
    for (size_t k = 0; k < t->count; ++k) {
        const trial *x = &t->trial[k];
        if (x->a == x->b) continue;
        if (!best_pair || x->gain > best_pair->gain) best_pair = x;
        if (count > 0 && uses(x, picked[0]->a) && (!with_first || x->gain > with_first->gain)) with_first = x;
    }
    if (best_pair && best_pair->gain > DECISIVE * 2.0 &&
        (!with_first || best_pair->gain > with_first->gain + DECISIVE))
        picked[count++] = best_pair;
    return count;
}

/* Of the readings as they are: smoothing takes the noise of currents and angle out of the residual, but not
 * out of the few orders that effects are found in. */
static hci_status noise_renew(search *s, hci_suspects *model, hci_fit *fit, hci_note *note)
{
    s->evidence->raw = true;
    hci_status status = residual_of(s, model, note);
    s->evidence->raw = false;
    if (!status)
        status = hci_attribute_noise(s->evidence, s->residual, parameters_in(model),
                                     s->options->resolution_Nm, note);
    if (!status) status = hci_evidence_fit(s->evidence, model, fit, note);
    return status;
}

/* Whether what one more effect changes is large enough to matter; one that is in may always become more
 * exact. */
static hci_status is_noticeable(search *s, const hci_suspects *with, const hci_suspects *without,
                                bool *answer, double *explained_Nm, hci_note *note)
{
    hci_status status = residual_of(s, with, note);
    const double after = residual_rms(s);
    if (!status) status = residual_of(s, without, note);
    const double before = residual_rms(s);
    *explained_Nm = sqrt(fmax(0.0, before * before - after * after));
    *answer = *explained_Nm > fmax(NOTICEABLE * noise_rms(s), 0.5 * s->options->resolution_Nm) ||
              rooms_in(with) == rooms_in(without);
    return status;
}

/* The model with a resonance of the torque sensor, fitted from the best point of a grid. */
static hci_status resonance_fit(search *s, const hci_suspects *model, hci_suspects *with, hci_fit *fit,
                                bool *found, hci_note *note)
{
    const hci_effect_room *room = hci_effect_room_find("torque_sensor");
    hci_suspect x = {.room = room, .count = 2, .price = RESONANCE_PRICE, .in = true};
    double gain;
    hci_status status = residual_of(s, model, note);
    *found = false;
    x.term[0] = (hci_effect_term){1, 0.0, 0.0, NAN};
    x.term[1] = (hci_effect_term){2, 0.0, 0.0, NAN};
    if (status || room_in(model, room)) return status;
    status =
        hci_evidence_resonance(s->evidence, s->residual, &x.term[0].value, &x.term[1].value, &gain, note);
    if (status || gain < hci_suspect_cost(&x, s->rows) + DECISIVE) return status;
    if (!copy(model, with)) return no_memory(note);
    status = hci_suspects_add(with, &x, note);
    if (!status) status = hci_evidence_fit(s->evidence, with, fit, note);
    *found = !status;
    return status;
}

/* High powers of the currents fit anything: they are looked into only where much is left, and taken only when
 * nothing else explains more of it. */
static hci_status trials_enriched(search *s, const hci_suspects *model, trials *t, hci_note *note)
{
    const hci_effect_room *saturation = hci_effect_room_find("saturation");
    hci_status status = residual_of(s, model, note);
    double most = 0.0, powers = 0.0;
    if (status || s->richness > 1 || !room_in(model, saturation) ||
        residual_rms(s) < MUCH * s->options->resolution_Nm || residual_rms(s) < 1.1 * noise_rms(s))
        return status ? status : trials_make(s, model, true, t, note);
    s->richness = 2;
    status = trials_make(s, model, true, t, note);
    for (size_t k = 0; k < t->count && !status; ++k) {
        if (t->trial[k].a != t->trial[k].b) continue;
        if (hci_suspect_room(t->trial[k].a) == saturation)
            powers = t->trial[k].gain;
        else
            most = fmax(most, t->trial[k].gain);
    }
    if (status || powers > most) return status;
    s->richness = 1;
    trials_release(t);
    return trials_make(s, model, true, t, note);
}

/* One round: takes in what lowers the score most. */
static hci_status add_best(search *s, hci_suspects *model, hci_fit *fit, bool *added, hci_note *note)
{
    const trial *picked[TRIALS + 1];
    trials t;
    hci_suspects best = {0};
    hci_fit best_fit = *fit;
    hci_status status = trials_enriched(s, model, &t, note);
    size_t count;
    *added = false;
    if (status) return status;
    best_fit.score = fit->score - DECISIVE;
    count = trials_pick(&t, picked);
    for (size_t k = 0; k < count && !status; ++k) {
        hci_suspects m = {0};
        hci_fit f;
        double explained = 0.0;
        bool noticeable = false;
        status = trial_fit(s, &t, picked[k], &m, &f, note);
        if (status) break;
        const double handicap = picked[k]->a != picked[k]->b ? DECISIVE + PAIR_MARGIN * picked[0]->gain : 0.0;
        if (f.score + handicap < best_fit.score)
            status = is_noticeable(s, &m, model, &noticeable, &explained, note);
        if (!status && noticeable) {
            best_fit = f;
            best_fit.score += handicap;
            replace(&best, &m);
        }
        hci_suspects_release(&m);
    }
    if (!status) {
        hci_suspects m = {0};
        hci_fit f;
        double explained;
        bool found, noticeable = false;
        status = resonance_fit(s, model, &m, &f, &found, note);
        if (!status && found && f.score < best_fit.score)
            status = is_noticeable(s, &m, model, &noticeable, &explained, note);
        if (!status && noticeable) replace(&best, &m);
        hci_suspects_release(&m);
    }
    if (!status && best.suspect) {
        replace(model, &best);
        *added = true;
        status = noise_renew(s, model, fit, note);
    }
    hci_suspects_release(&best);
    trials_release(&t);
    return status;
}

/* ---- backward ---- */

/* The score without a room. */
static hci_status fit_without(search *s, const hci_suspects *model, const hci_effect_room *room,
                              hci_suspects *without, hci_fit *fit, hci_note *note)
{
    if (!copy(model, without)) return no_memory(note);
    room_out(without, room);
    return hci_evidence_fit(s->evidence, without, fit, note);
}

/* Drops single orders that are not worth their price, and rooms that are no longer decisive. */
static hci_status drop_worst(search *s, hci_suspects *model, hci_fit *fit, bool *dropped, hci_note *note)
{
    hci_status status = HCI_OK;
    *dropped = false;
    for (size_t r = 0; hci_suspect_room(r) && !status && !*dropped; ++r) {
        const hci_effect_room *room = hci_suspect_room(r);
        hci_suspects without = {0};
        hci_fit f;
        bool noticeable = true;
        double explained;
        if (!room_in(model, room)) continue;
        status = fit_without(s, model, room, &without, &f, note);
        if (!status) status = is_noticeable(s, model, &without, &noticeable, &explained, note);
        if (!status && (f.score < fit->score + DECISIVE || !noticeable)) {
            replace(model, &without);
            *dropped = true;
            status = noise_renew(s, model, fit, note);
        }
        hci_suspects_release(&without);
    }
    return status;
}

static hci_status prune(search *s, hci_suspects *model, hci_fit *fit, hci_note *note)
{
    hci_status status = HCI_OK;
    for (bool again = true; again && !status;) {
        size_t worst = model->count;
        double least = 0.0;
        hci_normal normal;
        hci_sweep sweep = {0};
        again = false;
        status = hci_evidence_normal(s->evidence, model, false, &normal, note);
        if (status) return status;
        if (!hci_sweep_start(&sweep, &normal)) status = no_memory(note);
        for (size_t c = 0; c < normal.n && !status; ++c)
            hci_sweep_in(&sweep, c);
        for (size_t k = 0, c = 0; k < model->count && !status; ++k) {
            const hci_suspect *x = &model->suspect[k];
            if (!x->in) continue;
            double value_fall = 0.0;
            /* the worth of leaving at the present values: steps from them are near 0 */
            double saved[HCI_SUSPECT_TERMS];
            for (size_t j = 0; j < x->count; ++j) {
                saved[j] = sweep.b[c + j];
                sweep.b[c + j] += x->term[j].value;
            }
            value_fall = hci_sweep_worth(&sweep, c, x->count) - hci_suspect_cost(x, normal.rows);
            for (size_t j = 0; j < x->count; ++j)
                sweep.b[c + j] = saved[j];
            c += x->count;
            if (value_fall < least && rooms_in(model) > 0) {
                least = value_fall;
                worst = k;
            }
        }
        hci_sweep_release(&sweep);
        hci_normal_release(&normal);
        if (!status && worst < model->count) {
            hci_suspects without;
            hci_fit f;
            if (!copy(model, &without)) return no_memory(note);
            without.suspect[worst].in = false;
            status = hci_evidence_fit(s->evidence, &without, &f, note);
            if (!status && f.score <= fit->score + 0.5) {
                replace(model, &without);
                *fit = f;
                again = true;
            }
            hci_suspects_release(&without);
        }
    }
    return status;
}

/* ---- rivals ---- */

/* The best other effects in place of one that is in the model. */
static hci_status rivals_of(search *s, hci_suspects *model, hci_fit *fit, const hci_effect_room *room,
                            hci_attribution *out, bool *swapped, hci_note *note)
{
    hci_suspects without = {0};
    hci_fit f;
    trials t;
    hci_status status = fit_without(s, model, room, &without, &f, note);
    const double worth = f.score - fit->score;
    *swapped = false;
    if (status) return status;
    status = trials_make(s, &without, false, &t, note);
    for (size_t k = 0; k < t.count && !status && !*swapped; ++k) {
        const trial *x = &t.trial[k];
        const hci_effect_room *other = hci_suspect_room(x->a);
        hci_suspects m = {0};
        hci_fit rival;
        if (other == room || room_in(model, other) || x->gain < 0.6 * worth - 20.0) continue;
        status = trial_fit(s, &t, x, &m, &rival, note);
        if (status) break;
        const bool strange = other == &hci_unknown_room; /* has to be better, not as good */
        if (!out && rival.score < fit->score - (strange ? DECISIVE : 0.5)) {
            replace(model, &m);
            *swapped = true;
            status = noise_renew(s, model, fit, note);
        } else if (out && !strange && rival.score < fit->score + EQUAL) {
            hci_verdict *v = &out->verdict[x->a];
            v->ambiguous = true;
            v->rival_of = room;
            v->gain = f.score - rival.score;
            out->verdict[room_index(room)].ambiguous = true;
            replace(&v->alternative, &m);
        }
        hci_suspects_release(&m);
    }
    trials_release(&t);
    hci_suspects_release(&without);
    return status;
}

static hci_status swap_any(search *s, hci_suspects *model, hci_fit *fit, bool *swapped, hci_note *note)
{
    hci_status status = HCI_OK;
    *swapped = false;
    for (size_t r = 0; hci_suspect_room(r) && !status && !*swapped; ++r)
        if (room_in(model, hci_suspect_room(r)))
            status = rivals_of(s, model, fit, hci_suspect_room(r), NULL, swapped, note);
    return status;
}

/* ---- the whole ---- */

static void tell(const search *s, const char *what, double share)
{
    if (s->options->progress) s->options->progress(s->options->context, what, share);
}

static hci_status search_run(search *s, hci_attribution *a, hci_note *note)
{
    hci_status status = noise_renew(s, &a->suspects, &a->fit, note);
    bool again = true;
    for (int round = 0; again && !status && round < MOST_ROUNDS; ++round) {
        bool dropped = true, swapped = false;
        tell(s, "looking for effects", 0.1 + 0.6 * round / MOST_ROUNDS);
        again = false;
        if (rooms_in(&a->suspects) < MOST_EFFECTS) status = add_best(s, &a->suspects, &a->fit, &again, note);
        if (!status && again) status = prune(s, &a->suspects, &a->fit, note);
        while (dropped && !status)
            status = drop_worst(s, &a->suspects, &a->fit, &dropped, note);
        if (!again && !status) {
            status = swap_any(s, &a->suspects, &a->fit, &swapped, note);
            again = swapped;
        }
    }
    return status;
}

/* Sums over the stretches that a judgement of the residual needs. */
typedef struct {
    double square, noise, rows;         /* residual and noise, N²·m² */
    double block, block_square, blocks; /* sums of whitened squares over short blocks */
} goodness;

enum { BLOCK = 24 };

static void goodness_add(const hci_noise *noise, const double *residual, double *whitened, size_t n,
                         goodness *g)
{
    memcpy(whitened, residual, n * sizeof *whitened);
    hci_noise_whiten(noise, whitened, n, 1);
    for (size_t j = 0; j < n; ++j)
        g->square += residual[j] * residual[j];
    g->noise += (double)n * noise->rms * noise->rms;
    g->rows += (double)n;
    for (size_t j = HCI_NOISE_MEMORY; j + BLOCK <= n; j += BLOCK) {
        double sum = 0.0;
        for (size_t k = j; k < j + BLOCK; ++k)
            sum += whitened[k] * whitened[k];
        g->block += sum;
        g->block_square += sum * sum;
        g->blocks += 1.0;
    }
}

/* The variance of a block's sum relative to its mean is 2/BLOCK for noise. */
static double clumps_of(const goodness *g)
{
    if (g->blocks < 50.0) return 1.0;
    const double mean = g->block / g->blocks;
    return (g->block_square / g->blocks - mean * mean) / (mean * mean) * 0.5 * BLOCK;
}

/* Whether the residual that is left is noise: its variance against that of the noise under its lines, and
 * whether its size is the same all along. */
static hci_status residual_judge(search *s, hci_attribution *a, hci_note *note)
{
    const hci_cells *cells = s->evidence->cells;
    const double resolution = s->options->resolution_Nm;
    goodness g = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    double *whitened = hci_memory_new(HCI_MOST_STRETCH, sizeof *whitened);
    hci_status status;
    s->evidence->raw = true;
    status = whitened ? residual_of(s, &a->suspects, note) : no_memory(note);
    s->evidence->raw = false;
    if (!status)
        status = hci_attribute_noise(s->evidence, s->residual, parameters_in(&a->suspects), resolution, note);
    for (size_t k = 0; k < cells->stretch_count && !status; ++k) {
        const hci_stretch *x = &cells->stretch[k];
        if (s->evidence->use[x->run] && x->count >= HCI_NOISE_LEAST)
            goodness_add(&s->evidence->noise[k], s->residual + x->first, whitened, x->count, &g);
    }
    hci_memory_free(whitened);
    if (status || !(g.rows > 0.0)) return status;
    a->excess = g.square / g.noise - 1.0;
    a->clumps = clumps_of(&g);
    const double left = g.square / g.rows;
    const bool repeats = a->excess < EXCESS && a->clumps < CLUMPS;
    a->unknown = !repeats && left > 4.0 * resolution * resolution;
    a->unexplained_Nm = a->unknown ? sqrt(left * fmax(a->excess / (1.0 + a->excess), 0.25)) : 0.0;
    return status;
}

/* ---- what is not understood ---- */

static double explained_by(search *s, const hci_suspects *model, const hci_effect_room *room, hci_note *note)
{
    hci_suspects without = {0};
    hci_fit f;
    bool noticeable;
    double explained = 0.0;
    if (!fit_without(s, model, room, &without, &f, note))
        is_noticeable(s, model, &without, &noticeable, &explained, note);
    hci_suspects_release(&without);
    return explained;
}

/* Known effects beside something larger that is not understood cannot be told from a part of it; and a small
 * remainder beside known effects is no finding. */
static hci_status unknown_settle(search *s, hci_attribution *a, hci_note *note)
{
    const hci_effect_room *unknown = &hci_unknown_room;
    hci_suspects *model = &a->suspects;
    hci_status status = residual_judge(s, a, note);
    double strange = a->unexplained_Nm;
    bool changed = false;
    if (status) return status;
    if (room_in(model, unknown)) strange = hypot(strange, explained_by(s, model, unknown, note));
    if (!(strange > 0.0)) return HCI_OK;
    double known = 0.0;
    for (size_t r = 0; hci_effect_room_at(r); ++r)
        if (room_in(model, hci_effect_room_at(r)))
            known = hypot(known, explained_by(s, model, hci_effect_room_at(r), note));
    a->unknown = strange > SMALL * known;
    for (size_t r = 0; hci_suspect_room(r); ++r) {
        const hci_effect_room *room = hci_suspect_room(r);
        if (!room_in(model, room) || (room == unknown) == a->unknown) continue;
        if (a->unknown && explained_by(s, model, room, note) > UNTOUCHED * strange) continue;
        room_out(model, room);
        changed = true;
    }
    if (changed) status = noise_renew(s, model, &a->fit, note);
    if (!status && a->unknown) a->unexplained_Nm = strange;
    return status;
}

/* What speaks for and against each effect in the end. */
static hci_status verdicts(search *s, hci_attribution *a, hci_note *note)
{
    trials t;
    hci_status status;
    bool swapped;
    for (size_t r = 0; r < a->rooms; ++r)
        a->verdict[r] = (hci_verdict){.room = hci_suspect_room(r)};
    for (size_t r = 0; r < a->rooms; ++r) {
        hci_verdict *v = &a->verdict[r];
        hci_suspects without = {0};
        hci_fit f;
        bool noticeable;
        if (!room_in(&a->suspects, v->room)) continue;
        v->in = true;
        status = fit_without(s, &a->suspects, v->room, &without, &f, note);
        if (!status) status = is_noticeable(s, &a->suspects, &without, &noticeable, &v->explained_Nm, note);
        v->gain = f.score - a->fit.score;
        hci_suspects_release(&without);
        if (!status) status = rivals_of(s, &a->suspects, &a->fit, v->room, a, &swapped, note);
        if (status) return status;
    }
    status = trials_make(s, &a->suspects, false, &t, note);
    for (size_t k = 0; k < t.count && !status; ++k) {
        hci_verdict *v = &a->verdict[t.trial[k].a];
        if (!v->in && !v->ambiguous) v->gain = t.trial[k].gain;
    }
    trials_release(&t);
    return status;
}

hci_status hci_attribute(hci_evidence *evidence, const hci_attribute_options *options,
                         hci_attribution *attribution, hci_note *note)
{
    search s = {evidence, options, NULL, NULL, 1.0, 1};
    hci_suspects none = {0};
    hci_status status;
    memset(attribution, 0, sizeof *attribution);
    attribution->rooms = room_count();
    s.residual = hci_memory_new(2 * evidence->cells->count + 1, sizeof *s.residual);
    if (!s.residual) return no_memory(note);
    s.variance = s.residual + evidence->cells->count;
    status = search_run(&s, attribution, note);
    if (!status) tell(&s, "weighing the evidence", 0.75);
    if (!status) status = unknown_settle(&s, attribution, note);
    if (!status) status = verdicts(&s, attribution, note);
    if (!status) status = hci_evidence_errors(evidence, &attribution->suspects, note);
    if (!status) status = hci_evidence_fit(evidence, &none, &attribution->before, note);
    hci_memory_free(s.residual);
    if (status) hci_attribution_release(attribution);
    return status;
}

void hci_attribution_release(hci_attribution *a)
{
    for (size_t r = 0; r < a->rooms; ++r)
        hci_suspects_release(&a->verdict[r].alternative);
    hci_suspects_release(&a->suspects);
    memset(a, 0, sizeof *a);
}
