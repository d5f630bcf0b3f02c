/* Candidate terms: what the model could lack, and which of that is in the model.
 *
 * A candidate is one to four terms of one effect that come and go together, such as the sine and the cosine
 * of a cogging order. A list of candidates is also how a model is written down: it has the terms that are
 * `in`. */
#ifndef HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CANDIDATES_H
#define HCI_SRC_HOST_DIAGNOSE_CANDIDATES_CANDIDATES_H

#include "host/diagnose/prepare/binned_samples.h"

enum { HCI_CANDIDATE_TERMS = 4 };

/* Terms of one effect that come and go together. */
typedef struct {
    const hci_effect_type *type;
    hci_effect_term term[HCI_CANDIDATE_TERMS]; /* value: where to start from */
    double declared[HCI_CANDIDATE_TERMS];      /* their values in the machine as it is declared */
    size_t count;
    double price;     /* of having chosen it among so many of its kind: 2 ln(kinds), in units of χ² */
    double deviation; /* standard deviation about the declared values to be expected, in the terms' unit; 0:
                       * any */
    double coenergy_unit; /* of a term of the co-energy: the deviation to be expected of it where coefficients
                           * of power 2 and order 0 deviate by 1 N·m; else 0 */
    int power;            /* of the currents, there */
    bool unlike;          /* of a rotor that does not look alike both ways round, there */
    bool shortened;       /* of the terms that stand together the last ones are another candidate */
    size_t grown_from;    /* terms that the law in the model has, of which this one has more; 0: no fewer */
    bool in;              /* in the model */
} hci_candidate;

/* Candidates of one effect stand together. Start with {0}. */
typedef struct {
    hci_candidate *candidate;
    size_t count;
    double reference_current_A; /* of a series in the currents */
} hci_candidates;

void hci_candidates_release(hci_candidates *candidates);

/* The effect types of candidates: those of the registry, and behind them the one for what is not known; NULL
 * from there on. */
const hci_effect_type *hci_candidate_type(size_t k);
size_t hci_candidate_types(void); /* how many */

/* HCI_ERROR_MEMORY, and then `to` is empty. */
hci_status hci_candidates_copy(const hci_candidates *from, hci_candidates *to, hci_note *note);

/* Adds a candidate behind those of its effect. On failure nothing is changed. HCI_ERROR_MEMORY. */
hci_status hci_candidates_add(hci_candidates *candidates, const hci_candidate *candidate, hci_note *note);

/* By how much the value of term k is away from the declared one; 0 of a scale, which is nothing by itself. */
double hci_candidate_departure(const hci_candidate *candidate, size_t k);

/* Whether a term of the magnetic circuit takes phases that differ. In a balanced machine the orders of the
 * back-EMF have their own sequence, and those of reluctance and saturation are 6k. */
bool hci_candidate_is_unbalanced(const hci_effect_type *type, size_t parameter, double order);

/* Whether a type is of current sensors that read in another proportion: what they read without a current says
 * nothing of it. */
bool hci_candidate_is_gain(const hci_effect_type *type);

/* The type that has the zero of a torque sensor, and which of its parameters that is; NULL: none has. */
const hci_effect_type *hci_sensor_zero(size_t *parameter);

/* The type that has the back-EMF of the magnets, and which of its parameters that is, whose order 1 is the
 * torque per ampere; NULL: none has. */
const hci_effect_type *hci_torque_per_ampere(size_t *parameter);

/* Leaves the last of several terms out. */
void hci_candidate_shorten(hci_candidate *candidate);

/* The one with the same terms that is in; NULL where there is none. */
const hci_candidate *hci_candidates_find_in(const hci_candidates *candidates, const hci_candidate *candidate);

/* Whether a type is in, or a series of many terms; how many types are, and how many terms. */
bool hci_candidates_have(const hci_candidates *candidates, const hci_effect_type *type);
bool hci_candidates_have_series(const hci_candidates *candidates);
size_t hci_candidates_types_in(const hci_candidates *candidates);
size_t hci_candidates_terms_in(const hci_candidates *candidates);

/* Whether a type is in with terms of a whole co-energy (coenergy_terms.h). These stand for each other, and
 * were chosen together, by runs left out. */
bool hci_candidates_are_of_whole(const hci_candidates *s, const hci_effect_type *type);

/* Takes a type out of the model; its candidates stay in the list. */
void hci_candidates_remove_type(hci_candidates *candidates, const hci_effect_type *type);

/* What the candidates are chosen from. */
typedef struct {
    const hci_machine *machine;
    const hci_effects *declared; /* those that the machine has already */
    const hci_binned_samples *samples;
    const hci_run *runs;
    const bool *use;            /* of each run */
    const double *residual_Nm;  /* of each sample */
    const double *variance;     /* of each sample, N²·m² */
    double reference_current_A; /* of a series in the currents; NAN: the largest of the runs */
    int richness;       /* as in hci_effect_survey: 0 low orders, 1 all orders, 2 to high powers of the
                           currents */
    size_t slots;       /* of the machine; 0: not known */
    bool known_only;    /* without the one for what is not known */
    bool magnetic_only; /* only those of the magnetic circuit that the currents tell apart */
    bool no_current;    /* without those that need a current */
    const bool *denied; /* without these, of each type; NULL: all */
    bool one_gain;      /* the model shows a gain of the torque sensor, whatever the residual does */
    bool has_neutral;   /* of the machine */
} hci_candidates_source;

/* Whether all runs in use are tables of torques over i_d and i_q, which no sensor of an angle has read. */
bool hci_candidates_lack_angle(const hci_run *runs, const bool *use, size_t count);

#endif
