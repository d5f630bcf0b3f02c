/* The files that a measured waveform is written to. */
#include <math.h>

#include "hci/host/report/write.h"
#include "hci/math/harmonic.h"
#include "host/plot/plot.h"

/* The fundamental is the zero: θ + φ in place of θ turns order n by −nφ. */
static double phase_of(const hci_waveform *w, const hci_waveform_order *o)
{
    if (!(fabs(w->zero_rad) > 0.0)) return o->phase_rad;
    const double phase = remainder(o->phase_rad - o->order * w->zero_rad, 2.0 * HCI_PI);
    return fabs(o->order - 1.0) < HCI_ORDER_TOLERANCE ? 0.0 : phase;
}

static void write_orders(hci_output *out, const hci_waveform *w, const char *unit)
{
    hci_output_text(out, "order,amplitude_%s,phase_rad,std_error_%s\n", unit, unit);
    for (size_t k = 0; k < w->count; ++k) {
        const hci_waveform_order *o = &w->order[k];
        if (!o->kept) continue;
        hci_output_number(out, o->order, ',');
        hci_output_number(out, o->amplitude, ',');
        hci_output_number(out, phase_of(w, o), ',');
        hci_output_number(out, o->std_error, '\n');
    }
}

hci_status hci_waveform_write(const hci_waveform *w, const char *folder, hci_note *note)
{
    const bool emf = w->quantity == HCI_WAVEFORM_BACK_EMF;
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_output_file(out, emf ? "back_emf.csv" : "cogging.csv", note);
    if (!status) write_orders(out, w, emf ? "Nm_per_A" : "Nm");
    if (!status) status = hci_output_file(out, emf ? "back_emf.svg" : "cogging.svg", note);
    if (!status) hci_plot_waveform(out, w);
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}
