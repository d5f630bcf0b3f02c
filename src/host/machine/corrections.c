/* The inverse of what sensors do to currents and angles, in words. In: effects; out: what a drive has to do.
 */
#include "hci/host/machine/corrections.h"

#include <string.h>

#include "host/base/words.h"

static const char SUBTRACT[] = "subtract ", FROM[] = "from ";

/* "subtract … from" of a value below 0 is "add … to" of its size. */
static void say_part(const hci_words *w, const char *part, bool adds)
{
    const char *from = adds ? strstr(part, FROM) : NULL;
    if (adds && strncmp(part, SUBTRACT, strlen(SUBTRACT)) == 0) {
        hci_words_say(w, "add ");
        part += strlen(SUBTRACT);
    }
    if (from) hci_words_say(w, "%.*sto ", (int)(from - part), part);
    hci_words_say(w, "%s", from ? from + strlen(FROM) : part);
}

/* Of a gain, which is near 1, what it departs by counts: its digits are two more. */
static void say_term(const hci_words *w, const hci_effect_correction *c, const hci_effect_term *term)
{
    const bool adds = term->value < 0.0 && strncmp(c->before, SUBTRACT, strlen(SUBTRACT)) == 0;
    const double value = c->plus + term->value;
    hci_words_say(w, "%s", *w->text ? ", " : "");
    say_part(w, c->before, adds);
    hci_words_say(w, "%.*g", c->plus != 0.0 ? 5 : 3, adds ? -value : value);
    say_part(w, c->after, adds);
    if (c->behind) hci_words_say(w, "%.5g%s", term->order, c->behind);
}

/* No sensor reads before it is true: a time below 0 is more likely that of the torque sensor, which is late.
 */
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
