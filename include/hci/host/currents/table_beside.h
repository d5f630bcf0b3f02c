/* What the rotation of a table does not tell of a recording: whether the table is in it beside another
 * current, and whether the drive has corrected its sensors for it. */
#ifndef HCI_HOST_CURRENTS_TABLE_BESIDE_H
#define HCI_HOST_CURRENTS_TABLE_BESIDE_H

#include "hci/effects/effect.h"
#include "hci/host/currents/currents.h"
#include "hci/host/recording/run.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Start with {0}. */
typedef struct {
    double harmonics, harmonics_error; /* what the table has beside its fundamental, in the currents, whose
                                        * fundamental is another one in each direction: 1 is as in the table;
                                        * and its standard error. 0 where the table has none */
    double beside_A;  /* peak of a phase: by what the fundamentals differ from the table's, rms of both
                       * directions */
    double corrected; /* of the corrections of the current and position sensors, what is in the currents: 0,
                       * they are the table as they are read; 1, after the corrections; NAN: it is not told */
    double corrected_error; /* standard error of it */
    double corrections_A;   /* rms of a phase, that the corrections change the currents by */
} hci_table_beside;

/* Compares. run: with an angle from a known zero and currents. rotation_rad: electrical, by which the table
 * is read ahead, 0 as a rule. effects: of the machine that the table was solved for; may be NULL. O(samples).
 */
hci_table_beside hci_table_beside_of(const hci_currents *table, const hci_run *run, int pole_pairs,
                                     double rotation_rad, const hci_effects *effects);

#ifdef __cplusplus
}
#endif

#endif
