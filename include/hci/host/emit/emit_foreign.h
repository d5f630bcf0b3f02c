/* Currents to the compensation map of somebody else's drive, and what ripple it leaves there. */
#ifndef HCI_HOST_EMIT_EMIT_FOREIGN_H
#define HCI_HOST_EMIT_EMIT_FOREIGN_H

#include <stdbool.h>
#include <stdint.h>

#include "hci/host/foreign/foreign_target.h"
#include "hci/host/machine/machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is asked for. Start with {0}; arrays and strings belong to the caller. */
typedef struct {
    const char *name;                /* of the files: a C identifier */
    hci_foreign_name target;         /* whose drive */
    const char *machine_folder;      /* its effects.csv is read too */
    const hci_machine_data *machine; /* as read */
    const hci_wave *currents;        /* in A: all of them, or what does not depend on the torque */
    size_t current_count;            /* entries of currents */
    const hci_wave *per_Nm;     /* in A/(N·m), or NULL; only for targets whose map depends on the torque */
    size_t per_Nm_count;        /* entries of per_Nm */
    double reference_torque_Nm; /* with per_Nm: for which torque the ripple is told */
    double torque_constant_Nm_per_A; /* by which the drive makes i_q of a torque; 0: that of the machine */
    hci_foreign_wave wave;           /* what the drive means by amplitude and phase */
    double counts_per_A;             /* for targets with counts; 0: not known */
    size_t points;                   /* for targets that take any number; 0: theirs */
    double encoder_offset_deg; /* what the drive's angle is where the machine's is 0, in its own turns */
    int encoder_direction; /* 1, or −1 where it falls when the machine turns in its positive direction */
    double
        expected_ripple_Nm; /* of the currents on the machine, peak to peak; 0: not known; for words alone */
    uint64_t input_hash;    /* 64-bit FNV-1a of what the currents were read from */
} hci_emit_foreign_request;

/* Ripple at one torque, peak to peak over a mechanical turn. */
typedef struct {
    double torque_Nm;  /* mean, to which the drive brings its own i_q */
    double without_Nm; /* with a plain sine of current */
    double with_Nm;    /* with the map, as the drive samples and rounds it */
    double mean_Nm;    /* mean that the drive reaches with the map: less where its numbers end before */
} hci_foreign_ripple;

/* Torques at which the ripple is told. */
enum { HCI_FOREIGN_RIPPLES = 3 };

/* What it has become. */
typedef struct {
    const char *carries, *lacks, *samples;          /* in words; static strings */
    char files[160];                                /* names of the files, a comma and a blank between them */
    size_t points, terms;                           /* of a table; of a sum of harmonics */
    double unit;                                    /* of its integers, in A (of torques in N·m); 0: none */
    double peak;                                    /* largest value, in A (of torques in N·m) */
    size_t cut;                                     /* values that were too large, and were cut */
    size_t left_out;                                /* orders for which it has no room, */
    double left_out_amplitude;                      /* and the largest of them */
    double torque_Nm;                               /* for which the map is made */
    double torque_constant_Nm_per_A;                /* that was used */
    hci_foreign_ripple ripple[HCI_FOREIGN_RIPPLES]; /* at 0, torque_Nm and −torque_Nm */
    size_t ripples;                                 /* 1 where torque_Nm is 0 */
} hci_emit_foreign_result;

/* Whether the drive reaches the mean torque with the map, to 1 %. */
bool hci_foreign_ripple_is_reached(const hci_foreign_ripple *ripple);

/* Writes the files of a target into `folder`, all or none; same request, same bytes.
 *
 * Of a target that carries i_q alone, it is that i_q which makes the torque of the currents with i_d = 0.
 * HCI_ERROR_ARGUMENT, _INPUT, _MEMORY, _OUTPUT, with a note. */
hci_status hci_emit_foreign(const char *folder, const hci_emit_foreign_request *request,
                            hci_emit_foreign_result *result, hci_note *note);

#ifdef __cplusplus
}
#endif

#endif
