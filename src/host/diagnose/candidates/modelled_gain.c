#include "host/diagnose/candidates/modelled_gain.h"

#include <math.h>

#include "hci/math/harmonic.h"

#define LEAST_GAIN 1e-3 /* below it there is none */

static bool is_cogging(const hci_candidate *x)
{
    return x->in && x->type->any_phase && x->type->propose_coenergy;
}

static bool has_order(const hci_candidate *x, size_t term, double order)
{
    return fabs(x->term[term].order - order) < HCI_ORDER_TOLERANCE && x->term[term].parameter < 2;
}

/* What the model adds to one order of the cogging torque: sine and cosine. */
static void modelled_wave(const hci_candidates *model, double order, double wave[2])
{
    wave[0] = wave[1] = 0.0;
    for (size_t k = 0; k < model->count; ++k) {
        const hci_candidate *x = &model->candidate[k];
        for (size_t j = 0; is_cogging(x) && j < x->count; ++j)
            if (has_order(x, j, order)) wave[x->term[j].parameter] += x->term[j].value;
    }
}

static bool shows_gain(const hci_harmonic *cogging, const hci_candidates *model, double gain)
{
    double off[2];
    modelled_wave(model, cogging->order, off);
    const double square = cogging->sine * cogging->sine + cogging->cosine * cogging->cosine;
    if (!(square > 0.0)) return false;
    const double along = (off[0] * cogging->sine + off[1] * cogging->cosine) / square;
    const double across = (off[1] * cogging->sine - off[0] * cogging->cosine) / square;
    return hypot(along - gain, across) < HCI_SAME_GAIN * fabs(gain);
}

bool hci_modelled_gain(const hci_machine *machine, const hci_candidates *model, double gain)
{
    for (size_t k = 0; fabs(gain) > LEAST_GAIN && k < machine->cogging_count; ++k)
        if (shows_gain(&machine->cogging[k], model, gain)) return true;
    return false;
}

bool hci_modelled_gain_has(const hci_machine *machine, const hci_candidates *model, double gain, size_t k)
{
    const hci_candidate *x = &model->candidate[k];
    for (size_t n = 0; is_cogging(x) && n < machine->cogging_count; ++n)
        for (size_t j = 0; j < x->count; ++j)
            if (has_order(x, j, machine->cogging[n].order) && shows_gain(&machine->cogging[n], model, gain))
                return true;
    return false;
}
