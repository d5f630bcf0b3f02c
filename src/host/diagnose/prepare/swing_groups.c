#include "host/diagnose/prepare/swing_groups.h"

#include <math.h>

#define ERRORS 4.0  /* standard errors by which frequencies may differ and are one */
#define SHARE  3e-3 /* or share of them */

static double frequency_of(const hci_swing *x, bool of_turn)
{
    return of_turn ? x->frequency_Hz / x->turn_Hz : x->frequency_Hz;
}

static double error_of(const hci_swing *x, bool of_turn)
{
    return of_turn ? x->error_Hz / x->turn_Hz : x->error_Hz;
}

bool hci_swing_is_of(const hci_swing *x, const hci_swing_group *group)
{
    const double off = fabs(frequency_of(x, group->of_turn) - group->frequency);
    return off < fmax(SHARE * group->frequency, ERRORS * hypot(error_of(x, group->of_turn), group->error));
}

/* Whether an earlier group has it. */
static bool is_taken(const hci_swing_groups *groups, const hci_swing *x)
{
    for (size_t k = 0; k < groups->count; ++k)
        if (hci_swing_is_of(x, &groups->group[k])) return true;
    return false;
}

/* The group about a swing: of all that are like it and in no other. */
static hci_swing_group group_about(const hci_run_statistics *statistics, size_t runs,
                                   const hci_swing_groups *others, const hci_swing *about, bool of_turn)
{
    hci_swing_group g = {of_turn, frequency_of(about, of_turn), error_of(about, of_turn), 0.0, 0};
    double weights = 0.0, sum = 0.0, amplitude = 0.0;
    for (size_t r = 0; r < runs; ++r)
        for (size_t k = 0; k < statistics[r].swings; ++k) {
            const hci_swing *x = &statistics[r].swing[k];
            const double weight = pow(error_of(x, of_turn), -2.0);
            if (!hci_swing_is_of(x, &g) || is_taken(others, x)) continue;
            weights += weight;
            sum += weight * frequency_of(x, of_turn);
            amplitude += hypot(x->cosine_Nm, x->sine_Nm);
            ++g.runs;
        }
    g.frequency = sum / weights;
    g.error = 1.0 / sqrt(weights);
    g.amplitude_Nm = amplitude / (double)g.runs;
    return g;
}

/* The group of most runs that no other one has; by the frequency where both are as good. */
static hci_swing_group largest_find(const hci_run_statistics *statistics, size_t runs,
                                    const hci_swing_groups *others)
{
    hci_swing_group best = {.runs = 0};
    for (int of_turn = 0; of_turn < 2; ++of_turn)
        for (size_t r = 0; r < runs; ++r)
            for (size_t k = 0; k < statistics[r].swings; ++k) {
                const hci_swing *x = &statistics[r].swing[k];
                if (is_taken(others, x)) continue;
                const hci_swing_group g = group_about(statistics, runs, others, x, of_turn != 0);
                if (g.runs > best.runs) best = g;
            }
    return best;
}

hci_swing_groups hci_swing_groups_find(const hci_run_statistics *statistics, size_t runs)
{
    hci_swing_groups groups = {.count = 0};
    while (groups.count < HCI_MOST_SWINGS) {
        const hci_swing_group g = largest_find(statistics, runs, &groups);
        if (g.runs == 0) break;
        groups.group[groups.count++] = g;
    }
    return groups;
}
