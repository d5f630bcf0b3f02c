#include "hci/host/waveform/waveform.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"
#include "host/waveform/task.h"

static hci_status check_options(const hci_waveform_options *o, hci_note *note)
{
    if (o->pole_pairs < 1)
        return hci_note_set(note, HCI_ERROR_ARGUMENT, "found %d pole pairs, expected 1 or more",
                            o->pole_pairs);
    for (size_t k = 0; k < o->order_count; ++k) {
        if (!(o->orders[k] > HCI_ORDER_TOLERANCE) || o->orders[k] > HCI_MOST_ORDER)
            return hci_note_set(note, HCI_ERROR_ARGUMENT, "order %g: expected one above 0, at most %g",
                                o->orders[k], HCI_MOST_ORDER);
        if (k > 0 && !(o->orders[k] > o->orders[k - 1] + HCI_ORDER_TOLERANCE))
            return hci_note_set(note, HCI_ERROR_ARGUMENT, "order %g: expected each once and ascending",
                                o->orders[k]);
    }
    return HCI_OK;
}

hci_status hci_waveform_find(const hci_run *run, const hci_waveform_options *options, hci_waveform *waveform,
                             hci_note *note)
{
    const hci_waveform_task t = {run, options, waveform, note};
    memset(waveform, 0, sizeof *waveform);
    waveform->quantity = options->quantity;
    waveform->mean_Nm = waveform->friction_Nm = waveform->friction_error_Nm = NAN;
    waveform->frequency_Hz = waveform->drift_Hz_per_s = waveform->speed_rad_per_s = NAN;
    hci_status status = check_options(options, note);
    if (!status)
        status =
            options->quantity == HCI_WAVEFORM_COGGING ? hci_waveform_cogging(&t) : hci_waveform_back_emf(&t);
    if (status) hci_waveform_release(waveform);
    return status;
}

void hci_waveform_release(hci_waveform *waveform)
{
    hci_memory_free(waveform->order);
    memset(waveform, 0, sizeof *waveform);
}
