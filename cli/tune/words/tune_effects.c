#include "cli/tune/words/tune_effects.h"

#include <math.h>
#include <string.h>

/* The place of "sine" or "cosine" among the values of an effect, of an order; -1: none. */
int cli_tune_place_of(const hci_effect *e, const char *name, double order)
{
    for (size_t k = 0; k < e->count; ++k)
        if (strcmp(e->type->parameter[e->term[k].parameter].name, name) == 0 &&
            fabs(e->term[k].order - order) < HCI_ORDER_TOLERANCE)
            return (int)k;
    return -1;
}

/* What the sine and the cosine of an order are called: of phases that are alike, or of one sequence. */
static const char *const WAVE[][2] = {
    {"sine", "cosine"}, {"pos_sine", "pos_cosine"}, {"neg_sine", "neg_cosine"}, {"zero_sine", "zero_cosine"}};

/* Those of a value; NULL: it is none. */
static const char *const *wave_of(const hci_effect *e, size_t k)
{
    const char *name = e->type->parameter[e->term[k].parameter].name;
    for (size_t w = 0; w < sizeof WAVE / sizeof *WAVE; ++w)
        if (strcmp(WAVE[w][0], name) == 0 || strcmp(WAVE[w][1], name) == 0) return WAVE[w];
    return NULL;
}

/* The amplitude of the order of a value, at its sine, or at a cosine that has none beside it; else 0. */
double cli_tune_amplitude_of(const hci_effect *e, size_t k, double *std_error)
{
    const char *const *wave = wave_of(e, k);
    if (!wave) return 0.0;
    const int place[] = {cli_tune_place_of(e, wave[0], e->term[k].order),
                         cli_tune_place_of(e, wave[1], e->term[k].order)};
    double amplitude = 0.0;
    if ((place[0] >= 0 ? place[0] : place[1]) != (int)k) return 0.0;
    *std_error = 0.0;
    for (int j = 0; j < 2; ++j) {
        if (place[j] < 0) continue;
        amplitude = hypot(amplitude, e->term[place[j]].value);
        *std_error = fmax(*std_error, e->term[place[j]].std_error);
    }
    return amplitude;
}

/* Whether an effect is a sum of sines with cosines. */
bool cli_tune_has_orders(const hci_effect *e)
{
    double std_error;
    for (size_t k = 0; k < e->count; ++k)
        if (cli_tune_amplitude_of(e, k, &std_error) > 0.0) return true;
    return false;
}

/* The effect of a finding; NULL: not among those of the corrected machine. */
const hci_effect *cli_tune_effect_of(const cli_tuning *t, const hci_finding *f)
{
    const hci_effects *list = &t->diagnosis.effects.list;
    for (size_t k = 0; k < list->count; ++k)
        if (strcmp(list->effect[k].type->name, f->effect) == 0) return &list->effect[k];
    return NULL;
}

/* Whether an effect is a torque that follows the angle alone, as cogging torque is. */
bool cli_tune_is_of_angle(const hci_effect *e)
{
    return e && cli_tune_has_orders(e) && strcmp(e->type->parameter[0].unit, "Nm") == 0;
}

bool cli_tune_is_of_emf(const hci_effect *e)
{
    return strcmp(e->type->parameter[0].unit, "Nm_per_A") == 0;
}

bool cli_tune_is_friction(const hci_effect *e)
{
    return e && e->type->coulomb_Nm;
}

/* An effect that the recordings show and that is of a kind, from number `from` of the findings on; NULL:
 * none. */
const hci_effect *cli_tune_next_found(const cli_tuning *t, bool (*is_kind)(const hci_effect *), size_t *from)
{
    for (; *from < t->diagnosis.findings; ++*from) {
        const hci_finding *f = &t->diagnosis.finding[*from];
        const hci_effect *e = cli_tune_effect_of(t, f);
        if (f->verdict == HCI_FINDING_ADDED && is_kind(e)) return ++*from, e;
    }
    return NULL;
}
