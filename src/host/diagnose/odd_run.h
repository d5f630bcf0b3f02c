/* One recording that disagrees with all others: swapped phases, another index, unit or sign in its file.
 *
 * In: a machine, and runs. Out: the run without which the machine describes all of them to their noise, and
 * what would make that run agree. A run that alone shows something is none: the others have to tell its
 * state, or a slip of one file has to bring it down to its noise. */
#ifndef HCI_SRC_HOST_DIAGNOSE_ODD_RUN_H
#define HCI_SRC_HOST_DIAGNOSE_ODD_RUN_H

#include "hci/host/diagnose/diagnose.h"
#include "host/diagnose/fit/dataset.h"

/* Whether there are enough runs for one of them to disagree with the others. */
bool hci_odd_run_is_asked(const hci_runs *runs);

/* Looks for it among so many. certain: all others are at their noise; else the run only stands out, and is to
 * be looked for again with the machine that the others give, and its slip is looked for then. odd->file is
 * NULL where there is none; it belongs to runs. dataset: of these runs and effects; it is left as it was but
 * for the noise, which is not known then. HCI_ERROR_MEMORY. O(samples of the dataset), and of the run that
 * stands out some hundred times its own. */
hci_status hci_odd_run_find(const hci_machine_data *machine, hci_dataset *dataset, const hci_runs *runs,
                            hci_odd_run *odd, bool *certain, hci_note *note);

/* Whether the mean currents of a run lie outside of those of the others, taken as alike for both signs of
 * i_q: iron that saturates is not told there by them. dataset: of all runs. O(runs). */
bool hci_odd_run_is_beyond(const hci_dataset *dataset, const hci_runs *runs, const char *file);

/* Runs that are tried, where the means of all are not explained: if the others are without either of two, it
 * is none of them. */
enum { HCI_ODD_MEANS = 2 };

/* Those without which a zero, a friction and a torque of the current come nearest to the mean errors of the
 * others, best first. d: of all runs. file: out, belong to runs. Returns their number; 0 where there are too
 * few or none makes much of a difference. O(runs²). */
size_t hci_odd_means_rank(const hci_dataset *dataset, const hci_runs *runs, const hci_diagnosis *d,
                          const char *file[HCI_ODD_MEANS]);

/* Of a run without which one machine explains all others: whether it is off from that by a constant alone,
 * that stands out of its error, and at a speed that no other has drives; then odd->file is set. dataset: of
 * all runs. HCI_ERROR_MEMORY. O(samples of the run). */
hci_status hci_odd_mean_judge(const hci_machine_data *machine, const hci_dataset *dataset,
                              const hci_runs *runs, const char *file, const hci_diagnosis *others,
                              hci_odd_run *odd, hci_note *note);

/* The run that was listed last, of those to be fitted that tell a torque and no voltages without a current,
 * which is what the others are held against, and whose state the others tell, the sign of its load too:
 * without the only one of its kind they would be explained by what it denies. And the one of them whose error
 * is most beside its noise, if that is another one. d: of all runs. file: out, belong to runs. Returns their
 * number. O(runs²). */
size_t hci_odd_aside_pick(const hci_machine *machine, const hci_dataset *dataset, const hci_runs *runs,
                          const hci_diagnosis *d, const char *file[HCI_ODD_MEANS]);

/* Of a run without which one machine explains all others: odd is set to how far that machine is from it.
 * HCI_ERROR_MEMORY. O(samples of the run). */
hci_status hci_odd_aside_judge(const hci_machine_data *machine, const hci_dataset *dataset,
                               const hci_runs *runs, const char *file, const hci_diagnosis *others,
                               hci_odd_run *odd, hci_note *note);

/* A run that stands out, by itself. Start with {0}; it must not be moved. */
typedef struct {
    hci_dataset dataset;
    hci_run run;
    hci_role role;
    hci_candidates shown; /* what the others showed when it was asked last */
    double work;          /* that this took */
    bool untold;          /* what they show does not hold in its state */
} hci_suspect;

/* file: of one of the runs. On failure *suspect is empty. HCI_ERROR_MEMORY. O(samples of the run). */
hci_status hci_suspect_make(const hci_machine_data *machine, const hci_effects *effects, const hci_runs *runs,
                            const char *file, hci_suspect *suspect, hci_note *note);

/* Tries effects on it that the other runs show: HCI_ERROR_STOPPED, without a note, where its error with them
 * is not far above its noise any more, so that it is none that disagrees, or half as large again as without
 * them, so that they do not tell its state. HCI_ERROR_MEMORY. O(samples of the run). */
hci_status hci_suspect_ask(hci_suspect *suspect, const hci_effects *effects, hci_note *note);
void hci_suspect_release(hci_suspect *suspect);

#endif
