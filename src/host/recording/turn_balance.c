#include "host/recording/turn_balance.h"

#include <math.h>

#include "hci/math/harmonic.h"

#define OWN_SWING (2.0 * HCI_PI * 20.0) /* rad/s, of a rotor in its own cogging torque */
#define TENTH     0.1
#define TOLD      0.1 /* of an inertia, its standard error */
#define EXPLAINED 0.5 /* of what currents differ by, rms, that an inertia may leave */
#define SEEN      0.3 /* the same, to tell anything of one that is declared */
#define SURE      3.0 /* standard errors */
#define ERRORS    2.0 /* of an acceleration that does not stand out */

enum { MOST_WAYS = 16, LEAST_COORDINATES = 4 };

/* ---- the inertia that makes ways agree ---- */

typedef struct {
    const hci_way *way[MOST_WAYS];
    size_t count, highest;
} way_list;

static void add_ways(way_list *l, const hci_turn_ways *ways)
{
    if (l->count == 0 || ways->highest < l->highest) l->highest = ways->highest;
    for (int d = 0; d < 2; ++d)
        if (ways->way[d].any && l->count < MOST_WAYS) l->way[l->count++] = &ways->way[d];
}

/* Sums over ways and both coordinates of an order, about the mean of the ways: α², α k i, (k i)². */
typedef struct {
    double alpha2, product, made2, coordinates;
} difference_sums;

static void add_coordinate(const way_list *l, const double *alpha, const double *made_Nm, difference_sums *s)
{
    double mean_alpha = 0.0, mean_Nm = 0.0;
    const double count = (double)l->count;
    for (size_t g = 0; g < l->count; ++g)
        mean_alpha += alpha[g] / count, mean_Nm += made_Nm[g] / count;
    for (size_t g = 0; g < l->count; ++g) {
        const double da = alpha[g] - mean_alpha, dm = made_Nm[g] - mean_Nm;
        s->alpha2 += da * da;
        s->product += da * dm;
        s->made2 += dm * dm;
    }
    s->coordinates += count - 1.0;
}

static bool moves(const way_list *l, size_t k)
{
    for (size_t g = 0; g < l->count; ++g)
        if (l->way[g]->order[k].time_s.stands_out) return true;
    return false;
}

static void add_order(const way_list *l, size_t k, double constant, difference_sums *s)
{
    double alpha[2][MOST_WAYS], made_Nm[2][MOST_WAYS];
    for (size_t g = 0; g < l->count; ++g) {
        const hci_way_order *o = &l->way[g]->order[k];
        alpha[0][g] = o->alpha_sine, alpha[1][g] = o->alpha_cosine;
        made_Nm[0][g] = constant * o->iq_A.sine, made_Nm[1][g] = constant * o->iq_A.cosine;
    }
    add_coordinate(l, alpha[0], made_Nm[0], s);
    add_coordinate(l, alpha[1], made_Nm[1], s);
}

double hci_balance_inertia(const hci_turn_ways *ways, size_t count, double constant, double *std_error)
{
    way_list l = {.count = 0};
    difference_sums s = {0.0, 0.0, 0.0, 0.0};
    for (size_t k = 0; k < count; ++k) {
        if (fabs(ways[k].scale - ways[0].scale) > 0.0) return 0.0;
        add_ways(&l, &ways[k]);
    }
    for (size_t k = 1; k <= l.highest && l.count > 1; ++k)
        if (moves(&l, k)) add_order(&l, k, constant, &s);
    if (!(s.alpha2 > 0.0) || !(s.product > 0.0)) return 0.0;
    const double inertia = s.product / s.alpha2, left = fmax(s.made2 - inertia * s.product, 0.0);
    const double error = sqrt(left / (s.coordinates - 1.0) / s.alpha2);
    if (std_error) *std_error = error;
    return error < TOLD * inertia && left < EXPLAINED * EXPLAINED * s.made2 ? inertia : 0.0;
}

/* ---- beside an inertia that is declared ---- */

bool hci_balance_bounds(const hci_turn_ways *ways, double constant, double *least_kgm2, double *most_kgm2)
{
    way_list l = {.count = 0};
    difference_sums s = {0.0, 0.0, 0.0, 0.0};
    add_ways(&l, ways);
    for (size_t k = 1; k <= l.highest && l.count > 1; ++k)
        if (moves(&l, k)) add_order(&l, k, constant, &s);
    if (!(s.product > 0.0) || !(s.coordinates > LEAST_COORDINATES)) return false;
    const double inertia = s.product / s.alpha2, left = fmax(s.made2 - inertia * s.product, 0.0);
    const double error = sqrt(left / (s.coordinates - 1.0) / s.alpha2) / inertia;
    if (!(error < SEEN)) return false;
    *least_kgm2 = inertia * (1.0 - SURE * error);
    *most_kgm2 = s.made2 / s.product * (1.0 + SURE * error);
    return true;
}

/* ---- without an inertia ---- */

/* At most, rad/s². */
static double acceleration_of(const hci_turn_ways *ways, const hci_way *way, size_t k)
{
    const hci_way_order *o = &way->order[k];
    const double phi_rate = ways->scale * way->speed_rad_per_s, n = (double)k;
    if (o->time_s.stands_out) return hypot(o->alpha_sine, o->alpha_cosine);
    return fabs(n * n * phi_rate * phi_rate * phi_rate) / ways->scale * ERRORS * o->time_s.std_error;
}

bool hci_balance_needs_inertia(const hci_turn_ways *ways)
{
    for (int d = 0; d < 2; ++d)
        for (size_t j = 0; j < ways->way[d].count; ++j) {
            const size_t k = ways->way[d].seen[j];
            const double events = ways->scale * (double)k;
            if (acceleration_of(ways, &ways->way[d], k) * events > TENTH * OWN_SWING * OWN_SWING) return true;
        }
    return false;
}

double hci_balance_limit(const hci_turn_ways *ways, double constant)
{
    double alpha2 = 0.0, made2 = 0.0;
    for (int d = 0; d < 2; ++d)
        for (size_t j = 0; j < ways->way[d].count; ++j) {
            const size_t k = ways->way[d].seen[j];
            const hci_way_order *o = &ways->way[d].order[k];
            const double alpha = acceleration_of(ways, &ways->way[d], k);
            const double made_Nm = constant * hypot(o->iq_A.sine, o->iq_A.cosine);
            alpha2 += alpha * alpha;
            made2 += made_Nm * made_Nm;
        }
    return alpha2 > 0.0 ? TENTH * sqrt(made2 / alpha2) : (double)INFINITY;
}
