/* A = L Lᵀ, left-looking: column k of L is what is left of column k of A,
 *
 *     l_kk² = a_kk − Σ l_kj²,     l_ik = (a_ik − Σ l_ij l_kj)/l_kk        j < k
 */
#include <float.h>

#include "core/math/vector.h"
#include "hci/math/dense.h"

/* Takes columns j < k out of column k. */
static void columns_take(size_t n, double *a, size_t k)
{
    double *column = a + k + k * n;
    size_t j = 0;
    for (; j + 4 <= k; j += 4) {
        const double *x = a + k + j * n, *const of[4] = {x, x + n, x + 2 * n, x + 3 * n};
        const double t[4] = {-of[0][0], -of[1][0], -of[2][0], -of[3][0]};
        hci_vector_add_four(n - k, t, of, column);
    }
    for (; j < k; j++)
        hci_vector_add(n - k, -a[k + j * n], a + k + j * n, column);
}

hci_status hci_cholesky_factor(size_t n, double *a)
{
    for (size_t k = 0; k < n; k++) {
        double *column = a + k * n;
        const double diagonal = column[k];
        columns_take(n, a, k);

        /* what the subtraction leaves of a dependent column is rounding: n ε a_kk */
        if (!(column[k] > (double)n * DBL_EPSILON * diagonal)) return HCI_ERROR_SINGULAR;
        const double root = sqrt(column[k]);
        for (size_t i = k; i < n; i++)
            column[i] /= root;
    }
    return HCI_OK;
}

/* x ← L⁻ᵀ L⁻¹ x */
void hci_cholesky_solve(size_t n, const double *l, double *x)
{
    for (size_t k = 0; k < n; k++) {
        x[k] /= l[k + k * n];
        hci_vector_add(n - k - 1, -x[k], l + k * n + k + 1, x + k + 1);
    }
    for (size_t k = n; k-- > 0;)
        x[k] = (x[k] - hci_vector_dot(n - k - 1, l + k * n + k + 1, x + k + 1)) / l[k + k * n];
}
