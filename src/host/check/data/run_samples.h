/* From the samples of one recording to its statistics: samples are read (run_samples.c), their means taken
 * (run_means.c), also in frames that turn with the recorded angle in each way that an interpretation may ask
 * for (run_frames.c), and only these are kept (runs.c). */
#ifndef HCI_SRC_HOST_CHECK_RUN_SAMPLES_H
#define HCI_SRC_HOST_CHECK_RUN_SAMPLES_H

#include "host/check/data/data.h"
#include "host/recording/run_columns.h"

/* A wave is said to turn with the rotor when it has this share of the mean square. */
#define CHECK_COHERENT 0.6

/* Less than this share of the rated or of the largest current is no current. */
#define CHECK_NO_CURRENT 0.03

/* Samples of one file while its statistics are taken; what it does not have, or what is not compared, is
 * NULL. */
typedef struct {
    hci_run_columns columns; /* owns what follows, but for the vectors */
    size_t count;
    const double *time, *theta, *other, *speed, *d, *q, *vd, *vq; /* theta_m beside theta_e is the other */
    const double *torque;
    const double *const *phase, *const *volt; /* three columns each, as recorded */
    check_vector *current, *voltage;          /* of three phases */
    double gap_s;                             /* longer steps of the time are gaps; 0: not told */
    bool *follows;  /* of each: the sample before it is the one before it in the file; NULL: all */
    double *memory; /* of a part of the samples (run_parts.h), as are the next two */
    const double *of_phase[3], *of_volt[3];
} check_samples;

/* Reads what a check needs of a file, and says in the remark how. data: the machine's. run: out,
 * which columns it has and where they stand. *s starts from {0}; what it leaves is to be released even after
 * a failure. HCI_ERROR_INPUT, HCI_ERROR_MEMORY. */
hci_status hci_check_samples_read(const hci_csv *csv, const check_data *data, check_run *run,
                                  check_samples *s, hci_note *remark, hci_note *note);
void hci_check_samples_release(check_samples *s);

/* Means over the samples. */
void hci_check_run_means(const check_samples *s, check_run *run);

/* Mean and mean square of run->torque. */
void hci_check_run_ripple(check_run *run);

/* Means in the frames of f->scale. */
void hci_check_run_frames(const check_data *data, const check_samples *s, check_run *run);

#endif
