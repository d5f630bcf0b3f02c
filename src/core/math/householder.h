/* Householder reflections H = I − τ (1, v)(1, v)ᵀ of a head element and a tail vector, which need not be
 * neighbours. */
#ifndef HCI_SRC_CORE_MATH_HOUSEHOLDER_H
#define HCI_SRC_CORE_MATH_HOUSEHOLDER_H

#include "core/math/vector.h"

/* Chooses H so that H (head, tail) = (β, 0) with β = −sign(head) ‖(head, tail)‖, which cancels nothing.
 * head: out β; tail: out v. Returns τ, 0 for H = I. The squares must neither overflow nor all underflow. */
static inline double hci_householder(double *head, size_t n, double *tail)
{
    const double square = hci_vector_dot(n, tail, tail), alpha = *head;
    if (square == 0.0) return 0.0;
    const double beta = -copysign(sqrt(alpha * alpha + square), alpha);
    for (size_t i = 0; i < n; i++)
        tail[i] /= alpha - beta;
    *head = beta;
    return (beta - alpha) / beta;
}

/* (head, tail) ← H (head, tail) */
static inline void hci_householder_apply(double tau, size_t n, const double *v, double *head, double *tail)
{
    const double t = tau * (*head + hci_vector_dot(n, v, tail));
    *head -= t;
    hci_vector_add(n, -t, v, tail);
}

#endif
