/* Current waves to C: a header and a source file with a table that a microcontroller reads through
 * hci/table.h. */
#ifndef HCI_HOST_EMIT_EMIT_H
#define HCI_HOST_EMIT_EMIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hci/host/base/note.h"
#include "hci/math/harmonic.h"
#include "hci/table.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A table has at most so many points and its period at most so many electrical turns. */
enum { HCI_EMIT_POINTS = 256, HCI_EMIT_MAX_POINTS = 65536, HCI_EMIT_MAX_TURNS = 4096 };

/* What goes into a table. Start with {0}; the arrays and strings belong to the caller. */
typedef struct {
    const char *name;              /* of the table, its two files and nothing else: a C identifier */
    const char *format;            /* "f32" */
    hci_table_frame frame;         /* phase currents, or rotor frame */
    bool has_neutral;              /* else a star connection: no zero sequence, ic = −ia − ib */
    const hci_wave *currents;      /* i(θ) in A, or B(θ) when there is a part proportional to torque */
    size_t current_count;          /* 0: none */
    const hci_wave *per_Nm;        /* A(θ) in A/(N·m) for i = T·A(θ) + B(θ), or NULL */
    size_t per_Nm_count;           /* not used with per_Nm NULL */
    double reference_torque_Nm;    /* > 0 with per_Nm: the largest |T| for which errors and peak are stated */
    size_t points;                 /* 0: from max_error_A, or HCI_EMIT_POINTS without that either */
    double max_error_A;            /* > 0: the fewest points that keep every current within it; else 0 */
    const char *const *provenance; /* lines for the comment, without paths and dates */
    size_t provenance_count;       /* entries of provenance */
    uint64_t input_hash;           /* 64-bit FNV-1a of what the currents were read from */
} hci_emit_request;

/* What a table has become. */
typedef struct {
    size_t points, columns, parts; /* of the table: rows, values of one part in a row, 1 or 2 parts */
    size_t period_turns;           /* electrical turns in one period */
    size_t bytes;                  /* of the rows */
    double max_error_A; /* holds at every angle for |T| <= reference_torque_Nm, single precision included */
    double peak_A;      /* largest |phase current| */
    uint32_t crc32;     /* of the rows */
} hci_emit_result;

/* Writes NAME.h and NAME.c into `folder`, both or none; same request, same bytes. result and note may be
 * NULL. HCI_ERROR_ARGUMENT, _NOT_FINITE, _MEMORY, _OUTPUT, with a note. */
hci_status hci_emit(const char *folder, const hci_emit_request *request, hci_emit_result *result,
                    hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
