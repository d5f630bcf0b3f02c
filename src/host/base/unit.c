/* The units that files may use, in every spelling. */
#include "hci/host/base/unit.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/math/harmonic.h"
#include "host/base/unit_lookup.h"

enum {
    NONE,
    CURRENT,
    VOLTAGE,
    TIME,
    ANGLE,
    SPEED,
    FREQUENCY,
    TORQUE,
    TORQUE_CONSTANT,
    INDUCTANCE,
    INDUCTANCE_SLOPE,
    RESISTANCE,
    INERTIA,
    VISCOUS_FRICTION,
    POWER,
    TEMPERATURE,
    FLUX
};

#define SQRT2 1.4142135623730951

/* In lower case; a '.' is a product that may be written in any way or left out. The first of a dimension has
 * factor 1. */
static const hci_unit units[] = {
    {"1", NONE, 1},
    {".", NONE, 1},
    {"%", NONE, 0.01},
    {"a", CURRENT, 1},
    {"amp", CURRENT, 1},
    {"amps", CURRENT, 1},
    {"ampere", CURRENT, 1},
    {"amperes", CURRENT, 1},
    {"arms", CURRENT, SQRT2}, /* of servo drives, whose currents are those of a sine */
    {"a.rms", CURRENT, SQRT2},
    {"aeff", CURRENT, SQRT2},
    {"a.eff", CURRENT, SQRT2},
    {"amps.rms", CURRENT, SQRT2},
    {"apk", CURRENT, 1},
    {"a.peak", CURRENT, 1},
    {"amps.peak", CURRENT, 1},
    {"a.pk", CURRENT, 1},
    {"ma", CURRENT, 1e-3},
    {"ka", CURRENT, 1e3},
    {"v", VOLTAGE, 1},
    {"volt", VOLTAGE, 1},
    {"volts", VOLTAGE, 1},
    {"uv", VOLTAGE, 1e-6},
    {"mv", VOLTAGE, 1e-3},
    {"kv", VOLTAGE, 1e3},
    {"s", TIME, 1},
    {"sec", TIME, 1},
    {"second", TIME, 1},
    {"seconds", TIME, 1},
    {"ms", TIME, 1e-3},
    {"msec", TIME, 1e-3},
    {"us", TIME, 1e-6},
    {"ns", TIME, 1e-9},
    {"rad", ANGLE, 1},
    {"radian", ANGLE, 1},
    {"radians", ANGLE, 1},
    {"mrad", ANGLE, 1e-3},
    {"deg", ANGLE, HCI_PI / 180},
    {"degree", ANGLE, HCI_PI / 180},
    {"degrees", ANGLE, HCI_PI / 180},
    {"grad", ANGLE, HCI_PI / 180}, /* degrees in German; nobody logs gradians */
    {"degre", ANGLE, HCI_PI / 180},
    {"degres", ANGLE, HCI_PI / 180},
    {"gon", ANGLE, HCI_PI / 200},
    {"gradi", ANGLE, HCI_PI / 180},
    {"grado", ANGLE, HCI_PI / 180},
    {"grados", ANGLE, HCI_PI / 180},
    {"rev", ANGLE, 2 * HCI_PI},
    {"turn", ANGLE, 2 * HCI_PI},
    {"turns", ANGLE, 2 * HCI_PI},
    {"revolution", ANGLE, 2 * HCI_PI},
    {"revolutions", ANGLE, 2 * HCI_PI},
    {"edeg", ANGLE, HCI_PI / 180},
    {"eldeg", ANGLE, HCI_PI / 180},
    {"elecdeg", ANGLE, HCI_PI / 180},
    {"deg.e", ANGLE, HCI_PI / 180},
    {"deg.el", ANGLE, HCI_PI / 180},
    {"deg.el.", ANGLE, HCI_PI / 180},
    {"deg.elec", ANGLE, HCI_PI / 180},
    {"deg.elec.", ANGLE, HCI_PI / 180},
    {"deg.elek", ANGLE, HCI_PI / 180},
    {"deg.elektr", ANGLE, HCI_PI / 180},
    {"deg.elektr.", ANGLE, HCI_PI / 180},
    {"grad.el", ANGLE, HCI_PI / 180},
    {"grad.el.", ANGLE, HCI_PI / 180},
    {"grad.elektr", ANGLE, HCI_PI / 180},
    {"rad.el", ANGLE, 1},
    {"rad.elec", ANGLE, 1},
    {"rad.electrical", ANGLE, 1},
    {"mechdeg", ANGLE, HCI_PI / 180},
    {"deg.mech", ANGLE, HCI_PI / 180},
    {"deg.mech.", ANGLE, HCI_PI / 180},
    {"grad.mech", ANGLE, HCI_PI / 180},
    {"grad.mech.", ANGLE, HCI_PI / 180},
    {"rad.mech", ANGLE, 1},
    {"rad/s", SPEED, 1},
    {"rad.s", SPEED, 1},
    {"rad/sec", SPEED, 1},
    {"deg/s", SPEED, HCI_PI / 180},
    {"rpm", SPEED, 2 * HCI_PI / 60},
    {"1/min", SPEED, 2 * HCI_PI / 60},
    {"r/min", SPEED, 2 * HCI_PI / 60},
    {"rev/min", SPEED, 2 * HCI_PI / 60},
    {"u/min", SPEED, 2 * HCI_PI / 60},
    {"umdr/min", SPEED, 2 * HCI_PI / 60},
    {"upm", SPEED, 2 * HCI_PI / 60},
    {"tr/min", SPEED, 2 * HCI_PI / 60},
    {"giri/min", SPEED, 2 * HCI_PI / 60},
    {"min.1", SPEED, 2 * HCI_PI / 60},
    {"grad/s", SPEED, HCI_PI / 180},
    {"rad.s.1", SPEED, 1},
    {"u/s", SPEED, 2 * HCI_PI},
    {"tr/s", SPEED, 2 * HCI_PI},
    {"rev/s", SPEED, 2 * HCI_PI},
    {"rev.s", SPEED, 2 * HCI_PI},
    {"turn.s", SPEED, 2 * HCI_PI},
    {"turns.s", SPEED, 2 * HCI_PI},
    {"rev.min", SPEED, 2 * HCI_PI / 60},
    {"rps", SPEED, 2 * HCI_PI},
    {"turn/s", SPEED, 2 * HCI_PI},
    {"turns/s", SPEED, 2 * HCI_PI},
    {"hz", FREQUENCY, 1},
    {"khz", FREQUENCY, 1e3},
    {"n.m", TORQUE, 1},
    {"newton.meter", TORQUE, 1},
    {"newton.metre", TORQUE, 1},
    {"mnewton.meter", TORQUE, 1e-3},
    {"kn.m", TORQUE, 1e3},
    {"n.cm", TORQUE, 1e-2},
    {"mn.m", TORQUE, 1e-3},
    {"un.m", TORQUE, 1e-6},
    {"lbf.ft", TORQUE, 1.3558179483314004},
    {"lb.ft", TORQUE, 1.3558179483314004},
    {"ft.lb", TORQUE, 1.3558179483314004},
    {"ft.lbs", TORQUE, 1.3558179483314004},
    {"ft.lbf", TORQUE, 1.3558179483314004},
    {"lbf.in", TORQUE, 0.1129848290276167},
    {"lb.in", TORQUE, 0.1129848290276167},
    {"in.lb", TORQUE, 0.1129848290276167},
    {"oz.in", TORQUE, 0.00706155181422604},
    {"ozf.in", TORQUE, 0.00706155181422604},
    {"kgf.cm", TORQUE, 0.0980665},
    {"kgf.m", TORQUE, 9.80665},
    {"n.m/a", TORQUE_CONSTANT, 1},
    {"mn.m/a", TORQUE_CONSTANT, 1e-3},
    {"v.s/rad", TORQUE_CONSTANT, 1},
    {"h", INDUCTANCE, 1},
    {"mh", INDUCTANCE, 1e-3},
    {"uh", INDUCTANCE, 1e-6},
    {"nh", INDUCTANCE, 1e-9},
    {"h/rad", INDUCTANCE_SLOPE, 1},
    {"mh/rad", INDUCTANCE_SLOPE, 1e-3},
    {"uh/rad", INDUCTANCE_SLOPE, 1e-6},
    {"ohm", RESISTANCE, 1},
    {"mohm", RESISTANCE, 1e-3},
    {"v/a", RESISTANCE, 1},
    {"kg.m2", INERTIA, 1},
    {"kg.cm2", INERTIA, 1e-4},
    {"g.cm2", INERTIA, 1e-7},
    {"n.m.s/rad", VISCOUS_FRICTION, 1},
    {"w", POWER, 1},
    {"kw", POWER, 1e3},
    {"c", TEMPERATURE, 1},
    {"deg.c", TEMPERATURE, 1},
    {"celsius", TEMPERATURE, 1},
    {"wb", FLUX, 1},
    {"weber", FLUX, 1},
    {"v.s", FLUX, 1},
    {"mwb", FLUX, 1e-3},
    {"mv.s", FLUX, 1e-3},
};

typedef struct {
    const char *from, *to;
} replacement;

/* Tried in this order at each position. */
static const replacement replacements[] = {
    {"_per_", "/"},
    {"\xC3\xA9", "e"},              /* é */
    {"\xC3\xA8", "e"},              /* è */
    {"\xE2\x81\xBB\xC2\xB9", ".1"}, /* ⁻¹ */
    {" per ", "/"},
    {" / ", "/"},
    {"_", "."},
    {"*", "."},
    {"-", "."},
    {" ", "."},
    {"\xC2\xB7", "."},     /* · */
    {"\xE2\x8B\x85", "."}, /* ⋅ */
    {"^", ""},
    {"\xC2\xB2", "2"},       /* ² */
    {"\xC2\xB5", "u"},       /* µ, micro sign */
    {"\xCE\xBC", "u"},       /* μ, mu */
    {"\xCE\xA9", "ohm"},     /* Ω, omega */
    {"\xE2\x84\xA6", "ohm"}, /* Ω, ohm sign */
    {"\xC2\xB0", "deg"},     /* ° */
};

enum { SPELLING_SIZE = 24 };

static const replacement *find_replacement(const char *text, size_t length)
{
    for (size_t i = 0; i < sizeof replacements / sizeof *replacements; i++) {
        const size_t from = strlen(replacements[i].from);
        if (from <= length && memcmp(text, replacements[i].from, from) == 0) return &replacements[i];
    }
    return NULL;
}

/* False when the text is longer than any unit. */
static bool normalise(const char *text, size_t length, char out[SPELLING_SIZE])
{
    size_t used = 0;
    for (size_t i = 0; i < length;) {
        if (used + 4 > SPELLING_SIZE) return false;
        const replacement *found = find_replacement(text + i, length - i);
        if (found != NULL) {
            memcpy(out + used, found->to, strlen(found->to));
            used += strlen(found->to);
            i += strlen(found->from);
        } else {
            out[used++] = (char)(text[i] >= 'A' && text[i] <= 'Z' ? text[i] - 'A' + 'a' : text[i]);
            i++;
        }
    }
    out[used] = '\0';
    return true;
}

static bool is_spelling(const char *spelling, const char *text)
{
    for (; *spelling != '\0'; spelling++) {
        if (*text == *spelling) {
            text++;
        } else if (*spelling != '.') {
            return false;
        }
    }
    return *text == '\0';
}

static const hci_unit *find_without_case(const char *text, size_t length)
{
    char normal[SPELLING_SIZE];
    if (!normalise(text, length, normal)) return NULL;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (is_spelling(units[i].spelling, normal)) return &units[i];
    }
    return NULL;
}

/* MDeg, the mechanical degrees that stand beside EDeg. */
static bool is_mechanical_degree(const char *text, size_t length)
{
    return length == 4 && memcmp(text, "MDeg", 4) == 0;
}

hci_unit_turn hci_unit_turn_of(const hci_unit *unit)
{
    const char *spelling = unit != NULL && unit->dimension == ANGLE ? unit->spelling : "";
    if (strstr(spelling, "mech") != NULL) return HCI_UNIT_TURN_MECHANICAL;
    const bool is_electrical = spelling[0] == 'e' || strstr(spelling, ".e") != NULL;
    return is_electrical ? HCI_UNIT_TURN_ELECTRICAL : HCI_UNIT_TURN_UNSAID;
}

const hci_unit *hci_unit_find(const char *text, size_t length)
{
    if (is_mechanical_degree(text, length)) return find_without_case("mechdeg", 7);
    return length > 0 && text[0] == 'M' ? NULL : find_without_case(text, length);
}

const hci_unit *hci_unit_of_suffix(const char *suffix)
{
    return find_without_case(suffix, strlen(suffix));
}

const hci_unit *hci_unit_of_name(const char *name, size_t *base_length)
{
    for (const char *at = strchr(name, '_'); at != NULL; at = strchr(at + 1, '_')) {
        const hci_unit *unit = hci_unit_of_suffix(at + 1);
        if (unit == NULL) continue;
        *base_length = (size_t)(at - name);
        return unit;
    }
    *base_length = strlen(name);
    return hci_unit_find("1", 1);
}

bool hci_unit_equal(const hci_unit *a, const hci_unit *b)
{
    return a->dimension == b->dimension && !(a->factor < b->factor) && !(a->factor > b->factor);
}

bool hci_unit_factor(const char *unit, const char *wanted_unit, double *factor)
{
    const hci_unit *from = hci_unit_find(unit, strlen(unit));
    const hci_unit *to = hci_unit_find(wanted_unit, strlen(wanted_unit));
    if (from == NULL || to == NULL || from->dimension != to->dimension) return false;
    *factor = from->factor / to->factor;
    return true;
}

double hci_rpm(double speed_rad_per_s)
{
    char text[32];
    double rpm;
    snprintf(text, sizeof text, "%.12g", speed_rad_per_s * 30.0 / HCI_PI);
    return hci_number_parse(text, &rpm) ? rpm : speed_rad_per_s * 30.0 / HCI_PI;
}
