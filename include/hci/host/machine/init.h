/* A first machine folder from the values of a data sheet. */
#ifndef HCI_HOST_MACHINE_INIT_H
#define HCI_HOST_MACHINE_INIT_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a data sheet may say how strong the magnets are: X(name, unit, what is meant). k_e is the peak of the
 * back-EMF of a phase, line to star point, in V·s/rad of the mechanical angle, and ω is mechanical.
 *
 * - Kv: rpm per volt of sqrt(3) k_e ω (line to line, peak), of its rms, or of k_e ω.
 * - Volt per krpm: the same voltages at 1000 rpm.
 * - N·m/A of a sine: torque 3/2 k_e I by its peak or its rms; dc: sqrt(3) k_e, as of a brushless motor in
 * block commutation, where N·m/A times rpm/V is 60/(2π).
 * - Flux linkage of a phase, peak: k_e = pole pairs × flux. */
#define HCI_SHEET_READINGS(X)                                                                                \
    X(HCI_SHEET_KV_LINE_PEAK, "rpm/V", "Kv of the line-to-line peak")                                        \
    X(HCI_SHEET_KV_LINE_RMS, "rpm/V", "Kv of the line-to-line rms")                                          \
    X(HCI_SHEET_KV_PHASE_PEAK, "rpm/V", "Kv of the phase peak")                                              \
    X(HCI_SHEET_VOLT_LINE_RMS, "V/krpm", "line-to-line rms")                                                 \
    X(HCI_SHEET_VOLT_LINE_PEAK, "V/krpm", "line-to-line peak")                                               \
    X(HCI_SHEET_VOLT_PHASE_PEAK, "V/krpm", "phase peak")                                                     \
    X(HCI_SHEET_VOLT_PHASE_RMS, "V/krpm", "phase rms")                                                       \
    X(HCI_SHEET_TORQUE_PEAK, "Nm/A", "torque per ampere peak of a sine")                                     \
    X(HCI_SHEET_TORQUE_RMS, "Nm/A", "torque per ampere rms of a sine")                                       \
    X(HCI_SHEET_TORQUE_DC, "Nm/A", "torque per ampere of line current in block commutation")                 \
    X(HCI_SHEET_FLUX, "Wb", "flux linkage of a phase, peak")

/* One of these readings; each says its unit and what is meant. */
typedef enum {
#define HCI_SHEET_NAME(name, unit, meaning) name,
    HCI_SHEET_READINGS(HCI_SHEET_NAME)
#undef HCI_SHEET_NAME
} hci_sheet_reading;

/* What the sheet says, as it says it. Not given: NAN, and 0 slots. */
typedef struct {
    const char *name;                      /* of the machine, for the first line of the tables */
    int pole_pairs;                        /* from 1 to 1000 */
    int slots;                             /* up to HCI_MOST_SLOTS */
    hci_sheet_reading reading;             /* what strength is */
    double strength;                       /* above 0, in the unit of the reading */
    double resistance_ohm;                 /* of what the next says */
    bool resistance_of_line;               /* between two terminals, not of a phase */
    double inductance_d_H, inductance_q_H; /* of a phase, along the magnets and across them */
    double inertia_kgm2;                   /* of the rotor */
    double rated_current_A;                /* of a phase, as the next says */
    bool rated_current_is_rms;             /* else peak */
    double rated_torque_Nm;                /* on the shaft */
    double rated_speed_rpm;                /* mechanical */
    double dc_link_voltage_V;              /* of battery or supply */
} hci_sheet;

/* Most slots of a stator. */
enum { HCI_MOST_SLOTS = 600 };

/* k_e in V·s/rad (mechanical, phase peak; the same number is N·m/A of a phase) of a value above 0. */
double hci_sheet_emf(hci_sheet_reading reading, double value, int pole_pairs);

/* And back: the value that a sheet with this reading gives for k_e above 0. */
double hci_sheet_value(hci_sheet_reading reading, double emf_Vs_per_rad, int pole_pairs);

/* The unit as in the list; a static string. */
const char *hci_sheet_unit(hci_sheet_reading reading);

/* What is meant, as in the list; a static string. */
const char *hci_sheet_meaning(hci_sheet_reading reading);

/* Resistance of one phase; NAN where the sheet does not say. */
double hci_sheet_resistance_ohm(const hci_sheet *sheet);

/* Rated current as a peak; NAN where the sheet does not say. */
double hci_sheet_current_A(const hci_sheet *sheet);

/* First electrical order of the cogging torque, lcm(slots, 2p)/p; slots and pole_pairs from 1. */
int hci_cogging_order(int slots, int pole_pairs);

/* Whether three equal phases can be wound on so many slots; both from 1. */
bool hci_has_equal_phases(int slots, int pole_pairs);

/* Ratings that do not agree with the strength of the magnets, and by which convention they would: rated
 * torque against 3/2 k_e × rated current, and the back-EMF at rated speed against the dc link. "" if there is
 * nothing to say. */
void hci_sheet_remark(const hci_sheet *sheet, hci_note *remark);

/* Whether L_d and L_q differ by more than 1 %, which makes it a machine with interior magnets. */
bool hci_sheet_is_salient(const hci_sheet *sheet);

/* Writes machine.csv, back_emf.csv and, where slots are given, cogging.csv, where L_d and L_q differ
 * inductance.csv into `folder`, which is made if it is missing. HCI_ERROR_ARGUMENT for values outside their
 * range, HCI_ERROR_OUTPUT when a table of a machine is there already; then nothing is written.
 * HCI_ERROR_MEMORY. */
hci_status hci_init_write(const char *folder, const hci_sheet *sheet, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
