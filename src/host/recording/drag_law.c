#include "host/recording/drag_law.h"

#include <math.h>

#include "host/numeric/normal_equations.h"

#define NEARLY 0.1 /* of the rms drag, that friction of a shaft is known to */

#define SIMILAR 0.15 /* speeds that differ by less, as a share, are the same */

enum { SIGN, SPEED, SQUARE, CONSTANT, COLUMNS, LEAST_FOR_SQUARE = 5 };

static double fastest_of(const hci_drag *drag, size_t count)
{
    double fastest = 0.0;
    for (size_t k = 0; k < count; ++k)
        fastest = fmax(fastest, fabs(drag[k].speed_rad_per_s));
    return fastest;
}

/* False when memory is out. Speeds are in units of the fastest. */
static bool start(const hci_drag *drag, size_t count, hci_normal_equations *normal, hci_sweep *sweep)
{
    const double fastest = fastest_of(drag, count);
    if (!hci_normal_equations_start(normal, COLUMNS)) return false;
    for (size_t k = 0; k < count; ++k) {
        const hci_drag *d = &drag[k];
        const double row[COLUMNS] = {d->sign, d->speed_rad_per_s / fastest, d->square / (fastest * fastest),
                                     d->constant};
        hci_normal_equations_add(normal, row, &d->drag_Nm, 1);
    }
    hci_normal_equations_finish(normal);
    if (hci_sweep_start(sweep, normal)) return true;
    hci_normal_equations_release(normal);
    return false;
}

static bool is_law(const hci_normal_equations *normal, hci_sweep *sweep)
{
    const double allowed = NEARLY * NEARLY * normal->square;
    const bool both_ways = hci_sweep_in(sweep, SIGN) && hci_sweep_in(sweep, CONSTANT);
    (void)hci_sweep_in(sweep, SPEED);
    if (normal->rows >= LEAST_FOR_SQUARE) (void)hci_sweep_in(sweep, SQUARE);
    return both_ways && sweep->square <= allowed &&
           sweep->b[CONSTANT] * sweep->b[CONSTANT] * normal->rows <= allowed;
}

static bool all_brake(const hci_drag *drag, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (!(drag[k].drag_Nm * drag[k].sign > 0.0)) return false;
    return true;
}

bool hci_drags_are_friction(const hci_drag *drag, size_t count, bool *is_friction)
{
    hci_normal_equations normal;
    hci_sweep sweep;
    *is_friction = false;
    if (!(fastest_of(drag, count) > 0.0) || !all_brake(drag, count)) return true;
    if (!start(drag, count, &normal, &sweep)) return false;
    *is_friction = is_law(&normal, &sweep);
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
    return true;
}

/* ---- the law ---- */

/* How many speeds there are, at most as many as the law has terms. */
static size_t speeds_of(const hci_drag *drag, size_t count)
{
    double known[HCI_DRAG_TERMS];
    size_t speeds = 0;
    for (size_t k = 0; k < count && speeds < HCI_DRAG_TERMS; ++k) {
        const double speed = fabs(drag[k].speed_rad_per_s);
        bool is_new = true;
        for (size_t j = 0; j < speeds; ++j)
            is_new = is_new && fabs(speed - known[j]) > SIMILAR * fmax(speed, known[j]);
        if (is_new) known[speeds++] = speed;
    }
    return speeds;
}

static double variance_of(const hci_normal_equations *normal, const hci_sweep *sweep, size_t terms)
{
    const double freedom = normal->rows - (double)terms,
                 rms = NEARLY * NEARLY * normal->square / normal->rows;
    return freedom >= 1.0 && sweep->square > 0.0 ? sweep->square / freedom : rms;
}

static void fill(const hci_normal_equations *normal, const hci_sweep *sweep, double fastest,
                 hci_drag_law *law)
{
    const double variance = variance_of(normal, sweep, law->terms);
    double unit = 1.0;
    for (size_t k = 0; k < law->terms; ++k, unit /= fastest) {
        law->value[k] = sweep->b[k] * unit;
        law->std_error[k] = sqrt(variance * sweep->a[k * sweep->n + k]) * unit;
    }
    law->gain =
        (normal->square - sweep->square) / variance - (double)law->terms * log(fmax(2.0, normal->rows));
}

bool hci_drag_law_find(const hci_drag *drag, size_t count, hci_drag_law *law)
{
    hci_normal_equations normal;
    hci_sweep sweep;
    const size_t most = speeds_of(drag, count);
    *law = (hci_drag_law){.terms = 0};
    if (most == 0) return true;
    if (!start(drag, count, &normal, &sweep)) return false;
    while (law->terms < most && hci_sweep_in(&sweep, law->terms))
        ++law->terms;
    while (law->terms > 1 && sweep.b[HCI_DRAG_COULOMB] < 0.0)
        hci_sweep_out(&sweep, --law->terms);
    fill(&normal, &sweep, fastest_of(drag, count), law);
    hci_sweep_release(&sweep);
    hci_normal_equations_release(&normal);
    return true;
}

double hci_drag_law_at(const hci_drag_law *law, const hci_drag *drag)
{
    return law->value[HCI_DRAG_COULOMB] * drag->sign + law->value[HCI_DRAG_VISCOUS] * drag->speed_rad_per_s +
           law->value[HCI_DRAG_QUADRATIC] * drag->square;
}
