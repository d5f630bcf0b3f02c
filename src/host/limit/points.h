/* Where over the angle currents and voltages are limited: rows of phase currents, line voltages and torque,
 * linear in the coordinates of the components, and the angles of their peaks (theory.md, section 15). */
#ifndef HCI_SRC_HOST_LIMIT_POINTS_H
#define HCI_SRC_HOST_LIMIT_POINTS_H

#include "host/limit/bounds.h"
#include "host/limit/voltage.h"
#include "host/machine/torque_gradient.h"
#include "host/solve/harmonic_system.h"

typedef enum {
    HCI_POINT_NONE,
    HCI_POINT_CURRENT,
    HCI_POINT_VOLTAGE,
    HCI_POINT_VECTOR, /* the size of the voltage vector, which has two rows: of the plane's axes */
    HCI_POINT_TORQUE
} hci_point_kind;

/* One quantity at one angle. */
typedef struct {
    hci_point_kind kind;
    int phase; /* of the current; pair of the line voltage; end of the torque's range in a program */
    double theta_rad;
    double direction_rad; /* VECTOR: that of a row alone, in the plane */
} hci_limit_point;

/* The largest size of a current or voltage. */
double hci_limit_of_point(const hci_bounds *bounds, hci_point_kind kind, int phase);

/* What makes a quantity a function of the coordinates x (S and C of each component in turn). */
typedef struct {
    const hci_component_set *set;
    const hci_wave *held;              /* or NULL */
    const hci_voltage_model *voltage;  /* or NULL */
    const hci_wave_list *at;           /* currents where the voltage is made linear; NULL: none */
    const hci_harmonic_system *system; /* of the torque; only for its points */
    double mean_Nm;                    /* at which h of the system is taken */
    size_t turns;                      /* electrical turns of a period */
} hci_limit_field;

/* The row g (2·count, out) and the constant: quantity = g·x + constant. The torque is that less what is
 * wanted, orders above 0. */
double hci_limit_row(const hci_limit_field *field, const hci_limit_point *point, double *g);

/* Rows of one angle: two of a vector, whose root of the sum of squares is the quantity, else one. g: out,
 * each row with its constant behind it. */
size_t hci_limit_parts(hci_point_kind kind);
void hci_limit_rows(const hci_limit_field *field, const hci_limit_point *point, double *g);

/* Numbers that g needs room for. */
size_t hci_limit_row_room(const hci_limit_field *field);

/* The quantity of such rows. unknowns: numbers of a row without its constant. */
double hci_limit_value(hci_point_kind kind, size_t unknowns, const double *g, const double *x);

/* Whether the voltage is not linear in the currents. */
bool hci_limit_is_bent(const hci_limit_field *field);

/* The true voltage of currents that has to stay within the dc link: a line voltage, with sinusoidal
 * modulation twice that of a phase, of a vector √3 times the amplitude. */
double hci_limit_link_V(const hci_limit_field *field, const hci_limit_point *point, const hci_wave_list *i);

/* Points with what was added last behind, and the rows of the first of them. Start with {0}. */
typedef struct {
    hci_limit_point *point;
    size_t count, room;
    double *row; /* `width` numbers a point: hci_limit_rows, with room for two */
    size_t width, rows, row_room;
} hci_limit_points;

/* Appends a point. HCI_ERROR_MEMORY, without a note. */
hci_status hci_limit_points_add(hci_limit_points *points, hci_limit_point point);

/* Makes the rows of points that have none yet. HCI_ERROR_MEMORY, without a note. */
hci_status hci_limit_points_fill(const hci_limit_field *field, hci_limit_points *points);

/* The rows of a point that were made. */
const double *hci_limit_points_row(const hci_limit_points *points, size_t k);

/* Keeps point k and its row as number `kept` <= k. */
void hci_limit_points_keep(hci_limit_points *points, size_t k, size_t kept);

/* No more than the first `count` points; their rows stay. */
void hci_limit_points_cut(hci_limit_points *points, size_t count);

/* Where what is limited was made linear anew: no point has a row any more. */
void hci_limit_points_change(hci_limit_points *points);
void hci_limit_points_release(hci_limit_points *points);

/* The rows of one quantity at angles that are evenly spaced over the period. Start with {0}. */
typedef struct {
    hci_point_kind kind;
    int phase;
    size_t samples, unknowns;
    double period_rad,
        step_rad; /* over which they are; the quantity repeats after it, or its negative does */
    double *g;    /* hci_limit_rows of each sample in turn */
    bool *is_row; /* samples: whether it is a row of the program; the caller's to set */
} hci_limit_grid;

/* kind, phase, samples and period_rad of *grid are filled already. HCI_ERROR_MEMORY, without a note. */
hci_status hci_limit_grid_make(const hci_limit_field *field, hci_limit_grid *grid);
void hci_limit_grid_release(hci_limit_grid *grid);

/* The rows of sample k. */
const double *hci_limit_grid_rows(const hci_limit_grid *grid, size_t k);

/* Takes samples out of the program that are below a share of the ends of `range`. */
void hci_limit_grid_thin(hci_limit_grid *grid, const double *x, const double range[2], double share);

/* Appends the local extremes of the quantity beyond low … high, each to the rounding of its angle. *worst:
 * out, how far the furthest is beyond, in the unit of the quantity; negative when all are within.
 * HCI_ERROR_MEMORY, without a note. O(samples · unknowns). */
hci_status hci_limit_peaks(const hci_limit_field *field, const hci_limit_grid *grid, const double *x,
                           const double range[2], hci_limit_points *points, double *worst);

/* Coordinates of component k as phase s sees it: a sine of S' and a cosine of C' of its order. turn: out,
 * S' = turn[0] S + turn[1] C, C' = turn[0] C − turn[1] S. */
void hci_limit_turn(hci_component component, int phase, double turn[2]);

#endif
