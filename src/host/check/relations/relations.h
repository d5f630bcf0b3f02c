/* The relations that are checked: physics that ties the numbers of the files together, such as v = R i +
 * dψ/dt or power in = power out. Each file relations_….c has the functions of one kind and, at its end, a row
 * for each; relations.c joins the rows. A value is NAN where the data do not have what it needs, and whether
 * it is does not depend on the interpretation. */
#ifndef HCI_SRC_HOST_CHECK_RELATIONS_H
#define HCI_SRC_HOST_CHECK_RELATIONS_H

#include "host/check/relations/interpreted_run.h"
#include "host/check/relations/relation.h"

/* Tolerances are one standard deviation: of a bench 5 % (magnets 25 K warmer or colder 3 %, sensors 2 %, iron
 * 3 %), of power with what the iron takes 8 %, of a sheet's torque 8 % above what the current makes and twice
 * that below, of warm copper 20 % above and 10 % below, of counting 1 %. Caps: counting is as good as
 * certain; a measured ratio may be odd once in e⁹; ratings are written by people, once in e^6.5; plausible
 * sizes decide little. */

/* Tolerances that are also the measure of what is unknown in one recording. */
#define CHECK_EMF_TOLERANCE           0.05
#define CHECK_EMF_ANGLE_TOLERANCE     0.03
#define CHECK_LOADED_ANGLE_UNKNOWN    0.15 /* rad, of a voltage beside a current, or that a drive asks for */
#define CHECK_RESISTANCE_TOLERANCE    0.20
#define CHECK_POWER_TOLERANCE         0.08
#define CHECK_TORQUE_TOLERANCE        0.05
#define CHECK_COGGING_ANGLE_TOLERANCE 0.30

/* Resistance (warm copper) and inductance (saturation) are known to a fifth. */
#define CHECK_DROP_UNKNOWN 0.2

/* What a drive logs as v_d, v_q is what it has asked for: dead times and drops of its switches are not in it.
 */
#define CHECK_COMMAND_UNKNOWN 0.05

/* By resistance: leads, switches and dead time of a drive. */
#define CHECK_SWITCHES_UNKNOWN 1.0

/* A machine without inductances is declared to have L_d = L_q; so much of k_e may p (L_d − L_q) i_d be after
 * all. */
#define CHECK_SALIENCY_UNKNOWN 0.15

/* The back-EMF in the voltages of a recording that hci_check_has_emf. */
typedef struct {
    check_vector found, expected; /* in V: by the voltages, by the table */
    double unknown;               /* of the length of what is expected */
} check_emf;

void hci_check_emf_of(const check_data *data, const check_run *r, const check_interpretation *as,
                      const check_model *m, check_emf *emf);

/* The L_q - L_d that the torques ask for beside the torque per ampere of the tables, where none is declared:
 * at small currents and at the largest i_q. share: of the largest torque of the magnets, what it makes at
 * most; 0 where one is declared or no torque is told. left_open: beside it, the standard deviation of the
 * torque per ampere. */
typedef struct {
    double small_H, large_H, share, left_open;
} check_saliency;

check_saliency hci_check_saliency(const check_data *data, const check_interpretation *as);

extern const check_relation_list HCI_CHECK_TABLE_RELATIONS, HCI_CHECK_WAVE_RELATIONS,
    HCI_CHECK_TORQUE_RELATIONS, HCI_CHECK_COGGING_RELATIONS, HCI_CHECK_PHASE_RELATIONS,
    HCI_CHECK_POLE_RELATIONS;

/* All of them, in the order in which they are reported; k from 0. At most HCI_CHECK_MOST_EVIDENCE. */
size_t hci_check_relation_count(void);
const check_relation *hci_check_relation(size_t k);

#endif
