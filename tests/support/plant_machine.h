/* Machines for the tests and the benchmark of the plant, written twice: as the library's lists, and as plain
 * formulas over the three phases that take nothing from it.
 *
 *     e_s  = Σ E sin(μ(θ − 2πs/3) + φ)        T_cog = Σ C sin(mθ + γ)
 *     L_ss = Σ A cos(m(θ − 2πs/3))          M_rt  = Σ B cos(m(θ − 2πs/3)), s the phase that is neither r nor
 * t */
#ifndef PLANT_MACHINE_H
#define PLANT_MACHINE_H

#include <math.h>
#include <stddef.h>

#include "hci/drive/plant.h"
#include "support/draws.h"

enum { PM_MOST = 12 };

typedef struct {
    double order, amplitude, phase;
} pm_term;

typedef struct {
    int pole_pairs;
    size_t emf_count, cogging_count, inductance_count;
    pm_term emf[PM_MOST];
    pm_term cogging[PM_MOST];
    double order[PM_MOST], self[PM_MOST], mutual[PM_MOST];
} pm_machine;

/* clang-format off */

/* Interior magnets, 8 N·m: the size of the machine of the second paper. */
static const pm_machine PM_INTERIOR = {
    .pole_pairs = 2,
    .emf_count = 6,
    .cogging_count = 3,
    .inductance_count = 6,
    .emf = {{1, 0.892, 0}, {3, 0.125, 0}, {5, 0.0037, 2.9}, {7, 0.0236, 0.3}, {11, 0.0844, -0.1}, {13, 0.0131, 1}},
    .cogging = {{12, 0.157, 3.1}, {24, 0.122, 3.2}, {36, 0.017, 0.4}},
    .order  = {0,        2,       4,       6,       8,       12},
    .self   = {0.0792,  -0.01476, 0.00068, 0.00082, 0.00071, 0.00064},
    .mutual = {-0.0274, -0.01205, 0.00076, 0.00003, 0.00056, 0.00025},
};

/* The same with low orders only. */
static const pm_machine PM_SMOOTH = {
    .pole_pairs = 2,
    .emf_count = 2,
    .cogging_count = 1,
    .inductance_count = 2,
    .emf = {{1, 0.892, 0}, {5, 0.037, 2.5}},
    .cogging = {{6, 0.2, 0.7}},
    .order  = {0,        2},
    .self   = {0.0792,  -0.01476},
    .mutual = {-0.0274, -0.01205},
};

/* Surface magnets, sinusoidal: L_d = L_q = 20 mH, amplitude of the back-EMF 0.9 N·m/A. */
static const pm_machine PM_SINE = {
    .pole_pairs = 3,
    .emf_count = 1,
    .inductance_count = 1,
    .emf = {{1, 0.9, 0}},
    .self = {0.015},
    .mutual = {-0.005},
};

/* clang-format on */

/* ---- formulas ---- */

static inline double pm_emf(const pm_machine *m, int s, double theta)
{
    double sum = 0.0;
    for (size_t k = 0; k < m->emf_count; ++k)
        sum +=
            m->emf[k].amplitude * sin(m->emf[k].order * (theta - 2.0 * REF_PI * s / 3.0) + m->emf[k].phase);
    return sum;
}

static inline double pm_cogging(const pm_machine *m, double theta)
{
    double sum = 0.0;
    for (size_t k = 0; k < m->cogging_count; ++k)
        sum += m->cogging[k].amplitude * sin(m->cogging[k].order * theta + m->cogging[k].phase);
    return sum;
}

/* L_rt, and its slope by the electrical angle. */
static inline double pm_inductance(const pm_machine *m, int r, int t, double theta)
{
    const double *amplitude = r == t ? m->self : m->mutual;
    const double x = theta - 2.0 * REF_PI * (r == t ? r : 3 - r - t) / 3.0;
    double sum = 0.0;
    for (size_t k = 0; k < m->inductance_count; ++k)
        sum += amplitude[k] * cos(m->order[k] * x);
    return sum;
}

static inline double pm_inductance_slope(const pm_machine *m, int r, int t, double theta)
{
    const double *amplitude = r == t ? m->self : m->mutual;
    const double x = theta - 2.0 * REF_PI * (r == t ? r : 3 - r - t) / 3.0;
    double sum = 0.0;
    for (size_t k = 0; k < m->inductance_count; ++k)
        sum -= m->order[k] * amplitude[k] * sin(m->order[k] * x);
    return sum;
}

/* ---- lists ---- */

typedef struct {
    hci_wave emf[PM_MOST];
    hci_harmonic cogging[PM_MOST];
    hci_inductance inductance[PM_MOST];
    hci_inductance_slope slope[PM_MOST];
    hci_machine machine;
    hci_plant_inductance given;
} pm_lists;

static inline void pm_inductance_term(const pm_machine *m, size_t k, hci_inductance *term)
{
    static const int mutual_of[3] = {HCI_BC, HCI_CA, HCI_AB};
    term->order = m->order[k];
    for (int s = 0; s < 3; ++s) {
        const double shift = m->order[k] * 2.0 * REF_PI * s / 3.0;
        term->cosine[HCI_AA + s] = m->self[k] * cos(shift);
        term->sine[HCI_AA + s] = m->self[k] * sin(shift);
        term->cosine[mutual_of[s]] = m->mutual[k] * cos(shift);
        term->sine[mutual_of[s]] = m->mutual[k] * sin(shift);
    }
}

/* Fills lists whose pointers stay within the struct: do not copy it. The slopes are those of the inductances.
 */
static inline void pm_list(const pm_machine *m, pm_lists *lists)
{
    for (size_t k = 0; k < m->emf_count; ++k)
        lists->emf[k] = hci_wave_polar(m->emf[k].order, hci_sequence_of_order(m->emf[k].order),
                                       m->emf[k].amplitude, m->emf[k].phase);
    for (size_t k = 0; k < m->cogging_count; ++k)
        lists->cogging[k] =
            hci_harmonic_polar(m->cogging[k].order, m->cogging[k].amplitude, m->cogging[k].phase);
    for (size_t k = 0; k < m->inductance_count; ++k) {
        pm_inductance_term(m, k, &lists->inductance[k]);
        const hci_inductance *l = &lists->inductance[k];
        lists->slope[k].order = l->order;
        for (size_t q = 0; q < HCI_PHASE_MATRIX; ++q) {
            lists->slope[k].sine[q] = -m->pole_pairs * l->order * l->cosine[q];
            lists->slope[k].cosine[q] = m->pole_pairs * l->order * l->sine[q];
        }
    }
    lists->machine = (hci_machine){m->pole_pairs,    lists->emf,   m->emf_count,       lists->cogging,
                                   m->cogging_count, lists->slope, m->inductance_count};
    lists->given = (hci_plant_inductance){lists->inductance, m->inductance_count, 0.0, 0.0};
}

#endif
