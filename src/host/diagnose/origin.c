#include "host/diagnose/origin.h"

#include <math.h>
#include <stdio.h>

#include "hci/host/waveform/turning_load.h"
#include "host/base/memory.h"
#include "host/numeric/statistics.h"
#include "host/waveform/sensor_zero.h"

/* Over all recordings, of a ripple beside the mean of each. */
static double unexplained_ripple_Nm(const hci_diagnosis *d)
{
    double sum = 0.0, count = 0.0;
    for (size_t k = 0; k < d->runs; ++k) {
        const hci_run_errors *e = &d->run[k];
        const double square = e->ripple_after_Nm * e->ripple_after_Nm - e->noise_floor_Nm * e->noise_floor_Nm;
        if (!isfinite(square)) continue;
        sum += fmax(0.0, square);
        count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : (double)NAN;
}

#define STANDS_OUT 2.0 /* of what noise exceeds once in twenty times: it does once in 160 000 times */

/* Of the sum of many waves with phases by chance, peak to peak, to the root of the sum of their squares: 1.85
 * for 15 and 1.94 for 30 of them on the average. */
#define BY_CHANCE 1.9

/* The ripple, peak to peak, that repeats with the turn in a recording and is not in the model: what was
 * decisive and not taken, and what no effect describes. */
static double left_of_run_Nm(const hci_diagnosis *d, size_t run)
{
    double sum = 0.0, square = 0.0;
    for (size_t k = 0; k < d->lines; ++k) {
        const hci_residual_line *l = &d->line[k];
        if (l->run != run || l->order <= HCI_ORDER_TOLERANCE || l->after_Nm <= STANDS_OUT * l->noise_Nm)
            continue;
        sum += 2.0 * l->after_Nm;
        square += 4.0 * l->after_Nm * l->after_Nm;
    }
    return fmin(sum, BY_CHANCE * sqrt(square));
}

/* The median over the recordings: of one alone, as of the largest current, most currents have less. */
static hci_status left_orders_find(const hci_diagnosis *d, double *left_Nm, hci_note *note)
{
    const size_t runs = d->runs + (d->odd.file != NULL); /* one that disagrees keeps its number */
    double *of_run = hci_memory_new(runs + 1, sizeof *of_run);
    *left_Nm = 0.0;
    if (!of_run) return hci_note_memory(note, NULL, "what the model leaves");
    for (size_t r = 0; r < runs; ++r)
        of_run[r] = left_of_run_Nm(d, r);
    if (runs > 0) *left_Nm = hci_median(of_run, runs);
    hci_memory_free(of_run);
    return HCI_OK;
}

/* Of the runs that were fitted, rms. */
static double means_left_Nm(const hci_diagnosis *d)
{
    double sum = 0.0, count = 0.0;
    for (size_t r = 0; r < d->runs; ++r) {
        if (d->run[r].role != HCI_ROLE_FIT || !isfinite(d->run[r].error_mean_after_Nm)) continue;
        sum += pow(d->run[r].error_mean_after_Nm, 2.0);
        count += 1.0;
    }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

/* Goes with the corrected machine, whether or not anything is stated of it. */
hci_status hci_origin_fill(const hci_machine *machine, const hci_runs *runs, hci_diagnosis *d, hci_note *note)
{
    hci_machine_origin *origin = &d->uncertainty.origin;
    snprintf(origin->verdict, sizeof origin->verdict, "%s", hci_diagnosis_verdict_name(d->verdict));
    snprintf(origin->search, sizeof origin->search, "%s", hci_diagnosis_search_name(d->search));
    origin->unexplained_Nm = unexplained_ripple_Nm(d);
    if (d->means_alone && d->uncertainty.machines > 0) origin->left_means_Nm = means_left_Nm(d);
    origin->constant_is_declared = d->held_constant_Nm_per_A > 0.0;
    origin->turning_load_Nm = hci_turning_load_Nm(machine, &d->effects.list, runs);
    origin->sensor_zero_Nm = hci_sensor_zero_Nm(machine, &d->effects.list, runs, d->zeros_read_A);
    return left_orders_find(d, &origin->left_Nm, note);
}
