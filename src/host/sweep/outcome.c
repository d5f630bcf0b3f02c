/* What a grid shows as a whole, and in words. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/host/sweep/sweep.h"
#include "host/base/words.h"
#include "host/limit/bounds.h"

const hci_grid_row *hci_grid_least(const hci_grid *s, bool of_copper, double ripple_percent)
{
    const size_t from = of_copper ? s->plan.by_current : 0,
                 to = of_copper ? s->plan.count : s->plan.by_current;
    for (size_t k = from; k < to; ++k)
        if (s->done[k] && s->row[k].verdict <= HCI_GRID_RIPPLE &&
            s->row[k].best.T_ripple_percent <= ripple_percent)
            return &s->row[k];
    return NULL;
}

void hci_grid_count(const hci_grid *s, size_t count[HCI_GRID_FAILED + 1])
{
    memset(count, 0, (HCI_GRID_FAILED + 1) * sizeof *count);
    for (size_t k = 0; k < s->plan.count; ++k)
        if (s->done[k]) ++count[s->row[k].verdict];
}

/* One value for all phases, or one for each. */
static void say_phases(const hci_words *w, const char *what, const double limit[3])
{
    static const char *const PHASE[3] = {" a", " b", " c"};
    const bool are_same = limit[0] == limit[1] && limit[1] == limit[2];
    for (int s = 0; s < (are_same ? 1 : 3); ++s)
        if (limit[s] < HUGE_VAL)
            hci_words_say(w, "%s%s%s at most %.5g A", w->text[0] ? "; " : "", what, are_same ? "" : PHASE[s],
                          limit[s]);
}

void hci_grid_limits_words(const hci_grid_request *r, char text[HCI_GRID_WORDS_SIZE])
{
    const hci_words w = {text, HCI_GRID_WORDS_SIZE};
    hci_solve_options o = *r->options;
    hci_bounds b;
    text[0] = '\0';
    o.speed_rad_per_s = 1.0; /* where the machine's dc link is a limit */
    if (hci_bounds_make(r->machine, &o, 1.0, &b, NULL)) return;
    say_phases(&w, "phase current", b.current_A);
    say_phases(&w, "rms current", b.rms_A);
    if (b.line_V < HUGE_VAL && !r->link_V.count)
        hci_words_say(&w, "%sline voltage at most %.5g V", text[0] ? "; " : "", b.line_V);
    if (o.limits.copper_W > 0.0)
        hci_words_say(&w, "%scopper loss at most %.5g W", text[0] ? "; " : "", o.limits.copper_W);
    if (o.limits.copper_ratio > 0.0)
        hci_words_say(&w, "%scopper loss at most %.5g × the plain sine", text[0] ? "; " : "",
                      o.limits.copper_ratio);
}

double hci_grid_copper_W(const hci_grid_request *r, const hci_grid_figures *f)
{
    return r->machine->resistance_ohm * f->mean_square_A2;
}
