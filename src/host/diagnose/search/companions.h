/* What an effect must explain to be more than a part of what those beside it get wrong. */
#ifndef HCI_SRC_HOST_DIAGNOSE_SEARCH_COMPANIONS_H
#define HCI_SRC_HOST_DIAGNOSE_SEARCH_COMPANIONS_H

#include "host/diagnose/reading/regression.h"
#include "host/diagnose/search/attribution.h"

/* Whether every torque in use is an inertia times an acceleration. */
bool hci_are_free_shafts(const hci_regression *regression);

/* The fall of the score that an effect with this verdict must reach beside those of the attribution that are
 * in; INFINITY: whatever it reaches, it is an error of the readings. */
double hci_companion_least(const hci_regression *regression, const hci_attribution *attribution,
                           const hci_verdict *verdict);

/* The same of an effect that runs without a current show by themselves: beside a lag or a resonance of the
 * torque sensor through which they were read, what any effect has to reach; 0: there is none. */
double hci_companion_of_sensor(const hci_attribution *attribution, const hci_verdict *verdict);

/* The same of a back-EMF beside a series in the currents at the same orders: a few powers are not the curve
 * of saturated iron, and a linear part takes some of what they miss; with direct current phases that differ
 * do as well. 0: it is none. Not of a whole co-energy. */
double hci_companion_of_series(const hci_regression *regression, const hci_attribution *attribution,
                               const hci_verdict *verdict);

/* Whether the torque of a type goes with an acceleration, a slope of readings that is rounded where the speed
 * begins to change and ends to: effects but plain friction that explain less than its error are a part of it.
 */
bool hci_companion_is_by_slope(const hci_effect_type *type);

/* What a type in a model gets wrong, as a share of what it explains: effects of the iron that explain less
 * are a part of that. */
double hci_companion_error(const hci_regression *regression, const hci_candidates *model,
                           const hci_effect_type *type);

#endif
