/* Anderson's acceleration (D. G. Anderson, 1965; H. F. Walker and P. Ni, 2011, with five steps). In: points
 * and what the iteration answers to them; out: better points. Where a bare iteration swings or diverges, the
 * combination of the last steps that would have made f = g − x least converges. */
#include "host/numeric/anderson.h"

#include <string.h>

#include "hci/math/dense.h"
#include "host/base/memory.h"

enum { MEMORY = 5 };

#define DEPENDENT 1e-10 /* columns of df that are dependent within this are left out */

void hci_anderson_release(hci_anderson *m)
{
    hci_memory_free(m->x);
    memset(m, 0, sizeof *m);
}

hci_status hci_anderson_reset(hci_anderson *m, size_t n)
{
    hci_anderson_release(m);
    m->x = hci_memory_new((3 + 3 * MEMORY) * n + hci_orthogonal_workspace(n, MEMORY) + MEMORY, sizeof *m->x);
    if (!m->x) return HCI_ERROR_MEMORY;
    m->f = m->x + n;
    m->dx = m->f + n;
    m->df = m->dx + MEMORY * n;
    m->a = m->df + MEMORY * n;
    m->b = m->a + MEMORY * n;
    m->work = m->b + n;
    m->n = n;
    return HCI_OK;
}

/* Takes x and f = g − x, and how they changed since the last step. */
static void remember(hci_anderson *m, const double *x, const double *g)
{
    const size_t n = m->n, last = (m->steps + MEMORY - 1) % MEMORY;
    for (size_t k = 0; k < n; ++k) {
        const double f = g[k] - x[k];
        if (m->steps > 0) {
            m->dx[last * n + k] = x[k] - m->x[k];
            m->df[last * n + k] = f - m->f[k];
        }
        m->x[k] = x[k];
        m->f[k] = m->b[k] = f;
    }
}

/* x ← x + f − Σ w_j (dx_j + df_j) with the weights of min ‖f − Σ w_j df_j‖ */
void hci_anderson_step(hci_anderson *m, double *x, const double *g)
{
    const size_t n = m->n, known = m->steps < MEMORY ? m->steps : MEMORY;
    size_t column[MEMORY];
    hci_orthogonal q = {.m = n, .n = known, .a = m->a, .column = column, .work = m->work};
    double weight[MEMORY] = {0.0}, work[MEMORY];
    remember(m, x, g);
    memcpy(m->a, m->df, known * n * sizeof *m->a);
    if (known > 0 && !hci_orthogonal_factor(&q, DEPENDENT, NULL))
        hci_orthogonal_solve(&q, m->b, weight, work);
    for (size_t k = 0; k < n; ++k) {
        x[k] = m->x[k] + m->f[k];
        for (size_t j = 0; j < known; ++j)
            x[k] -= weight[j] * (m->dx[j * n + k] + m->df[j * n + k]);
    }
    ++m->steps;
}
