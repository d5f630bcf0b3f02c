/* A table on its way from waves to text. */
#ifndef HCI_SRC_HOST_EMIT_EMISSION_H
#define HCI_SRC_HOST_EMIT_EMISSION_H

#include "host/emit/spline.h"
#include "host/machine/machine_plant.h"

enum { HCI_EMIT_PROBES = 8 };

/* All that is emitted. Start with {0}. */
typedef struct {
    const hci_emit_request *request;
    const hci_machine_plant *plant; /* NULL: no machine is given */
    hci_wave *waves;                /* the constant ones, then those per N·m */
    hci_tabulation tabulation;
    hci_emit_result result;

    float *rows; /* of format f32 */
    hci_table_f32 table;
    hci_table_f32_probe probes[HCI_EMIT_PROBES];

    size_t most_bytes; /* of rows or knots; 0: any */
    bool only_whether; /* it is only asked whether a table fits */

    hci_spline_room room; /* of i16 and q15 */
    hci_table_i16 spline;
    hci_table_i16_probe spline_probes[HCI_EMIT_PROBES];
} hci_emission;

/* Looks at all shapes, chooses the one that the request asks for, and makes its table: result, and rows or
 * knots, without probes and CRC. HCI_ERROR_ARGUMENT with what there is where none fits; _MEMORY. */
hci_status hci_emission_choose(hci_emission *e, hci_note *note);

/* Frees what hci_emission_choose has made. */
void hci_emission_release(hci_emission *e);

#endif
