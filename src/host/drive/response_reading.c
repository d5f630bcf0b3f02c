#include "host/drive/response_reading.h"

#include "hci/host/base/number.h"
#include <math.h>
#include <stdio.h>

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

/* ---- how far off ---- */

/* A response as it may have been meant. */
typedef struct {
    const hci_drive_data *drive;
    hci_response_of of;
    double frequency, gain, turn_rad; /* what frequencies and gains are times of, and phases are more by */
} response;

/* Largest |measured/computed − 1|, up to the frequency that the loop does for; 2 where all lie above it.
 * at_Hz: out, or NULL. */
static double off_of(const response *r, const hci_loop_model *m, double *at_Hz)
{
    const double highest = hci_drive_highest_rad_per_s(r->drive);
    double most = -1.0;
    for (size_t k = 0; k < r->drive->response_count; ++k) {
        const hci_loop_point *p = &r->drive->response[k];
        const double nu = 2.0 * HCI_PI * p->frequency_Hz / r->frequency;
        if (nu > highest) break;
        const hci_loop_answer answer = hci_loop_answer_at(m, nu);
        const hci_matrix2 *of = r->of == HCI_RESPONSE_OF_SAMPLES ? &answer.sampled : &answer.reference;
        for (int axis = 0; axis < 2; ++axis) {
            const double complex measured =
                p->gain[axis] / r->gain * cexp((p->phase_rad[axis] - r->turn_rad) * (double complex)I);
            const double off = cabs(measured / of->m[axis][axis] - 1.0);
            if (!(off > most)) continue;
            most = off;
            if (at_Hz) *at_Hz = p->frequency_Hz;
        }
    }
    return most < 0.0 ? 2.0 : most;
}

/* ---- what explains it ---- */

typedef struct {
    hci_response_reading reading;
    double off, value;
} explanation;

static void keep_better(explanation *best, hci_response_reading reading, double off, double value)
{
    if (off < best->off) *best = (explanation){reading, off, value};
}

/* Other gains and delays, of which only those that are stable may be meant. */
static void try_loops(const response *r, const hci_loop_model *m, explanation *best)
{
    for (int k = -96; k <= 96; ++k) {
        const double factor = pow(2.0, k / 24.0);
        const hci_loop_model other = hci_loop_with_gains(*m, factor);
        if (hci_loop_largest_pole(&other) < 1.0)
            keep_better(best, HCI_RESPONSE_GAINS, off_of(r, &other, NULL), factor);
    }
    for (int k = 0; k <= 40; ++k) {
        hci_loop_model other = *m;
        other.delay_s = m->sample_s * k / 40.0;
        if (hci_loop_largest_pole(&other) < 1.0)
            keep_better(best, HCI_RESPONSE_DELAY, off_of(r, &other, NULL), other.delay_s);
    }
}

/* What frequencies may be in. */
static const struct {
    const char *name;
    double in_a_Hz;
} UNITS[] = {{"rad/s", 2.0 * HCI_PI}, {"turns for rad", 0.5 / HCI_PI}, {"kHz", 1e-3}, {"1/min", 60.0}};

/* Of a factor by which the column is to be multiplied. */
static const char *unit_of(double factor)
{
    size_t k = 0;
    while (k + 1 < sizeof UNITS / sizeof *UNITS && fabs(factor * UNITS[k].in_a_Hz - 1.0) > 1e-6)
        ++k;
    return UNITS[k].name;
}

/* The columns in other units, and of another sign. */
static void try_columns(const response *r, const hci_loop_model *m, explanation *best)
{
    const double scale[] = {sqrt(2.0), sqrt(0.5), sqrt(1.5), sqrt(2.0 / 3.0), 1.5, 2.0 / 3.0, 100.0, 0.01};
    response other = *r;
    for (size_t k = 0; k < sizeof UNITS / sizeof *UNITS; ++k) {
        other.frequency = UNITS[k].in_a_Hz;
        keep_better(best, HCI_RESPONSE_FREQUENCY, off_of(&other, m, NULL), 1.0 / UNITS[k].in_a_Hz);
    }
    other = *r;
    for (size_t k = 0; k < sizeof scale / sizeof *scale; ++k) {
        other.gain = scale[k];
        keep_better(best, HCI_RESPONSE_SCALE, off_of(&other, m, NULL), 1.0 / scale[k]);
    }
    other = *r;
    other.turn_rad = HCI_PI;
    keep_better(best, HCI_RESPONSE_HALF_TURN, off_of(&other, m, NULL), (double)NAN);
}

static double off_of_other_current(const response *r, const hci_loop_model *m)
{
    response other = *r;
    other.of = r->of == HCI_RESPONSE_OF_SAMPLES ? HCI_RESPONSE_OF_CURRENT : HCI_RESPONSE_OF_SAMPLES;
    return off_of(&other, m, NULL);
}

/* What is left with other columns, gains or delays: one change at a time. */
static explanation explain(const response *r, const hci_loop_model *m)
{
    explanation best = {HCI_RESPONSE_UNKNOWN, HUGE_VAL, (double)NAN};
    keep_better(&best, HCI_RESPONSE_OTHER_CURRENT, off_of_other_current(r, m), (double)NAN);
    try_columns(r, m, &best);
    try_loops(r, m, &best);
    return best;
}

/* Whether a response within the tolerance is plainly that of the other current. */
static bool is_of_other_current(double off, double off_of_other)
{
    return off > 0.25 * HCI_RESPONSE_TOLERANCE && off_of_other < 0.1 * off;
}

void hci_response_compare(const hci_drive_data *drive, const hci_loop_model *m, hci_drive_facts *f)
{
    const response r = {drive, drive->response_of, 1.0, 1.0, 0.0};
    f->response_off = f->response_off_Hz = f->reading_off = f->reading_value = (double)NAN;
    f->response_count = drive->response_count;
    if (f->response_count == 0) return;
    f->reading_off = f->response_off = off_of(&r, m, &f->response_off_Hz);
    const bool is_near = f->response_off <= HCI_RESPONSE_TOLERANCE;
    if (is_near && !is_of_other_current(f->response_off, off_of_other_current(&r, m))) return;
    const explanation e = explain(&r, m);
    f->reading = HCI_RESPONSE_UNKNOWN;
    if (e.off > 0.5 * HCI_RESPONSE_TOLERANCE && e.off > 0.25 * f->response_off) return;
    f->reading = e.reading;
    f->reading_off = e.off;
    f->reading_value = e.value;
}

/* ---- words ---- */

enum { VALUE_SIZE = 48 };

static void put_value(const hci_drive_facts *f, char value[VALUE_SIZE])
{
    value[0] = '\0';
    if (f->reading == HCI_RESPONSE_GAINS)
        snprintf(value, VALUE_SIZE, ": %.3g times as large", f->reading_value);
    if (f->reading == HCI_RESPONSE_DELAY) snprintf(value, VALUE_SIZE, ": %.3g us", 1e6 * f->reading_value);
    if (f->reading == HCI_RESPONSE_SCALE) snprintf(value, VALUE_SIZE, " by %.4g", f->reading_value);
    if (f->reading == HCI_RESPONSE_FREQUENCY)
        snprintf(value, VALUE_SIZE, " by %.4g, as of %s", f->reading_value, unit_of(f->reading_value));
}

void hci_response_reading_text(const hci_drive_facts *f, char text[HCI_RESPONSE_TEXT_SIZE])
{
    char value[VALUE_SIZE];
    put_value(f, value);
    if (f->reading == HCI_RESPONSE_UNKNOWN || f->reading == HCI_RESPONSE_AS_DECLARED)
        snprintf(text, HCI_RESPONSE_TEXT_SIZE, "%s", WORDS[f->reading]);
    else
        snprintf(text, HCI_RESPONSE_TEXT_SIZE, "%s%s; then %s %% are left", WORDS[f->reading], value,
                 HCI_PERCENT(100.0 * f->reading_off, 3));
}
