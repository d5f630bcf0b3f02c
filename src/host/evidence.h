/* How well a machine with effects describes recordings: weighted residuals, normal equations, and the fit. */
#ifndef HCI_SRC_HOST_EVIDENCE_H
#define HCI_SRC_HOST_EVIDENCE_H

#include "cells.h"
#include "noise.h"
#include "normal.h"
#include "suspects.h"

typedef struct {
    const hci_machine *machine;
    const hci_effects *declared; /* those that the machine has already */
    const hci_cells *cells;
    const hci_run *runs;
    const bool *use;         /* of each run */
    bool raw;                /* readings as they are, not smoothed */
    hci_noise *noise;        /* of each stretch */
    double *sum_deviation_A; /* of each run: noise of i_a + i_b + i_c; NAN where that says nothing */
} hci_evidence;

/* The effects of suspects that are in (or of all), on top of the declared ones. Release with
 * hci_model_release. */
typedef struct {
    hci_effects list;
    hci_effect *effect;
    hci_effect_term *term;
    size_t *column; /* of each term of the suspects, in their order: its place in the list */
    size_t columns; /* how many terms the suspects have */
} hci_model;

hci_status hci_model_make(const hci_effects *declared, const hci_suspects *suspects, bool all,
                          hci_model *model, hci_note *note);
void hci_model_release(hci_model *model);

/* Measured less modelled torque of each cell of the runs in use, others 0: residual_Nm[cells]. */
hci_status hci_evidence_residual(const hci_evidence *evidence, const hci_effects *effects,
                                 double *residual_Nm, hci_note *note);

/* Normal equations with a column for each term of the suspects that are in (or of all of them), at their
 * present values. */
hci_status hci_evidence_normal(const hci_evidence *evidence, const hci_suspects *suspects, bool all,
                               hci_normal *normal, hci_note *note);

typedef struct {
    double square;     /* χ² at the solution */
    size_t parameters; /* terms that are in */
    double score;      /* χ² + parameters·ln(samples) + prices: the smaller the better */
    double rows;
} hci_fit;

/* Values of the suspects that are in, by Gauss–Newton steps that are shortened where they would not do. Sets
 * their standard errors too. HCI_ERROR_MEMORY. */
hci_status hci_evidence_fit(const hci_evidence *evidence, hci_suspects *suspects, hci_fit *fit,
                            hci_note *note);

/* Raises the standard errors of the suspects that are in where the residual is more correlated than the model of the
 * noise has it: from the scatter of sums over blocks of the recordings. Nothing happens with few recordings.
 * HCI_ERROR_MEMORY. */
hci_status hci_evidence_errors(const hci_evidence *evidence, hci_suspects *suspects, hci_note *note);

/* Looks for a resonance of the torque sensor over a grid of frequencies: natural_frequency_Hz and damping
 * where χ² falls most, and by how much; 0 where no grid point helps. residual_Nm: of the model without one.
 * O(cells) for each of some hundred grid points. HCI_ERROR_MEMORY. */
hci_status hci_evidence_resonance(const hci_evidence *evidence, const double *residual_Nm,
                                  double *natural_frequency_Hz, double *damping, double *gain,
                                  hci_note *note);

/* The price of a suspect's coming in: of its parameters and of the choice. */
double hci_suspect_cost(const hci_suspect *suspect, double rows);

#endif
