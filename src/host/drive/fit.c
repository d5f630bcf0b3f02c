/* A drive and a machine that belong together: defaults, what is missing, and whether the loop is stable. */
#include <math.h>
#include <stdio.h>

#include "host/base/quote.h"
#include "host/drive/machine_model.h"

static const char *file_of(const hci_drive_data *d, char path[HCI_QUOTE_PATH_SIZE])
{
    return d->path[0] ? hci_quote_path(d->path, path) : "drive.csv";
}

/* A value that either file may hold, but not both. */
static hci_status join(const hci_drive_data *d, double given, const char *name, double *value, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (isnan(given)) return HCI_OK;
    if (!isnan(*value))
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: `%s` is in machine.csv already; delete one of the two", file_of(d, path),
                            name);
    *value = given;
    return HCI_OK;
}

static void fill(double *value, double fallback)
{
    if (isnan(*value)) *value = fallback;
}

/* Share of half the sampling frequency. */
static const double SAMPLING_SHARE = 0.8;

double hci_drive_highest_rad_per_s(const hci_drive_data *drive)
{
    return SAMPLING_SHARE * HCI_PI / hci_drive_sample_s(drive);
}

static void fill_defaults(hci_drive_data *d, const hci_machine_model *m)
{
    const double bandwidth_per_s =
        isnan(d->bandwidth_Hz) ? 0.2 / d->sample_s : 2.0 * HCI_PI * d->bandwidth_Hz;
    fill(&d->bandwidth_Hz, bandwidth_per_s / (2.0 * HCI_PI));
    fill(&d->kp_ohm, bandwidth_per_s * 0.5 * (m->inductance_H[0] + m->inductance_H[1]));
    fill(&d->ki_ohm_per_s, bandwidth_per_s * m->resistance_ohm);
    fill(&d->kp_q_ohm, d->kp_ohm);
    fill(&d->ki_q_ohm_per_s, d->ki_ohm_per_s);
    fill(&d->filter_s, 0.0);
    fill(&d->computing_delay_s, d->sample_s);
    fill(&d->dead_time_s, 0.0);
    fill(&d->pwm_frequency_Hz, 1.0 / d->sample_s);
    fill(&d->dead_time_crossing_A, 0.0);
    fill(&d->dead_time_compensation, 0.0);
    fill(&d->current_quantum_A, 0.0);
    fill(&d->encoder_counts, 0.0);
}

static hci_status check_times(const hci_drive_data *d, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (d->computing_delay_s > d->sample_s * (1.0 + 1e-9))
        return hci_note_set(note, HCI_ERROR_INPUT,
                            "%s: `computing_delay` is %g s, expected at most `current_sample_time`, %g s",
                            file_of(d, path), d->computing_delay_s, d->sample_s);
    if (hci_drive_dead_share(d) >= 0.5 * (1.0 - 1e-9))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: `dead_time` is %g s, expected less than half a period of the PWM, which is %g s by "
            "`pwm_frequency`, or else `current_sample_time`",
            file_of(d, path), d->dead_time_s, 1.0 / d->pwm_frequency_Hz);
    return HCI_OK;
}

/* The share of k_p and k_i at which the loop is just stable, by bisection; 0 where none is. */
static double stable_share(hci_loop_model whole)
{
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 24; ++k) {
        const double share = 0.5 * (low + high);
        const hci_loop_model model = hci_loop_with_gains(whole, share);
        if (hci_loop_largest_pole(&model) < 1.0)
            low = share;
        else
            high = share;
    }
    return low;
}

/* Two digits that are no more than the value, which is above 0: at them the loop is stable. */
static double two_digits_below(double value)
{
    const double unit = pow(10.0, floor(log10(value)) - 1.0);
    return unit * floor(value / unit);
}

enum { Q_SIZE = 64 };

/* The gains of q in words, where they are others. */
static const char *also_of_q(const hci_drive_data *d, char text[Q_SIZE])
{
    text[0] = '\0';
    if (d->kp_q_ohm < d->kp_ohm || d->kp_q_ohm > d->kp_ohm || d->ki_q_ohm_per_s < d->ki_ohm_per_s ||
        d->ki_q_ohm_per_s > d->ki_ohm_per_s)
        snprintf(text, Q_SIZE, " (of q %g and %g)", d->kp_q_ohm, d->ki_q_ohm_per_s);
    return text;
}

static hci_status check_stable(const hci_drive_data *d, const hci_machine_model *m, double speed_rad_per_s,
                               hci_note *note)
{
    const hci_loop_model model = hci_drive_loop(d, m, speed_rad_per_s);
    const double pole = hci_loop_largest_pole(&model);
    char path[HCI_QUOTE_PATH_SIZE], q[Q_SIZE];
    if (pole < 1.0) return HCI_OK;
    const double share = stable_share(model);
    if (share > 1e-3)
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: `current_kp` of %g V/A with `current_ki` of %g V/(A*s)%s is not stable at %g rpm: "
            "largest pole %.4g, expected less than 1; both together at most %.2g of that are",
            file_of(d, path), d->kp_ohm, d->ki_ohm_per_s, also_of_q(d, q),
            speed_rad_per_s * 30.0 / HCI_PI / m->table.pole_pairs, pole, two_digits_below(share));
    return hci_note_set(
        note, HCI_ERROR_INPUT,
        "%s: the current loop is not stable at %g rpm: largest pole %.4g, expected less than 1; "
        "change `current_kp`, `current_ki`, `decoupling` or the sample time",
        file_of(d, path), speed_rad_per_s * 30.0 / HCI_PI / m->table.pole_pairs, pole);
}

static hci_status join_all(const hci_drive_data *d, hci_machine_data *fitted, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    hci_status status = join(d, d->resistance_ohm, "resistance", &fitted->resistance_ohm, note);
    if (!status && fitted->inductance_count > 0 && !(isnan(d->inductance_d_H) && isnan(d->inductance_q_H)))
        status =
            hci_note_set(note, HCI_ERROR_INPUT,
                         "%s: `inductance_d` and `inductance_q` beside inductance.csv of the machine; delete "
                         "the rows",
                         file_of(d, path));
    if (!status) status = join(d, d->inductance_d_H, "inductance_d", &fitted->inductance_d_H, note);
    if (!status) status = join(d, d->inductance_q_H, "inductance_q", &fitted->inductance_q_H, note);
    if (!status && !isnan(d->dc_link_voltage_V)) fitted->dc_link_voltage_V = d->dc_link_voltage_V;
    if (!status && !(fitted->dc_link_voltage_V > 0.0))
        status = hci_note_set(note, HCI_ERROR_INPUT,
                              "%s: no `dc_link_voltage`, and machine.csv has none; add a row "
                              "`dc_link_voltage,VALUE,V`",
                              file_of(d, path));
    return status;
}

hci_status hci_drive_fit(hci_drive_data *drive, const hci_machine_data *machine, hci_machine_data *fitted,
                         hci_note *note)
{
    hci_machine_model model;
    *fitted = *machine;
    drive->sample_s = hci_drive_sample_s(drive);
    hci_status status = join_all(drive, fitted, note);
    if (status) return status;
    drive->dc_link_voltage_V = fitted->dc_link_voltage_V;
    status = hci_machine_model_make(fitted, &model, note);
    if (status) return status;
    fill_defaults(drive, &model);
    status = check_times(drive, note);
    if (!status) status = check_stable(drive, &model, 0.0, note);
    hci_machine_model_release(&model);
    return status;
}

/* Samples in an electrical turn below which the rotor goes too far between them. */
static const double LEAST_SAMPLES = 10.0;

hci_status hci_drive_check_speed(const hci_drive_data *drive, const hci_machine_data *fitted,
                                 double speed_rad_per_s, hci_note *note)
{
    const double electrical = fabs(speed_rad_per_s) * fitted->model.pole_pairs;
    const double samples = 2.0 * HCI_PI / (electrical * drive->sample_s);
    char path[HCI_QUOTE_PATH_SIZE];
    hci_machine_model model;
    if (samples < LEAST_SAMPLES * (1.0 - 1e-9))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: %g rpm has %.3g samples in an electrical turn, expected at least %g: at most %.4g "
            "rpm with a `current_sample_time` of %g s",
            file_of(drive, path), speed_rad_per_s * 30.0 / HCI_PI, samples, LEAST_SAMPLES,
            fabs(speed_rad_per_s) * 30.0 / HCI_PI * samples / LEAST_SAMPLES, drive->sample_s);
    hci_status status = hci_machine_model_make(fitted, &model, note);
    if (status) return status;
    status = check_stable(drive, &model, speed_rad_per_s * fitted->model.pole_pairs, note);
    hci_machine_model_release(&model);
    return status;
}
