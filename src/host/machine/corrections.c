/* The inverse of what sensors do to currents and angles. In: effects; out: what a drive has to do, in numbers
 * and in lines. */
#include "hci/host/machine/corrections.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- numbers ---- */

static void add_wave(hci_corrections *c, hci_effect_correction kind, const hci_effect_term *term)
{
    if (c->waves == HCI_CORRECTION_WAVES || term->value == 0.0) return;
    c->wave[c->waves++] =
        (hci_angle_wave){.order = term->order,
                         .amplitude_rad = term->value,
                         .is_mechanical = kind == HCI_CORRECT_TURN_SINE || kind == HCI_CORRECT_TURN_COSINE,
                         .is_cosine = kind == HCI_CORRECT_ANGLE_COSINE || kind == HCI_CORRECT_TURN_COSINE};
}

bool hci_correction_is_asked(const hci_effect_type *type, const hci_effect_term *term)
{
    const hci_effect_correction kind =
        type->correction ? type->correction[term->parameter] : HCI_CORRECT_NOTHING;
    return kind != HCI_CORRECT_NOTHING && !(kind == HCI_CORRECT_ANGLE_DELAY && term->value < 0.0);
}

/* What terms of a kind add up in; NULL: they do not add up. */
static double *sum_of(hci_corrections *c, hci_effect_correction kind, size_t parameter)
{
    switch (kind) {
    case HCI_CORRECT_CURRENT_ZERO:
        return &c->zero_A[parameter];
    case HCI_CORRECT_ANGLE_ZERO:
        return &c->angle_zero_rad;
    case HCI_CORRECT_ANGLE_LOAD:
        return &c->load_rad_per_A;
    case HCI_CORRECT_CURRENT_DELAY:
        return &c->current_delay_s;
    case HCI_CORRECT_CURRENT_FILTER:
        return &c->current_filter_s;
    default:
        return NULL;
    }
}

static void take_term(hci_corrections *c, hci_effect_correction kind, const hci_effect_term *term)
{
    double *sum = sum_of(c, kind, term->parameter);
    if (sum != NULL)
        *sum += term->value;
    else if (kind == HCI_CORRECT_CURRENT_GAIN)
        c->gain[term->parameter] /= 1.0 + term->value;
    else if (kind == HCI_CORRECT_ANGLE_DELAY)
        c->angle_delay_s += term->value;
    else
        add_wave(c, kind, term);
}

static void take_type(const hci_effects *effects, const hci_effect_type *type, hci_corrections *c)
{
    for (size_t n = 0; n < effects->count && type->correction; ++n) {
        const hci_effect *e = &effects->effect[n];
        for (size_t k = 0; k < e->count && e->type == type; ++k)
            if (hci_correction_is_asked(type, &e->term[k]))
                take_term(c, type->correction[e->term[k].parameter], &e->term[k]);
    }
}

/* Effects act in the order of their registry: what acts last is undone first. */
void hci_corrections_take(const hci_effects *effects, hci_corrections *c)
{
    size_t types = 0;
    *c = (hci_corrections){.gain = {1.0, 1.0, 1.0}};
    while (hci_effect_type_at(types) != NULL)
        ++types;
    while (types-- > 0)
        take_type(effects, hci_effect_type_at(types), c);
    for (size_t s = 0; s < 3; ++s)
        c->has_currents = c->has_currents || c->zero_A[s] != 0.0 || c->gain[s] != 1.0;
    c->has_angle = c->angle_zero_rad != 0.0 || c->waves > 0 || c->load_rad_per_A != 0.0;
}

/* ---- lines ---- */

typedef struct {
    char *text;
    size_t size, used;
} lines;

/* A line that has no room is left out. */
static void say(lines *l, const char *format, ...)
{
    char line[160];
    va_list values;
    va_start(values, format);
    const int length = vsnprintf(line, sizeof line, format, values);
    va_end(values);
    if (length < 0 || l->used + (size_t)length + 2 > l->size) return;
    l->used += (size_t)snprintf(l->text + l->used, l->size - l->used, "%s%s", l->used > 0 ? "\n" : "", line);
}

/* What is taken away, with its sign: "- 0.02" or "+ 0.02". */
#define LESS(value) (value) < 0.0 ? '+' : '-', fabs(value)

static void say_currents(lines *l, const hci_corrections *c)
{
    for (int s = 0; s < 3; ++s) {
        const char phase = "abc"[s];
        const double zero_A = c->zero_A[s], gain = c->gain[s];
        if (zero_A != 0.0 && gain != 1.0)
            say(l, "i_%c = (i_%c_read %c %.3g A) * %.5g", phase, phase, LESS(zero_A), gain);
        else if (zero_A != 0.0)
            say(l, "i_%c = (i_%c_read %c %.3g A)", phase, phase, LESS(zero_A));
        else if (gain != 1.0)
            say(l, "i_%c = i_%c_read * %.5g", phase, phase, gain);
    }
}

/* read: "_read" in the first line of an angle, "" below it. */
static void say_wave(lines *l, const hci_angle_wave *w, const char *read)
{
    const char *angle = w->is_mechanical ? "theta_m" : "theta";
    say(l, "%s = %s%s %c %.3g rad * %s(%.5g %s%s) (%s)", angle, angle, read, LESS(w->amplitude_rad),
        w->is_cosine ? "cos" : "sin", w->order, angle, read, w->is_mechanical ? "mechanical" : "electrical");
}

static void say_angle(lines *l, const hci_corrections *c)
{
    static const char READ[] = "_read";
    const char *read = READ;
    if (c->angle_zero_rad != 0.0) {
        say(l, "theta = theta%s %c %.3g rad (electrical)", read, LESS(c->angle_zero_rad));
        read = "";
    }
    for (size_t k = 0; k < c->waves; ++k, read = "")
        say_wave(l, &c->wave[k], read);
    if (c->load_rad_per_A != 0.0) {
        say(l, "theta = theta%s %c %.3g rad/A * i_q (electrical)", read, LESS(c->load_rad_per_A));
        read = "";
    }
    if (c->angle_delay_s > 0.0)
        say(l, "theta = theta%s + %.3g s * d theta/dt (the angle is late)", read, c->angle_delay_s);
}

static void say_delays(lines *l, const hci_corrections *c)
{
    if (c->current_delay_s != 0.0)
        say(l, "currents: with the angle of %.3g s before (they are late)", c->current_delay_s);
    if (c->current_filter_s != 0.0)
        say(l, "currents: with the angle of %.3g s before (of their low pass)", c->current_filter_s);
}

void hci_corrections_words(const hci_effects *effects, char *text, size_t size)
{
    hci_corrections c;
    lines l = {text, size, 0};
    text[0] = '\0';
    hci_corrections_take(effects, &c);
    say_currents(&l, &c);
    say_angle(&l, &c);
    say_delays(&l, &c);
}
