/* A machine: a folder of small tables (machine.csv, back_emf.csv, cogging.csv, inductance.csv). */
#ifndef HCI_HOST_MACHINE_MACHINE_H
#define HCI_HOST_MACHINE_MACHINE_H

#include <stdbool.h>

#include "hci/host/base/note.h"
#include "hci/host/csv/csv.h"
#include "hci/machine/torque.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Scalars of machine.csv: X(field, name in the file, unit suffix of the canonical unit). Not given: NAN. */
#define HCI_MACHINE_VALUES(X)                                                                                \
    X(pole_pairs, "pole_pairs", "1")                                                                         \
    X(slots, "slots", "1")                                                                                   \
    X(emf_frequency_Hz, "emf_frequency", "Hz")                                                               \
    X(resistance_ohm, "resistance", "ohm")                                                                   \
    X(inductance_d_H, "inductance_d", "H")                                                                   \
    X(inductance_q_H, "inductance_q", "H")                                                                   \
    X(inertia_kgm2, "inertia", "kgm2")                                                                       \
    X(viscous_friction_Nms_per_rad, "viscous_friction", "Nms_per_rad")                                       \
    X(coulomb_friction_Nm, "coulomb_friction", "Nm")                                                         \
    X(dc_link_voltage_V, "dc_link_voltage", "V")                                                             \
    X(max_current_A, "max_current", "A")                                                                     \
    X(rated_current_A, "rated_current", "A")                                                                 \
    X(rated_torque_Nm, "rated_torque", "Nm")                                                                 \
    X(rated_speed_rad_per_s, "rated_speed", "rad_per_s")

/* Letters of a machine's name with the zero behind it. */
enum { HCI_MACHINE_NAME = 64 };

/* Which machine it is: to tell whether currents are another one's. */
typedef struct {
    char name[HCI_MACHINE_NAME]; /* of its folder, cut short where it is long */
    char digest[17];             /* of what makes its torque: 16 hexadecimal digits; "" where none was read */
} hci_machine_identity;

/* A machine as read from its folder. Start with {0}. */
typedef struct {
#define HCI_MACHINE_FIELD(field, name, unit) double field;
    HCI_MACHINE_VALUES(HCI_MACHINE_FIELD)
#undef HCI_MACHINE_FIELD
    bool has_neutral;              /* connection star-neutral */
    bool has_effects;              /* effects.csv is there */
    hci_machine model;             /* points into the arrays below */
    hci_wave *back_emf;            /* of model */
    hci_harmonic *cogging;         /* of model */
    hci_inductance_slope *slope;   /* of model */
    hci_inductance *inductance;    /* L(θ) of inductance.csv; NULL without it or when it holds slopes only */
    size_t inductance_count;       /* entries of inductance */
    hci_order_base order_base;     /* of the tables that were read */
    hci_machine_identity identity; /* which it is */
    hci_note remark;               /* what a reader should know: names that were not understood, or "" */
} hci_machine_data;

/* Reads the folder `path`. On success *machine is to be given to hci_machine_release; on failure it is empty
 * and the note says why. HCI_ERROR_INPUT, HCI_ERROR_MEMORY. */
hci_status hci_machine_read(const char *path, hci_machine_data *machine, hci_note *note);

/* The same where the column `order` of back_emf.csv and cogging.csv counts what base says. */
hci_status hci_machine_read_orders(const char *path, hci_order_base base, hci_machine_data *machine,
                                   hci_note *note);

/* N·m per ampere of i_q by its back-EMF: 3/2 of the fundamental, as peak values. O(harmonics). */
double hci_machine_torque_constant(const hci_machine_data *machine);

/* Frees what a machine holds and empties it. */
void hci_machine_release(hci_machine_data *machine);

#ifdef __cplusplus
}
#endif

#endif
