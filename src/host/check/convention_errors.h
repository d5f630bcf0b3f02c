/* The convention errors that are looked for: one row for each form of each (poles for pole pairs, rms for
 * peak,
 * ...). A row says how probable the error is before anything is compared, what it does to the interpretation
 * of the numbers, and in which words it is reported. Reports call them slips. */
#ifndef HCI_SRC_HOST_CHECK_CONVENTION_ERRORS_H
#define HCI_SRC_HOST_CHECK_CONVENTION_ERRORS_H

#include "host/check/relations/interpretation.h"

/* Where an error stands. Beginning with CHECK_AT_THETA_M: in the recordings. */
enum {
    CHECK_AT_POLES,
    CHECK_AT_EMF,
    CHECK_AT_EMF_SIGN,
    CHECK_AT_EMF_ORDER,
    CHECK_AT_COGGING_ORDER,
    CHECK_AT_PHASE,
    CHECK_AT_EMF_PHASE,
    CHECK_AT_COGGING_PHASE,
    CHECK_AT_ZERO,
    CHECK_AT_RATED_CURRENT,
    CHECK_AT_RESISTANCE,
    CHECK_AT_SLOPE,
    CHECK_AT_THETA_M,
    CHECK_AT_THETA_E,
    CHECK_AT_THETA,
    CHECK_AT_PHASES,
    CHECK_AT_CLAMPS, /* currents, where there are voltages to compare them with */
    CHECK_AT_PROBES, /* voltages, where there are currents */
    CHECK_AT_ABC,
    CHECK_AT_DQ,
    CHECK_AT_DRIVE,
    CHECK_AT_CURRENT,
    CHECK_AT_VOLTAGE,
    CHECK_AT_PHASE_VOLTAGE,
    CHECK_AT_TORQUE,
    CHECK_AT_SPEED,
    CHECK_AT_SPEED_M,
    CHECK_AT_SPEED_E,
    CHECK_AT_SPEED_SIGN,
    CHECK_AT_TIME
};

/* What an error is about. */
enum {
    CHECK_OF_POLES,
    CHECK_OF_EMF,
    CHECK_OF_EMF_SIGN,
    CHECK_OF_EMF_ORDER,
    CHECK_OF_COGGING_ORDER,
    CHECK_OF_PHASE,
    CHECK_OF_ZERO,
    CHECK_OF_RATED_CURRENT,
    CHECK_OF_RESISTANCE,
    CHECK_OF_SLOPE,
    CHECK_OF_THETA,
    CHECK_OF_THETA_UNIT,
    CHECK_OF_DIRECTION,
    CHECK_OF_RUN_ZERO,
    CHECK_OF_PHASES,
    CHECK_OF_CURRENT,
    CHECK_OF_CURRENT_UNIT,
    CHECK_OF_CURRENT_SIGN,
    CHECK_OF_VOLTAGE,
    CHECK_OF_VOLTAGE_SIGN,
    CHECK_OF_TORQUE,
    CHECK_OF_TORQUE_UNIT,
    CHECK_OF_SPEED,
    CHECK_OF_SPEED_SIGN,
    CHECK_OF_TIME
};

/* One form of a convention error. */
typedef struct {
    const char *name; /* as it is reported; forms of one error share it */
    int aspect;       /* CHECK_OF_…; of errors about the same thing at most one is supposed */
    double prior;
    size_t field; /* offset in check_interpretation: field = field × times + plus */
    double times, plus;
    int where; /* CHECK_AT_… */
    const char *words;
    const char *should_be; /* with %s for the number that should stand there */
    const char *told_by;   /* what would tell this error from its like */
} check_error;

/* The error of a zero that may be anywhere. */
#define HCI_CHECK_RUN_OFFSET "run_angle_offset"

extern const check_error HCI_CHECK_ERRORS[];
extern const size_t HCI_CHECK_ERROR_COUNT;

/* Its probability in these files before anything is compared. */
double hci_check_error_prior(const check_error *error, const check_data *data);

/* Supposes that the error was made, beside what is supposed already. */
void hci_check_error_apply(check_interpretation *as, const check_error *error);

#endif
