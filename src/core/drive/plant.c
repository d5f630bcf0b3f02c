#include "hci/drive/plant.h"

#include <math.h>

#include "core/drive/plant_table.h"

/* What is held over a step, or over the part of one in which friction has one direction. */
typedef struct {
    const hci_plant *plant;
    double v[2], load_Nm;
    bool imposed;           /* the current is held instead of the voltage */
    double inverse_inertia; /* 0 at rest under stiction, where nothing accelerates */
    double friction_Nm;     /* T_c with the sign of ω */
} motion;

typedef struct {
    double i[2], speed, angle;
} rates;

static inline void point_of(const hci_plant *plant, const hci_plant_state *y, hci_plant_point *p)
{
    hci_plant_table_point(&plant->table, y->theta_m_rad, p);
    for (size_t k = 0; k < plant->effect_count; ++k)
        plant->effects[k].apply(plant->effects[k].context, y, p);
}

/* L di/dt = v − R i − ω (e + L'i) by Cramer's rule, J dω/dt = T − …; returns T. */
static inline double differentiate(const motion *m, const hci_plant_state *y, rates *rate)
{
    hci_plant_point p;
    point_of(m->plant, y, &p);
    const double *l = p.inductance_H, *h = p.magnetic.slope, *e = p.magnetic.e, *i = y->i;
    const double hi[2] = {h[0] * i[0] + h[1] * i[1], h[1] * i[0] + h[2] * i[1]};
    const double torque = (e[0] + 0.5 * hi[0]) * i[0] + (e[1] + 0.5 * hi[1]) * i[1] + p.magnetic.cogging_Nm;
    rate->i[0] = rate->i[1] = 0.0;
    if (!m->imposed) {
        const double r = m->plant->resistance_ohm, inverse = 1.0 / (l[0] * l[2] - l[1] * l[1]);
        const double a = m->v[0] - r * i[0] - y->speed_rad_per_s * (e[0] + hi[0]);
        const double b = m->v[1] - r * i[1] - y->speed_rad_per_s * (e[1] + hi[1]);
        rate->i[0] = (l[2] * a - l[1] * b) * inverse;
        rate->i[1] = (l[0] * b - l[1] * a) * inverse;
    }
    rate->speed =
        (torque - m->load_Nm - p.shaft_Nm - m->plant->viscous_Nms * y->speed_rad_per_s - m->friction_Nm) *
        m->inverse_inertia;
    rate->angle = y->speed_rad_per_s;
    return torque;
}

static inline void move(const hci_plant_state *from, const rates *k, double h, hci_plant_state *to)
{
    to->i[0] = from->i[0] + h * k->i[0];
    to->i[1] = from->i[1] + h * k->i[1];
    to->speed_rad_per_s = from->speed_rad_per_s + h * k->speed;
    to->theta_m_rad = from->theta_m_rad + h * k->angle;
    to->turns = from->turns;
}

/* The classical fourth-order method. Returns the torque at the start. */
static double runge_kutta(const motion *m, const hci_plant_state *from, double h, hci_plant_state *to)
{
    rates k1, k2, k3, k4, mean;
    hci_plant_state y;
    const double torque = differentiate(m, from, &k1);
    move(from, &k1, 0.5 * h, &y);
    differentiate(m, &y, &k2);
    move(from, &k2, 0.5 * h, &y);
    differentiate(m, &y, &k3);
    move(from, &k3, h, &y);
    differentiate(m, &y, &k4);
    mean.i[0] = k1.i[0] + 2.0 * (k2.i[0] + k3.i[0]) + k4.i[0];
    mean.i[1] = k1.i[1] + 2.0 * (k2.i[1] + k3.i[1]) + k4.i[1];
    mean.speed = k1.speed + 2.0 * (k2.speed + k3.speed) + k4.speed;
    mean.angle = k1.angle + 2.0 * (k2.angle + k3.angle) + k4.angle;
    move(from, &mean, h / 6.0, to);
    return torque;
}

/* ---- Coulomb friction ---- */

/* Sets friction for the motion that follows from a state; returns its direction, 0 for a rotor that stays at
 * rest. */
static int set_friction(motion *m, const hci_plant_state *state, bool may_start)
{
    const hci_plant *plant = m->plant;
    double drive = state->speed_rad_per_s;
    if (drive == 0.0 && may_start) {
        const hci_plant_point p = hci_plant_at(plant, state);
        const double net = hci_point_torque_Nm(&p.magnetic, state->i) - m->load_Nm - p.shaft_Nm;
        drive = fabs(net) > plant->coulomb_Nm ? net : 0.0;
    }
    const int direction = (drive > 0.0) - (drive < 0.0);
    m->friction_Nm = direction * plant->coulomb_Nm;
    m->inverse_inertia = direction == 0 ? 0.0 : 1.0 / plant->inertia_kgm2;
    return direction;
}

/* The time in (0, high) at which a moving rotor comes to rest, by the Illinois method on the speed at the end
 * of a Runge-Kutta step; to: out, the state there. */
static double time_of_rest(const motion *m, const hci_plant_state *from, double high, double speed_high,
                           hci_plant_state *to)
{
    double low = 0.0, speed_low = from->speed_rad_per_s, t = high;
    int side = 0;
    for (int k = 0; k < 60 && high - low > 1e-15 * high; ++k) {
        t = low + (high - low) * speed_low / (speed_low - speed_high);
        runge_kutta(m, from, t, to);
        const double speed = to->speed_rad_per_s;
        if (speed == 0.0) break;
        if ((speed > 0.0) == (speed_low > 0.0)) {
            low = t;
            speed_low = speed;
            if (side == 1) speed_high *= 0.5;
            side = 1;
        } else {
            high = t;
            speed_high = speed;
            if (side == -1) speed_low *= 0.5;
            side = -1;
        }
    }
    to->speed_rad_per_s = 0.0;
    return t;
}

/* Rests within one step after which the rotor stays at rest to its end. */
enum { RESTS_MOST = 4 };

static double step_with_friction(motion *m, hci_plant_state *state, double dt_s)
{
    double torque = 0.0, left_s = dt_s;
    for (int rests = 0;; ++rests) {
        hci_plant_state next;
        int direction = set_friction(m, state, rests < RESTS_MOST);
        double start = runge_kutta(m, state, left_s, &next);
        if (state->speed_rad_per_s == 0.0 && direction * next.speed_rad_per_s < 0.0) {
            direction = set_friction(m, state, false); /* it would turn back at once */
            start = runge_kutta(m, state, left_s, &next);
        }
        if (rests == 0) torque = start;
        if (!(direction * next.speed_rad_per_s < 0.0)) {
            *state = next;
            return torque;
        }
        const hci_plant_state from = *state;
        left_s -= time_of_rest(m, &from, left_s, next.speed_rad_per_s, state);
    }
}

/* ---- steps ---- */

static void wrap(hci_plant_state *state)
{
    const double turn = 2.0 * HCI_PI;
    if (state->theta_m_rad >= 0.0 && state->theta_m_rad < turn) return;
    const double turns = floor(state->theta_m_rad / turn);
    state->turns += turns;
    state->theta_m_rad -= turns * turn;
}

static double step(motion *m, hci_plant_state *state, double dt_s)
{
    double torque;
    if (m->plant->coulomb_Nm > 0.0) {
        torque = step_with_friction(m, state, dt_s);
    } else {
        const hci_plant_state from = *state;
        torque = runge_kutta(m, &from, dt_s, state);
    }
    wrap(state);
    return torque;
}

double hci_plant_step(const hci_plant *plant, hci_plant_state *state, const double v[2], double load_Nm,
                      double dt_s)
{
    motion m = {plant, {v[0], v[1]}, load_Nm, false, 1.0 / plant->inertia_kgm2, 0.0};
    return step(&m, state, dt_s);
}

double hci_plant_step_imposed(const hci_plant *plant, hci_plant_state *state, const double i[2],
                              double load_Nm, double dt_s)
{
    motion m = {plant, {0.0, 0.0}, load_Nm, true, 1.0 / plant->inertia_kgm2, 0.0};
    state->i[0] = i[0];
    state->i[1] = i[1];
    return step(&m, state, dt_s);
}

/* ---- readings ---- */

hci_plant_point hci_plant_at(const hci_plant *plant, const hci_plant_state *state)
{
    hci_plant_point p;
    point_of(plant, state, &p);
    return p;
}

double hci_plant_torque_Nm(const hci_plant *plant, const hci_plant_state *state)
{
    const hci_plant_point p = hci_plant_at(plant, state);
    return hci_point_torque_Nm(&p.magnetic, state->i);
}

void hci_plant_emf_V(const hci_plant *plant, const hci_plant_state *state, double abc[3])
{
    const hci_plant_point p = hci_plant_at(plant, state);
    const double *e = p.magnetic.e, *h = p.magnetic.slope, *i = state->i;
    const double v[2] = {state->speed_rad_per_s * (e[0] + h[0] * i[0] + h[1] * i[1]),
                         state->speed_rad_per_s * (e[1] + h[1] * i[0] + h[2] * i[1])};
    hci_plane_to_abc(v, abc);
}

double hci_plant_angle_rad(const hci_plant_state *state)
{
    return 2.0 * HCI_PI * state->turns + state->theta_m_rad;
}
