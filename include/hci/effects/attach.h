/* Effects put on a simulated drive: on its plant as torque, on its sensors as what they read. */
#ifndef HCI_EFFECTS_ATTACH_H
#define HCI_EFFECTS_ATTACH_H

#include "hci/drive/control.h"
#include "hci/effects/effect.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What one sensor calls. */
typedef struct {
    hci_effect_channel channel;   /* what effects put before it */
    hci_sensor before;            /* as it was; its own modification comes first */
    const hci_plant_state *state; /* of the plant; or NULL */
    double step_s;                /* from one reading to the next */
} hci_effects_probe;

/* What a drive with effects points to; one for each drive, to be kept where it is as long as that. */
typedef struct {
    hci_effects_plant plant;                  /* context of effect */
    hci_plant_effect effect;                  /* all of them, on the plant */
    hci_effects_probe probe[HCI_SENSE_COUNT]; /* one for each sensor */
    hci_effects_probe
        *probe_of[HCI_SENSE_COUNT]; /* a sensor's context is read-only, but its links remember */
} hci_effects_attachment;

/* Why effects cannot be put on a drive. */
typedef enum {
    HCI_EFFECTS_FIT,           /* they can */
    HCI_EFFECTS_NOT_A_DRIVE,   /* it has no step, or effects already */
    HCI_EFFECTS_DRIVING,       /* Coulomb friction below 0 in sum, which would drive the shaft */
    HCI_EFFECTS_DELAY,         /* below 0, or a million steps and more */
    HCI_EFFECTS_TOO_MANY_LINKS /* more than HCI_EFFECT_LINKS act on one sensor */
} hci_effects_reason;

/* The reason, and what it is about. */
typedef struct {
    hci_effects_reason reason; /* of the five above */
    const hci_effect_type
        *type;    /* of the effect that it is about; NULL: the machine's own friction, or none */
    double value; /* friction in N·m, or delay in s */
} hci_effects_refusal;

/* Most steps of a delay, and one more. */
#define HCI_EFFECTS_MOST_STEPS 1000000

/* Puts effects on a drive whose plant, control.step_s and sensors are set up: plant.effects (which must be
 * empty) gets one entry, plant.coulomb_Nm grows, and the sensors become `sensors`, HCI_SENSE_COUNT of them,
 * changed and kept. Do this before hci_sensor_workspace and hci_sensor_start. plant: the machine, its effects
 * and the temperature of its magnets (NAN: the reference); what it points to is kept. state: whose speed the
 * friction before the torque sensor has, kept; NULL: the sensor does not see that friction. attachment: out,
 * kept. refusal: out. HCI_ERROR_ARGUMENT where refusal has a reason; drive and sensors are then untouched. */
hci_status hci_effects_put(const hci_effects_plant *plant, const hci_plant_state *state, hci_drive *drive,
                           hci_sensor *sensors, hci_effects_attachment *attachment,
                           hci_effects_refusal *refusal);

#ifdef __cplusplus
}
#endif

#endif
