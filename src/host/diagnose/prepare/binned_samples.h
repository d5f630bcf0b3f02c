/* Recordings made small enough for thousands of fits.
 *
 * In: runs as they were read, of any length. Out: samples in segments that follow each other in time. Where
 * the current, the speed and the temperature are steady over three turns or more, a segment is the
 * synchronous average: the mean of all samples in each of 4096 narrow bins of the turn, of which neighbours
 * are joined where 180 for each electrical period are enough; of a short run only where all runs together
 * have many samples, and nothing but white noise is left beside the means. Not where the noise is slower than
 * a few orders of the turn, which a mean cannot tell from what repeats, but of very long runs. There and
 * elsewhere the samples stay as they are, and of a long run evenly spread parts of them. Each sample carries
 * its readings as they were and smoothed. */
#ifndef HCI_SRC_HOST_DIAGNOSE_PREPARE_BINNED_SAMPLES_H
#define HCI_SRC_HOST_DIAGNOSE_PREPARE_BINNED_SAMPLES_H

#include "hci/host/base/note.h"
#include "hci/host/recording/run.h"
#include "host/diagnose/prepare/run_statistics.h"
#include "host/diagnose/prepare/segment.h"

/* Start with {0}. */
typedef struct {
    hci_binned_sample *sample;
    size_t count;
    hci_segment *segment;
    size_t segment_count;
    hci_run_statistics *statistics; /* one for each run */
    size_t run_count;
} hci_binned_samples;

/* Runs without a torque give no samples. rated_current_A: peak of a phase; NAN: not known. HCI_ERROR_MEMORY.
 * O(samples). */
hci_status hci_binned_samples_make(const hci_machine *machine, double rated_current_A, const hci_run *runs,
                                   size_t run_count, hci_binned_samples *samples, hci_note *note);
void hci_binned_samples_release(hci_binned_samples *samples);

/* Samples of a segment that tell a torque. */
size_t hci_segment_telling(const hci_binned_samples *samples, const hci_segment *segment);

/* Samples of the longest segment, at least 1. */
size_t hci_segment_longest(const hci_binned_samples *samples);

/* The segment of a run that follows `after` (NULL: the first one); NULL behind the last. */
const hci_segment *hci_segment_next(const hci_binned_samples *samples, size_t run, const hci_segment *after);

#endif
