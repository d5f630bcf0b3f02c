#include "hci/effects/attach.h"

#include <math.h>
#include <string.h>

#include "core/effects/type.h"

static double modify(const void *context, double value, double theta_m_rad)
{
    hci_effects_probe *const p = *(hci_effects_probe *const *)context;
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

static hci_status refuse(hci_effects_refusal *refusal, hci_effects_reason reason, const hci_effect_type *type,
                         double value)
{
    *refusal = (hci_effects_refusal){reason, type, value};
    return HCI_ERROR_ARGUMENT;
}

static hci_status set_delay(hci_effects_probe *p, bool wraps, hci_sensor *sensor,
                            hci_effects_refusal *refusal)
{
    const double steps = p->channel.delay_s / p->step_s, whole = floor(steps + 1e-9);
    if (!(steps >= 0.0 && steps < HCI_EFFECTS_MOST_STEPS))
        return refuse(refusal, HCI_EFFECTS_DELAY, p->channel.delayed_by, p->channel.delay_s);
    sensor->delay_steps += (size_t)whole;
    if (steps - whole > 1e-9) {
        const hci_effect_link link = {
            delay_by_fraction, NULL, {0.0, 0.0, steps - whole, wraps ? 2.0 * HCI_PI : 0.0}};
        if (p->channel.count < HCI_EFFECT_LINKS) p->channel.link[p->channel.count] = link;
        ++p->channel.count;
    }
    return HCI_OK;
}

static void simulate_one(const hci_effect *effect, int pole_pairs, hci_sensor *sensors,
                         hci_effect_channel *channels)
{
    const hci_effect_link link = {effect->type->modify_torque, effect, {0.0}};
    if (effect->type->simulate) effect->type->simulate(effect, pole_pairs, sensors, channels);
    if (link.modify) hci_effect_link_add(&channels[HCI_SENSE_TORQUE], &link);
}

/* What each type of effect does to the sensors, in the order of the registry. */
static void simulate_types(const hci_effects *effects, int pole_pairs, hci_sensor *sensors,
                           hci_effect_channel *channels)
{
    const hci_effect_type *type;
    for (size_t r = 0; (type = hci_effect_type_at(r)) != NULL; ++r)
        for (size_t k = 0; k < effects->count; ++k)
            if (effects->effect[k].type == type)
                simulate_one(&effects->effect[k], pole_pairs, sensors, channels);
}

static hci_status set_sensors(const hci_effects *effects, int pole_pairs, hci_effects_attachment *a,
                              hci_sensor *sensors, hci_effects_refusal *refusal)
{
    hci_effect_channel channels[HCI_SENSE_COUNT];
    hci_status status = HCI_OK;
    memset(channels, 0, sizeof channels);
    simulate_types(effects, pole_pairs, sensors, channels);
    for (int s = 0; s < HCI_SENSE_COUNT && !status; ++s) {
        hci_effects_probe *p = &a->probe[s];
        p->channel = channels[s];
        p->before = sensors[s];
        status = set_delay(p, s == HCI_SENSE_ANGLE, &sensors[s], refusal);
        if (!status && p->channel.count > HCI_EFFECT_LINKS)
            status = refuse(refusal, HCI_EFFECTS_TOO_MANY_LINKS, NULL, 0.0);
        a->probe_of[s] = p;
        if (p->channel.count == 0) continue;
        sensors[s].modify = modify;
        sensors[s].context = &a->probe_of[s];
    }
    return status;
}

/* Friction of the effects and of the plant may not drive the shaft. */
static hci_status check_coulomb(const hci_effects *effects, double plant_Nm, hci_effects_refusal *refusal)
{
    const double sum_Nm = plant_Nm + hci_effects_coulomb_Nm(effects);
    size_t k = 0;
    if (!(sum_Nm < 0.0)) return HCI_OK;
    while (k < effects->count && !effects->effect[k].type->coulomb_Nm)
        ++k;
    return refuse(refusal, HCI_EFFECTS_DRIVING, k < effects->count ? effects->effect[k].type : NULL, sum_Nm);
}

static void set_drive(const hci_effects_plant *plant, hci_effects_attachment *a, hci_drive *drive)
{
    a->plant = *plant;
    a->effect = (hci_plant_effect){hci_effects_apply, &a->plant};
    drive->plant.effects = &a->effect;
    drive->plant.effect_count = plant->effects->count > 0 ? 1 : 0;
    drive->plant.coulomb_Nm += hci_effects_coulomb_Nm(plant->effects);
}

hci_status hci_effects_put(const hci_effects_plant *plant, const hci_plant_state *state, hci_drive *drive,
                           hci_sensor *sensors, hci_effects_attachment *attachment,
                           hci_effects_refusal *refusal)
{
    hci_sensor changed[HCI_SENSE_COUNT];
    *refusal = (hci_effects_refusal){HCI_EFFECTS_FIT, NULL, 0.0};
    if (drive->plant.effect_count > 0 || !(drive->control.step_s > 0.0))
        return refuse(refusal, HCI_EFFECTS_NOT_A_DRIVE, NULL, 0.0);
    hci_status status = check_coulomb(plant->effects, drive->plant.coulomb_Nm, refusal);
    if (status) return status;
    for (int s = 0; s < HCI_SENSE_COUNT; ++s) {
        attachment->probe[s].state = state;
        attachment->probe[s].step_s = drive->control.step_s;
    }
    memcpy(changed, sensors, sizeof changed);
    status = set_sensors(plant->effects, plant->machine->pole_pairs, attachment, changed, refusal);
    if (status) return status;
    memcpy(sensors, changed, sizeof changed);
    set_drive(plant, attachment, drive);
    drive->sensors = sensors;
    return HCI_OK;
}
