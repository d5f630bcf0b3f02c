/* What the real machine is expected to do, in words. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/math/harmonic.h"
#include "host/base/words.h"
#include "host/machine/expected_ripple.h"

/* A mean torque so small beside the ripple is none to take a percentage of. */
#define NO_MEAN_PERCENT 1000.0

enum { NUMBER_SIZE = 48 };

#define ROUNDED 1e-9 /* of a last digit, that is no more than rounding */

/* The power of ten of the second digit. */
static double second_place(double value)
{
    return value > 0.0 && isfinite(value) ? floor(log10(value)) - 1.0 : 0.0;
}

double hci_ripple_bound_as_said(double value)
{
    const double digit = pow(10.0, second_place(value));
    return isfinite(value) ? ceil(value / digit - ROUNDED) * digit : value;
}

/* Two digits and no exponent, such as 260, 1.6 or 0.00025; a limit is rounded up. */
static const char *number(double value, bool limit, char text[NUMBER_SIZE])
{
    const double place = second_place(value), digit = pow(10.0, place);
    const int decimals = (int)fmax(0.0, fmin(-place, NUMBER_SIZE - 16));
    snprintf(text, NUMBER_SIZE, "%.*f", decimals,
             limit ? hci_ripple_bound_as_said(value) : floor(value / digit + 0.5) * digit);
    for (size_t n = strlen(text); decimals > 0 && (text[n - 1] == '0' || text[n - 1] == '.'); --n) {
        const bool point = text[n - 1] == '.';
        text[n - 1] = '\0';
        if (point) break;
    }
    return text;
}

/* What the bound consists of besides the machines that the recordings allow. */
static void say_parts(const hci_words *w, const hci_expected_ripple *e)
{
    char Nm[NUMBER_SIZE];
    if (e->table_peak_to_peak_Nm > 0.0)
        hci_words_say(w, " Of that the table, to which the currents were cut, makes %s N·m.",
                      number(e->table_peak_to_peak_Nm, true, Nm));
    if (e->angle_peak_to_peak_Nm > 0.0)
        hci_words_say(w,
                      " Of that %s N·m are for the steps of the recorded angle, which may have been cut off "
                      "where the drive's own goes on.",
                      number(e->angle_peak_to_peak_Nm, true, Nm));
    if (e->loop_peak_to_peak_Nm > 0.0)
        hci_words_say(w, " Of that the current loop makes %s N·m.",
                      number(e->loop_peak_to_peak_Nm, true, Nm));
    if (e->origin.sensor_zero_Nm > 0.0)
        hci_words_say(w,
                      " Of that %s N·m are for order 1, which zeros of the current sensors that are off make "
                      "as well as cogging torque.",
                      number(2.0 * e->origin.sensor_zero_Nm, true, Nm));
    if (e->left_peak_to_peak_Nm > 0.0)
        hci_words_say(w,
                      " Of that %s N·m are for orders that the recordings show and the model does not have.",
                      number(e->left_peak_to_peak_Nm, true, Nm));
}

static void say_ripple(const hci_words *w, const hci_expected_ripple *e)
{
    char percent[NUMBER_SIZE], Nm[NUMBER_SIZE], middle[NUMBER_SIZE];
    if (isfinite(e->T_ripple_percent) && e->T_ripple_percent < NO_MEAN_PERCENT)
        hci_words_say(
            w,
            "Ripple at most %s %% of the mean torque (95 %%), %s N·m from peak to peak; half of the "
            "machines that the recordings allow stay below %s %%.",
            number(e->T_ripple_percent, true, percent), number(e->peak_to_peak_Nm, true, Nm),
            number(e->middle_percent, false, middle));
    else
        hci_words_say(w, "Ripple at most %s N·m from peak to peak (95 %%).",
                      number(e->peak_to_peak_Nm, true, Nm));
    say_parts(w, e);
    if (isfinite(e->worst_order_Nm))
        hci_words_say(w, " Worst order %.4g, at most %s N·m off.", e->worst_order,
                      number(e->worst_order_Nm, true, Nm));
}

/* No recording has currents like these. */
static void say_unbounded_mean(const hci_words *w, const hci_expected_ripple *e)
{
    const double most_A = fmax(fmax(fabs(e->measured_id_A.least), fabs(e->measured_id_A.most)),
                               fmax(fabs(e->measured_iq_A.least), fabs(e->measured_iq_A.most)));
    if (most_A > 0.0)
        hci_words_say(
            w,
            " Mean torque %.4g N·m in the model: how far it is off is not known, since no torque of "
            "such currents was recorded.",
            e->mean_Nm);
    else
        hci_words_say(w,
                      " Mean torque %.4g N·m by the torque per ampere of the data sheet, or of voltages: no "
                      "torque under load was recorded, and how far it is off is not known.",
                      e->mean_Nm);
}

/* A sensor that reads all torques too large makes the same of all machines that its recordings allow. */
static void say_mean(const hci_words *w, const hci_expected_ripple *e)
{
    char Nm[NUMBER_SIZE];
    const bool any = !(fabs(e->mean_Nm) <= ROUNDED * e->mean_error_Nm) &&
                     fabs(e->mean_Nm) > ROUNDED * e->peak_to_peak_Nm; /* also where its error is not known */
    if (isfinite(e->mean_Nm) && e->origin.constant_is_declared)
        hci_words_say(w, " Mean torque %.4g N·m by the declared torque per ampere, which no recording tells.",
                      e->mean_Nm);
    else if (isfinite(e->mean_error_Nm))
        hci_words_say(w, " Mean torque %.4g N·m, at most %s N·m off (95 %%) as the torque was measured.",
                      any ? e->mean_Nm : 0.0, number(e->mean_error_Nm, true, Nm));
    else if (isfinite(e->mean_Nm) && any)
        say_unbounded_mean(w, e);
}

/* A current beside the largest of them: rounding is 0. */
static double beside(double value_A, const hci_expected_ripple *e)
{
    const double most_A = fmax(fmax(fabs(e->measured_id_A.least), fabs(e->measured_id_A.most)),
                               fmax(fabs(e->measured_iq_A.least), fabs(e->measured_iq_A.most)));
    return fabs(value_A) > ROUNDED * most_A ? value_A : 0.0;
}

static void say_measured(const hci_words *w, const hci_expected_ripple *e)
{
    hci_words_say(w, " (i_d %.3g … %.3g A, i_q %.3g … %.3g A)", beside(e->measured_id_A.least, e),
                  beside(e->measured_id_A.most, e), beside(e->measured_iq_A.least, e),
                  beside(e->measured_iq_A.most, e));
}

static void say_currents(const hci_words *w, const hci_expected_ripple *e)
{
    if (e->outside_share > 0.0) {
        hci_words_say(w, " At %s %% of the angle the currents lie outside of what was recorded",
                      HCI_PERCENT(100.0 * e->outside_share, 3));
        say_measured(w, e);
        hci_words_say(
            w, ", by up to %.2g A: what the machine does there was not seen, and the bound is wider for it.",
            e->outside_A);
        if (hci_expected_ripple_is_far(e))
            hci_words_say(w, " That is further outside than such a bound has been checked for: record it.");
        return;
    }
    hci_words_say(w, " The currents lie within what was recorded");
    say_measured(w, e);
    hci_words_say(w, ".");
}

static void say_speed(const hci_words *w, const hci_expected_ripple *e)
{
    const double rpm = 30.0 / HCI_PI;
    if (e->speed_outside)
        hci_words_say(w, " The speed lies outside of what was recorded (%.4g … %.4g rpm).",
                      rpm * e->measured_speed_rad_per_s.least, rpm * e->measured_speed_rad_per_s.most);
}

/* Parts of a recording are left out where there are no recordings to leave out. */
static void say_recordings(const hci_words *w, const hci_expected_ripple *e)
{
    if (e->recordings > 0 && e->recordings < HCI_RIPPLE_LEAST_RECORDINGS)
        hci_words_say(
            w,
            " That was told by parts of %zu recording%s: what the machine does otherwise than there "
            "was not seen.",
            e->recordings, e->recordings == 1 ? "" : "s");
}

/* Whether the diagnosis explains the recordings, but had not compared all that may. */
static bool is_unfinished(const hci_expected_ripple *e)
{
    return e->origin.search[0] && strcmp(e->origin.search, "complete") != 0 &&
           strcmp(e->origin.verdict, "partly explained") != 0 && strcmp(e->origin.verdict, "unknown") != 0;
}

/* What holds for the model alone. */
static void say_origin(const hci_words *w, const hci_expected_ripple *e)
{
    char Nm[NUMBER_SIZE];
    if (hci_machine_origin_is_doubtful(&e->origin)) {
        if (is_unfinished(e))
            hci_words_say(
                w,
                " The model describes the recordings, but the search for effects ended before all had been "
                "compared: what currents do in this model holds for the model alone");
        else
            hci_words_say(w,
                          " What currents do in this model holds for the model alone: its diagnosis is %s%s",
                          e->origin.verdict,
                          strcmp(e->origin.search, "complete") != 0 ? ", and its search ended early" : "");
        if (e->origin.unexplained_Nm > 0.0)
            hci_words_say(w, "; its recordings have another %s N·m rms of ripple",
                          number(e->origin.unexplained_Nm, false, Nm));
        hci_words_say(w, ".");
    }
    if (!hci_machine_origin_is_doubtful(&e->origin) && e->origin.left_means_Nm > 0.0)
        hci_words_say(w,
                      " The ripple of the recordings is explained, and of their mean torques %s N·m rms are "
                      "not: the mean is known no better than that, and the torque per ampere is taken to be "
                      "within 20 %% of "
                      "the declared one.",
                      number(e->origin.left_means_Nm, false, Nm));
    if (isfinite(e->unbelievable_order))
        hci_words_say(w,
                      " Its back-EMF of order %.4g is %s %% of the fundamental, which is not believable: a "
                      "wave of constant size has %s %%.",
                      e->unbelievable_order, HCI_PERCENT(100.0 * e->unbelievable_share, 2),
                      HCI_PERCENT(100.0 / e->unbelievable_order, 2));
}

void hci_expected_ripple_words(const hci_expected_ripple *e, char *text, size_t size)
{
    const hci_words w = {text, size};
    text[0] = '\0';
    if (e->state != HCI_RIPPLE_KNOWN) {
        if (e->state == HCI_RIPPLE_UNEXPLAINED && is_unfinished(e))
            hci_words_say(&w, "Ripple not known.");
        else
            hci_words_say(&w, "%s.", hci_ripple_state_words(e->state));
        say_origin(&w, e);
        return;
    }
    say_ripple(&w, e);
    say_mean(&w, e);
    say_currents(&w, e);
    say_speed(&w, e);
    say_recordings(&w, e);
    say_origin(&w, e);
}
