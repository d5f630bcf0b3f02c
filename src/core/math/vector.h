/* The level-1 kernels under the dense and Fourier modules: contiguous, without a heap, vectorised by the
 * compiler.
 *
 * A fixed number of lanes is what lets gcc -O2 vectorise: its cost model needs a known trip count, and a
 * sum may be reordered only by whoever wrote it down in lanes. */
#ifndef HCI_SRC_CORE_MATH_VECTOR_H
#define HCI_SRC_CORE_MATH_VECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#define HCI_LANES 8

/* xᵀy */
static inline double hci_vector_dot(size_t n, const double *restrict x, const double *restrict y)
{
    const size_t whole = n - n % HCI_LANES;
    double lane[HCI_LANES] = {0.0};
    double sum = 0.0;
    for (size_t i = 0; i < whole; i += HCI_LANES)
        for (size_t r = 0; r < HCI_LANES; r++)
            lane[r] += x[i + r] * y[i + r];
    for (size_t i = whole; i < n; i++)
        sum += x[i] * y[i];
    for (size_t r = 0; r < HCI_LANES; r++)
        sum += lane[r];
    return sum;
}

/* y += t x */
static inline void hci_vector_add(size_t n, double t, const double *restrict x, double *restrict y)
{
    const size_t whole = n - n % HCI_LANES;
    for (size_t i = 0; i < whole; i += HCI_LANES)
        for (size_t r = 0; r < HCI_LANES; r++)
            y[i + r] += t * x[i + r];
    for (size_t i = whole; i < n; i++)
        y[i] += t * x[i];
}

/* y += t_0 x_0 + t_1 x_1 + t_2 x_2 + t_3 x_3, one after the other: what is loaded of y is used four times. */
static inline void hci_vector_add_four(size_t n, const double t[4], const double *const x[4],
                                       double *restrict y)
{
    const double *restrict a = x[0], *restrict b = x[1], *restrict c = x[2], *restrict d = x[3];
    const size_t whole = n - n % HCI_LANES;
    for (size_t i = 0; i < whole; i += HCI_LANES)
        for (size_t r = 0; r < HCI_LANES; r++)
            y[i + r] = (((y[i + r] + t[0] * a[i + r]) + t[1] * b[i + r]) + t[2] * c[i + r]) + t[3] * d[i + r];
    for (size_t i = whole; i < n; i++)
        y[i] = (((y[i] + t[0] * a[i]) + t[1] * b[i]) + t[2] * c[i]) + t[3] * d[i];
}

/* Σ|x| */
static inline double hci_vector_norm_1(size_t n, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += fabs(x[i]);
    return sum;
}

/* First position of the largest |x|; n > 0. */
static inline size_t hci_vector_largest(size_t n, const double *x)
{
    size_t largest = 0;
    for (size_t i = 1; i < n; i++)
        if (fabs(x[i]) > fabs(x[largest])) largest = i;
    return largest;
}

static inline bool hci_vector_finite(size_t n, const double *x)
{
    double sum = 0.0; /* 0·x is NaN for an infinite x and for NaN, else 0 */
    for (size_t i = 0; i < n; i++)
        sum += 0.0 * x[i];
    return sum == 0.0;
}

static inline void hci_swap(double *x, double *y)
{
    const double t = *x;
    *x = *y;
    *y = t;
}

#endif
