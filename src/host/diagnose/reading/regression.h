/* What the search regresses the torque on: a machine, and the samples of the runs in use with their noise. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_REGRESSION_H
#define HCI_SRC_HOST_DIAGNOSE_READING_REGRESSION_H

#include "hci/machine/torque.h"
#include "host/base/watch.h"
#include "host/diagnose/prepare/binned_samples.h"
#include "host/machine/saliency.h"
#include "host/numeric/noise.h"

typedef struct hci_known_equations hci_known_equations;
typedef struct hci_known_columns hci_known_columns;

/* The recordings, and what is known of them. */
typedef struct {
    const hci_machine *machine;
    const hci_effects *declared; /* those that the machine has already */
    double declared_constant;    /* torque per ampere of both, N·m/A */
    const hci_binned_samples *samples;
    const hci_run *runs;
    const bool *use;             /* of each run */
    bool raw;                    /* readings as they are, not smoothed */
    hci_noise *noise;            /* of each segment */
    double *sum_deviation_A;     /* of each run: noise of i_a + i_b + i_c; NAN where that says nothing */
    hci_known_equations *known;  /* of models linearised before; NULL: none are kept */
    hci_known_columns *columns;  /* derivatives that were predicted before; NULL: none are kept */
    hci_torque_parts *parts;     /* of each sample, as hci_effects_predict_again keeps them; NULL: none are */
    double *work;                /* multiplications so far, about, over work_times; NULL: not counted */
    double work_times;           /* as much may be taken as for a usual list; 0: once */
    bool free_means;             /* of each segment: nothing is concluded from them */
    hci_watch *watch;            /* by which the user ends it all; NULL: nobody does, or is told */
    hci_saliency_width saliency; /* what the machine's own leaves open */
} hci_regression;

/* Work that a search may take; beyond it the best model so far is kept. And what judging that may take
 * besides, behind which fits end after a few steps. */
#define HCI_MOST_WORK       8e10
#define HCI_WORK_OF_JUDGING 2.5e10

/* A list of more rows than this may take as many times as much, up to three times. */
#define HCI_USUAL_ROWS 60000.0
#define HCI_LONG_TIMES 3.0

/* The segment of a run in use that follows `after` (NULL: the first one); NULL behind the last. */
const hci_segment *hci_regression_next(const hci_regression *regression, const hci_segment *after);

/* How many runs are in use. */
size_t hci_regression_runs_in_use(const hci_regression *regression);
/* Whether the torque of any of them is inertia × acceleration, which is a slope of the speed. */
bool hci_regression_has_slopes(const hci_regression *regression);

/* Calls `visit` once for each run in use, with that run alone in use, until it returns a status other than
 * HCI_OK. HCI_ERROR_MEMORY, and what `visit` returns. */
hci_status hci_regression_each_run(hci_regression *regression,
                                   hci_status (*visit)(void *context, size_t run, hci_note *note),
                                   void *context, hci_note *note);

/* Adds the multiplications of predicting so many samples of a model, about. */
void hci_regression_count(const hci_regression *regression, size_t samples, size_t terms);

/* Adds those of so many samples through a stage of a torque sensor, with columns of derivatives beside the
 * torque. */
void hci_regression_count_filtered(const hci_regression *regression, size_t samples, size_t columns);

/* Adds multiplications of anything else. */
void hci_regression_count_products(const hci_regression *regression, double products);

/* Within how much, one standard deviation, the mean of a segment is not known beside its noise: INFINITY
 * where it says nothing and is at its best value whatever the model, a share of what was taken out of the
 * torque of a run that drifts, 0 else. */
double hci_regression_mean_unknown_Nm(const hci_regression *regression, const hci_segment *segment);

/* The noise of a segment. */
hci_noise *hci_regression_noise(const hci_regression *regression, const hci_segment *segment);

#endif
