/* What is drawn. Each function appends one <svg> element to the current file of `out`: a file of its own, or
 * part of an HTML page. No script, font or other reference; same input, same bytes. They allocate nothing and
 * cannot fail: write errors are kept by `out`. */
#ifndef HCI_SRC_HOST_PLOT_PLOT_H
#define HCI_SRC_HOST_PLOT_PLOT_H

#include "hci/host/base/output.h"
#include "hci/host/diagnose/diagnose.h"
#include "hci/host/simulate/speeds.h"
#include "hci/host/solve/solve.h"
#include "hci/host/waveform/waveform.h"
#include "hci/machine/frames.h"
#include "host/draw/svg.h"

/* ---- plot_solution.c: a solution ---- */

/* Torque, its spectrum, phase currents and current vector as one picture under a verdict.
 * O(samples·(orders + components)), at most 23040 samples; so are the next two. */
void hci_plot_solution(hci_output *out, const hci_solution *solution);

/* Its panels, each about the box of its axes; solution: an hci_solution. */
void hci_plot_solution_torque(hci_output *out, const hci_svg_box *box, const void *solution);
void hci_plot_solution_spectrum(hci_output *out, const hci_svg_box *box, const void *solution);
void hci_plot_solution_currents(hci_output *out, const hci_svg_box *box, const void *solution);
void hci_plot_solution_dq(hci_output *out, const hci_svg_box *box, const void *solution);

enum { HCI_PLOT_LINE_SIZE = 512 };

/* Height of the band about the curve after in which 19 of 20 machines that the recordings allow have their
 * torque, its mean apart, in N·m, as it is said; 0: not known. */
double hci_plot_expected_Nm(const hci_solution *solution);

/* The words of the picture, and the extremes of its curves. */
typedef struct {
    char verdict[HCI_PLOT_LINE_SIZE], facts[HCI_PLOT_LINE_SIZE], baseline[HCI_PLOT_LINE_SIZE];
    hci_range before_Nm, wanted_Nm, after_Nm, phase_A[3], d_A, q_A;
    hci_dq plain_dq_A; /* of the plain sine */
} hci_plot_facts;

void hci_plot_solution_facts(const hci_solution *solution, hci_plot_facts *facts);

/* What the curves are at one electrical angle. */
typedef struct {
    double before_Nm, wanted_Nm, after_Nm;
    double plain_A; /* phase a before */
    double phase_A[3];
    hci_dq dq_A;
} hci_plot_point;

void hci_plot_solution_point(const hci_solution *solution, double theta_rad, hci_plot_point *point);

/* ---- plot_waveform.c ---- */

/* A measured waveform as a picture with a style sheet of its own: over a turn, and by order.
 * O(points·orders). */
void hci_plot_waveform(hci_output *out, const hci_waveform *waveform);

/* ---- plot_tuning.c ---- */

/* A log over its time, angle or speed above, and torque, current or voltage below; log: an hci_run of which
 * hci_plot_log_can. O(samples). */
void hci_plot_log(hci_output *out, const hci_svg_box *box, const void *log);
bool hci_plot_log_can(const hci_run *log);

/* What its panels show, and its extremes. */
typedef struct {
    const char *position, *signal;
    hci_range of_position, of_signal;
} hci_plot_log_facts;

void hci_plot_log_ranges(const hci_run *log, hci_plot_log_facts *facts);

/* Torque, torque without current, and i_d and i_q, in this order from above: the same angle is at the same
 * place. tuned: an hci_plot_tuned, for hci_plot_tuned_open with torques. */
typedef struct {
    const hci_solution *solution;
    const double
        *open_Nm; /* without current over the period of the solution, its ends included; NULL: none */
    size_t count; /* of them */
} hci_plot_tuned;

void hci_plot_tuned_torque(hci_output *out, const hci_svg_box *box, const void *tuned);
void hci_plot_tuned_open(hci_output *out, const hci_svg_box *box, const void *tuned);
void hci_plot_tuned_dq(hci_output *out, const hci_svg_box *box, const void *tuned);

/* ---- plot_speeds.c ---- */

/* Torque ripple, and voltage, over the speed; speeds: an hci_speeds. O(speeds). */
void hci_plot_speeds_ripple(hci_output *out, const hci_svg_box *box, const void *speeds);
void hci_plot_speeds_voltage(hci_output *out, const hci_svg_box *box, const void *speeds);

/* Both as a picture with a style sheet of its own. */
void hci_plot_speeds(hci_output *out, const hci_speeds *speeds);

/* ---- plot_residuals.c: numbers in rows and columns, as squares whose size tells theirs ---- */

/* Residual after by run and order, before it behind. run, order: what is shown, ascending; at most
 * HCI_PLOT_MOST_CELLS of each. */
enum { HCI_PLOT_MOST_CELLS = 24 };

typedef struct {
    const hci_diagnosis *diagnosis;
    const hci_runs *runs;
    const size_t *run;
    const double *order;
    size_t runs_shown, orders_shown;
} hci_plot_map;

void hci_plot_residuals(hci_output *out, const hci_svg_box *box, const void *map);

/* ---- largest.c, plot_orders.c ---- */

/* The `most` places k < count of the largest weights above 0, ascending; returns how many. O(count·most). */
size_t hci_plot_largest(double (*weight)(const void *context, size_t k), const void *context, size_t count,
                        size_t most, size_t *place);

/* What there is at one order; NAN for what there is not. */
typedef struct {
    double order;
    double before_Nm, after_Nm, noise_Nm; /* peak amplitude */
    size_t before_run, after_run;         /* where it comes from */
} hci_plot_order;

/* Amplitudes over the order, ascending; logarithmic over at most four decades. noise: what the legend calls
 * noise_Nm; before_Nm and noise_Nm are there of all orders or of none. */
typedef struct {
    const hci_plot_order *order;
    size_t count;
    const char *title, *noise;
    bool logarithmic;
} hci_plot_orders_data;

/* orders: an hci_plot_orders_data. */
void hci_plot_orders(hci_output *out, const hci_svg_box *box, const void *orders);

/* ---- plot_findings.c, plot_runs.c: of a diagnosis ---- */

/* rms torque that an effect alone explains; NAN where there is none. */
double hci_plot_own_Nm(const hci_diagnosis *diagnosis, const hci_finding *finding);

/* Those that explain some, and how many they are. */
size_t hci_plot_findings_shown(const hci_diagnosis *diagnosis, const hci_finding *shown[HCI_MOST_FINDINGS]);

/* The torque that each of these explains, beside the errors before and after; a row each. */
void hci_plot_findings(hci_output *out, const hci_svg_box *box, const void *diagnosis);

/* Error of the runs before and after, those held out first; at most so many of each role. */
enum { HCI_PLOT_MOST_RUNS = 40 };
size_t hci_plot_runs_rows(const hci_diagnosis *diagnosis);
void hci_plot_runs(hci_output *out, const hci_svg_box *box, const void *diagnosis);

/* "sine_18" */
enum { HCI_PLOT_NAME_SIZE = 96 };
void hci_plot_term_name(char name[HCI_PLOT_NAME_SIZE], const hci_effect *effect, size_t term);

#endif
