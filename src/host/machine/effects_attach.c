/* Effects put on a simulated drive: on its plant as torque, on its sensors as what they read. */
#include <math.h>
#include <string.h>

#include "hci/host/machine/effects.h"
#include "host/base/memory.h"

/* What one sensor calls. */
typedef struct {
    hci_effect_channel channel;
    hci_sensor before; /* as it was; its own modification comes first */
    const hci_plant_state *state;
    double step_s;
} probe;

struct hci_effects_attachment {
    hci_effects_plant plant;
    hci_plant_effect effect;
    probe probe[HCI_SENSE_COUNT];
    probe *probe_of[HCI_SENSE_COUNT]; /* a sensor's context is read-only, but its links remember */
};

static double modify(const void *context, double value, double theta_m_rad)
{
    probe *const p = *(probe *const *)context;
    if (p->before.modify) value = p->before.modify(p->before.context, value, theta_m_rad);
    for (size_t k = 0; k < p->channel.count; ++k) {
        hci_effect_link *link = &p->channel.link[k];
        value = link->modify(link->effect, p->state, p->step_s, link->memory, value, theta_m_rad);
    }
    return value;
}

/* The part of a delay that is no whole step, by linear interpolation. memory: started, last value, fraction,
 * period of a value that wraps or 0. */
static double delay_by_fraction(const hci_effect *effect, const hci_plant_state *plant, double step_s,
                                double *memory, double value, double theta_m_rad)
{
    double change = memory[0] > 0.0 ? value - memory[1] : 0.0;
    (void)effect;
    (void)plant;
    (void)step_s;
    (void)theta_m_rad;
    memory[0] = 1.0;
    memory[1] = value;
    if (memory[3] > 0.0) change -= memory[3] * floor(change / memory[3] + 0.5);
    return value - memory[2] * change;
}

enum { MOST_STEPS = 1000000 };

static hci_status set_delay(probe *p, bool wraps, hci_sensor *sensor, hci_note *note)
{
    const double steps = p->channel.delay_s / p->step_s, whole = floor(steps + 1e-9);
    if (!(steps >= 0.0 && steps < MOST_STEPS))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "%s: found %g s, expected 0 or more and less than %d steps of the simulation; "
                            "delay the other channels instead of one by less than 0",
                            p->channel.delayed_by->name, p->channel.delay_s, MOST_STEPS);
    sensor->delay_steps += (size_t)whole;
    if (steps - whole > 1e-9) {
        const hci_effect_link link = {
            delay_by_fraction, NULL, {0.0, 0.0, steps - whole, wraps ? 2.0 * HCI_PI : 0.0}};
        if (p->channel.count < HCI_EFFECT_LINKS) p->channel.link[p->channel.count] = link;
        ++p->channel.count;
    }
    return HCI_OK;
}

/* What each type of effect does to the sensors, in the order of the registry. */
static void simulate_types(const hci_effects *effects, int pole_pairs, hci_sensor *sensors,
                           hci_effect_channel *channels)
{
    const hci_effect_type *type;
    for (size_t r = 0; (type = hci_effect_type_at(r)) != NULL; ++r)
        for (size_t k = 0; k < effects->count && type->simulate; ++k)
            if (effects->effect[k].type == type)
                type->simulate(&effects->effect[k], pole_pairs, sensors, channels);
}

static hci_status set_sensors(const hci_effects *effects, int pole_pairs, hci_effects_attachment *a,
                              hci_sensor *sensors, hci_note *note)
{
    hci_effect_channel channels[HCI_SENSE_COUNT];
    hci_status status = HCI_OK;
    memset(channels, 0, sizeof channels);
    simulate_types(effects, pole_pairs, sensors, channels);
    for (int s = 0; s < HCI_SENSE_COUNT && !status; ++s) {
        probe *p = &a->probe[s];
        p->channel = channels[s];
        p->before = sensors[s];
        status = set_delay(p, s == HCI_SENSE_ANGLE, &sensors[s], note);
        if (!status && p->channel.count > HCI_EFFECT_LINKS)
            status = hci_note_set(note, HCI_ERROR_ARGUMENT,
                                  "more than %d effects act on one sensor; join those of one kind",
                                  HCI_EFFECT_LINKS);
        a->probe_of[s] = p;
        if (p->channel.count == 0) continue;
        sensors[s].modify = modify;
        sensors[s].context = &a->probe_of[s];
    }
    return status;
}

/* Friction of the effects and of the plant may not drive the shaft. */
static hci_status check_coulomb(const hci_effects *effects, double plant_Nm, hci_note *note)
{
    const double sum_Nm = plant_Nm + hci_effects_coulomb_Nm(effects);
    size_t k = 0;
    if (!(sum_Nm < 0.0)) return HCI_OK;
    while (k < effects->count && !effects->effect[k].type->coulomb_Nm)
        ++k;
    return hci_note_set(
        note, HCI_ERROR_ARGUMENT,
        "%s: Coulomb friction is %g N·m in sum, expected 0 or more; a simulated shaft cannot be "
        "driven by its bearings",
        k < effects->count ? effects->effect[k].type->name : "machine", sum_Nm);
}

static hci_status check_attachable(const hci_effects *effects, const hci_drive *drive, hci_note *note)
{
    if (drive->plant.effect_count > 0 || !(drive->control.step_s > 0.0))
        return hci_note_set(note, HCI_ERROR_ARGUMENT,
                            "effects belong on a drive that has a step and no effects yet");
    return check_coulomb(effects, drive->plant.coulomb_Nm, note);
}

static void set_drive(const hci_effects_plant *plant, hci_effects_attachment *a, hci_drive *drive)
{
    a->plant = *plant;
    a->effect = (hci_plant_effect){hci_effects_apply, &a->plant};
    drive->plant.effects = &a->effect;
    drive->plant.effect_count = plant->effects->count > 0 ? 1 : 0;
    drive->plant.coulomb_Nm += hci_effects_coulomb_Nm(plant->effects);
}

hci_status hci_effects_attach(const hci_effects_plant *plant, const hci_plant_state *state, hci_drive *drive,
                              hci_sensor *sensors, hci_effects_attachment **attachment, hci_note *note)
{
    hci_sensor changed[HCI_SENSE_COUNT];
    hci_effects_attachment *a;
    hci_status status = check_attachable(plant->effects, drive, note);
    *attachment = NULL;
    if (status) return status;
    a = hci_memory_new(1, sizeof *a);
    if (!a) return hci_note_memory(note, NULL, "the effects of the machine");
    for (int s = 0; s < HCI_SENSE_COUNT; ++s) {
        a->probe[s].state = state;
        a->probe[s].step_s = drive->control.step_s;
    }
    memcpy(changed, sensors, sizeof changed);
    status = set_sensors(plant->effects, plant->machine->pole_pairs, a, changed, note);
    if (status) {
        hci_memory_free(a);
        return status;
    }
    memcpy(sensors, changed, sizeof changed);
    set_drive(plant, a, drive);
    drive->sensors = sensors;
    *attachment = a;
    return HCI_OK;
}

void hci_effects_detach(hci_effects_attachment *attachment)
{
    hci_memory_free(attachment);
}
