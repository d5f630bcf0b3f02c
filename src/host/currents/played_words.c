/* What a recording says of the currents that were solved, for people. */
#include <math.h>

#include "hci/host/base/number.h"
#include "hci/host/currents/played.h"
#include "hci/math/harmonic.h"
#include "host/base/words.h"

static double degrees(double rad)
{
    return rad * 180.0 / HCI_PI;
}

static void say_turned(const hci_words *w, const hci_table_rotation *x)
{
    hci_words_say(w,
                  "not those that were solved: the %s is read %s%.2f degrees electrical %s of the angle "
                  "in the log",
                  x->of_index ? "index of the table" : "table", x->backwards ? "backwards, " : "",
                  fabs(degrees(x->rotation_rad)), x->rotation_rad < 0.0 ? "behind" : "ahead");
}

static void say_beside(const hci_words *w, const hci_played *p)
{
    const hci_table_beside *b = &p->beside;
    hci_words_say(
        w,
        "those that were solved in what they have beside their sine (%.3g ± %.1g times it), and the "
        "sine is another one, by %.3g A: ",
        b->harmonics, b->harmonics_error, b->beside_A);
    hci_words_say(w,
                  p->is_of_control
                      ? "the table with what the control adds for load and friction, or the control alone, "
                        "which makes the same where it turns a shaft slowly: which of both, the run does not "
                        "tell"
                      : "the table, and what a control adds for load and friction");
}

static void say_currents(const hci_words *w, const hci_played *p)
{
    const hci_table_rotation *x = &p->rotation;
    hci_words_say(w, "the currents are ");
    if (p->currents == HCI_PLAYED_UNKNOWN)
        hci_words_say(w, "not to be compared with those that were solved, for want of an angle with a known "
                         "zero or of a current");
    else if (p->currents == HCI_PLAYED_AS_SOLVED)
        hci_words_say(w, "those that were solved (%.4g times them, from which they differ by %s %% rms)",
                      x->gain, HCI_PERCENT(100.0 * x->left, 2));
    else if (p->currents == HCI_PLAYED_TURNED)
        say_turned(w, x);
    else if (p->currents == HCI_PLAYED_BESIDE)
        say_beside(w, p);
    else if (p->currents == HCI_PLAYED_RESIZED)
        hci_words_say(w, "not those that were solved, but %.4g times them", x->gain);
    else
        hci_words_say(w,
                      "not those that were solved, as in a run without the table (they "
                      "differ from it by %s %% rms)",
                      HCI_PERCENT(100.0 * x->left_as_is, 2));
}

static void say_ripple(const hci_words *w, const hci_solved_currents *solved, const hci_played *p)
{
    if (isfinite(p->ripple_Nm))
        hci_words_say(w,
                      " The measured ripple is %.3g ± %.1g N·m from peak to peak, in orders up to %.3g of "
                      "an electrical turn",
                      p->ripple_Nm, p->ripple_error_Nm, p->ripple_order);
    else
        hci_words_say(w, " The run tells no ripple, for want of a measured torque over whole turns");
    if (isfinite(solved->promised_Nm))
        hci_words_say(w, "; at most %.3g N·m (95 %%) was promised of the currents as solved",
                      solved->promised_Nm);
    else
        hci_words_say(w, "; no bound on it was promised");
}

static void say_promise(const hci_words *w, hci_promise promise)
{
    static const char *const WORDS[] = {
        ": this run does not judge that promise.", ": the promise was kept.", ": the promise was not kept.",
        ": whether that promise holds the noise of this run does not tell.",
        ": it is promised of sensors that are corrected first, as the header "
        "of the table asks, and in this run the readings are the table as they "
        "stand: correct them and record again; what the machine is said to be "
        "is not contradicted by that."};
    hci_words_say(w, "%s", WORDS[promise]);
}

void hci_played_words(const hci_solved_currents *solved, const hci_played *p, const char *file, char *text,
                      size_t size)
{
    const hci_words w = {text, size};
    text[0] = '\0';
    hci_words_say(&w, " In %s ", file);
    say_currents(&w, p);
    hci_words_say(&w, ".");
    say_ripple(&w, solved, p);
    say_promise(&w, p->promise);
    if (p->currents != HCI_PLAYED_AS_SOLVED)
        hci_words_say(&w, " `hci-solve check %s %s --table %s` tells how they lie to the table%s.",
                      solved->machine, file, solved->folder,
                      p->currents == HCI_PLAYED_TURNED ? ", and by how much to turn the angle that reads it"
                                                       : "");
}
