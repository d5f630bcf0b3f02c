/* Currents for a drive to C: a header and a source file with the orders of current and voltage that a
 * microcontroller reads through hci/loop.h. */
#ifndef HCI_HOST_EMIT_EMIT_LOOP_H
#define HCI_HOST_EMIT_EMIT_LOOP_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/host/drive/drive.h"
#include "hci/host/emit/emit_facts.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is asked for. Start with {0}. */
typedef struct {
    const char *name;                /* of the table and its two files: a C identifier */
    const hci_machine_data *machine; /* as read */
    const char *machine_folder; /* whose effects.csv acts on the voltages, and on what is told between levels;
                                   NULL: neither */
    hci_drive_data *drive;      /* as read; its defaults are filled in */
    const hci_loop_level *levels; /* ascending by torque, equally far apart: 1, 2, or an odd number */
    size_t level_count;           /* entries of levels */
    double max_error_A;           /* of a table over the angle; 0: 2e-4 of the largest current */
    double speed_rad_per_s;       /* mechanical, up to which it is used; 0: as far as it goes */
    hci_emit_facts facts;         /* for the header and the blob */
    bool blob;                    /* NAME.bin too, for hci/loop_blob.h */
    uint64_t input_hash;          /* 64-bit FNV-1a of what the currents were read from */
} hci_emit_loop_request;

/* What it has become. */
typedef struct {
    size_t orders, levels, points; /* orders with the mean; points of a table in RAM */
    size_t repeats, period_turns;  /* periods of the table in 2^32 of angle, and its electrical turns */
    double highest_order;          /* electrical, in the rotor frame */
    size_t flash_bytes;            /* of the constants */
    size_t ram_bytes;              /* for reading ahead and for compensation */
    size_t feedforward_ram_bytes;  /* for feedforward */
    double max_error_A;            /* of a table against its waves, at each level's torque */
    double peak_A;                 /* largest current, length of the vector */
    double torque_low_Nm, torque_high_Nm; /* of the levels */
    double coarse_mean_Nm;     /* mean torque at torque_high_Nm, read at encoder_counts that are fewer than
                                * twice the highest order takes, at low speed; NAN: they are not */
    double dc_link_V;          /* that voltage_rad_per_s is for */
    double lead_s;             /* delay of the loop at low frequency */
    double voltage_rad_per_s;  /* mechanical: above it the voltage does not do for all orders; HUGE_VAL */
    double sampled_rad_per_s;  /* mechanical: above it the sampling does not do for all orders; HUGE_VAL */
    double measured_rad_per_s; /* mechanical: above it orders lie beyond the measured response; HUGE_VAL */
    double response_error;     /* share of the measured answer that loop.csv is off between its points, by how
                                * well     they tell one another; NAN: there is none, or it is not known */
    double response_ripple_percent; /* of the mean torque, peak to peak, that compensation can be left with by
                                     * that at response_rad_per_s; NAN likewise, and without a torque */
    double response_rad_per_s;  /* mechanical: the speed asked for, or the highest that all orders are whole
                                 * at; 0: none */
    hci_between_levels between; /* NAN with one level, and where it is not told */
    uint32_t crc32;             /* of the waves */
} hci_emit_loop_result;

/* Writes NAME.h and NAME.c into `folder`, and NAME.bin where asked for, all or none; same request, same
 * bytes. HCI_ERROR_INPUT, _ARGUMENT, _MEMORY, _OUTPUT, with a note. */
hci_status hci_emit_loop(const char *folder, const hci_emit_loop_request *request,
                         hci_emit_loop_result *result, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
