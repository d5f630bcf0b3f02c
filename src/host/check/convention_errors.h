/* The slips of convention that are looked for. */
#ifndef HCI_SRC_HOST_CHECK_CONVENTION_ERRORS_H
#define HCI_SRC_HOST_CHECK_CONVENTION_ERRORS_H

#include "host/check/interpretation.h"

enum {
    AT_POLES,
    AT_EMF,
    AT_EMF_SIGN,
    AT_EMF_ORDER,
    AT_COGGING_ORDER,
    AT_PHASE,
    AT_EMF_PHASE,
    AT_COGGING_PHASE,
    AT_ZERO,
    AT_RATED_CURRENT,
    AT_RESISTANCE,
    AT_SLOPE,
    AT_THETA_M,
    AT_THETA_E,
    AT_THETA,
    AT_PHASES,
    AT_ABC,
    AT_DQ,
    AT_DRIVE,
    AT_CURRENT,
    AT_VOLTAGE,
    AT_PHASE_VOLTAGE,
    AT_TORQUE,
    AT_SPEED,
    AT_SPEED_M,
    AT_TIME
};

enum {
    OF_POLES,
    OF_EMF,
    OF_EMF_SIGN,
    OF_EMF_ORDER,
    OF_COGGING_ORDER,
    OF_PHASE,
    OF_ZERO,
    OF_RATED_CURRENT,
    OF_RESISTANCE,
    OF_SLOPE,
    OF_THETA,
    OF_THETA_UNIT,
    OF_DIRECTION,
    OF_RUN_ZERO,
    OF_PHASES,
    OF_CURRENT,
    OF_CURRENT_SIGN,
    OF_VOLTAGE,
    OF_VOLTAGE_SIGN,
    OF_TORQUE,
    OF_TORQUE_UNIT,
    OF_SPEED,
    OF_TIME
};

/* One way to read one thing. */
typedef struct {
    const char *slip;
    int aspect; /* of choices with the same aspect at most one is taken */
    double prior;
    size_t field; /* offset in check_view: field = field × times + plus */
    double times, plus;
    int where;
    const char *words;
    const char *should_be; /* with %s for the number that should stand there */
    const char *told_by;   /* what would tell this slip from its like */
} check_choice;

extern const check_choice HCI_CHECK_CHOICES[];
extern const size_t HCI_CHECK_CHOICE_COUNT;

/* Whether the files have what a choice is about. */
bool hci_check_choice_applies(const check_choice *choice, const check_figures *f);

double hci_check_choice_prior(const check_choice *choice, const check_figures *f);

void hci_check_view_take(check_view *view, const check_choice *choice);

/* Where a choice points to, what stands there and what should. */
void hci_check_choice_locate(const check_choice *choice, const check_figures *f, const check_view *view,
                             hci_check_finding *finding);

#endif
