#include "host/limit/voltage.h"

#include <math.h>

#include "hci/machine/frames.h"
#include "host/solve/task.h"

#define DIFFERENCE_A 1e-3 /* of the difference quotients of effects, polynomials in the current */

/* ---- inductance ---- */

/* A symmetric phase matrix in the plane: αα, αβ, ββ. */
static void matrix_to_plane(const double m[HCI_PHASE_MATRIX], double out[3])
{
    const double row[3][3] = {{m[HCI_AA], m[HCI_AB], m[HCI_CA]},
                              {m[HCI_AB], m[HCI_BB], m[HCI_BC]},
                              {m[HCI_CA], m[HCI_BC], m[HCI_CC]}};
    double column[2][2];
    for (int k = 0; k < 2; ++k) {
        const double unit[2] = {k == 0, k == 1};
        double abc[3], product[3];
        hci_plane_to_abc(unit, abc);
        for (int s = 0; s < 3; ++s)
            product[s] = row[s][0] * abc[0] + row[s][1] * abc[1] + row[s][2] * abc[2];
        hci_plane_from_abc(product, column[k]);
    }
    out[0] = column[0][0];
    out[1] = column[0][1];
    out[2] = column[1][1];
}

static double mean_of_axes_H(const hci_machine_data *m)
{
    return 0.5 * (m->inductance_d_H + m->inductance_q_H);
}

/* Of the table, else the mean of both axes. */
static void fill_mean(const hci_machine_data *m, double mean_H[3])
{
    mean_H[0] = mean_H[2] = mean_of_axes_H(m);
    mean_H[1] = 0.0;
    if (m->inductance_count > 0 && m->inductance->order < HCI_ORDER_TOLERANCE)
        matrix_to_plane(m->inductance->cosine, mean_H);
}

hci_status hci_voltage_model_make(const hci_machine_data *m, const hci_solve_options *o,
                                  hci_voltage_model *model, hci_note *note)
{
    *model = (hci_voltage_model){.machine = m,
                                 .effects = o->effects,
                                 .speed_rad_per_s = o->speed_rad_per_s,
                                 .temperature_C = hci_magnet_temperature_C(o),
                                 .modulation = o->limits.modulation};
    fill_mean(m, model->mean_H);
    if (!isnan(m->resistance_ohm) && (!isnan(model->mean_H[0]) || o->speed_rad_per_s == 0.0)) return HCI_OK;
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "machine.csv: the voltage needs `resistance`, `inductance_d` and `inductance_q`; add these rows "
        "or leave out --limit-voltage and --speed; --ignore-ratings leaves out a declared dc_link_voltage");
}

static void add(double factor, const double term[3], double sum[3])
{
    for (int k = 0; k < 3; ++k)
        sum[k] += factor * term[k];
}

/* The part of L that varies with the angle, from its slope L' = p dL/dθ by the table. */
static void add_integral(const hci_machine *m, double theta_rad, double l_H[3])
{
    for (size_t k = 0; k < m->slope_count; ++k) {
        const hci_inductance_slope *h = &m->slope[k];
        const double scale = h->order > HCI_ORDER_TOLERANCE ? 1.0 / (m->pole_pairs * h->order) : 0.0;
        double plane[3];
        matrix_to_plane(h->sine, plane);
        add(-scale * cos(h->order * theta_rad), plane, l_H);
        matrix_to_plane(h->cosine, plane);
        add(scale * sin(h->order * theta_rad), plane, l_H);
    }
}

/* L and L' of L_d and L_q: the d axis is (−cos θ, −sin θ). */
static void add_axes(const hci_machine_data *m, double theta_rad, double l_H[3], double slope[3])
{
    const double half_H = 0.5 * (m->inductance_d_H - m->inductance_q_H), c = cos(2.0 * theta_rad),
                 s = sin(2.0 * theta_rad);
    const double turn[3] = {c, s, -c}, change[3] = {-2.0 * s, 2.0 * c, 2.0 * s};
    add(half_H, turn, l_H);
    add(half_H * m->pole_pairs, change, slope);
}

/* ---- voltage ---- */

/* L, L' and e of the declared machine at one angle. */
typedef struct {
    double inductance_H[3], slope[3], e[2];
} magnetic;

static magnetic magnetic_at(const hci_voltage_model *v, double theta_rad)
{
    const hci_machine *m = &v->machine->model;
    const hci_machine_point p = hci_machine_at(m, theta_rad);
    magnetic x = {
        {v->mean_H[0], v->mean_H[1], v->mean_H[2]}, {p.slope[0], p.slope[1], p.slope[2]}, {p.e[0], p.e[1]}};
    if (m->slope_count > 0)
        add_integral(m, theta_rad, x.inductance_H);
    else if (v->machine->inductance_count == 0 && v->machine->inductance_d_H != v->machine->inductance_q_H)
        add_axes(v->machine, theta_rad, x.inductance_H, x.slope);
    return x;
}

/* Nothing at standstill, where inductances need not be known. */
static void add_product(double factor, const double m[3], const double x[2], double out[2])
{
    if (factor == 0.0) return;
    out[0] += factor * (m[0] * x[0] + m[1] * x[1]);
    out[1] += factor * (m[1] * x[0] + m[2] * x[1]);
}

/* What the effects add. inductance_H: out, theirs. */
static void add_effects(const hci_voltage_model *v, double theta_rad, const hci_plane_current *i,
                        double out[2], double inductance_H[3])
{
    double slope_Vs[2] = {0.0, 0.0};
    hci_effects_add_flux_slope(&v->machine->model, v->effects, v->temperature_C, theta_rad, i, slope_Vs,
                               inductance_H);
    out[0] += v->speed_rad_per_s * slope_Vs[0];
    out[1] += v->speed_rad_per_s * slope_Vs[1];
}

static bool has_effects(const hci_voltage_model *v)
{
    return v->effects && v->effects->count > 0;
}

/* inductance_H: out, that of the effects. */
static void voltage_of(const hci_voltage_model *v, const magnetic *m, double theta_rad,
                       const hci_plane_current *i, double out[2], double inductance_H[3])
{
    const double w = v->speed_rad_per_s;
    for (int k = 0; k < 2; ++k)
        out[k] = v->machine->resistance_ohm * i->x[k] + w * m->e[k];
    add_product(w, m->slope, i->x, out);
    add_product(w * v->machine->pole_pairs, m->inductance_H, i->slope, out);
    inductance_H[0] = inductance_H[1] = inductance_H[2] = 0.0;
    if (has_effects(v)) add_effects(v, theta_rad, i, out, inductance_H);
}

void hci_voltage_at(const hci_voltage_model *model, double theta_rad, const hci_plane_current *i, double v[2])
{
    const magnetic m = magnetic_at(model, theta_rad);
    double ignored_H[3];
    voltage_of(model, &m, theta_rad, i, v, ignored_H);
}

/* One column of what the effects add by the current, by the central difference. */
static void add_difference(const hci_voltage_model *model, double theta_rad, const hci_plane_current *i,
                           int coordinate, double column[2])
{
    const double size_A = DIFFERENCE_A * fmax(1.0, hypot(i->x[0], i->x[1]));
    double low[2] = {0.0, 0.0}, high[2] = {0.0, 0.0}, ignored_H[3];
    hci_plane_current moved = *i;
    moved.x[coordinate] += size_A;
    add_effects(model, theta_rad, &moved, high, ignored_H);
    moved.x[coordinate] -= 2.0 * size_A;
    add_effects(model, theta_rad, &moved, low, ignored_H);
    for (int k = 0; k < 2; ++k)
        column[k] += (high[k] - low[k]) / (2.0 * size_A);
}

void hci_voltage_linearise(const hci_voltage_model *model, double theta_rad, const hci_plane_current *i,
                           hci_linear_voltage *v)
{
    const magnetic m = magnetic_at(model, theta_rad);
    const double speed = model->speed_rad_per_s, r = model->machine->resistance_ohm,
                 speed_e = speed * model->machine->pole_pairs;
    double inductance_H[3];
    voltage_of(model, &m, theta_rad, i, v->value, inductance_H);
    for (int k = 0; k < 2; ++k) {
        const double unit[2] = {k == 0, k == 1};
        double *by_current = v->by_current + 2 * k, *by_slope = v->by_slope + 2 * k;
        by_current[0] = r * unit[0], by_current[1] = r * unit[1];
        by_slope[0] = by_slope[1] = 0.0;
        add_product(speed, m.slope, unit, by_current);
        add_product(speed_e, m.inductance_H, unit, by_slope);
        add_product(speed_e, inductance_H, unit, by_slope);
        if (has_effects(model)) add_difference(model, theta_rad, i, k, by_current);
    }
}

double hci_voltage_of_link(const hci_voltage_model *model, const double v[2], int place)
{
    double abc[3];
    hci_plane_to_abc(v, abc);
    return model->modulation == HCI_MODULATION_SINUSOIDAL ? 2.0 * abc[place]
                                                          : abc[place] - abc[(place + 1) % 3];
}

/* An amplitude A of the phases is a vector of √(3/2)·A in the plane. */
double hci_voltage_of_circle(const double v[2])
{
    return sqrt(2.0) * hypot(v[0], v[1]);
}

double hci_voltage_in_direction(const double v[2], double direction_rad)
{
    return sqrt(2.0) * (v[0] * cos(direction_rad) + v[1] * sin(direction_rad));
}
