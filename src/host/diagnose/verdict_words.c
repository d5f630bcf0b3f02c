/* The verdict of a diagnosis for people. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/diagnose/diagnose.h"

typedef struct {
    char *text;
    size_t used, size;
} words;

static void say(words *w, const char *format, ...)
{
    va_list arguments;
    if (w->used + 1 >= w->size) return;
    va_start(arguments, format);
    const int n = vsnprintf(w->text + w->used, w->size - w->used, format, arguments);
    va_end(arguments);
    if (n > 0) w->used = w->used + (size_t)n < w->size ? w->used + (size_t)n : w->size - 1;
}

/* Names of the findings of one verdict: "cogging, friction and reluctance". */
static void say_names(words *w, const hci_diagnosis *d, hci_finding_verdict verdict, const char *last)
{
    size_t count = 0, said = 0;
    for (size_t k = 0; k < d->findings; ++k)
        count += d->finding[k].verdict == verdict && strcmp(d->finding[k].effect, "unknown") != 0;
    for (size_t k = 0; k < d->findings; ++k) {
        const hci_finding *f = &d->finding[k];
        if (f->verdict != verdict || strcmp(f->effect, "unknown") == 0) continue;
        say(w, "%s%s", said == 0 ? "" : said + 1 == count ? last : ", ", f->effect);
        ++said;
    }
}

static bool any(const hci_diagnosis *d, hci_finding_verdict verdict)
{
    for (size_t k = 0; k < d->findings; ++k)
        if (d->finding[k].verdict == verdict && strcmp(d->finding[k].effect, "unknown") != 0) return true;
    return false;
}

static void say_errors(words *w, const hci_diagnosis *d)
{
    if (isfinite(d->holdout_after_Nm))
        say(w,
            " On the runs that were held out the error (rms of measured less modelled torque) falls from "
            "%.3g to "
            "%.3g N·m; their noise is %.3g N·m.",
            d->holdout_before_Nm, d->holdout_after_Nm, d->holdout_noise_Nm);
    else
        say(w,
            " On the runs that were fitted the error (rms of measured less modelled torque) falls from %.3g "
            "to "
            "%.3g N·m; their noise is %.3g N·m. No run was held out, so this is not a test.",
            d->rms_before_Nm, d->rms_after_Nm, d->noise_Nm);
}

static void say_unknown(words *w, const hci_diagnosis *d)
{
    say(w, "No known effect explains what the model lacks.");
    if (d->contradicted)
        say(w, " Effects that describe the runs that were fitted do not describe those that were held out, "
               "and were "
               "dropped.");
    if (d->wanders) say(w, " Something in it does not repeat with the turn of the rotor.");
    for (size_t k = 0; k < d->unexplained_count; ++k) {
        const hci_unexplained *u = &d->unexplained[k];
        say(w, " Order %.6g (up to %.3g N·m) grows as |i|^%.3g |ω|^%.3g%s.", u->order, u->amplitude_Nm,
            u->current_exponent, u->speed_exponent,
            u->turns_sign ? " and turns its sign with the direction" : "");
    }
    if (any(d, HCI_FINDING_ADDED)) {
        say(w, " Beside it: ");
        say_names(w, d, HCI_FINDING_ADDED, " and ");
        say(w, ".");
    }
}

/* A torque that no sensor has read is right only where the shaft drives nothing. */
static void say_free_shafts(words *w, const hci_diagnosis *d)
{
    size_t count = 0;
    for (size_t k = 0; k < d->runs; ++k)
        count += d->run[k].source == HCI_TORQUE_INERTIA;
    if (count > 0)
        say(w, " The torque of %zu of %zu runs is inertia x acceleration, as of a free shaft.", count,
            d->runs);
}

static void say_search(words *w, const hci_diagnosis *d)
{
    if (d->search == HCI_WORK_COMPLETE) return;
    say(w, "%s: this is the best model that it had found; others have not been compared with it. ",
        d->search == HCI_WORK_INTERRUPTED ? "The search was interrupted"
                                          : "The search reached the limit of its work");
}

static void say_verdict(words *w, const hci_diagnosis *d)
{
    switch (d->verdict) {
    case HCI_DIAGNOSIS_COMPLETE:
        say(w,
            "Nothing is missing: what the model leaves, %.3g N·m rms, is the noise of the recordings (%.3g "
            "N·m).",
            d->rms_after_Nm, d->noise_Nm);
        if (d->holdout_after_Nm > 1.5 * d->holdout_noise_Nm)
            say(w, " But on the runs that were held out it is %.3g N·m, and their noise is %.3g N·m.",
                d->holdout_after_Nm, d->holdout_noise_Nm);
        return;
    case HCI_DIAGNOSIS_EXPLAINED:
        say(w, "The model lacked ");
        say_names(w, d, HCI_FINDING_ADDED, " and ");
        say(w, ".");
        break;
    case HCI_DIAGNOSIS_AMBIGUOUS:
        if (any(d, HCI_FINDING_ADDED)) {
            say(w, "The model lacked ");
            say_names(w, d, HCI_FINDING_ADDED, " and ");
            say(w, ". ");
        }
        say(w, "These recordings do not tell ");
        say_names(w, d, HCI_FINDING_AMBIGUOUS, " and ");
        say(w, " apart: each explains them equally well.");
        break;
    case HCI_DIAGNOSIS_UNKNOWN:
        say_unknown(w, d);
        return;
    }
    say_errors(w, d);
}

void hci_diagnosis_words(const hci_diagnosis *d, char *text, size_t size)
{
    words w = {text, 0, size};
    text[0] = '\0';
    say_search(&w, d);
    say_verdict(&w, d);
    say_free_shafts(&w, d);
}
