/* What the current loop of a drive is: read off its linear model. */
#include "hci/host/base/number.h"
#include "hci/host/drive/drive_facts.h"

#include <math.h>

#include "host/base/quote.h"
#include "host/drive/machine_model.h"
#include "host/drive/response_reading.h"

/* ---- bandwidth ---- */

static double complex answer_of(const hci_loop_model *m, int axis, double nu_rad_per_s)
{
    return hci_loop_answer_at(m, nu_rad_per_s).reference.m[axis][axis];
}

enum { FREQUENCIES = 400, HALVINGS = 30 };

/* The first frequency at which the answer is below 1/√2. */
static double bandwidth_Hz(const hci_loop_model *m, int axis, double highest_rad_per_s)
{
    double low = 1e-4 * highest_rad_per_s, high = low;
    for (int k = 1; k <= FREQUENCIES; ++k) {
        high = 1e-4 * highest_rad_per_s * pow(1e4, (double)k / FREQUENCIES);
        if (cabs(answer_of(m, axis, high)) < sqrt(0.5)) break;
        low = high;
    }
    if (!(low < high)) return HUGE_VAL;
    for (int k = 0; k < HALVINGS; ++k) {
        const double middle = 0.5 * (low + high);
        if (cabs(answer_of(m, axis, middle)) < sqrt(0.5))
            high = middle;
        else
            low = middle;
    }
    return high / (2.0 * HCI_PI);
}

/* Largest answer, of the frequencies looked at. */
static double peak_of(const hci_loop_model *m, int axis, double highest_rad_per_s, double *at_Hz)
{
    double most = 0.0;
    for (int k = 0; k <= FREQUENCIES; ++k) {
        const double nu = 1e-4 * highest_rad_per_s * pow(1e4, (double)k / FREQUENCIES);
        const double gain = cabs(answer_of(m, axis, nu));
        if (!(gain > most)) continue;
        most = gain;
        *at_Hz = nu / (2.0 * HCI_PI);
    }
    return most;
}

/* ---- stability ---- */

static double gain_margin(const hci_loop_model *m)
{
    double low = 1.0, high = 100.0;
    for (int k = 0; k < HALVINGS; ++k) {
        const double middle = sqrt(low * high);
        const hci_loop_model more = hci_loop_with_gains(*m, middle);
        if (hci_loop_largest_pole(&more) < 1.0)
            low = middle;
        else
            high = middle;
    }
    return low > 99.9 ? 100.0 : low;
}

static bool is_stable_at(hci_loop_model m, double speed_rad_per_s)
{
    m.speed_rad_per_s = speed_rad_per_s;
    return hci_loop_largest_pole(&m) < 1.0;
}

enum { SPEEDS = 64 };

/* Electrical speed from which on the loop is not stable, below the one that the sampling does for. */
static double stable_end(const hci_loop_model *m, double sampled_rad_per_s)
{
    int k = 1;
    while (k <= SPEEDS && is_stable_at(*m, sampled_rad_per_s * k / SPEEDS))
        ++k;
    if (k > SPEEDS) return HUGE_VAL;
    double low = sampled_rad_per_s * (k - 1) / SPEEDS, high = sampled_rad_per_s * k / SPEEDS;
    for (int n = 0; n < HALVINGS; ++n) {
        const double middle = 0.5 * (low + high);
        if (is_stable_at(*m, middle))
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* ---- all of it ---- */

static void look_at(const hci_drive_data *d, const hci_machine_model *machine, hci_drive_facts *f)
{
    const double pairs = machine->table.pole_pairs, highest = hci_drive_highest_rad_per_s(d);
    const double late = 0.02 * HCI_PI / d->sample_s, sampled = 2.0 * HCI_PI / (10.0 * d->sample_s);
    const hci_loop_model m = hci_drive_loop(d, machine, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
        f->inductance_H[axis] = machine->inductance_H[axis];
        f->peak[axis] = peak_of(&m, axis, highest, &f->peak_Hz[axis]);
        f->bandwidth_Hz[axis] = bandwidth_Hz(&m, axis, highest);
    }
    f->pole_pairs = machine->table.pole_pairs;
    f->lead_s = -carg(answer_of(&m, 1, late)) / late;
    f->largest_pole = hci_loop_largest_pole(&m);
    f->gain_margin = gain_margin(&m);
    f->sampled_rad_per_s = sampled / pairs;
    f->stable_rad_per_s = stable_end(&m, sampled) / pairs;
    f->highest_order = f->speed_rad_per_s > 0.0 ? highest / (pairs * f->speed_rad_per_s) : (double)NAN;
    hci_response_compare(d, &m, f);
}

hci_status hci_drive_facts_of(hci_drive_data *drive, const hci_machine_data *machine, double speed_rad_per_s,
                              hci_drive_facts *facts, hci_note *note)
{
    hci_machine_data fitted;
    hci_machine_model model = {0};
    *facts = (hci_drive_facts){.speed_rad_per_s = speed_rad_per_s};
    hci_status status = hci_drive_fit(drive, machine, &fitted, note);
    if (!status && speed_rad_per_s > 0.0)
        status = hci_drive_check_speed(drive, &fitted, speed_rad_per_s, note);
    if (!status) status = hci_machine_model_make(&fitted, &model, note);
    if (status) return status;
    facts->drive = *drive;
    facts->drive.response = NULL;
    facts->drive.response_count = 0;
    facts->drive.path[0] = '\0';
    look_at(drive, &model, facts);
    hci_machine_model_release(&model);
    return HCI_OK;
}

void hci_drive_remark_response(const hci_drive_data *drive, const hci_machine_data *machine, hci_note *remark)
{
    char text[HCI_RESPONSE_TEXT_SIZE], path[HCI_QUOTE_PATH_SIZE];
    hci_drive_data d = *drive;
    hci_drive_facts f;
    hci_note note = {{0}};
    if (d.response_count == 0 || hci_drive_facts_of(&d, machine, 0.0, &f, &note)) return;
    if (f.reading == HCI_RESPONSE_AS_DECLARED) return;
    hci_response_reading_text(&f, text);
    hci_note_add(remark,
                 "%s: its `response` is at most %s %% off what %s make of R and L, at %.4g Hz, and "
                 "`compensation` and `lead` are of the response: %s",
                 hci_quote_path(drive->path, path), HCI_PERCENT(100.0 * f.response_off, 3),
                 drive->gains_are_given ? "its gains" : "the default gains, since it has none,",
                 f.response_off_Hz, text);
}
