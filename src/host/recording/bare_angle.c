#include "host/recording/bare_angle.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/csv/column.h"
#include "host/csv/table.h"
#include "host/recording/run_columns.h"

#define NEAR 0.1 /* of a ratio of speeds */

static const char *name(hci_run_column which)
{
    return hci_run_column_name(which);
}

/* The columns that tell, one after the other. */
enum { TIME, SPEED, ANGLE, COLUMNS };

/* Numbers of a column; holes are NAN. */
static bool read(const hci_csv *csv, const char *column, double *values)
{
    hci_csv_hole hole = {0};
    hci_note unused = {{0}};
    return hci_csv_numbers_or_nan(csv, column, values, &hole, &unused) == HCI_OK;
}

/* How often the angle turns while the shaft turns once: of steps of less than a quarter of a turn, 0 where
 * there are none. full: a turn in the numbers of the angle. */
static double ratio_of(const double *x, size_t n, double full)
{
    double turned = 0.0, driven = 0.0;
    for (size_t k = 1; k < n; ++k) {
        const double step_s = x[TIME * n + k] - x[TIME * n + k - 1];
        const double speed = 0.5 * fabs(x[SPEED * n + k] + x[SPEED * n + k - 1]);
        const double step = remainder(x[ANGLE * n + k] - x[ANGLE * n + k - 1], full) / full;
        if (!isfinite(step) || !isfinite(speed) || !isfinite(step_s) || step_s < 0.0) continue;
        turned += 2.0 * HCI_PI * step * ((x[SPEED * n + k] > 0.0) - (x[SPEED * n + k] < 0.0));
        driven += speed * step_s;
    }
    return driven > 0.0 ? fabs(turned) / driven : 0.0;
}

static bool is_near(double ratio, double wanted)
{
    return fabs(ratio - wanted) < NEAR * wanted;
}

/* Of an angle in turns of `full`. */
static bool decide(double ratio, int pole_pairs, hci_run_column *which)
{
    const double whole = pole_pairs > 0 ? pole_pairs : fmax(2.0, round(ratio));
    const bool is_mechanical = is_near(ratio, 1.0), is_electrical = is_near(ratio, whole);
    *which = is_mechanical ? HCI_RUN_THETA_M : HCI_RUN_THETA_E;
    return is_mechanical || is_electrical;
}

static hci_status give(hci_csv *csv, size_t column, hci_run_column which, bool in_degrees, hci_note *note)
{
    char quoted[HCI_QUOTE_SIZE];
    const bool is_mechanical = which == HCI_RUN_THETA_M;
    hci_note_set(&csv->decided, HCI_OK, "%s is the %s angle%s: it turns %s the speed says",
                 hci_quote(hci_csv_name(csv, column), quoted), is_mechanical ? "mechanical" : "electrical",
                 in_degrees ? ", in degrees" : "",
                 is_mechanical ? "as fast as" : "by the pole pairs faster than");
    const char *as =
        is_mechanical ? (in_degrees ? "theta_m_deg" : "theta_m") : (in_degrees ? "theta_e_deg" : "theta_e");
    return hci_csv_give(csv, as, column, note);
}

static hci_status compare(hci_csv *csv, size_t column, int pole_pairs, double *x, hci_note *note)
{
    const size_t n = hci_csv_rows(csv);
    hci_run_column which;
    if (!read(csv, name(HCI_RUN_TIME), x + TIME * n) || !read(csv, name(HCI_RUN_SPEED), x + SPEED * n))
        return HCI_OK;
    hci_status status = hci_csv_give(csv, "theta_m", column, note); /* in the unit of the file */
    const bool is_read = !status && read(csv, name(HCI_RUN_THETA_M), x + ANGLE * n);
    if (!status) --csv->given_count;
    if (status || !is_read) return status;
    if (decide(ratio_of(x, n, 2.0 * HCI_PI), pole_pairs, &which))
        return give(csv, column, which, false, note);
    if (hci_column_unit(csv, column) == NULL && decide(ratio_of(x, n, 360.0), pole_pairs, &which))
        return give(csv, column, which, true, note);
    return HCI_OK;
}

hci_status hci_bare_angle_decide(hci_csv *csv, int pole_pairs, hci_note *note)
{
    size_t column;
    const size_t n = hci_csv_rows(csv);
    if (hci_csv_has(csv, name(HCI_RUN_THETA_M)) || hci_csv_has(csv, name(HCI_RUN_THETA_E))) return HCI_OK;
    if (n < 2 || !hci_csv_unclear(csv, &column)) return HCI_OK;
    if (!hci_csv_has(csv, name(HCI_RUN_TIME)) || !hci_csv_has(csv, name(HCI_RUN_SPEED))) return HCI_OK;
    double *x = hci_memory_new(COLUMNS * n, sizeof *x);
    if (x == NULL) return hci_note_memory(note, hci_csv_path(csv), "its angle");
    const hci_status status = compare(csv, column, pole_pairs, x, note);
    hci_memory_free(x);
    return status;
}
