#include "host/diagnose/next/open_points.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/machine/frames.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/diagnose/next/tell_apart.h"
#include "host/diagnose/next/trial_run.h"

enum { ANGLES = 64 };

#define MUCH_MORE 5.0 /* times the spread at the recorded points, from which on a point is worth a run */
#define TOGETHER  0.5 /* correlation of two terms, one of which takes from the other */

/* by_value[ANGLES][terms], without its mean over the angles. */
typedef struct {
    const hci_machine *machine;
    const hci_uncertainty *uncertainty;
    size_t terms;
    double *by_value;
} differing;

static hci_status differing_make(const hci_machine *machine, const hci_uncertainty *u, differing *x,
                                 hci_note *note)
{
    *x = (differing){machine, u, hci_effects_terms(&u->effects.list), NULL};
    x->by_value = hci_memory_new(ANGLES * x->terms + 1, sizeof *x->by_value);
    return x->by_value ? HCI_OK : hci_note_memory(note, NULL, "what to measure next");
}

/* ---- one operating point ---- */

static void by_value_fill(const differing *x, double id_A, double iq_A)
{
    for (size_t k = 0; k < ANGLES; ++k) {
        const double theta_e = 2.0 * HCI_PI * (double)k / ANGLES;
        hci_sample sample = {.theta_m_rad = theta_e / x->machine->pole_pairs};
        hci_clarke_inverse(hci_park_inverse((hci_dq){id_A, iq_A, 0.0}, theta_e), sample.i_abc);
        hci_effects_torque(x->machine, &x->uncertainty->effects.list, &sample, x->by_value + k * x->terms);
    }
    for (size_t t = 0; t < x->terms; ++t) {
        double mean = 0.0;
        for (size_t k = 0; k < ANGLES; ++k)
            mean += x->by_value[k * x->terms + t] / ANGLES;
        for (size_t k = 0; k < ANGLES; ++k)
            x->by_value[k * x->terms + t] -= mean;
    }
}

/* Root mean square of the ripple in which the machines differ from the one that is written down. */
static double spread_at(const differing *x, double id_A, double iq_A)
{
    const hci_uncertainty *u = x->uncertainty;
    double sum = 0.0;
    by_value_fill(x, id_A, iq_A);
    for (size_t m = 0; m < u->machines; ++m)
        for (size_t k = 0; k < ANGLES; ++k) {
            double torque_Nm = 0.0;
            for (size_t t = 0; t < x->terms; ++t)
                torque_Nm += x->by_value[k * x->terms + t] * u->departure[t * u->machines + m];
            sum += torque_Nm * torque_Nm;
        }
    return sqrt(sum / (ANGLES * (double)u->machines));
}

static double middle(hci_measured_range range)
{
    return 0.5 * (range.least + range.most);
}

static double spread_recorded(const differing *x)
{
    double most_Nm = 0.0;
    for (size_t r = 0; r < x->uncertainty->runs; ++r) {
        const hci_measured_run *run = &x->uncertainty->run[r];
        most_Nm = fmax(most_Nm, spread_at(x, middle(run->id_A), middle(run->iq_A)));
    }
    return most_Nm;
}

/* ---- names ---- */

static double product_of(const differing *x, size_t a, size_t b)
{
    const hci_uncertainty *u = x->uncertainty;
    double sum = 0.0;
    for (size_t m = 0; m < u->machines; ++m)
        sum += u->departure[a * u->machines + m] * u->departure[b * u->machines + m];
    return sum;
}

/* How much of the spread at the last point a term makes by itself, as a square. */
static double share_of(const differing *x, size_t t)
{
    double sum = 0.0;
    for (size_t k = 0; k < ANGLES; ++k)
        sum += x->by_value[k * x->terms + t] * x->by_value[k * x->terms + t];
    return sum * product_of(x, t, t);
}

static const hci_effect_term *term_at(const differing *x, size_t at, const hci_effect_type **type)
{
    const hci_effects *list = &x->uncertainty->effects.list;
    for (size_t k = 0; k < list->count; at -= list->effect[k++].count)
        if (at < list->effect[k].count) {
            *type = list->effect[k].type;
            return &list->effect[k].term[at];
        }
    return NULL;
}

static void name_fill(const differing *x, size_t at, char name[HCI_TERM_NAME_SIZE])
{
    const hci_effect_type *type = NULL;
    const hci_effect_term *term = term_at(x, at, &type);
    if (!term) return;
    const hci_effect_parameter *p = &type->parameter[term->parameter];
    snprintf(name, HCI_TERM_NAME_SIZE, "%s %s_%.6g", type->name, p->name, term->order);
}

/* The largest share of the terms that were found, or of those that were not; x->terms: none. */
static size_t largest_of(const differing *x, bool were_found, size_t beside)
{
    double most = 0.0;
    size_t best = x->terms;
    for (size_t t = 0; t < x->terms; ++t) {
        const hci_effect_type *type = NULL;
        const hci_effect_term *term = term_at(x, t, &type);
        const double other = beside < x->terms ? product_of(x, t, beside) : 0.0;
        if (!term || (term->value != 0.0) != were_found) continue;
        if (beside < x->terms &&
            !(other * other > TOGETHER * TOGETHER * product_of(x, t, t) * product_of(x, beside, beside)))
            continue;
        const double share = share_of(x, t);
        if (!(share > most)) continue;
        most = share;
        best = t;
    }
    return best;
}

static void names_fill(const differing *x, hci_open_point *out)
{
    const size_t twin = largest_of(x, false, x->terms);
    const size_t found = twin < x->terms ? largest_of(x, true, twin) : x->terms;
    if (found == x->terms) return;
    name_fill(x, found, out->found);
    name_fill(x, twin, out->twin);
}

/* ---- the choice ---- */

static double chi_square_of(const differing *x, const hci_playable *playable, double spread_Nm)
{
    const double turn = (double)hci_trial_run_samples(x->machine->pole_pairs);
    return HCI_LEAST_TURNS * turn * spread_Nm * spread_Nm / (playable->noise_Nm * playable->noise_Nm);
}

/* The point that tells most, which is one of a large current; of points alike the slow one forward. */
static bool choose(const differing *x, const hci_playable *playable, hci_open_point *out)
{
    hci_operating_point point[HCI_OPERATING_POINTS];
    const size_t count = hci_operating_points(playable, point);
    const double least_Nm = MUCH_MORE * spread_recorded(x);
    *out = (hci_open_point){.chi_square = HCI_TELLS};
    bool any = false;
    for (size_t k = 0; k < count; ++k) {
        const double spread_Nm = spread_at(x, point[k].id_A, point[k].iq_A);
        const double chi_square = chi_square_of(x, playable, spread_Nm);
        if (!(spread_Nm > least_Nm && chi_square > (1.0 + 1e-9) * out->chi_square)) continue;
        *out = (hci_open_point){.point = k, .spread_Nm = spread_Nm, .chi_square = chi_square};
        any = true;
    }
    if (any) spread_at(x, point[out->point].id_A, point[out->point].iq_A);
    return any;
}

hci_status hci_open_points_find(const hci_machine *machine, const hci_uncertainty *u,
                                const hci_playable *playable, hci_open_point *out, bool *found,
                                hci_note *note)
{
    differing x;
    *found = false;
    if (u->machines == 0 || playable->source != HCI_TORQUE_MEASURED || !(playable->noise_Nm > 0.0))
        return HCI_OK;
    const hci_status status = differing_make(machine, u, &x, note);
    if (status) return status;
    *found = choose(&x, playable, out);
    if (*found) names_fill(&x, out);
    hci_memory_free(x.by_value);
    return HCI_OK;
}
