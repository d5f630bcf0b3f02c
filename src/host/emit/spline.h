/* From current waves to the knots of a small table: which knots, how far the table is off, and the fewest. */
#ifndef HCI_SRC_HOST_EMIT_SPLINE_H
#define HCI_SRC_HOST_EMIT_SPLINE_H

#include "hci/table_i16.h"
#include "host/emit/symmetry.h"

/* Room for the knots of any table. */
enum { HCI_SPLINE_MOST_VALUES = ((int)HCI_TABLE_I16_MOST_INTERVALS + 3) * 6 };

/* Where a table is made. */
typedef struct {
    const hci_tabulation *waves;
    hci_symmetry symmetry;
    int16_t *knots;     /* [HCI_SPLINE_MOST_VALUES] */
    double *knots_A;    /* the same in A */
    int8_t *knots_i8;   /* [HCI_SPLINE_MOST_VALUES], or NULL where they are not used */
    uint32_t knot_bits; /* 16 or 8: which are made */
} hci_spline_room;

/* Makes the table of a degree (1, 2, 3) and so many intervals: knots, unit, errors, peak; all but its probes
 * and CRC. The knots are those of room, until the next call. */
void hci_spline_make(const hci_spline_room *room, uint32_t degree, uint32_t intervals, hci_table_i16 *table);

/* The same with the fewest intervals whose error, that of the integer functions where `integer`, is at most
 * max_error_A: one interval less would not do; with knots of 8 bits one of those tried.
 * False where no table keeps it; *table is then that of the most intervals. */
bool hci_spline_make_within(const hci_spline_room *room, uint32_t degree, double max_error_A, bool integer,
                            hci_table_i16 *table);

/* The same with knots of 8 bits, whose rounding makes the error go up and down with their number: the first
 * of some from `first` on, which is best what 16 bits need, to twice that. */
bool hci_spline_make_i8_within(const hci_spline_room *room, uint32_t degree, uint32_t first,
                               double max_error_A, hci_table_i16 *table);

#endif
