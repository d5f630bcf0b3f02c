/* The C text of an emitted table. */
#ifndef HCI_SRC_HOST_EMIT_TEXT_H
#define HCI_SRC_HOST_EMIT_TEXT_H

#include "hci/host/base/output.h"
#include "hci/host/emit/emit.h"
#include "host/emit/tabulate.h"

enum { HCI_EMIT_PROBES = 8 };

/* All that is emitted. */
typedef struct {
    const hci_emit_request *request;
    hci_wave *waves; /* the constant ones, then those per N·m */
    float *rows;
    hci_tabulation tabulation;
    hci_table_f32_probe probes[HCI_EMIT_PROBES];
    hci_table_f32 table;
} hci_emission;

/* A number of nine significant digits as C takes it for a floating constant. */
const char *hci_emission_number(double value, char text[32]);

/* The same as a constant of single precision, and what follows it. */
void hci_emission_float(hci_output *output, float value, const char *end);

/* What goes into NAME.h and NAME.c. */
void hci_emission_write_header(const hci_emission *e, hci_output *output);
void hci_emission_write_source(const hci_emission *e, hci_output *output);

#endif
