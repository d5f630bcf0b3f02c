/* What an effect was found to be, for people: its largest values by what they are called in the field. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/diagnose/diagnose.h"
#include "host/base/words.h"

enum { MOST_SAID = 4, MOST_VALUES = 256, NAME_SIZE = 96 };

/* A value of an effect, or the amplitude of its sine and cosine at one order. */
typedef struct {
    const hci_effect_parameter *parameter;
    double order, value, std_error;
    double weight; /* in proportion to the torque that it makes, among those of one unit */
} said;

static bool ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), tail = strlen(end);
    return length >= tail && strcmp(text + length - tail, end) == 0;
}

static bool is_wave(const hci_effect_parameter *p)
{
    return p->ordered && (ends_with(p->name, "sine") || ends_with(p->name, "cosine"));
}

/* Bytes of the name without "sine" or "cosine" at its end. */
static size_t stem_length(const hci_effect_parameter *p)
{
    return strlen(p->name) - (ends_with(p->name, "cosine") ? 6 : is_wave(p) ? 4 : 0);
}

static bool belong_together(const said *s, const hci_effect_parameter *p, double order)
{
    const size_t length = stem_length(p);
    return s->parameter == p || (is_wave(p) && order > 0.0 && fabs(s->order - order) < HCI_ORDER_TOLERANCE &&
                                 is_wave(s->parameter) && stem_length(s->parameter) == length &&
                                 strncmp(s->parameter->name, p->name, length) == 0);
}

/* A co-energy of order n, as an inductance gives it, makes n times the torque. */
static double weight_of(const said *s)
{
    const bool is_coenergy =
        strcmp(s->parameter->unit, "H") == 0 || strncmp(s->parameter->meaning, "co-energy", 9) == 0;
    return fabs(s->value) * (is_coenergy ? fmax(1.0, s->order) : 1.0);
}

static size_t add_value(const hci_effect_type *type, const hci_effect_term *x, said *all, size_t count)
{
    const hci_effect_parameter *p = &type->parameter[x->parameter];
    size_t k = 0;
    if ((p->traits & HCI_PARAMETER_REFERENCE_CURRENT) || (x->value == 0.0 && !(x->std_error > 0.0)))
        return count;
    while (k < count &&
           !(belong_together(&all[k], p, x->order) && fabs(all[k].order - x->order) < HCI_ORDER_TOLERANCE))
        ++k;
    if (k == MOST_VALUES) return count;
    if (k == count) {
        all[k] =
            (said){p, x->order, x->order > 0.0 && is_wave(p) ? fabs(x->value) : x->value, x->std_error, 0.0};
    } else {
        all[k].value = hypot(all[k].value, x->value);
        all[k].std_error = fmax(all[k].std_error, x->std_error);
    }
    all[k].weight = weight_of(&all[k]);
    return k == count ? count + 1 : count;
}

/* The largest first, among those of one unit; those of different units stay as they are. */
static void sort(said *all, size_t count)
{
    for (size_t k = 1; k < count; ++k)
        for (size_t j = k; j > 0 && all[j].weight > all[j - 1].weight &&
                           strcmp(all[j].parameter->unit, all[j - 1].parameter->unit) == 0;
             --j) {
            const said held = all[j];
            all[j] = all[j - 1];
            all[j - 1] = held;
        }
}

static const char *unit_words(const char *unit)
{
    static const char *const WORDS[][2] = {{"1", ""},
                                           {"Nm", " N·m"},
                                           {"Nm_per_A", " N·m/A"},
                                           {"Nm_per_A2", " N·m/A²"},
                                           {"Nm_per_s", " N·m/s"},
                                           {"Nms_per_rad", " N·m·s/rad"},
                                           {"Nms2_per_rad2", " N·m·s²/rad²"},
                                           {"Nms_per_rad_A2", " N·m·s/(rad·A²)"},
                                           {"kgm2", " kg·m²"},
                                           {"rad_per_A", " rad/A"},
                                           {"rad_per_s", " rad/s"},
                                           {"C", " °C"},
                                           {"A", " A"},
                                           {"H", " H"},
                                           {"Hz", " Hz"},
                                           {"rad", " rad"},
                                           {"s", " s"},
                                           {"1/K", " 1/K"}};
    for (size_t k = 0; k < sizeof WORDS / sizeof *WORDS; ++k)
        if (strcmp(WORDS[k][0], unit) == 0) return WORDS[k][1];
    return "";
}

/* "L_dd" of "of L_dd, cos nθ"; "" where the effect has one wave alone. */
static void quantity_of(const hci_effect_parameter *p, char text[NAME_SIZE])
{
    const char *from = p->meaning, *end = strstr(from, strstr(from, "cos ") ? "cos " : "sin ");
    text[0] = '\0';
    if (stem_length(p) == 0 || !end) return;
    if (strncmp(from, "of ", 3) == 0) from += 3;
    size_t length = end > from ? (size_t)(end - from) : 0;
    if (length >= 3 && strncmp(end - 3, "of ", 3) == 0) length -= 3;
    while (length > 0 && strchr(", ", from[length - 1]))
        --length;
    snprintf(text, NAME_SIZE, ", %.*s", (int)length, from);
}

/* "mean, L_dd", "order 12", "time constant", "phase a" */
static void name_of(const said *s, char text[2 * NAME_SIZE])
{
    char quantity[NAME_SIZE];
    if (is_wave(s->parameter)) {
        quantity_of(s->parameter, quantity);
        if (s->order > 0.0)
            snprintf(text, 2 * NAME_SIZE, "order %.4g%s", s->order, quantity);
        else
            snprintf(text, 2 * NAME_SIZE, "mean%s", quantity);
        return;
    }
    snprintf(text, 2 * NAME_SIZE, "%s%s", strlen(s->parameter->name) == 1 ? "phase " : "",
             s->parameter->name);
    for (char *c = text; *c; ++c)
        if (*c == '_') *c = ' ';
}

static void say_value(const hci_words *w, const said *s, bool is_first)
{
    char name[2 * NAME_SIZE];
    name_of(s, name);
    hci_words_say(w, "%s%s = %.4g", is_first ? "" : "; ", name, s->value);
    if (s->std_error > 0.0)
        hci_words_say(w, " ± %.2g%s", s->std_error, unit_words(s->parameter->unit));
    else
        hci_words_say(w, "%s, not told by itself", unit_words(s->parameter->unit));
}

/* What stands behind the values of a friction. */
static void say_condition(const hci_words *w, const char *detail)
{
    const char *of_sum = strstr(detail, "; only their sum"), *of_constant = strstr(detail, ", times the ");
    if (of_sum || of_constant) hci_words_say(w, "%s", of_sum ? of_sum : of_constant);
}

/* What another effect explains as well is no value of the machine. */
static void say_detail(const hci_words *w, const hci_finding *f)
{
    static const char PLACE[] = "in place of ", SAME[] = "looks the same as a part of ";
    const bool is_rival = strncmp(f->detail, PLACE, sizeof PLACE - 1) == 0;
    if (!is_rival && strncmp(f->detail, SAME, sizeof SAME - 1) != 0) {
        hci_words_say(w, "%s", f->detail);
        return;
    }
    const char *other = f->detail + (is_rival ? sizeof PLACE : sizeof SAME) - 1;
    const size_t length = strcspn(other, ": ");
    char id[NAME_SIZE];
    snprintf(id, sizeof id, "%.*s", (int)length, other);
    if (is_rival)
        hci_words_say(w, "in place of %s; values in effects.csv", hci_finding_title(id));
    else
        hci_words_say(w, "%s%s%s", SAME, hci_finding_title(id), other + length);
}

const char *hci_finding_title(const char *effect)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    return type ? type->title : strcmp(effect, "unknown") == 0 ? "what is not known" : effect;
}

void hci_finding_words(const hci_diagnosis *d, const hci_finding *f, char *text, size_t size)
{
    const hci_words w = {text, size};
    const hci_effect *e = NULL;
    said all[MOST_VALUES];
    size_t count = 0;
    text[0] = '\0';
    for (size_t k = 0; k < d->effects.list.count; ++k)
        if (strcmp(d->effects.list.effect[k].type->name, f->effect) == 0) e = &d->effects.list.effect[k];
    const bool is_rival =
        strncmp(f->detail, "in place of ", 12) == 0 || strncmp(f->detail, "looks the same", 14) == 0;
    for (size_t k = 0; e && !is_rival && f->verdict != HCI_FINDING_REJECTED && k < e->count; ++k)
        count = add_value(e->type, &e->term[k], all, count);
    if (count == 0) {
        say_detail(&w, f);
        return;
    }
    sort(all, count);
    for (size_t k = 0; k < count && k < MOST_SAID; ++k)
        say_value(&w, &all[k], k == 0);
    if (count > MOST_SAID) hci_words_say(&w, "; and %zu more in effects.csv", count - MOST_SAID);
    say_condition(&w, f->detail);
}
