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

const char *hci_again_speaks_name(hci_again_speaks speaks)
{
    static const char *const NAMES[] = {"silent", "for", "against"};
    return NAMES[speaks];
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

/* Whether the new recordings tell the machine of last time from that which is fitted to all of them. */
static bool is_same(const hci_again *a)
{
    return fabs(a->now_Nm - a->last_Nm) <= SAME * a->last_Nm;
}

static void say_now(const hci_words *w, const hci_again *a)
{
    const bool same = is_same(a);
    hci_words_say(w, " Fitted to all recordings, the machine is off by %.3g N·m there: %s.", a->now_Nm,
                  same                     ? "no change"
                  : a->now_Nm < a->last_Nm ? "better"
                                           : "worse");
}

/* What left is contradicted where the new recordings alone are described better without it, and not where it
 * is only the list of all of them that was judged otherwise. */
static void say_left(const hci_words *w, const hci_again_effect *e)
{
    if (e->speaks == HCI_AGAIN_AGAINST)
        hci_words_say(w, " %s is contradicted and left.", e->effect);
    else if (e->speaks == HCI_AGAIN_FOR)
        hci_words_say(w,
                      " %s is not in the machine of all recordings, but the machine of last time describes "
                      "the new ones better with it: it is not contradicted.",
                      e->effect);
    else
        hci_words_say(w,
                      " %s is not in the machine of all recordings; the new ones by themselves speak neither "
                      "for nor against it.",
                      e->effect);
}

static void say_effect(const hci_words *w, const hci_again_effect *e)
{
    if (e->was_ambiguous && !e->is_ambiguous)
        hci_words_say(w, " %s was ambiguous and is now %s.", e->effect,
                      e->change == HCI_AGAIN_LEFT ? "rejected" : "added");
    else if (!e->was_ambiguous && e->is_ambiguous)
        hci_words_say(w, " %s is ambiguous now.", e->effect);
    else if (e->change == HCI_AGAIN_LEFT && !e->is_ambiguous)
        say_left(w, e);
    else if (e->change == HCI_AGAIN_CAME)
        hci_words_say(w, " %s came.", e->effect);
    if (e->change == HCI_AGAIN_CHANGED)
        hci_words_say(w, " %s has changed by %.3g standard errors: %s.", e->effect, e->deviations, e->words);
}

/* Values that together describe the new recordings as those of last time do are another description. */
static void say_changes(const hci_words *w, const hci_again *a)
{
    size_t changed = 0;
    for (size_t k = 0; k < a->effects; ++k)
        changed += a->effect[k].change == HCI_AGAIN_CHANGED;
    if (changed > 0 && a->runs > 0 && is_same(a))
        hci_words_say(w, " The new recordings do not contradict what has changed: the machine of last time "
                         "describes them as well, so that these values together are another description of "
                         "the same.");
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
    if (a->without_cogging)
        hci_words_say(&w,
                      " The cogging torque that the last diagnosis started from was of one slow turn, with "
                      "what its sensors made of it: here it is found by all recordings together, and not "
                      "compared with that of last time.");
    for (size_t k = 0; k < a->effects; ++k) {
        say_effect(&w, &a->effect[k]);
        stay += a->effect[k].change == HCI_AGAIN_STAYS && !a->effect[k].was_ambiguous;
    }
    say_changes(&w, a);
    if (stay > 0)
        hci_words_say(&w, " %zu effect%s within %s error%s.", stay, stay == 1 ? " stays" : "s stay",
                      stay == 1 ? "its" : "their", stay == 1 ? "" : "s");
}
