/* A compensation map as it stands in somebody else's drive: numbers that are those of its file, how the drive
 * makes currents of them, and the file.
 *
 * The angle of a map is the drive's own, in turns: mechanical ones of its encoder or electrical ones,
 *
 *     drive's angle = zero_deg + offset_deg + direction·θ
 *
 * with θ that of the machine, 0 at the rising zero crossing of phase a's back-EMF. Where the direction is −1
 * the drive's positive current makes torque against the machine's positive direction. */
#ifndef HCI_SRC_HOST_FOREIGN_MAP_H
#define HCI_SRC_HOST_FOREIGN_MAP_H

#include <stdbool.h>
#include <stddef.h>

#include "hci/host/base/note.h"
#include "hci/host/base/output.h"
#include "hci/host/foreign/foreign_target.h"

/* What the values of a map are. */
typedef enum {
    HCI_FOREIGN_Q,      /* i_q in A, whatever the torque: one column */
    HCI_FOREIGN_TORQUE, /* torque in N·m that the drive makes of i_q by its torque constant: harmonics */
    HCI_FOREIGN_DQ      /* i_d, i_q in A, and what is added of both for each A of the drive's own i_q */
} hci_foreign_kind;

enum { HCI_FOREIGN_MOST_COLUMNS = 4, HCI_FOREIGN_MOST_TERMS = 20, HCI_FOREIGN_MOST_FILES = 3 };

typedef struct hci_foreign_type hci_foreign_type;

/* amplitude·sin(order·(drive's angle) + phase_rad), in the unit of the map. */
typedef struct {
    double order, amplitude, phase_rad;
} hci_foreign_term;

/* Start with hci_foreign_map_init. Columns: q; or d, q, d per A, q per A. */
typedef struct {
    const hci_foreign_type *type;
    double offset_deg; /* of the drive's own turns, mechanical or electrical */
    int direction;     /* 1 or −1 */
    double counts_per_A;
    hci_foreign_wave wave;           /* what the file means by amplitude and phase */
    double torque_constant_Nm_per_A; /* by which the drive makes i_q of a torque */

    size_t points, columns;
    double *value; /* [points][columns], as the drive uses them; NULL for harmonics */
    hci_foreign_term term[HCI_FOREIGN_MOST_TERMS];
    size_t terms;

    double unit;               /* of its integers, in the unit of the map; 0: it has none */
    size_t cut;                /* values that were too large for it, and were cut */
    size_t left_out;           /* orders for which it has no room */
    double left_out_amplitude; /* the largest of them */
} hci_foreign_map;

/* What is asked of a target's file beside the map. */
typedef struct {
    const char *name;         /* of the files */
    const char *const *lines; /* for the comment at the head, NULL ends them */
} hci_foreign_files;

/* One target. Functions that it does not need are NULL. */
struct hci_foreign_type {
    const char *word;
    const char *carries, *lacks, *samples; /* in words for the user */
    hci_foreign_kind kind;
    bool is_electrical; /* the angle of the map */
    double zero_deg;    /* of the drive's angle where that of the machine is 0 */
    size_t points;      /* 0: as asked, or default_points */
    size_t default_points;
    bool in_middle;    /* the value of an index is that at the middle of its part of the turn */
    bool has_wave;     /* what it means by amplitude and phase has to be said */
    bool has_counts;   /* counts_per_A must be known */
    size_t most_terms; /* of harmonics */
    double most_order; /* of harmonics, in turns of its angle */
    const char *file[HCI_FOREIGN_MOST_FILES]; /* endings of the files, the first is that which is read back */

    /* Rounds value or term to what the file can hold; counts what is cut. */
    void (*fit)(hci_foreign_map *map);
    /* What the drive adds to its own i_q (A) at an angle in turns, 0 to 1: add[0] i_d, add[1] i_q (A), or
     * add[1] the torque (N·m) for harmonics. */
    void (*at)(const hci_foreign_map *map, double turn, double own_q_A, double add[2]);
    /* The text of a file. */
    void (*write[HCI_FOREIGN_MOST_FILES])(const hci_foreign_map *map, const hci_foreign_files *files,
                                          hci_output *output);
    /* Whether a text is such a file, and the map in it. */
    bool (*recognises)(const char *text);
    hci_status (*read)(const char *path, const char *text, hci_foreign_map *map, hci_note *note);
};

/* One file each. */
extern const hci_foreign_type hci_foreign_simplefoc, hci_foreign_mcsdk, hci_foreign_moteus,
    hci_foreign_novanta, hci_foreign_csv, hci_foreign_beckhoff, hci_foreign_openffboard;

/* All targets, by their names. */
extern const hci_foreign_type *const hci_foreign_types[HCI_FOREIGN_TARGET_COUNT];

/* An empty map of a target, of an encoder that is that of the machine. */
void hci_foreign_map_init(hci_foreign_map *map, const hci_foreign_type *type);

/* Room for values, all 0. HCI_ERROR_MEMORY. */
hci_status hci_foreign_map_points(hci_foreign_map *map, size_t points, hci_note *note);

void hci_foreign_map_release(hci_foreign_map *map);

/* The drive's angle in turns, 0 to 1, for one of the machine in rad of the same kind, and the other way
 * round.
 */
double hci_foreign_turn(const hci_foreign_map *map, double theta_rad);
double hci_foreign_theta_rad(const hci_foreign_map *map, double turn);

/* Straight lines between node k at k/points and the next, in double precision. */
void hci_foreign_line(const hci_foreign_map *map, double turn, double *value);

/* The sum of the terms. */
double hci_foreign_sum(const hci_foreign_map *map, double turn);

/* Moves the nodes of smooth values by −1/16 of their second difference, by which straight lines between them
 * are off by half as much, above and below. HCI_ERROR_MEMORY. */
hci_status hci_foreign_balance(hci_foreign_map *map, hci_note *note);

/* Largest magnitude of a column. */
double hci_foreign_largest(const hci_foreign_map *map, size_t column);

/* The index of an angle in turns, where values are not joined by lines. */
size_t hci_foreign_index(const hci_foreign_map *map, double turn);

/* Terms from values in equal steps of a turn: the strongest whole orders, up to what the type has room for. A
 * mean is no term. */
void hci_foreign_find_terms(hci_foreign_map *map, const double *value, size_t count);

/* The phase of a term as the file has it, 0 to 2π, and as it is. */
double hci_foreign_phase_in_file(const hci_foreign_map *map, double phase_rad);
double hci_foreign_phase_of_file(const hci_foreign_map *map, double phase_rad);

#endif
