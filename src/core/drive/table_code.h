/* The firmware of a simulated drive: hci/loop.h in single precision, asked once a sample. */
#ifndef HCI_SRC_CORE_DRIVE_TABLE_CODE_H
#define HCI_SRC_CORE_DRIVE_TABLE_CODE_H

#include "hci/drive/control.h"
#include "hci/loop.h"

typedef struct {
    hci_loop_tables tables; /* made for the speed; loop NULL: the plain sine */
    uint32_t pole_pairs;
    uint32_t counts; /* of the encoder in a mechanical turn; 0: the angle is not in counts */
    float sine_A;    /* i_q of the plain sine */
} hci_table_code;

/* context: hci_table_code. */
void hci_table_code_at(void *context, const hci_measurement *measured, double torque_Nm,
                       hci_reference_dq *reference);

#endif
