/* The voltage that currents need at one speed: v = R i + d(L(θ) i)/dt + ω_m e(θ), and what effects add. */
#ifndef HCI_SRC_HOST_LIMIT_VOLTAGE_H
#define HCI_SRC_HOST_LIMIT_VOLTAGE_H

#include "hci/host/solve/solve.h"
#include "host/drive/effect_winding.h"

typedef struct {
    const hci_machine_data *machine;
    const hci_effects *effects; /* or NULL */
    double speed_rad_per_s, temperature_C;
    double mean_H[3]; /* the constant part of L in the orthonormal plane: αα, αβ, ββ */
    hci_modulation modulation;
} hci_voltage_model;

/* v made linear at a current: v ≈ value + by_current (x − x_0) + by_slope (x' − x'_0); matrices by columns.
 */
typedef struct {
    double value[2], by_current[4], by_slope[4];
} hci_linear_voltage;

/* HCI_ERROR_INPUT when machine.csv lacks a value that the voltage needs. machine and effects must outlive
 * *model. */
hci_status hci_voltage_model_make(const hci_machine_data *machine, const hci_solve_options *options,
                                  hci_voltage_model *model, hci_note *note);

/* The phase voltages at one angle in the plane. O(harmonics). */
void hci_voltage_at(const hci_voltage_model *model, double theta_rad, const hci_plane_current *i,
                    double v[2]);

/* The same made linear. */
void hci_voltage_linearise(const hci_voltage_model *model, double theta_rad, const hci_plane_current *i,
                           hci_linear_voltage *v);

/* What has to stay within the dc link, of phase voltages in the plane: v_a − v_b, v_b − v_c or v_c − v_a
 * (place 0, 1, 2), of which the inverter makes any by a zero sequence; without one 2 v_a, 2 v_b or 2 v_c. The
 * circle is within the hexagon of the first. */
double hci_voltage_of_link(const hci_voltage_model *model, const double v[2], int place);

/* The same of the circle: √3 times the amplitude; and what of it is in a direction of the plane. */
double hci_voltage_of_circle(const double v[2]);
double hci_voltage_in_direction(const double v[2], double direction_rad);

#endif
