#include "host/diagnose/reading/within_slope.h"

#include <math.h>
#include <string.h>

#include "host/base/memory.h"
#include "host/diagnose/reading/predicted_reading.h"
#include "host/numeric/statistics.h"

#define OF_MEDIAN 1.4826 /* deviation over the median of its size, of a normal distribution */

typedef struct {
    const hci_regression *regression;
    const hci_effects *effects;
    hci_predicted_reading predicted;
    double *instant_Nm; /* [samples of the longest segment] */
    double *within_Nm;  /* [samples], sizes */
    size_t count;
} comparing;

static void segment_add(comparing *c, const hci_segment *s)
{
    const hci_binned_sample *sample = c->regression->samples->sample + s->first;
    c->predicted.instant = true;
    hci_predicted_reading_fill(c->regression, c->effects, s, &c->predicted);
    memcpy(c->instant_Nm, c->predicted.torque_Nm, s->count * sizeof *c->instant_Nm);
    c->predicted.instant = false;
    hci_predicted_reading_fill(c->regression, c->effects, s, &c->predicted);
    for (size_t k = 0; k < s->count; ++k)
        if (sample[k].count > 0.0)
            c->within_Nm[c->count++] = fabs(c->instant_Nm[k] - c->predicted.torque_Nm[k]);
}

hci_status hci_within_slope_find(const hci_regression *e, const hci_effects *effects, double *usual_Nm,
                                 hci_note *note)
{
    comparing c = {.regression = e, .effects = effects};
    *usual_Nm = 0.0;
    if (!hci_regression_has_slopes(e)) return HCI_OK;
    c.within_Nm = hci_memory_new(e->samples->count + hci_segment_longest(e->samples), sizeof *c.within_Nm);
    c.instant_Nm = c.within_Nm ? c.within_Nm + e->samples->count : NULL;
    const bool made = c.within_Nm && hci_predicted_reading_make(e, effects, false, &c.predicted);
    for (const hci_segment *s = NULL; made && (s = hci_regression_next(e, s)) != NULL;)
        if (e->runs[s->run].torque_source == HCI_TORQUE_INERTIA) segment_add(&c, s);
    if (c.count > 0) *usual_Nm = OF_MEDIAN * hci_median(c.within_Nm, c.count);
    if (made) hci_predicted_reading_release(&c.predicted);
    hci_memory_free(c.within_Nm);
    return made ? HCI_OK : hci_note_memory(note, NULL, "comparing model and recordings");
}
