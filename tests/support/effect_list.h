/* Lists of effects for tests, put together by names as in effects.csv, and a machine whose formulas stand
 * here once more. */
#ifndef EFFECT_LIST_H
#define EFFECT_LIST_H

#include <math.h>
#include <string.h>

#include "hci/effects/effect.h"
#include "support/draws.h"
#include "unity.h"

enum { EL_EFFECTS = 32, EL_TERMS = 96 };

typedef struct {
    hci_effect effect[EL_EFFECTS];
    hci_effect_term term[EL_EFFECTS][EL_TERMS];
    hci_effects list;
} el_list;

static inline size_t el_parameter(const hci_effect_type *type, const char *name)
{
    size_t k = 0;
    while (k < type->parameter_count && strcmp(type->parameter[k].name, name) != 0)
        ++k;
    TEST_ASSERT_TRUE_MESSAGE(k < type->parameter_count, name);
    return k;
}

static inline void el_add(el_list *l, const char *effect, const char *parameter, double order, double value)
{
    const hci_effect_type *type = hci_effect_type_find(effect);
    size_t k = 0;
    TEST_ASSERT_NOT_NULL_MESSAGE(type, effect);
    while (k < l->list.count && l->effect[k].type != type)
        ++k;
    if (k == l->list.count) {
        l->effect[k] = (hci_effect){type, l->term[k], 0};
        l->list = (hci_effects){l->effect, k + 1};
    }
    l->term[k][l->effect[k].count++] = (hci_effect_term){el_parameter(type, parameter), order, value, NAN};
}

/* ---- a machine, p = 3 ---- */

static inline double el_emf(int s, double theta)
{
    const double x = theta - 2.0 * REF_PI * s / 3.0;
    return 0.8 * sin(x + 0.1) + 0.06 * sin(5.0 * x - 0.4) + 0.03 * sin(7.0 * x + 1.1);
}

typedef struct {
    hci_wave emf[3];
    hci_harmonic cogging[1];
    hci_inductance_slope slope[1];
    hci_machine machine;
} el_machine;

static inline void el_machine_make(el_machine *m)
{
    memset(m, 0, sizeof *m);
    m->emf[0] = hci_wave_polar(1.0, 1, 0.8, 0.1);
    m->emf[1] = hci_wave_polar(5.0, -1, 0.06, -0.4);
    m->emf[2] = hci_wave_polar(7.0, 1, 0.03, 1.1);
    m->cogging[0] = hci_harmonic_polar(12.0, 0.05, 0.3);
    m->slope[0].order = 2.0;
    for (int q = 0; q < HCI_PHASE_MATRIX; ++q) {
        m->slope[0].sine[q] = 2e-3 * (q + 1);
        m->slope[0].cosine[q] = -1e-3 * (q - 2);
    }
    m->machine = (hci_machine){3, m->emf, 3, m->cogging, 1, m->slope, 1};
}

static inline hci_sample el_sample(uint64_t *seed)
{
    hci_sample x = {0};
    x.theta_m_rad = ref_uniform(seed, 0.0, 2.0 * REF_PI);
    x.speed_rad_per_s = ref_uniform(seed, -100.0, 100.0);
    for (int s = 0; s < 3; ++s) {
        x.i_abc[s] = ref_uniform(seed, -5.0, 5.0);
        x.change_A_per_s[s] = ref_uniform(seed, -500.0, 500.0);
    }
    for (int s = 0; s < 3; ++s)
        x.curvature_A_per_s2[s] = 100.0 * x.change_A_per_s[(s + 1) % 3];
    x.temperature_C = ref_uniform(seed, 20.0, 100.0);
    x.swing_rad_per_s = 60.0;
    return x;
}

#endif
