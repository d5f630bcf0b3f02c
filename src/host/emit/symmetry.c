/* In: waves (n, σ), i_s = A sin(nθ − 2πσs/3 + γ). A sector of 1/S turn later wave n has gained 2πn/S, and the
 * phase moved on by r has lost 2πσr/3: the currents are the same, up to a sign that alternates, where
 * n/S + σr/3 is a whole number (plus a half). */
#include "host/emit/symmetry.h"

#include <math.h>

#include "host/numeric/divisor.h"

/* The least sector first. With 1/6 the next one holds (−i_b, −i_c, −i_a), with 1/3 (i_c, i_a, i_b). */
static const hci_symmetry PHASES[] = {{6, 1, 1}, {3, 2, 0}, {2, 0, 1}};

static bool is_whole(double x)
{
    return fabs(x - floor(x + 0.5)) < 1e-9;
}

static bool wave_has(const hci_wave *w, const hci_symmetry *s)
{
    return is_whole(w->order / s->sectors + w->sequence * (double)s->rotation / 3.0 + 0.5 * s->alternates);
}

static bool all_have(const hci_wave *waves, size_t count, const hci_symmetry *s)
{
    for (size_t k = 0; k < count; ++k)
        if (!wave_has(&waves[k], s)) return false;
    return true;
}

static size_t common_cycles(const hci_tabulation *t, const hci_wave *waves, size_t count, size_t divisor)
{
    for (size_t k = 0; k < count; ++k) {
        const double cycles = fabs(waves[k].order - waves[k].sequence) * (double)t->period_turns;
        divisor = hci_common_divisor(divisor, (size_t)floor(cycles + 0.5));
    }
    return divisor;
}

hci_symmetry hci_symmetry_of(const hci_tabulation *t)
{
    hci_symmetry none = {1, 0, 0};
    if (t->frame == HCI_TABLE_DQ) {
        const size_t constant = common_cycles(t, t->constant, t->constant_count, 0);
        const size_t all = common_cycles(t, t->per_Nm, t->per_Nm_count, constant);
        if (all > 0) none.sectors = (uint32_t)all;
        return none;
    }
    for (size_t k = 0; k < sizeof PHASES / sizeof *PHASES && t->period_turns == 1; ++k)
        if (all_have(t->constant, t->constant_count, &PHASES[k]) &&
            all_have(t->per_Nm, t->per_Nm_count, &PHASES[k]))
            return PHASES[k];
    return none;
}
