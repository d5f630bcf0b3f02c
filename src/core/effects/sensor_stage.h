/* A stage of a torque sensor, by the trapezoidal rule in parts of the steps between samples: a resonance or a
 * lag. Many columns go through one stage, or one torque through many stages, side by side. */
#ifndef HCI_SRC_CORE_EFFECTS_SENSOR_STAGE_H
#define HCI_SRC_CORE_EFFECTS_SENSOR_STAGE_H

#include "hci/effects/effect.h"

/* A resonance with omega > 0, else a lag. */
typedef struct {
    double omega, damping, tau_s;
} hci_sensor_stage;

typedef struct {
    double input, y, v; /* v = dy/dt of a resonance */
} hci_stage_state;

/* What a sample answers to: the inputs of the one before the last, of the last one, its own, the next one's.
 */
typedef struct {
    double before, from, to, after;
} hci_stage_inputs;

/* A trapezoid, which is the same for all states that make it: half its duration, what of the inputs and of
 * the state goes into the next one, and what that is divided by. */
typedef struct {
    double g, of_input, kept, divisor;
    bool swings; /* a resonance */
} hci_stage_part;

hci_stage_part hci_stage_part_of(const hci_sensor_stage *s, double step_s);
void hci_stage_go_on(const hci_stage_part *part, hci_stage_state *m, double input);

/* One trapezoid; returns y. */
double hci_stage_step(const hci_sensor_stage *s, hci_stage_state *m, double step_s, double input);

/* In how many parts a step is taken: trapezoids swing (ω step)²/12 too slowly. */
size_t hci_stage_parts(const hci_sensor_stage *s, double step_s);

/* Whether the samples around the step to sample k of n follow each other evenly. */
bool hci_stage_is_even(const double *time_s, size_t n, size_t k);

/* The input at a share of the way from the last sample: on the cubic through four samples where they follow
 * each other evenly, else on a line. A line through thirteen samples of a period is 2 % too low. */
double hci_stage_input_at(bool even, const hci_stage_inputs *x, double share);

/* Columns of a run in place: count of them beside each other from x on, rows `stride` apart. A stage is
 * settled at the first sample, and after a step back in time. */
void hci_stage_filter(const hci_sensor_stage *s, const hci_effect_run *run, double *x, size_t stride,
                      size_t count);

/* The torque of a run through each of HCI_EFFECT_SENSORS stages, all resonances or all lags:
 * y[sample][stage].
 */
void hci_stage_filter_many(const hci_sensor_stage s[HCI_EFFECT_SENSORS], const hci_effect_run *run,
                           double *y);

#endif
