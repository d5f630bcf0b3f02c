#include "host/conic/scaling.h"

#include <math.h>
#include <stdbool.h>

#include "core/math/vector.h"

/* ---- walking over the blocks ---- */

static bool is_linear(const hci_cone *c, size_t i)
{
    return i < c->linear || i >= c->entries - c->after;
}

/* The next linear entry at or after i: the second-order cones are stepped over. */
static size_t linear_at(const hci_cone *c, size_t i)
{
    return is_linear(c, i) ? i : c->entries - c->after;
}

size_t hci_cone_degree(hci_cone *cone)
{
    cone->entries = cone->linear + cone->after;
    for (size_t k = 0; k < cone->cones; ++k)
        cone->entries += cone->size[k];
    return cone->linear + cone->after + cone->cones;
}

/* u_0² − |u_1|² without the loss of digits near the boundary. */
static double hyperbolic(size_t n, const double *u)
{
    const double length = sqrt(hci_vector_dot(n - 1, u + 1, u + 1));
    return (u[0] - length) * (u[0] + length);
}

/* ---- the scaling ---- */

static void scale_block(const hci_cone_scaling *x, size_t k, size_t at, const double *s, const double *z)
{
    const size_t n = x->cone->size[k];
    const double s_size = sqrt(hyperbolic(n, s)), z_size = sqrt(hyperbolic(n, z));
    const double half = sqrt(0.5 * (1.0 + hci_vector_dot(n, s, z) / (s_size * z_size)));
    double *w = x->w + at;
    for (size_t i = 0; i < n; ++i)
        w[i] = (s[i] / s_size + (i == 0 ? 1.0 : -1.0) * z[i] / z_size) / (2.0 * half);
    w[0] = sqrt(1.0 + hci_vector_dot(n - 1, w + 1, w + 1));
    x->eta[k] = sqrt(s_size / z_size);
}

void hci_cone_scale(const hci_cone_scaling *scaling, const double *s, const double *z)
{
    const hci_cone *c = scaling->cone;
    size_t at = c->linear;
    for (size_t i = linear_at(c, 0); i < c->entries; i = linear_at(c, i + 1))
        scaling->w[i] = sqrt(s[i] / z[i]);
    for (size_t k = 0; k < c->cones; at += c->size[k++])
        scale_block(scaling, k, at, s + at, z + at);
    hci_cone_apply(scaling, 0, z, scaling->point);
}

void hci_cone_apply_block(const hci_cone_scaling *scaling, size_t k, size_t at, int inverse, double *u)
{
    const size_t n = scaling->cone->size[k];
    const double *w = scaling->w + at, eta = inverse ? 1.0 / scaling->eta[k] : scaling->eta[k];
    const double along = hci_vector_dot(n - 1, w + 1, u + 1), sign = inverse ? -1.0 : 1.0;
    const double turn = sign * u[0] + along / (1.0 + w[0]);
    u[0] = eta * (w[0] * u[0] + sign * along);
    for (size_t i = 1; i < n; ++i)
        u[i] = eta * (u[i] + w[i] * turn);
}

void hci_cone_apply(const hci_cone_scaling *scaling, int inverse, const double *u, double *out)
{
    const hci_cone *c = scaling->cone;
    size_t at = c->linear;
    for (size_t i = 0; i < c->entries; ++i)
        out[i] = !is_linear(c, i) ? u[i] : inverse ? u[i] / scaling->w[i] : u[i] * scaling->w[i];
    for (size_t k = 0; k < c->cones; at += c->size[k++])
        hci_cone_apply_block(scaling, k, at, inverse, out + at);
}

/* ---- the product of the cone ---- */

void hci_cone_product(const hci_cone *cone, const double *u, const double *v, double *out)
{
    size_t at = cone->linear;
    for (size_t i = linear_at(cone, 0); i < cone->entries; i = linear_at(cone, i + 1))
        out[i] = u[i] * v[i];
    for (size_t k = 0; k < cone->cones; at += cone->size[k++]) {
        out[at] = hci_vector_dot(cone->size[k], u + at, v + at);
        for (size_t i = at + 1; i < at + cone->size[k]; ++i)
            out[i] = u[at] * v[i] + v[at] * u[i];
    }
}

void hci_cone_divide(const hci_cone *cone, const double *lambda, const double *d, double *out)
{
    size_t at = cone->linear;
    for (size_t i = linear_at(cone, 0); i < cone->entries; i = linear_at(cone, i + 1))
        out[i] = d[i] / lambda[i];
    for (size_t k = 0; k < cone->cones; at += cone->size[k++]) {
        const size_t n = cone->size[k];
        const double *l = lambda + at;
        const double along = hci_vector_dot(n - 1, l + 1, d + at + 1);
        const double head = (l[0] * d[at] - along) / hyperbolic(n, l);
        for (size_t i = 1; i < n; ++i)
            out[at + i] = (d[at + i] - head * l[i]) / l[0];
        out[at] = head;
    }
}

void hci_cone_add_unit(const hci_cone *cone, double t, double *u)
{
    size_t at = cone->linear;
    for (size_t i = linear_at(cone, 0); i < cone->entries; i = linear_at(cone, i + 1))
        u[i] += t;
    for (size_t k = 0; k < cone->cones; at += cone->size[k++])
        u[at] += t;
}

double hci_cone_depth(const hci_cone *cone, const double *u)
{
    double most = -HUGE_VAL;
    size_t at = cone->linear;
    for (size_t i = linear_at(cone, 0); i < cone->entries; i = linear_at(cone, i + 1))
        most = fmax(most, -u[i]);
    for (size_t k = 0; k < cone->cones; at += cone->size[k++])
        most = fmax(most, sqrt(hci_vector_dot(cone->size[k] - 1, u + at + 1, u + at + 1)) - u[at]);
    return most;
}

/* (u + t d)_0² − |(u + t d)_1|², 0 outside of the cone. */
static double moved_square(size_t n, const double *u, const double *d, double t)
{
    const double head = u[0] + t * d[0];
    double side = 0.0;
    for (size_t i = 1; i < n; ++i)
        side += (u[i] + t * d[i]) * (u[i] + t * d[i]);
    side = sqrt(side);
    return head > side ? (head - side) * (head + side) : 0.0;
}

double hci_cone_least_product(const hci_cone *cone, const double *const s[2], const double *const z[2],
                              double t)
{
    double least = HUGE_VAL;
    size_t at = cone->linear;
    for (size_t i = linear_at(cone, 0); i < cone->entries; i = linear_at(cone, i + 1))
        least = fmin(least, fmax(0.0, s[0][i] + t * s[1][i]) * fmax(0.0, z[0][i] + t * z[1][i]));
    for (size_t k = 0; k < cone->cones; at += cone->size[k++])
        least = fmin(least, sqrt(moved_square(cone->size[k], s[0] + at, s[1] + at, t) *
                                 moved_square(cone->size[k], z[0] + at, z[1] + at, t)));
    return least;
}

/* Where u + t d leaves a second-order cone: the first root of a t² + 2 b t + c above zero, in the form that
 * does not subtract numbers of like size. Of a vector inside of the cone b² >= a c whatever d is: what is
 * less is rounding, of a step through the tip. */
static double block_step(size_t n, const double *u, const double *d)
{
    const double a = hyperbolic(n, d), c = hyperbolic(n, u),
                 b = u[0] * d[0] - hci_vector_dot(n - 1, u + 1, d + 1), root = sqrt(fmax(0.0, b * b - a * c));
    if (a >= 0.0 && b >= 0.0) return HUGE_VAL;
    return b > 0.0 ? -(root + b) / a : c / (root - b);
}

double hci_cone_step(const hci_cone *cone, const double *u, const double *d, double most)
{
    size_t at = cone->linear;
    for (size_t i = linear_at(cone, 0); i < cone->entries; i = linear_at(cone, i + 1))
        if (d[i] < 0.0) most = fmin(most, -u[i] / d[i]);
    for (size_t k = 0; k < cone->cones; at += cone->size[k++])
        most = fmin(most, block_step(cone->size[k], u + at, d + at));
    return most;
}
