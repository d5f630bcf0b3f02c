/* What must hold among the three phases of a recording. */
#include <math.h>

#include "host/check/relations/relations.h"

static check_value current_sum(const check_data *data, const check_interpretation *as, const check_model *m)
{
    double worst = NAN;
    (void)as, (void)m;
    for (size_t k = 0; k < data->runs && !data->has_neutral; ++k)
        if (hci_check_has_vector_current(data, &data->run[k])) worst = fmax(worst, data->run[k].current_sum);
    return hci_check_found(worst);
}

static check_value current_balance(const check_data *data, const check_interpretation *as,
                                   const check_model *m)
{
    double worst = NAN;
    (void)as, (void)m;
    for (size_t k = 0; k < data->runs; ++k)
        if (hci_check_has_vector_current(data, &data->run[k]))
            worst = fmax(worst, data->run[k].current_balance);
    return hci_check_found(worst);
}

static check_value voltage_balance(const check_data *data, const check_interpretation *as,
                                   const check_model *m)
{
    double worst = NAN;
    (void)as, (void)m;
    for (size_t k = 0; k < data->runs; ++k)
        worst = fmax(worst, data->run[k].voltage_balance);
    return hci_check_found(worst);
}

/* Both are the vector of one current, in whatever frame. */
static check_value phase_ratio(const check_data *data, const check_interpretation *as, const check_model *m)
{
    (void)m;
    for (size_t k = 0; k < data->runs; ++k) {
        const check_run *r = &data->run[k];
        if (r->has_dq && isfinite(r->phase_ratio) && hci_check_has_current(data, r))
            return hci_check_found(r->phase_ratio / fabs(as->current * as->dq));
    }
    return HCI_CHECK_NONE;
}

/* ---- the list */

static const check_relation LIST[] = {
    {"current_sum", "ia + ib + ic over the currents (rms)", CHECK_SHARE, 0.0, 0.05, 3.0, current_sum,
     "a recording of three phase currents", ""},
    {"phase_ratio", "phase currents over i_d and i_q, amplitudes", CHECK_RATIO, 1.0, 0.04, 9.0, phase_ratio,
     "a recording of phase currents beside i_d and i_q", ""},
    {"current_balance", "largest over smallest phase current", CHECK_MOST, 1.1, 0.1, 3.0, current_balance,
     "a recording of three phase currents", ""},
    {"voltage_balance", "largest over smallest phase voltage", CHECK_MOST, 1.1, 0.1, 3.0, voltage_balance,
     "a recording of three phase voltages", ""},
};
const check_relation_list HCI_CHECK_PHASE_RELATIONS = {LIST, sizeof LIST / sizeof *LIST};
