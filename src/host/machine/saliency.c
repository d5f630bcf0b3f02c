#include "host/machine/saliency.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/effects.h"
#include "hci/machine/torque.h"
#include "host/base/quote.h"
#include "host/machine/torque_constant.h"

enum { STEP_deg = 15, TURN_deg = 360 };

/* Of their mean: less is what a measurement of two equal ones may give. */
static const double DIFFERENCE = 0.01;

bool hci_is_salient(double inductance_d_H, double inductance_q_H)
{
    return fabs(inductance_d_H - inductance_q_H) > 0.5 * DIFFERENCE * (inductance_d_H + inductance_q_H);
}

/* An effect that is an inductance, or of higher degree in the currents than one. A file that cannot be read
 * is told by whoever needs it. */
static bool effects_have_it(const char *folder)
{
    hci_effects_data effects;
    bool found = false;
    if (hci_effects_read_machine(folder, &effects, NULL) != HCI_OK) return false;
    for (size_t k = 0; k < effects.list.count; ++k) {
        const hci_effect_type *type = effects.list.effect[k].type;
        found = found || type->beyond_quadratic || strcmp(type->parameter[0].unit, "H") == 0;
    }
    hci_effects_release(&effects);
    return found;
}

void hci_saliency_remark(const char *file, const char *folder, double inductance_d_H, double inductance_q_H,
                         hci_note *remark)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    if (!hci_is_salient(inductance_d_H, inductance_q_H)) return;
    if (effects_have_it(folder)) return;
    hci_note_add(
        remark,
        "%s: L_d of %.4g H and L_q of %.4g H differ, but there is no inductance.csv: the voltage and "
        "`simulate` know of it, the torque for which currents are solved is without the reluctance "
        "torque 3/2 p (L_d - L_q) i_d i_q. For that write inductance.csv, of L_d and L_q alone (as "
        "`init --inductance-d --inductance-q` does) La = (L_d + L_q)/3 + (L_d - L_q)/3 cos 2θ and "
        "Mab = -(L_d + L_q)/6 + (L_d - L_q)/3 cos(2θ - 2π/3), Lb and Mbc the same at θ - 2π/3, "
        "Lc and Mca at θ + 2π/3; or give both the same value",
        hci_quote_path(file, shown), inductance_d_H, inductance_q_H);
}

/* Of the mean of L_d and L_q where both are declared: what instruments and saturation by the magnets leave.
 */
static const double OF_INDUCTANCE = 0.1;

/* Of the magnets' flux where they are not: (L_d - L_q) times the rated current is 0 to 0.05 of it with
 * magnets on the surface, and 0.1 to 0.7 with magnets inside; twice the deviation covers these. */
static const double OF_FLUX = 0.35;

/* Mean of L_d and L_q; 0: not declared. */
static double mean_inductance_H(const hci_machine_data *m)
{
    for (size_t k = 0; k < m->inductance_count; ++k)
        if (m->inductance[k].order == 0.0)
            return m->inductance[k].cosine[HCI_AA] - m->inductance[k].cosine[HCI_AB];
    const double mean_H = 0.5 * (m->inductance_d_H + m->inductance_q_H);
    return mean_H > 0.0 ? mean_H : 0.0;
}

hci_saliency_width hci_saliency_width_of(const hci_machine_data *m)
{
    const double mean_H = mean_inductance_H(m);
    const double flux_Wb = hci_machine_torque_constant(m) / (1.5 * m->model.pole_pairs);
    if (!(mean_H > 0.0)) return (hci_saliency_width){0.0, OF_FLUX * fabs(flux_Wb)};
    const bool is_modelled = m->model.slope_count > 0 || m->inductance_count > 0;
    const double lacking_H = is_modelled ? 0.0 : m->inductance_d_H - m->inductance_q_H;
    return (hci_saliency_width){hypot(OF_INDUCTANCE * mean_H, lacking_H), 0.0};
}

/* 2/3 u(x)ᵀL u(y) with unit vectors u along phases x and y, and L of the plane: mean + half cos 2θ, half sin
 * 2θ, mean - half cos 2θ. */
static double entry(double mean, double half, double theta_rad, int x, int y)
{
    const double third = 2.0 * HCI_PI / 3.0;
    return 2.0 / 3.0 * (mean * cos(third * (x - y)) + half * cos(2.0 * theta_rad - third * (x + y)));
}

void hci_saliency_write_rows(hci_output *out, double inductance_d_H, double inductance_q_H)
{
    static const int PHASES[HCI_PHASE_MATRIX][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    const double mean = 0.5 * (inductance_d_H + inductance_q_H),
                 half = 0.5 * (inductance_d_H - inductance_q_H);
    hci_output_text(out, "theta_e_deg,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H\n");
    for (int deg = 0; deg < TURN_deg; deg += STEP_deg) {
        hci_output_text(out, "%d,", deg);
        for (size_t k = 0; k < HCI_PHASE_MATRIX; ++k)
            hci_output_number(out, entry(mean, half, deg * HCI_PI / 180.0, PHASES[k][0], PHASES[k][1]),
                              k + 1 < HCI_PHASE_MATRIX ? ',' : '\n');
    }
}
