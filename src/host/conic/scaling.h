/* The cone of a conic program and its scaling: the nonnegative orthant and second-order cones (theory.md,
 * section 15).
 *
 * A vector of the cone has first `linear` entries that are each not negative, then the second-order cones of
 * `size` entries with u_0 >= |u_1 … |, then `after` entries that are not negative again. */
#ifndef HCI_SRC_HOST_CONIC_SCALING_H
#define HCI_SRC_HOST_CONIC_SCALING_H

#include <stddef.h>

typedef struct {
    size_t linear, cones, after;
    const size_t *size; /* of each second-order cone */
    size_t entries;     /* of a vector: all of these together */
} hci_cone;

/* The scaling of Nesterov and Todd: W symmetric with W z = W⁻¹ s = λ. */
typedef struct {
    const hci_cone *cone;
    double *w;     /* entries: of a linear one √(s/z), of a second-order cone the vector w̄ */
    double *eta;   /* one for each second-order cone: the factor before it */
    double *point; /* entries: λ */
} hci_cone_scaling;

/* Fills a cone's `entries` and returns the degree: linear entries, and one for each second-order cone. */
size_t hci_cone_degree(hci_cone *cone);

/* Fills the scaling of two vectors inside the cone. */
void hci_cone_scale(const hci_cone_scaling *scaling, const double *s, const double *z);

/* out = W u or, with `inverse`, W⁻¹ u; out may be u. */
void hci_cone_apply(const hci_cone_scaling *scaling, int inverse, const double *u, double *out);

/* The block of one second-order cone in hci_cone_apply: its first entry is `at`. u: its entries, in place. */
void hci_cone_apply_block(const hci_cone_scaling *scaling, size_t k, size_t at, int inverse, double *u);

/* out = u ∘ v, the product of the cone: u v of linear entries, (u·v, u_0 v_1 + v_0 u_1) of the others. */
void hci_cone_product(const hci_cone *cone, const double *u, const double *v, double *out);

/* out with λ ∘ out = d; out may be d. */
void hci_cone_divide(const hci_cone *cone, const double *lambda, const double *d, double *out);

/* u += t e, e the unit of the cone: 1 in linear entries and at the head of a second-order cone. */
void hci_cone_add_unit(const hci_cone *cone, double t, double *u);

/* The least t with u + t e in the cone; negative inside of it. */
double hci_cone_depth(const hci_cone *cone, const double *u);

/* The smallest product of s + t ds with z + t dz in any part of the cone: of a second-order cone the root of
 * both hyperbolic squares. At the centre all are alike. 0 where one of both is outside. */
double hci_cone_least_product(const hci_cone *cone, const double *const s_and_ds[2],
                              const double *const z_and_dz[2], double t);

/* The largest step t <= most with u + t d in the cone, u inside of it. */
double hci_cone_step(const hci_cone *cone, const double *u, const double *d, double most);

#endif
