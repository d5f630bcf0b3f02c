/* What the recordings of a machine leave open: uncertainty.csv, measured.csv and diagnosis.csv of a machine
 * folder. */
#ifndef HCI_HOST_MACHINE_UNCERTAINTY_H
#define HCI_HOST_MACHINE_UNCERTAINTY_H

#include "hci/host/machine/effects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Least and most of a quantity; NAN: not known. */
typedef struct {
    double least; /* in the quantity's unit */
    double most;  /* likewise */
} hci_measured_range;

/* A recording that the machine was fitted to. */
typedef struct {
    char *file;                         /* as the list of recordings names it */
    hci_measured_range id_A, iq_A;      /* true currents in the rotor frame */
    hci_measured_range speed_rad_per_s; /* mechanical */
    double misfit; /* error that the model fitted to all other recordings has here, over what is to be
                    * expected; root of the mean over the recordings: 1. NAN: the recording tells nothing */
} hci_measured_run;

/* The diagnosis that a machine comes from. */
typedef struct {
    char verdict[20];          /* in a word or two, as in its summary.json; "": it comes from none */
    char search[16];           /* how its search ended, likewise */
    double unexplained_Nm;     /* rms of the ripple in its recordings that the model does not have and that is
                                * not noise; NAN: not known */
    bool constant_is_declared; /* no recording told the torque per ampere: it is the declared one */
    double turning_load_Nm;    /* torque once or twice a turn, which a load on the shaft makes as well as the
                                * motor, and no recording tells which; 0: none */
    double sensor_zero_Nm;     /* amplitude of the torque of electrical order 1, which zeros of the current
                                * sensors     that are off make as well as the motor, likewise; 0: none */
    double left_Nm; /* ripple, peak to peak, the median over the recordings, of orders that stand out of their
                     * noise and that the model does not have; 0: none */
    double left_means_Nm; /* rms of what is left of the means of the recordings, where nothing else is
                           * unknown; 0: more is, or nothing */
} hci_machine_origin;

/* Whether it has not explained the ripple of its recordings: partly explained, unknown, or a search that
 * ended early. Not where none of them had a torque, nor where their means alone are unknown. */
bool hci_machine_origin_is_doubtful(const hci_machine_origin *origin);

/* Machines that the recordings allow as well as the one that is written down. Start with {0}: nothing is
 * known. */
typedef struct {
    hci_effects_data effects; /* all terms that could differ, with the values that are written down */
    double *departure; /* [terms][machines]: value in each of these machines less the value written down */
    size_t machines;   /* 0: nothing is known */
    hci_measured_run *run;     /* what was recorded */
    size_t runs;               /* entries of run */
    hci_machine_origin origin; /* whether or not any machine is known to be allowed */
} hci_uncertainty;

/* Room for so many runs and machines; effects are the caller's to fill in before. HCI_ERROR_MEMORY. */
hci_status hci_uncertainty_reserve(hci_uncertainty *uncertainty, size_t runs, size_t machines,
                                   hci_note *note);

/* Reads uncertainty.csv and measured.csv of a machine folder, neither there: nothing is known; and
 * diagnosis.csv where it is there. What is wrong with a file, or one of the first two alone: HCI_ERROR_INPUT.
 * HCI_ERROR_MEMORY. On failure *uncertainty is empty. */
hci_status hci_uncertainty_read_machine(const char *folder, hci_uncertainty *uncertainty, hci_note *note);

/* Writes them as the next files of a set, or takes care that those are not there of which nothing is known.
 * Departures have four digits. HCI_ERROR_OUTPUT, _MEMORY; discard the set then. */
hci_status hci_uncertainty_write(hci_output *output, const hci_uncertainty *uncertainty, hci_note *note);

/* Frees what it holds and empties it. */
void hci_uncertainty_release(hci_uncertainty *uncertainty);

/* Whether it was found for a machine with these effects: the same terms with the same values. */
bool hci_uncertainty_is_of(const hci_uncertainty *uncertainty, const hci_effects *effects);

/* What all recordings cover together. */
hci_measured_run hci_uncertainty_measured(const hci_uncertainty *uncertainty);

#ifdef __cplusplus
}
#endif

#endif
