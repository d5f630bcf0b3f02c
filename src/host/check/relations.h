/* The relations of `check`. Each is NAN where the figures do not have what it needs, whatever the view. */
#ifndef HCI_SRC_HOST_CHECK_RELATIONS_H
#define HCI_SRC_HOST_CHECK_RELATIONS_H

#include "host/check/interpreted_run.h"
#include "host/check/relation.h"

/* Tolerances are one standard deviation: of a bench 5 % (magnets 25 K warmer or colder 3 %, sensors 2 %, iron
 * 3 %), of power with what the iron takes 8 %, of a sheet's torque 8 % above what the current makes and twice
 * that below, of warm copper 20 % above and 10 % below, of counting 1 %. Caps: counting is as good as
 * certain; a measured ratio may be odd once in e⁹; ratings are written by people, once in e^6.5; plausible
 * sizes decide little. */

/* Tolerances that are also the measure of what is unknown in one recording. */
enum {
    EMF_TOLERANCE_PERCENT = 5,
    EMF_ANGLE_TOLERANCE_PERCENT = 15,
    RESISTANCE_TOLERANCE_PERCENT = 20,
    POWER_TOLERANCE_PERCENT = 8,
    TORQUE_TOLERANCE_PERCENT = 5,
    COGGING_ANGLE_TOLERANCE_PERCENT = 30
};
#define PERCENT(x) ((x) / 100.0)

/* Resistance (warm copper) and inductance (saturation) are known to a fifth. */
#define DROP_UNKNOWN 0.2

/* What a drive logs as v_d, v_q is what it has asked for: dead times and drops of its switches are not in it.
 */
#define COMMAND_UNKNOWN 0.05

/* A machine without inductances is declared to have L_d = L_q; so much of k_e may p (L_d − L_q) i_d be after
 * all. */
#define SALIENCY_UNKNOWN 0.15

extern const check_relation_list HCI_CHECK_TABLE_RELATIONS, HCI_CHECK_WAVE_RELATIONS,
    HCI_CHECK_TORQUE_RELATIONS, HCI_CHECK_PHASE_RELATIONS;

/* All of them; k from 0. */
size_t hci_check_relation_count(void);
const check_relation *hci_check_relation(size_t k);

#endif
