#include "hci/host/waveform/turning_load.h"

#include <math.h>
#include <string.h>

#define MUCH 0.1 /* of the largest order, below which one is no matter */

bool hci_is_turning_load_order(double order, int pole_pairs)
{
    const double a_turn = order * pole_pairs;
    if (!(order > HCI_ORDER_TOLERANCE)) return false;
    return fabs(a_turn - 1.0) < HCI_ORDER_TOLERANCE * pole_pairs ||
           (fabs(a_turn - 2.0) < HCI_ORDER_TOLERANCE * pole_pairs && fabs(order - 1.0) > HCI_ORDER_TOLERANCE);
}

static void add_effect(const hci_effect *e, double order, double *sine_Nm, double *cosine_Nm)
{
    for (size_t k = 0; k < e->count; ++k) {
        const hci_effect_parameter *parameter = &e->type->parameter[e->term[k].parameter];
        if (strcmp(parameter->unit, "Nm") != 0 || fabs(e->term[k].order - order) > HCI_ORDER_TOLERANCE)
            continue;
        if (strcmp(parameter->name, "sine") == 0) *sine_Nm += e->term[k].value;
        if (strcmp(parameter->name, "cosine") == 0) *cosine_Nm += e->term[k].value;
    }
}

double hci_angle_torque_Nm(const hci_machine *machine, const hci_effects *effects, double order)
{
    double sine_Nm = 0.0, cosine_Nm = 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k) {
        const hci_harmonic *h = &machine->cogging[k];
        if (fabs(h->order - order) > HCI_ORDER_TOLERANCE) continue;
        sine_Nm += h->sine;
        cosine_Nm += h->cosine;
    }
    for (size_t k = 0; k < effects->count; ++k)
        add_effect(&effects->effect[k], order, &sine_Nm, &cosine_Nm);
    return hypot(sine_Nm, cosine_Nm);
}

/* A torque of the angle alone, as machine and effects have it. */
typedef struct {
    const hci_machine *machine;
    const hci_effects *effects;
} angle_torque;

/* The largest amplitudes so far, of a load that turns and of any order but 0. */
typedef struct {
    double load_Nm, any_Nm;
} largest;

static void look_at(const angle_torque *x, double order, largest *most)
{
    const double Nm = order > HCI_ORDER_TOLERANCE ? hci_angle_torque_Nm(x->machine, x->effects, order) : 0.0;
    most->any_Nm = fmax(most->any_Nm, Nm);
    if (hci_is_turning_load_order(order, x->machine->pole_pairs)) most->load_Nm = fmax(most->load_Nm, Nm);
}

static bool tells_load_from_motor(const hci_runs *runs)
{
    bool has_torque = false;
    for (size_t k = 0; k < runs->count; ++k) {
        if (runs->run[k].torque_source == HCI_TORQUE_MEASURED) return true;
        has_torque = has_torque || runs->run[k].torque_source != HCI_TORQUE_NONE;
    }
    return !has_torque;
}

double hci_turning_load_Nm(const hci_machine *machine, const hci_effects *effects, const hci_runs *runs)
{
    const angle_torque x = {machine, effects};
    largest most = {0.0, 0.0};
    if (tells_load_from_motor(runs)) return 0.0;
    for (size_t k = 0; k < machine->cogging_count; ++k)
        look_at(&x, machine->cogging[k].order, &most);
    for (size_t k = 0; k < effects->count; ++k)
        for (size_t j = 0; j < effects->effect[k].count; ++j)
            look_at(&x, effects->effect[k].term[j].order, &most);
    return most.load_Nm > MUCH * most.any_Nm ? most.load_Nm : 0.0;
}
