/* What a current loop makes of the torque, in words. */
#include <math.h>
#include <stdio.h>

#include "hci/host/machine/expected_ripple.h"
#include "hci/host/solve/loop_reach.h"
#include "host/base/words.h"

enum { NUMBER_SIZE = 48 };

#define USUAL_Hz 100.0 /* that a speed is said for where no bandwidth is given */

/* Two digits, rounded down, without an exponent. */
static const char *speed(double rpm, char text[NUMBER_SIZE])
{
    const double digit = pow(10.0, floor(log10(rpm)) - 1.0);
    if (isinf(rpm))
        snprintf(text, NUMBER_SIZE, "any speed");
    else if (!(rpm > 0.0))
        snprintf(text, NUMBER_SIZE, "no speed");
    else
        snprintf(text, NUMBER_SIZE, "%.10g rpm", digit * floor(rpm / digit * (1.0 + 1e-9)));
    return text;
}

static void say_reach(const hci_words *w, const hci_loop_reach *l)
{
    char rpm[NUMBER_SIZE], lead_rpm[NUMBER_SIZE];
    const bool is_given = l->bandwidth_Hz > 0.0;
    const double Hz = is_given ? l->bandwidth_Hz : USUAL_Hz;
    hci_words_say(w, isinf(l->rpm_per_Hz) ? "at %s" : "up to %s", speed(Hz * l->rpm_per_Hz, rpm));
    if (!is_given && isfinite(l->rpm_per_Hz)) hci_words_say(w, " for each %g Hz of its bandwidth", USUAL_Hz);
    if (isfinite(l->rpm_per_Hz))
        hci_words_say(w, " (%s where the table is read ahead by the delay of the loop)",
                      speed(Hz * l->lead_rpm_per_Hz, lead_rpm));
}

void hci_loop_reach_words(const hci_loop_reach *l, char *text, size_t size)
{
    const hci_words w = {text, size};
    text[0] = '\0';
    if (!(l->allowed_Nm > 0.0)) return;
    if (isfinite(l->added_Nm))
        hci_words_say(&w,
                      "at %.4g rpm a current loop of %.4g Hz adds %.2g N·m from peak to peak (%.2g where the "
                      "table is read ahead by its delay), and no more than %.2g N·m, a tenth of what a plain "
                      "sine leaves, ",
                      l->speed_rpm, l->bandwidth_Hz, hci_ripple_bound_as_said(l->added_Nm),
                      hci_ripple_bound_as_said(l->lead_added_Nm), l->allowed_Nm);
    else if (l->bandwidth_Hz > 0.0)
        hci_words_say(
            &w, "a current loop of %.4g Hz adds no more than %.2g N·m, a tenth of what a plain sine leaves, ",
            l->bandwidth_Hz, hci_ripple_bound_as_said(l->allowed_Nm));
    else
        hci_words_say(&w, "a current loop adds no more than %.2g N·m, a tenth of what a plain sine leaves, ",
                      hci_ripple_bound_as_said(l->allowed_Nm));
    say_reach(&w, l);
}
