/* The same terms fitted to each motor of one make: in which it differs from what is declared of all, without
 * a search, so that motors can be compared. */
#ifndef HCI_HOST_FLEET_FIT_H
#define HCI_HOST_FLEET_FIT_H

#include "hci/host/machine/effects.h"
#include "hci/host/machine/machine.h"
#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Most parameters of a motor, and bytes of the name of one. */
enum { HCI_FLEET_MOST_PARAMETERS = 48, HCI_FLEET_PARAMETER_SIZE = 40 };

/* By how much a motor differs in one respect. */
typedef struct {
    /* As in effects.csv; equal values of three phases: what they look like. */
    char effect[HCI_FLEET_PARAMETER_SIZE];
    /* As in effects.csv; `common`: the mean of the three phases, whose own values are then without it. */
    char parameter[HCI_FLEET_PARAMETER_SIZE];
    char unit[HCI_FLEET_PARAMETER_SIZE]; /* of value and std_error */
    double value;     /* beyond what is declared, of `machine` all of it; NAN: the recordings do not tell */
    double std_error; /* by the noise alone; NAN with value */
} hci_fleet_parameter;

/* What was fitted. */
typedef struct {
    hci_fleet_parameter parameter[HCI_FLEET_MOST_PARAMETERS]; /* in the order of the effects */
    size_t count;                                             /* entries of parameter */
    double rms_before_Nm;                                     /* measured less modelled torque, as declared */
    double rms_after_Nm;                  /* and fitted; the same where nothing was found */
    size_t samples;                       /* of all runs that were fitted */
    size_t recordings, recordings_unused; /* that the list gives to be fitted; and cannot be */
    size_t rows_unused;    /* with a hole, or that repeat the one before; not those at the end of a file */
    size_t judged, beyond; /* parameters that limits were compared with; outside of them or not told */
    hci_note remark;       /* what was not used, and whether nothing was found; or "" */
    bool is_found;         /* the error has its least value, where a motor may be; else all values are NAN */
} hci_fleet_fit;

/* Fits the terms that each effect names for this, together and with equal weights, to all samples with
 * a measured torque of the runs to be fitted: Gauss–Newton steps from what is declared, halved until
 * the error falls. A term that the runs cannot tell from those before it stays as declared; so does one
 * whose standard error moves the torque by more than the rms of what stays, or is larger than the
 * values that there are, and a Coulomb friction that drives: the rest is fitted again without it. Where
 * no least error is found, or only with shares of the flux that no motor has, all values stay as declared.
 * Resistance, inductances and gains of current sensors are by voltages and sums of currents. Standard errors
 * are those of white noise, widened for noise that is correlated from sample to sample. HCI_ERROR_INPUT where
 * no run tells a torque, _NUMERIC, _MEMORY. O(samples·terms²). */
hci_status hci_fleet_fit_runs(const hci_machine_data *machine, const hci_effects *declared,
                              const hci_runs *runs, hci_fleet_fit *fit, hci_note *note);

/* Compares the values with a table of limits, columns effect, parameter, low, high, of which an empty cell is
 * no limit: line.csv of `fleet` is one. `residual`, `rms` is the error that stays. The remark names each that
 * is outside. A parameter that is not told is outside. HCI_ERROR_INPUT for an effect and parameter that a fit
 * does not have, or low above high; _MEMORY. */
hci_status hci_fleet_fit_judge(const char *limits, hci_fleet_fit *fit, hci_note *note);

/* As in summary.json of `fit`; to be freed with hci_text_free, NULL when memory is out. */
char *hci_fleet_fit_json(const hci_fleet_fit *fit);

/* Writes parameters.csv and summary.json. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_fleet_fit_write(const hci_fleet_fit *fit, const char *folder, hci_note *note);

/* Reads both from a folder; false in *is_there where it has none. HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_fleet_fit_read(const char *folder, hci_fleet_fit *fit, bool *is_there, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
