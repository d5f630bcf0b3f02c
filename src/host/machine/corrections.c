/* The inverse of what sensors do to currents and angles, in words. In: effects; out: what a drive has to do.
 */
#include "hci/host/machine/corrections.h"

#include <math.h>
#include <string.h>

#include "host/base/words.h"

/* "i_a", "i_b", "i_c" of the parameters a, b, c. */
static const char *phase_of(const hci_effect *e, size_t k)
{
    static const char *const PHASE[] = {"i_a", "i_b", "i_c"};
    const size_t parameter = e->term[k].parameter;
    return PHASE[parameter < 3 ? parameter : 2];
}

static void say_offset(const hci_words *w, const hci_effect *e, size_t k)
{
    const double value_A = e->term[k].value;
    hci_words_say(w, "%s %.3g A %s %s", value_A < 0.0 ? "add" : "subtract", fabs(value_A),
                  value_A < 0.0 ? "to" : "from", phase_of(e, k));
}

static void say_gain(const hci_words *w, const hci_effect *e, size_t k)
{
    hci_words_say(w, "divide %s by %.5g", phase_of(e, k), 1.0 + e->term[k].value);
}

static void say_angle(const hci_words *w, const hci_effect *e, size_t k)
{
    hci_words_say(w, "subtract %.3g rad from the electrical angle", e->term[k].value);
}

/* One term of a wave over the angle; sines and cosines are parameters 0 and 1. */
static void say_wave(const hci_words *w, const hci_effect *e, size_t k, const char *angle)
{
    hci_words_say(w, "subtract %.3g rad %s(%.5g %s) from the %s angle", e->term[k].value,
                  e->term[k].parameter == 0 ? "sin" : "cos", e->term[k].order, angle,
                  strcmp(angle, "theta_m") == 0 ? "mechanical" : "electrical");
}

static void say_eccentricity(const hci_words *w, const hci_effect *e, size_t k)
{
    say_wave(w, e, k, "theta_m");
}

static void say_harmonic(const hci_words *w, const hci_effect *e, size_t k)
{
    say_wave(w, e, k, "theta");
}

static void say_filter(const hci_words *w, const hci_effect *e, size_t k)
{
    hci_words_say(w, "take the angle of %.3g s before for the currents, which lag as in a low pass",
                  e->term[k].value);
}

/* Parameters: of the currents, the angle, the torque, which is none of a drive. */
static void say_delay(const hci_words *w, const hci_effect *e, size_t k)
{
    if (e->term[k].parameter == 0)
        hci_words_say(w, "take the angle of %.3g s before for the currents, which are read late",
                      e->term[k].value);
    else
        hci_words_say(w, "add the speed times %.3g s to the angle, which is read late", e->term[k].value);
}

/* The effects that are sensors of a drive. `parameters`: how many of the first are. */
static const struct {
    const char *effect;
    size_t parameters;
    void (*say)(const hci_words *w, const hci_effect *e, size_t k);
} SENSORS[] = {{"current_offset", 3, say_offset},       {"current_gain", 3, say_gain},
               {"position_offset", 1, say_angle},       {"position_eccentricity", 2, say_eccentricity},
               {"position_harmonics", 2, say_harmonic}, {"channel_delay", 2, say_delay},
               {"current_filter", 1, say_filter}};

void hci_corrections_words(const hci_effects *effects, char *text, size_t size)
{
    const hci_words w = {text, size};
    text[0] = '\0';
    for (size_t s = 0; s < sizeof SENSORS / sizeof *SENSORS; ++s)
        for (size_t n = 0; n < effects->count; ++n) {
            const hci_effect *e = &effects->effect[n];
            for (size_t k = 0; k < e->count && strcmp(e->type->name, SENSORS[s].effect) == 0; ++k) {
                if (e->term[k].parameter >= SENSORS[s].parameters || e->term[k].value == 0.0) continue;
                if (*text) hci_words_say(&w, ", ");
                SENSORS[s].say(&w, e, k);
            }
        }
}
