/* Current waves to C: a header and a source file with a table that a microcontroller reads through
 * hci/table.h or hci/table_i16.h. */
#ifndef HCI_HOST_EMIT_EMIT_H
#define HCI_HOST_EMIT_EMIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "hci/host/base/note.h"
#include "hci/host/emit/emit_facts.h"
#include "hci/math/harmonic.h"
#include "hci/table_i16.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A table has at most so many points and its period at most so many electrical turns. */
enum { HCI_EMIT_MAX_POINTS = 65536, HCI_EMIT_MAX_TURNS = 4096 };

/* The bytes of knots up to which the shape with the fewest instructions is chosen, unless the request says
 * more; beyond it, the one with the fewest bytes. */
enum { HCI_EMIT_SMALL_BYTES = 1024 };

/* Without points, error or bytes: the largest error as a share of the peak current. */
#define HCI_EMIT_ERROR_SHARE 0.01

/* The least that is chosen with a machine: what a current sensor of 12 bits over plus and minus the peak
 * still tells apart. */
#define HCI_EMIT_LEAST_ERROR_SHARE (1.0 / 4096.0)

/* The share of the ripple to be expected that a table may add to it. */
#define HCI_EMIT_RIPPLE_SHARE 0.1

/* The bytes up to which a table is held to that. */
enum { HCI_EMIT_CHOSEN_BYTES = 16384 };

/* What the numbers of a table are. */
typedef enum {
    HCI_EMIT_F32, /* float rows, hci/table.h */
    HCI_EMIT_I16, /* 16-bit knots, hci/table_i16.h, read as amperes */
    HCI_EMIT_Q15, /* the same, read as integers */
    HCI_EMIT_I8,  /* 8-bit knots, read as the integers of q15 */
    HCI_EMIT_CSV, /* the rows of f32 as NAME.csv, for other programs */
    HCI_EMIT_JSON /* the same as NAME.json */
} hci_emit_format;

/* Their words in options and files: X(format, word). */
#define HCI_EMIT_FORMAT_NAMES(X)                                                                             \
    X(HCI_EMIT_F32, "f32")                                                                                   \
    X(HCI_EMIT_I16, "i16")                                                                                   \
    X(HCI_EMIT_Q15, "q15")                                                                                   \
    X(HCI_EMIT_I8, "i8")                                                                                     \
    X(HCI_EMIT_CSV, "csv")                                                                                   \
    X(HCI_EMIT_JSON, "json")

/* Whether a format holds rows of floats, not knots of integers. */
static inline bool hci_emit_has_rows(hci_emit_format format)
{
    return format != HCI_EMIT_I16 && format != HCI_EMIT_Q15 && format != HCI_EMIT_I8;
}

/* Whether it is meant for the functions that give integers, which round to them. */
static inline bool hci_emit_is_integer(hci_emit_format format)
{
    return format == HCI_EMIT_Q15 || format == HCI_EMIT_I8;
}

/* The name of a format; a static string. */
const char *hci_emit_format_name(hci_emit_format format);

/* How a table goes from one point to the next. */
typedef enum {
    HCI_EMIT_AUTO,      /* the fewest instructions within HCI_EMIT_SMALL_BYTES, else the fewest bytes */
    HCI_EMIT_LINEAR,    /* the one shape of format f32 */
    HCI_EMIT_QUADRATIC, /* a spline of degree 2 */
    HCI_EMIT_CUBIC      /* and 3 */
} hci_emit_shape;

/* Their words in options and files: X(shape, word). */
#define HCI_EMIT_SHAPE_NAMES(X)                                                                              \
    X(HCI_EMIT_AUTO, "auto")                                                                                 \
    X(HCI_EMIT_LINEAR, "linear")                                                                             \
    X(HCI_EMIT_QUADRATIC, "quadratic")                                                                       \
    X(HCI_EMIT_CUBIC, "cubic")

/* The name of a shape; a static string. */
const char *hci_emit_shape_name(hci_emit_shape shape);

/* Whether a table may have this name; NULL: none was given. HCI_ERROR_ARGUMENT. */
hci_status hci_emit_check_name(const char *name, hci_note *note);

/* What goes into a table. Start with {0}; the arrays and strings belong to the caller. */
typedef struct {
    const char *name;           /* of the table, its two files and nothing else: a C identifier */
    hci_emit_format format;     /* of its numbers */
    hci_emit_shape shape;       /* of its pieces; f32: auto or linear */
    hci_table_frame frame;      /* phase currents, or rotor frame */
    bool has_neutral;           /* else a star connection: no zero sequence, ic = −ia − ib */
    const hci_wave *currents;   /* i(θ) in A, or B(θ) when there is a part proportional to torque */
    size_t current_count;       /* 0: none */
    const hci_wave *per_Nm;     /* A(θ) in A/(N·m) for i = T·A(θ) + B(θ), or NULL */
    size_t per_Nm_count;        /* not used with per_Nm NULL */
    double reference_torque_Nm; /* > 0 with per_Nm: the largest |T| for which errors and peak are stated */
    size_t points;              /* f32: rows in a period; else steps in the part that is kept; 0: from
                                 * max_error_A, or without that and max_bytes chosen, see below */
    double max_error_A;         /* > 0: the fewest points that keep every current within it; else 0 */
    size_t max_bytes;           /* of rows or knots; 0: any. Alone, it gives the least error in so many */
    size_t max_instructions;    /* of one call on a Cortex-M4F; 0: any */
    const hci_machine_data *machine; /* that the currents flow in, or NULL: the ripple is not told */
    const char *machine_folder;      /* of it; its effects.csv is read too */
    double expected_ripple_Nm;       /* to be expected of the currents on the machine, peak to peak; 0: not
                                      * known */
    hci_emit_facts facts;            /* for the header and the blob */
    bool blob;                       /* NAME.bin too, for hci/blob.h; not of csv and json */
    const char *const *provenance;   /* lines for the comment, without paths and dates */
    size_t provenance_count;         /* entries of provenance */
    uint64_t input_hash;             /* 64-bit FNV-1a of what the currents were read from */
} hci_emit_request;

/* A table as it could be. */
typedef struct {
    hci_emit_format format;  /* of its numbers */
    hci_emit_shape shape;    /* not auto */
    bool fits;               /* what was asked for: error, bytes, instructions */
    size_t points;           /* as in the request */
    size_t bytes;            /* of rows or knots */
    double max_error_A;      /* holds at every angle for |T| <= reference_torque_Nm, rounding included */
    unsigned cortex_m4f;     /* instructions of one call there, about; measured with -O2 */
    unsigned cortex_m0_plus; /* and there */
} hci_emit_choice;

/* One of format f32, three of splines with knots of 16 bits and three with knots of 8. */
enum { HCI_EMIT_MOST_CHOICES = 7 };

/* Ripple at one torque, peak to peak over a mechanical turn, in the model of the machine. */
typedef struct {
    double torque_Nm; /* mean */
    double sine_Nm;   /* with a plain sine of current of that mean torque */
    double with_Nm;   /* with the table, as a controller reads it */
    double own_Nm;    /* of the torque with the table less that of the currents it was made from */
} hci_table_ripple;

/* Torques at which the ripple is told. */
enum { HCI_TABLE_RIPPLES = 3 };

/* What a table has become. */
typedef struct {
    hci_emit_choice chosen;                        /* what was written */
    hci_emit_choice choice[HCI_EMIT_MOST_CHOICES]; /* what was looked at, with chosen among it */
    size_t choices;                                /* entries of choice */
    size_t columns, parts;                         /* values of one part in a row, 1 or 2 parts */
    size_t period_turns;                           /* electrical turns in one period */
    size_t sectors;                                /* of the period, of which one is kept; f32: 1 */
    double unit_A;                                 /* of the integers; NAN for f32 */
    double peak_A;                                 /* largest |phase current| */
    uint32_t crc32;                                /* of the rows or knots */
    hci_table_ripple ripple[HCI_TABLE_RIPPLES];    /* that of the currents; of two parts at 0, T and −T */
    size_t ripples;                                /* entries of ripple; 0: no machine is given */
} hci_emit_result;

/* Without points, error and bytes, and with a machine, the error is chosen: what makes no more than
 * HCI_EMIT_RIPPLE_SHARE of the expected ripple, between HCI_EMIT_LEAST_ERROR_SHARE (also where that ripple is
 * not known) and HCI_EMIT_ERROR_SHARE of the peak current, and twice, four times … that where
 * HCI_EMIT_CHOSEN_BYTES or the format do not allow it. */

/* Writes NAME.h and NAME.c, and NAME.bin where asked for, or NAME.csv or NAME.json alone, into `folder`, all
 * or none; same request, same bytes. result and note may be NULL. HCI_ERROR_ARGUMENT, _NOT_FINITE, _MEMORY,
 * _OUTPUT, with a note. */
hci_status hci_emit(const char *folder, const hci_emit_request *request, hci_emit_result *result,
                    hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
