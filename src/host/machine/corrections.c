/* The inverse of what sensors do to currents and angles, in words. In: effects; out: what a drive has to do.
 */
#include "hci/host/machine/corrections.h"

#include "host/base/words.h"

static void say_term(const hci_words *w, const hci_effect_correction *c, const hci_effect_term *term)
{
    hci_words_say(w, "%s%s%.5g%s", *w->text ? ", " : "", c->before, c->plus + term->value, c->after);
    if (c->behind) hci_words_say(w, "%.5g%s", term->order, c->behind);
}

/* No sensor reads before it is true: a time below 0 is more likely that of the torque sensor, which is late. */
static bool is_said(const hci_effect_correction *c, double value)
{
    return c->late_alone ? value > 0.0 : value != 0.0;
}

void hci_corrections_words(const hci_effects *effects, char *text, size_t size)
{
    const hci_words w = {text, size};
    text[0] = '\0';
    for (size_t n = 0; n < effects->count; ++n) {
        const hci_effect *e = &effects->effect[n];
        for (size_t k = 0; k < e->count && e->type->correction; ++k) {
            const hci_effect_correction *c = &e->type->correction[e->term[k].parameter];
            if (c->before && is_said(c, e->term[k].value)) say_term(&w, c, &e->term[k]);
        }
    }
}
