/* What emitted files say of the machine that they are for. */
#ifndef HCI_HOST_EMIT_EMIT_FACTS_H
#define HCI_HOST_EMIT_EMIT_FACTS_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/machine/corrections.h"
#include "hci/host/machine/machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Facts for the head of a table and its blob. Start with {{0}}, which is that nothing is known. */
typedef struct {
    char machine[HCI_MACHINE_NAME]; /* its name, one line; "": not known */
    size_t pole_pairs;              /* 0: not known */
    double mean_torque_Nm;          /* that currents of one part were solved for; 0: not known */
    double rated_speed_rad_per_s;   /* mechanical; 0: not known */
    double emf_per_kelvin;          /* relative change of the back-EMF where magnets are hot; 0: not known */
    double magnets_C;               /* temperature of the declared back-EMF; with emf_per_kelvin */
    bool angle_of_logs;             /* theta is that of the recordings, whose zero is not known to be that of
                                     * the back-EMF */
    double angle_offset_deg;        /* that theta is ahead of the electrical angle of the recordings; 0: it is
                                     * that angle, or nothing is known of them */
    char corrections[HCI_CORRECTIONS_SIZE]; /* of the sensors that the machine was recorded with; "": none */
    hci_corrections correction_values;      /* the same in numbers */
} hci_emit_facts;

/* What the folder of a machine says, as hci_machine_read has read it; mean_torque_Nm stays. HCI_ERROR_INPUT,
 * _MEMORY; *facts is then as it was. */
hci_status hci_emit_facts_read(const char *folder, const hci_machine_data *machine, hci_emit_facts *facts,
                               hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
