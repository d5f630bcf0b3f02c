/* What the model could lack: the terms of effects that these recordings could show. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CANDIDATES_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CANDIDATES_H

#include "host/diagnose/prepare/binned_samples.h"

enum { HCI_SUSPECT_TERMS = 4 };

/* Terms of one effect that come and go together. */
typedef struct {
    const hci_effect_type *type;
    hci_effect_term term[HCI_SUSPECT_TERMS]; /* value: where to start from */
    size_t count;
    double price;     /* of having chosen it among its like, in units of χ² */
    double deviation; /* of values that are to be expected, in the terms' unit; 0: any */
    bool in;          /* in the model */
} hci_suspect;

/* Those of one effect stand together. Start with {0}. */
typedef struct {
    hci_suspect *suspect;
    size_t count;
    double reference_current_A; /* of saturation */
} hci_suspects;

typedef struct {
    const hci_machine *machine;
    const hci_cells *cells;
    const hci_run *runs;
    const bool *use;            /* of each run */
    const double *residual_Nm;  /* of each cell */
    const double *variance;     /* of each cell, N²·m² */
    double reference_current_A; /* of saturation; NAN: the largest of the runs */
    int richness; /* of saturation and reluctance: 0 low orders, 1 all orders, 2 to high powers of the
                     currents */
} hci_suspects_source;

/* Terms that these recordings could show, at the orders that stand out of the residual. Those that are
 * already `in` an older list (known; or NULL) stay, with their values. On failure *suspects is empty.
 * HCI_ERROR_MEMORY. O(cells·orders). */
hci_status hci_suspects_make(const hci_suspects_source *source, const hci_suspects *known,
                             hci_suspects *suspects, hci_note *note);
void hci_suspects_release(hci_suspects *suspects);

/* The effect types of suspects: those of the registry, and behind them the one for what is not known; NULL
 * from there on. */
const hci_effect_type *hci_suspect_type(size_t k);
size_t hci_suspect_types(void); /* how many */

/* HCI_ERROR_MEMORY, and then `to` is empty. */
hci_status hci_suspects_copy(const hci_suspects *from, hci_suspects *to, hci_note *note);

/* Adds a suspect behind its like. On failure nothing is changed. HCI_ERROR_MEMORY. */
hci_status hci_suspects_add(hci_suspects *suspects, const hci_suspect *suspect, hci_note *note);

/* Whether two are the same terms. */
bool hci_suspect_same(const hci_suspect *a, const hci_suspect *b);

/* Whether a type is in, how many are, and how many terms. */
bool hci_suspects_have(const hci_suspects *suspects, const hci_effect_type *type);
size_t hci_suspects_types_in(const hci_suspects *suspects);
size_t hci_suspects_terms_in(const hci_suspects *suspects);

/* Takes a type out of the model; its suspects stay in the list. */
void hci_suspects_leave(hci_suspects *suspects, const hci_effect_type *type);

#endif
