/* What new recordings say of the last diagnosis, for people. */
#include <math.h>
#include <string.h>

#include "hci/host/diagnose/again.h"
#include "host/base/words.h"

enum { MOST_PLAYED = 8 };

#define SAME 0.02 /* change of an error, as a share, that is none */

const char *hci_again_change_name(hci_again_change change)
{
    static const char *const NAMES[] = {"stays", "changed", "left", "came"};
    return NAMES[change];
}

static bool has_kept_promise(const hci_again *a)
{
    for (size_t k = 0; k < a->runs && a->solved.folder[0]; ++k)
        if (a->run[k].played.promise == HCI_PROMISE_KEPT) return true;
    return false;
}

static void say_prediction(const hci_words *w, const hci_again *a)
{
    hci_words_say(w,
                  "On %zu new recording%s the machine of last time was off by %.3g N·m rms before any "
                  "fit to them; the declared machine is off by %.3g N·m there, and %.3g N·m are noise.",
                  a->runs, a->runs == 1 ? "" : "s", a->last_Nm, a->declared_Nm, a->noise_Nm);
    if (a->bounded == 0)
        hci_words_say(w, " No bound was stated last time of that error.");
    else
        hci_words_say(w,
                      " It was within what had been stated of the torque, mean and ripple together, whatever "
                      "current flows (%.3g N·m, 95 %%) in %zu of %zu: what was stated of the model %s%s.",
                      a->bound_Nm, a->kept, a->bounded, a->kept == a->bounded ? "holds" : "does not hold",
                      a->kept < a->bounded && has_kept_promise(a)
                          ? "; the promise of the ripple is another one, and was kept"
                          : "");
}

static void say_now(const hci_words *w, const hci_again *a)
{
    const bool same = fabs(a->now_Nm - a->last_Nm) <= SAME * a->last_Nm;
    hci_words_say(w, " Fitted to all recordings, the machine is off by %.3g N·m there: %s.", a->now_Nm,
                  same                     ? "no change"
                  : a->now_Nm < a->last_Nm ? "better"
                                           : "worse");
}

static void say_effect(const hci_words *w, const hci_again_effect *e)
{
    if (e->was_ambiguous && !e->is_ambiguous)
        hci_words_say(w, " %s was ambiguous and is now %s.", e->effect,
                      e->change == HCI_AGAIN_LEFT ? "rejected" : "added");
    else if (!e->was_ambiguous && e->is_ambiguous)
        hci_words_say(w, " %s is ambiguous now.", e->effect);
    else if (e->change == HCI_AGAIN_LEFT && !e->is_ambiguous)
        hci_words_say(w, " %s is contradicted and left.", e->effect);
    else if (e->change == HCI_AGAIN_CAME)
        hci_words_say(w, " %s came.", e->effect);
    if (e->change == HCI_AGAIN_CHANGED)
        hci_words_say(w, " %s has changed by %.3g standard errors: %s.", e->effect, e->deviations, e->words);
}

/* Of runs that have not the currents that were solved the first alone: rounds of diagnosis have many. */
static void say_played(const hci_words *w, const hci_again *a)
{
    char text[HCI_AGAIN_WORDS / MOST_PLAYED];
    size_t said = 0, others = 0;
    if (!a->solved.folder[0])
        hci_words_say(w,
                      " What was promised of currents was not judged: no solution for the machine of last "
                      "time is known (%s).",
                      a->solved.why);
    for (size_t k = 0; k < a->runs && a->solved.folder[0]; ++k) {
        const hci_again_run *r = &a->run[k];
        const bool is_other = r->played.currents == HCI_PLAYED_OTHERS;
        others += is_other;
        if (said == MOST_PLAYED - 2 || (is_other && others > 1)) continue;
        hci_played_words(&a->solved, &r->played, r->path, text, sizeof text);
        hci_words_say(w, "%s", text);
        ++said;
    }
    if (others > 1)
        hci_words_say(w, " In %zu new recordings altogether the currents are not those that were solved.",
                      others);
}

void hci_again_words(const hci_again *a, char *text, size_t size)
{
    const hci_words w = {text, size};
    size_t stay = 0;
    text[0] = '\0';
    if (a->runs > 0) {
        say_prediction(&w, a);
        say_now(&w, a);
        say_played(&w, a);
    }
    for (size_t k = 0; k < a->effects; ++k) {
        say_effect(&w, &a->effect[k]);
        stay += a->effect[k].change == HCI_AGAIN_STAYS && !a->effect[k].was_ambiguous;
    }
    if (stay > 0)
        hci_words_say(&w, " %zu effect%s within %s error%s.", stay, stay == 1 ? " stays" : "s stay",
                      stay == 1 ? "its" : "their", stay == 1 ? "" : "s");
}
