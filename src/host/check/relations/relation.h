/* A relation: a number made of others, such as torque over 3/2 k_e i_q, that has a known value in every
 * correct machine. Here is what relations are made of: the value, a fit over several recordings, and how far
 * a value is from what it should be. */
#ifndef HCI_SRC_HOST_CHECK_RELATION_H
#define HCI_SRC_HOST_CHECK_RELATION_H

#include "host/check/relations/interpretation.h"

typedef enum {
    CHECK_RATIO, /* found/expected, by its logarithm */
    CHECK_FLUX,  /* so, and proportional to the flux of the magnets */
    CHECK_LOW,   /* so, below 1 with half as much again: friction, and a cautious sheet */
    CHECK_HIGH,  /* so, below 1 with half the tolerance and above with thrice: copper is warmer than on the
                    sheet, seldom  colder, and leads, switches and dead time come to it */
    CHECK_ANGLE, /* radians, modulo a turn */
    CHECK_SHARE, /* a difference */
    CHECK_MOST   /* at most the expected, by the logarithm of what is above */
} check_kind;

/* found: NAN where the data do not have it. spread: the tolerance is this many times that of the relation.
 * cost: in nats, of what had to be supposed for it. */
typedef struct {
    double found, spread, cost;
} check_value;

typedef struct {
    const char *name, *words;
    check_kind kind;
    double expected, tolerance;
    double cap; /* the most that one relation can count against an interpretation, in nats */
    check_value (*evaluate)(const check_data *data, const check_interpretation *as, const check_model *model);
    const char *needs;
    const char *instead; /* relation that tests the same where it can be checked; "": none */
} check_relation;

/* Relations of one kind, in the order in which they are reported. */
typedef struct {
    const check_relation *relation;
    size_t count;
} check_relation_list;

/* The value of a relation in an interpretation. */
check_value hci_check_relation_value(const check_data *data, const check_relation *relation,
                                     const check_interpretation *as);

/* Distance from the expected value in standard deviations, 0 or more. */
double hci_check_deviation(const check_relation *relation, check_value value);

/* How much a value counts against an interpretation: −ln of its likelihood, in nats, at most about
 * relation->cap.
 */
double hci_check_loss(const check_relation *relation, check_value value);

/* What it costs to suppose that the magnets have this share of the flux in the tables. */
double hci_check_magnets_loss(double share);

/* hci_check_loss of a CHECK_FLUX, where they have it. */
double hci_check_loss_beside_magnets(const check_relation *relation, check_value value, double share);

/* The data do not have it. */
extern const check_value HCI_CHECK_NONE;

check_value hci_check_found(double found);                 /* with the usual tolerance */
check_value hci_check_ratio_of(double top, double bottom); /* HCI_CHECK_NONE unless bottom > 0 */
double hci_check_or_zero(double x);                        /* 0 for NAN */

/* Least squares of `top` over `bottom` through the origin, over the recordings. Starts from {0}. */
typedef struct {
    double cross, square, other, unknown;
} check_fit;

/* unknown: what may be missing in `bottom`, in the measure of its usual tolerance: such a recording counts
 * less. */
void hci_check_fit_add(check_fit *x, double top, double bottom, double unknown);
check_value hci_check_fit_value(const check_fit *x);

/* ---- with effects that the machine folder may lack */

/* Over the recordings, y = x (factor + deviation) + Σ b_j z_j: what was measured, what the tables make of it,
 * and what reluctance, friction and their like could add, each b_j being normal with variance 1. So an effect
 * that would do in the place of a wrong factor widens the tolerance of that factor, and one that acts
 * otherwise in another recording does not. Friction only takes torque away: the first effects are never
 * negative. Starts from {0}. */
enum { CHECK_ONE_SIDED = 5, CHECK_MOST_EFFECTS = 7, CHECK_UNKNOWNS = 1 + CHECK_MOST_EFFECTS };

typedef struct {
    double matrix[CHECK_UNKNOWNS * CHECK_UNKNOWNS], right[CHECK_UNKNOWNS];
    size_t recordings;
} check_effects_fit;

/* z: [CHECK_MOST_EFFECTS], in the unit of y. sigma: above 0, of this recording alone. */
void hci_check_effects_add(check_effects_fit *fit, double y, double x, const double z[], double sigma);

/* b: [CHECK_MOST_EFFECTS], for a factor of 1. False, and b undefined, where they are not told. */
bool hci_check_effects_beside_one(const check_effects_fit *fit, double b[]);

/* The factor; HCI_CHECK_NONE without recordings. tolerance: of the relation. */
check_value hci_check_effects_value(const check_effects_fit *fit, double tolerance);

#endif
