/* Values of a drive and a winding that fit no motor, as a slip of a unit makes them. */
#include <math.h>

#include "hci/host/base/number.h"
#include "hci/host/drive/drive.h"
#include "host/base/quote.h"
#include "host/machine/torque_constant.h"

/* ---- current_sample_time ---- */

/* Of slow loops; 25 to 250 us are usual. */
#define LONGEST_SAMPLE_s 2e-3

static void look_at_sample(const hci_drive_data *d, const char *file, hci_note *remark)
{
    const double sample_s = hci_drive_sample_s(d);
    if (sample_s > LONGEST_SAMPLE_s)
        hci_note_add(remark,
                     "%s: `current_sample_time` of %g s: current loops are sampled some thousand times a "
                     "second; is it in a smaller unit, such as %g us?",
                     file, sample_s, 1e3 * sample_s);
}

/* ---- pwm_frequency ---- */

/* Periods of the PWM in a sample: half of one where both edges are sampled, some where a slow loop runs on a
 * fast PWM. */
static const double LEAST_PERIODS = 0.2, MOST_PERIODS = 50.0;

static void look_at_pwm(const hci_drive_data *d, const char *file, hci_note *remark)
{
    const double periods = d->pwm_frequency_Hz * hci_drive_sample_s(d);
    if (!(periods < LEAST_PERIODS) && !(periods > MOST_PERIODS)) return;
    hci_note_add(remark,
                 "%s: `pwm_frequency` of %g Hz is %.3g periods in a `current_sample_time` of %g s, expected "
                 "about 1, or 0.5 where both edges are sampled; is %s?",
                 file, d->pwm_frequency_Hz, periods, hci_drive_sample_s(d),
                 periods < 1.0 ? "it in kHz" : "one of the two in another unit");
    if (d->dead_time_s > 0.0)
        hci_note_add(remark, "by it a dead time of %g s is %s %% of a period", d->dead_time_s,
                     HCI_PERCENT(100.0 * d->dead_time_s * d->pwm_frequency_Hz, 3));
}

/* ---- inductance ---- */

typedef struct {
    double resistance_ohm, inductance_H;
} winding;

static double or_else(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

/* L between the declared L_d and L_q, or of a phase in inductance.csv without what neutral would carry; NAN
 * where it is not known. */
static winding winding_of(const hci_drive_data *d, const hci_machine_data *m)
{
    winding w = {or_else(m->resistance_ohm, d->resistance_ohm),
                 0.5 * (or_else(m->inductance_d_H, d->inductance_d_H) +
                        or_else(m->inductance_q_H, d->inductance_q_H))};
    for (size_t k = 0; k < m->inductance_count; ++k)
        if (m->inductance[k].order == 0.0)
            w.inductance_H = m->inductance[k].cosine[HCI_AA] - m->inductance[k].cosine[HCI_AB];
    return w;
}

/* L times the rated current over the flux of the magnets: what the current makes beside these. NAN where it
 * is not known. */
static double flux_share(const winding *w, const hci_machine_data *m)
{
    const double flux_Wb = fabs(hci_machine_torque_constant(m)) / (1.5 * m->model.pole_pairs);
    return flux_Wb > 0.0 ? w->inductance_H * m->rated_current_A / flux_Wb : (double)NAN;
}

/* Seconds of L/R and shares of the flux that no motor has: some 50 us to 0.3 s, and 0.005 to 2. */
static const double LONG_s = 2.0, SHORT_s = 1e-5, LARGE = 20.0, RATHER_SHORT_s = 1e-4, SMALL = 3e-3;

static void look_at_inductance(const hci_drive_data *d, const hci_machine_data *m, hci_note *remark)
{
    const winding w = winding_of(d, m);
    const double time_s = w.inductance_H / w.resistance_ohm, share = flux_share(&w, m);
    const bool is_large = time_s > LONG_s || share > LARGE;
    const bool is_small = time_s < SHORT_s || (time_s < RATHER_SHORT_s && share < SMALL);
    if (!is_large && !is_small) return;
    hci_note_add(remark,
                 "an inductance of %.4g H with a resistance of %.4g ohm has a time constant of %.3g s, "
                 "which no usual motor has; is %s, or the resistance in another unit?",
                 w.inductance_H, w.resistance_ohm, time_s,
                 is_large ? "the inductance in mH"
                          : "the inductance a thousand times as large, mH in place of uH");
    if (isfinite(share))
        hci_note_add(remark, "at the rated current of %.4g A it makes %.3g times the flux of the magnets",
                     m->rated_current_A, share);
}

/* ---- bandwidth ---- */

/* Of the sampling frequency: 0.032 is the default. */
static const double LEAST_BANDWIDTH = 5e-4;

static void look_at_bandwidth(const hci_drive_data *d, const hci_machine_data *m, const char *file,
                              hci_note *remark)
{
    const winding w = winding_of(d, m);
    const double by_gain_Hz = d->kp_ohm / (2.0 * HCI_PI * w.inductance_H);
    const bool by_gain = !isnan(by_gain_Hz);
    const double found_Hz = by_gain ? by_gain_Hz : d->bandwidth_Hz, sample_s = hci_drive_sample_s(d);
    if (!(found_Hz > 0.0) || !(found_Hz * sample_s < LEAST_BANDWIDTH)) return;
    hci_note_add(
        remark,
        "%s: the bandwidth of the current loop is %.3g Hz%s, a sample is %g s: expected some "
        "hundredths of the sampling frequency, such as %.3g Hz; is `bandwidth` in kHz, or `current_kp` "
        "in another unit than V/A?",
        file, found_Hz, by_gain ? " by k_p and L" : "", sample_s, 0.032 / sample_s);
}

void hci_drive_remark_units(const hci_drive_data *drive, const hci_machine_data *machine, hci_note *remark)
{
    char path[HCI_QUOTE_PATH_SIZE];
    const char *file = drive->path[0] ? hci_quote_path(drive->path, path) : "drive.csv";
    look_at_sample(drive, file, remark);
    look_at_pwm(drive, file, remark);
    look_at_bandwidth(drive, machine, file, remark);
    look_at_inductance(drive, machine, remark);
}
