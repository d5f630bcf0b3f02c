#include "host/check/own_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/check/data/dead_torque.h"
#include "host/check/relations/relations.h"

/* In noise of a sample: by so much the torques differ that the declared machine makes. */
#define WOULD_BE 20.0

/* q-axis current as declared, in A; NAN where nothing tells. */
static double q_current_of(const check_data *data, const check_run *r, const check_interpretation *as,
                           const check_model *m)
{
    if (hci_check_has_vector_current(data, r)) return hci_check_current_of(r, as, m).im;
    return hci_check_has_current(data, r) ? (double)NAN : 0.0;
}

/* The first recording with a current where all torques are noise; NULL: one answers, or too little flows for
 * that to be seen. */
static const check_run *find_dead_torque(const check_data *data)
{
    const check_interpretation as = hci_check_as_declared();
    const check_model m = hci_check_model_of(data, &as);
    const check_run *first = NULL;
    double noise_Nm, least_A = INFINITY, most_A = -INFINITY;
    if (!hci_check_torques_are_noise(data, &noise_Nm)) return NULL;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (!hci_check_torque_is_measured(r)) continue;
        const double q_A = q_current_of(data, r, &as, &m);
        if (isnan(q_A)) return NULL;
        if (!first && hci_check_has_vector_current(data, r)) first = r;
        least_A = fmin(least_A, q_A);
        most_A = fmax(most_A, q_A);
    }
    return 1.5 * m.emf_Nm_per_A * (most_A - least_A) > WOULD_BE * noise_Nm ? first : NULL;
}

void hci_check_add_dead_torque(const check_data *data, hci_check *check)
{
    const check_run *r = find_dead_torque(data);
    if (!r) return;
    hci_check_finding f = hci_check_finding_at("dead_torque", &r->torque_cell,
                                               "the torques of recordings with different currents");
    snprintf(f.words, sizeof f.words,
             "the torque does not answer to the current: it is the same noise in all recordings (no cable, a "
             "sensor without supply, another column), and tells nothing of the machine");
    snprintf(f.should_be, sizeof f.should_be, "a torque that was measured, or no column of it");
    check->findings = 0; /* of torques */
    hci_check_put_first(check, &f);
}
