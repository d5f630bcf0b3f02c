/* What the current loop of a drive is: read off its linear model, and compared with its measured response. */
#include "hci/host/drive/drive_facts.h"

#include <math.h>

#include "host/drive/machine_model.h"

#define NAME_OF(value, word, what)  [value] = word,
#define WORDS_OF(value, word, what) [value] = what,
static const char *const NAMES[] = {HCI_RESPONSE_READINGS(NAME_OF)};
static const char *const WORDS[] = {HCI_RESPONSE_READINGS(WORDS_OF)};
#undef NAME_OF
#undef WORDS_OF

const char *hci_response_reading_name(hci_response_reading reading)
{
    return NAMES[reading];
}

const char *hci_response_reading_words(hci_response_reading reading)
{
    return WORDS[reading];
}

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

/* ---- the measured response ---- */

typedef struct {
    const hci_loop_point *point;
    size_t count;
    double highest_rad_per_s; /* up to which the loop is compared */
    hci_response_of of;
} response;

/* Largest |measured/computed − 1|. at_Hz: out, or NULL. */
static double off_of(const response *r, const hci_loop_model *m, double *at_Hz)
{
    double most = 0.0;
    for (size_t k = 0; k < r->count; ++k) {
        const hci_loop_point *p = &r->point[k];
        const double nu = 2.0 * HCI_PI * p->frequency_Hz;
        if (nu > r->highest_rad_per_s) break;
        for (int axis = 0; axis < 2; ++axis) {
            const double complex measured = p->gain[axis] * cexp(p->phase_rad[axis] * (double complex)I);
            const hci_loop_answer answer = hci_loop_answer_at(m, nu);
            const hci_matrix2 *of = r->of == HCI_RESPONSE_OF_SAMPLES ? &answer.sampled : &answer.reference;
            const double off = cabs(measured / of->m[axis][axis] - 1.0);
            if (!(off > most)) continue;
            most = off;
            if (at_Hz) *at_Hz = p->frequency_Hz;
        }
    }
    return most;
}

typedef struct {
    hci_response_reading reading;
    double off, value;
} explanation;

static void keep_better(explanation *best, hci_response_reading reading, double off, double value)
{
    if (off < best->off) *best = (explanation){reading, off, value};
}

/* What is left with other units, gains or delays: one change at a time. */
static explanation explain(const response *r, const hci_loop_model *m)
{
    explanation best = {HCI_RESPONSE_UNKNOWN, HUGE_VAL, (double)NAN};
    response other_current = *r;
    other_current.of = r->of == HCI_RESPONSE_OF_SAMPLES ? HCI_RESPONSE_OF_CURRENT : HCI_RESPONSE_OF_SAMPLES;
    keep_better(&best, HCI_RESPONSE_OTHER_CURRENT, off_of(&other_current, m, NULL), (double)NAN);
    for (int k = -96; k <= 96; ++k) {
        const double factor = pow(2.0, k / 24.0);
        const hci_loop_model other = hci_loop_with_gains(*m, factor);
        keep_better(&best, HCI_RESPONSE_GAINS, off_of(r, &other, NULL), factor);
    }
    for (int k = 0; k <= 40; ++k) {
        hci_loop_model other = *m;
        other.delay_s = m->sample_s * k / 40.0;
        keep_better(&best, HCI_RESPONSE_DELAY, off_of(r, &other, NULL), other.delay_s);
    }
    return best;
}

static void compare_response(const hci_drive_data *drive, const hci_loop_model *m, hci_drive_facts *f)
{
    const response r = {drive->response, drive->response_count, hci_drive_highest_rad_per_s(drive),
                        drive->response_of};
    f->response_off = f->response_off_Hz = f->reading_off = f->reading_value = (double)NAN;
    f->response_count = drive->response_count;
    if (r.count == 0) return;
    f->reading_off = f->response_off = off_of(&r, m, &f->response_off_Hz);
    if (f->response_off <= HCI_RESPONSE_TOLERANCE) return;
    const explanation e = explain(&r, m);
    f->reading = HCI_RESPONSE_UNKNOWN;
    if (e.off > 0.5 * HCI_RESPONSE_TOLERANCE && e.off > 0.25 * f->response_off) return;
    f->reading = e.reading;
    f->reading_off = e.off;
    f->reading_value = e.value;
}

/* ---- all of it ---- */

static void look_at(const hci_drive_data *d, const hci_machine_model *machine, hci_drive_facts *f)
{
    const double pairs = machine->table.pole_pairs, highest = hci_drive_highest_rad_per_s(d);
    const double late = 0.02 * HCI_PI / d->sample_s, sampled = 2.0 * HCI_PI / (10.0 * d->sample_s);
    const hci_loop_model m = hci_drive_loop(d, machine, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
        f->inductance_H[axis] = machine->inductance_H[axis];
        f->bandwidth_Hz[axis] = bandwidth_Hz(&m, axis, highest);
    }
    f->lead_s = -carg(answer_of(&m, 1, late)) / late;
    f->largest_pole = hci_loop_largest_pole(&m);
    f->gain_margin = gain_margin(&m);
    f->sampled_rad_per_s = sampled / pairs;
    f->stable_rad_per_s = stable_end(&m, sampled) / pairs;
    f->highest_order = f->speed_rad_per_s > 0.0 ? highest / (pairs * f->speed_rad_per_s) : (double)NAN;
    compare_response(d, &m, f);
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
