/* The curves of a solution, its panels and its words: what plot_solution.c puts together. */
#ifndef HCI_SRC_HOST_PLOT_SOLUTION_CURVES_H
#define HCI_SRC_HOST_PLOT_SOLUTION_CURVES_H

#include <stdbool.h>

#include "hci/host/solve/solve.h"
#include "host/plot/plot.h"

/* ---- solution_curves.c ---- */

enum {
    HCI_CURVE_BEFORE,
    HCI_CURVE_WANTED,
    HCI_CURVE_AFTER,
    HCI_CURVE_PHASE_A,
    HCI_CURVE_PHASE_B,
    HCI_CURVE_PHASE_C,
    HCI_CURVE_PLAIN_A,
    HCI_CURVES
};

/* Each of the steps of a curve has two vertices: its extremes in the order in which they come. */
enum { HCI_CURVE_COLUMNS = 360, HCI_CURVE_VERTICES = 2 * HCI_CURVE_COLUMNS };

typedef struct {
    const hci_solution *solution;
    double top_order; /* highest one that can be seen */
    double turns;     /* electrical turns drawn */
    size_t fine;      /* samples of a step */
    hci_range beside; /* of what is drawn in a picture below with the same angle; empty: nothing */
    double value[HCI_CURVES][HCI_CURVE_VERTICES + 1];
} hci_solution_curves;

/* Of as many turns as what is seen repeats after, of more than eight the first three, or as many as
 * the slowest ripple takes; or of the whole period, whose extremes are those that are
 * stated. */
void hci_solution_curves_fill(hci_solution_curves *curves, const hci_solution *solution);
void hci_solution_curves_fill_period(hci_solution_curves *curves, const hci_solution *solution);
hci_range hci_curve_range(const double *value);

/* The box of a picture over the angle, with room at its left for the numbers of any of them, so that the
 * same angle is at the same place in all. */
hci_svg_box hci_curve_box(const hci_solution_curves *curves, const hci_svg_box *box);

/* Of all curves of the torque with what is to be expected of the machine; of the phases and the plain sine;
 * of i_d and i_q, and those of the plain sine. */
hci_range hci_curve_torque_range(const hci_solution_curves *curves);
hci_range hci_curve_current_range(const hci_solution_curves *curves);
hci_range hci_curve_dq_range(const hci_solution_curves *curves);

/* Grid lines of an upright axis at most. */
#define HCI_CURVE_TICKS 6.0

/* The current vector in dq, at an angle or as sample k of count. */
hci_dq hci_curve_vector(const hci_wave *waves, size_t count, double theta_rad);
size_t hci_curve_vectors(const hci_solution_curves *curves);
hci_dq hci_curve_vector_sample(const hci_solution_curves *curves, size_t k, size_t count);
void hci_curve_vector_ranges(const hci_solution_curves *curves, hci_plot_facts *facts);

/* Of one order: its peak amplitude, |mean| at order 0; the largest of wanted, before and after; its number;
 * whether it is cared for and not reached. */
double hci_peak_Nm(hci_harmonic h);
double hci_order_largest_Nm(const hci_solved_order *order);
double hci_order_number(const hci_solved_order *order);
bool hci_order_is_missed(const hci_solved_order *order);

/* ---- the panels, each in a box ---- */

void hci_panel_torque(hci_output *out, const hci_solution_curves *curves, const hci_svg_box *box);
void hci_panel_currents(hci_output *out, const hci_solution_curves *curves, const hci_svg_box *box);
void hci_panel_dq(hci_output *out, const hci_solution_curves *curves, const hci_svg_box *box);
void hci_panel_vector(hci_output *out, const hci_solution_curves *curves, const hci_svg_box *box);
void hci_panel_spectrum(hci_output *out, const hci_solution *solution, const hci_svg_box *box);

/* Grid, numbers and title of the electrical angle. */
void hci_panel_angle(hci_output *out, const hci_solution_curves *curves, const hci_svg_axis *x,
                     const hci_svg_box *box);

/* ---- solution_words.c ---- */

void hci_solution_curve_words(const hci_solution_curves *curves, hci_plot_facts *facts);

#endif
