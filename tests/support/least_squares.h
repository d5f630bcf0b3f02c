/* Least squares for tests that compare with them: systems of a few unknowns by Gauss and Jordan. Prefix ref_.
 */
#ifndef LEAST_SQUARES_H
#define LEAST_SQUARES_H

/* In place: the first m of `width` columns of a to the unit matrix, so that a right side becomes the solution
 * and a unit matrix the inverse. a: m rows, `stride` numbers each; its pivots must not be 0, as of XᵀX. */
static inline void ref_reduce(double *a, int m, int width, int stride)
{
    for (int p = 0; p < m; ++p) {
        const double pivot = a[p * stride + p];
        for (int j = 0; j < width; ++j)
            a[p * stride + j] /= pivot;
        for (int i = 0; i < m; ++i) {
            const double factor = a[i * stride + p];
            for (int j = 0; j < width && i != p; ++j)
                a[i * stride + j] -= factor * a[p * stride + j];
        }
    }
}

#endif
