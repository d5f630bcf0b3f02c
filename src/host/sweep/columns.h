/* Figures as columns of a table. */
#ifndef HCI_SRC_HOST_SWEEP_COLUMNS_H
#define HCI_SRC_HOST_SWEEP_COLUMNS_H

#include "hci/host/base/output.h"
#include "hci/host/sweep/sweep.h"

/* Numbers of figures: X(field, column). */
#define HCI_GRID_FIGURES(X)                                                                                  \
    X(mean_Nm, "mean_Nm")                                                                                    \
    X(T_ripple_percent, "T_ripple_percent")                                                                  \
    X(worst_Nm, "worst_error_Nm")                                                                            \
    X(worst_order, "worst_error_order")                                                                      \
    X(mean_square_A2, "mean_square_A2")                                                                      \
    X(loss_to_plain, "loss_to_plain")                                                                        \
    X(peak_A, "peak_phase_A")                                                                                \
    X(rms_A, "rms_phase_A")                                                                                  \
    X(line_V, "peak_line_V")

/* A number and what ends its cell; an empty cell where it is not known. */
void hci_grid_put(hci_output *out, double value, char end);

/* A text, in quotes where CSV needs them, and what ends its cell. */
void hci_grid_put_text(hci_output *out, const char *text, char end);

/* The names of all figures with their prefix, and `binds`, each with a comma behind it; then the cells. */
void hci_grid_put_names(hci_output *out, const char *prefix);
void hci_grid_put_figures(hci_output *out, const hci_grid_figures *figures);

#endif
