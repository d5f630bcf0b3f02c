/* The simulated drive: inverter, star-connected machine and shaft, advanced by one fixed step at a time.
 *
 *     L(θ) di/dt = v − R i − ω (e(θ) + L'(θ) i)              L' = ∂L/∂θ_m = p ∂L/∂θ
 *     T          = e·i + ½ iᵀL'i + T_cog(θ)
 *     J dω/dt    = T − T_load − B ω − T_c sign(ω)             |T − T_load| <= T_c keeps a rotor at rest
 *     dθ_m/dt    = ω
 *
 * Voltages and currents are those of the orthonormal αβ plane (frames.h: hci_plane_to_abc), which is all
 * that a floating star point leaves of three phases; ω is mechanical. e, L and T_cog come from a table over
 * the angle whose cubic interpolant is differentiated for L', so that electrical and mechanical power agree
 * at every angle. */
#ifndef HCI_DRIVE_PLANT_H
#define HCI_DRIVE_PLANT_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/machine/strategy.h"
#include "hci/machine/torque.h"
#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the machine as a table ---- */

/* L(θ) = the terms + a part that is constant in the rotor frame (d on the magnet axis, q on the fundamental
 * of the back-EMF). A machine with measured L(θ) leaves d_H and q_H zero, a surface-magnet one has d_H = q_H
 * and no term. */
typedef struct {
    const hci_inductance *terms; /* order 0 included; NULL with count 0 */
    size_t count;                /* entries of terms */
    double d_H, q_H;             /* of the part that is constant in the rotor frame */
} hci_plant_inductance;

/* The machine at one angle. Effects (below) may change any of it. */
typedef struct {
    hci_machine_point magnetic; /* e in N·m/A, L' in N·m/A², T_cog in N·m: what strategy.h takes */
    double inductance_H[3];     /* L_αα, L_αβ, L_ββ */
    double shaft_Nm;            /* torque that brakes the shaft and is not the machine's: 0 before effects */
} hci_plant_point;

/* Rows of a value and a slope of e_α, e_β, T_cog, L_αα, L_αβ, L_ββ at equal steps of the angle, over `turns`
 * electrical turns. The plant and a controller may share one, or have different ones. */
typedef struct {
    const double *rows;    /* points + 1 rows of 12 values; the caller's */
    int points;            /* of the whole table */
    int pole_pairs;        /* of the machine */
    int turns;             /* electrical turns that it holds */
    bool salient;          /* false when L is the same at all angles: then L' = 0 */
    double points_per_rad; /* mechanical */
} hci_plant_table;

/* Electrical turns after which the machine repeats itself: 1, or the pole pairs when there are orders k/p; 0
 * when no whole mechanical turn will do. */
int hci_plant_table_turns(const hci_machine *machine, const hci_plant_inductance *inductance);

/* Doubles in the rows of a table of `points` points: 12 (points + 1). */
size_t hci_plant_table_size(size_t points);

/* Fills rows, out, hci_plant_table_size(points) doubles, which the table keeps. points: >= 4 for the whole
 * table; the interpolation error of an order n is (2πn·turns/points)⁴/384 of its amplitude: 1e-7 at n = 12
 * and 5e-5 at n = 60 with 1024 points a turn, and of L' some (2πn·turns/points)³/125. machine->slope is not
 * read: L' follows from the inductance. HCI_ERROR_ARGUMENT for an order that does not fit, or fewer than 4
 * points; HCI_ERROR_SINGULAR when L is not positive definite at a point; HCI_ERROR_NOT_FINITE. The table is
 * then untouched, the rows are undefined. O(points·harmonics). */
hci_status hci_plant_table_fill(const hci_machine *machine, const hci_plant_inductance *inductance,
                                size_t points, double *rows, hci_plant_table *table);

/* The machine at a mechanical angle of any size and sign. O(1); may run in an interrupt. */
hci_plant_point hci_plant_table_at(const hci_plant_table *table, double theta_m_rad);

/* ---- the plant ---- */

/* The state of machine and shaft. All zeros is a currentless rotor at rest at angle 0. */
typedef struct {
    double i[2];            /* A, αβ */
    double speed_rad_per_s; /* ω */
    double theta_m_rad;     /* 0 … 2π */
    double turns;           /* whole mechanical turns since the start, negative backwards */
} hci_plant_state;

/* One more physical effect: called with the state at every evaluation of the right-hand side (four times in a
 * step) to change the point. Added to shaft_Nm: gear mesh, drag, another friction law. Added to T_cog, or
 * scaling e: a hot magnet, an eccentric rotor. Saturation sets L to ∂ψ/∂i, chooses e so that e + L'i =
 * ∂ψ/∂θ_m, and mends T by T_cog. */
typedef struct {
    void (*apply)(const void *context, const hci_plant_state *state,
                  hci_plant_point *point); /* point: in/out */
    const void *context;                   /* first argument of apply */
} hci_plant_effect;

/* Machine and shaft of a drive. */
typedef struct {
    hci_plant_table table;           /* the machine over the angle */
    double resistance_ohm;           /* of a phase */
    double inertia_kgm2;             /* > 0; INFINITY keeps the speed, whatever the torque */
    double viscous_Nms;              /* B, N·m·s/rad */
    double coulomb_Nm;               /* T_c >= 0, moving and at rest */
    const hci_plant_effect *effects; /* NULL with count 0; applied in order */
    size_t effect_count;             /* entries of effects */
} hci_plant;

/* One step of dt_s with the voltage v (V, αβ; hci_inverter_* below) and the load torque held: classical
 * Runge-Kutta, fourth order. A rotor that comes to rest within the step is stopped at that instant (found to
 * rounding), and stays at rest or turns back, whichever the torque there asks for; Coulomb friction can so
 * neither chatter nor feed in energy. A rotor at rest that breaks away does so at the start of a step.
 * Returns the machine's torque T in N·m at the start of the step. O(1); may run in an interrupt. */
double hci_plant_step(const hci_plant *plant, hci_plant_state *state, const double v[2], double load_Nm,
                      double dt_s);

/* The same for an ideal current source: i (A, αβ) flows from now to the end of the step, and only the shaft
 * moves. */
double hci_plant_step_imposed(const hci_plant *plant, hci_plant_state *state, const double i[2],
                              double load_Nm, double dt_s);

/* The machine in a state, effects included. */
hci_plant_point hci_plant_at(const hci_plant *plant, const hci_plant_state *state);

/* T in N·m in a state. */
double hci_plant_torque_Nm(const hci_plant *plant, const hci_plant_state *state);

/* Motional voltages ω (e + L'i) of the phases without their zero sequence: the terminal voltages of an open
 * machine. */
void hci_plant_emf_V(const hci_plant *plant, const hci_plant_state *state, double abc[3]);

/* Mechanical angle from the start, unwrapped. */
double hci_plant_angle_rad(const hci_plant_state *state);

/* ---- the inverter: two levels, star point floating ---- */

/* legs: bit s set when leg s is at the positive rail. v: out, V, αβ. */
void hci_inverter_switched(double dc_link_V, unsigned legs, double v[2]);

/* What pulse-width modulation with the best zero sequence can give on average: v (V, αβ) outside the hexagon
 * of the switched voltages (largest line voltage above dc_link_V) is shortened onto its edge, direction kept.
 * Returns the factor, 1 inside. */
double hci_inverter_average(double dc_link_V, double v[2]);

/* The same where the modulation adds no zero sequence: the largest |phase voltage| is half the dc link. */
double hci_inverter_sinusoidal(double dc_link_V, double v[2]);

/* The same where the control keeps the vector in the circle within the hexagon, whatever its direction: the
 * amplitude of a phase is at most dc_link_V/√3. */
double hci_inverter_circle(double dc_link_V, double v[2]);

/* Which voltages a modulation reaches. */
typedef enum {
    HCI_MODULATION_SPACE_VECTOR, /* with the best zero sequence: line voltages up to the dc link, the hexagon
                                  */
    HCI_MODULATION_SINUSOIDAL,   /* without: phase voltages up to half the dc link */
    HCI_MODULATION_CIRCLE        /* the circle within the hexagon */
} hci_modulation;

/* That of the three which the modulation is. */
double hci_inverter_limit(hci_modulation modulation, double dc_link_V, double v[2]);

/* Dead time: while both switches of a leg are open the current chooses the rail that is against it. Over a
 * period of the PWM this is on average −voltage_V·sat(i/crossing_A) for each phase, sat(x) = x limited to
 * −1 … 1. */
typedef struct {
    double voltage_V;  /* dc link voltage · dead time / period; 0: none */
    double crossing_A; /* |i| below which the current changes its sign within a period; 0: none does */
} hci_dead_time;

/* Adds factor·voltage_V·sat(i/crossing_A) of each phase to v. i: A, v: in/out, V, αβ; factor: −1 is what the
 * inverter does, +1 what compensates it. */
void hci_inverter_dead_time(const hci_dead_time *dead_time, const double i[2], double factor, double v[2]);

#ifdef __cplusplus
}
#endif

#endif
