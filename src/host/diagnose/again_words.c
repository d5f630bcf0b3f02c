/* What new recordings say of the last diagnosis, for people. */
#include <math.h>
#include <string.h>

#include "hci/host/diagnose/again.h"
#include "host/base/words.h"

#define SAME 0.02 /* change of an error, as a share, that is none */

const char *hci_again_change_name(hci_again_change change)
{
    static const char *const NAMES[] = {"stays", "changed", "left", "came"};
    return NAMES[change];
}

static void say_prediction(const hci_words *w, const hci_again *a)
{
    hci_words_say(w,
                  "On %zu new recording%s the machine of last time was off by %.3g N·m rms before any "
                  "fit to them; the declared machine is off by %.3g N·m there, and %.3g N·m are noise.",
                  a->runs, a->runs == 1 ? "" : "s", a->last_Nm, a->declared_Nm, a->noise_Nm);
    if (a->bounded == 0)
        hci_words_say(w, " No bound was stated last time, so there was no promise to keep.");
    else
        hci_words_say(
            w, " It was within what had been stated (%.3g N·m, 95 %%) in %zu of %zu: the promise was %s.",
            a->bound_Nm, a->kept, a->bounded, a->kept == a->bounded ? "kept" : "not kept");
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

void hci_again_words(const hci_again *a, char *text, size_t size)
{
    const hci_words w = {text, size};
    size_t stay = 0;
    text[0] = '\0';
    if (a->runs > 0) {
        say_prediction(&w, a);
        say_now(&w, a);
    }
    for (size_t k = 0; k < a->effects; ++k) {
        say_effect(&w, &a->effect[k]);
        stay += a->effect[k].change == HCI_AGAIN_STAYS && !a->effect[k].was_ambiguous;
    }
    if (stay > 0)
        hci_words_say(&w, " %zu effect%s within %s error%s.", stay, stay == 1 ? " stays" : "s stay",
                      stay == 1 ? "its" : "their", stay == 1 ? "" : "s");
}
