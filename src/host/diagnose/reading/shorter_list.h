/* A list of effects without terms that add nothing to the torque. */
#ifndef HCI_SRC_HOST_DIAGNOSE_READING_SHORTER_LIST_H
#define HCI_SRC_HOST_DIAGNOSE_READING_SHORTER_LIST_H

#include <stdbool.h>

#include "hci/effects/effect.h"

/* Whether the torque is linear in all values of an effect but its reference current, and no other effect
 * depends on them: a term of value 0 then adds nothing. */
bool hci_effect_is_linear(const hci_effect *effect);

/* The list without some terms, and without effects of which no value stays. left: of each term, one effect
 * after the other, whether it is left out; effect, term: out, room for as many as there are; place: out, of
 * each term that stays its place in the shorter list, or NULL. */
hci_effects hci_effects_shorten(const hci_effects *from, const bool *left, hci_effect *effect,
                                hci_effect_term *term, size_t *place);

/* The list without what is nothing by its value: the same torque. */
hci_effects hci_effects_present(const hci_effects *from, hci_effect *effect, hci_effect_term *term,
                                bool *work);

#endif
