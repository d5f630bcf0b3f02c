/* What a device has learnt of its cogging, as a recording. In: the bytes of a blob of hci/learn.h, sums of
 * the current by mechanical order, forward and backward; out: the text of a table that has these sums at
 * whole angles. */
#include "host/csv/learned.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/learn.h"
#include "hci/math/harmonic.h"
#include "host/base/memory.h"

/* Samples in a period of the highest order, and the fewest in a turn. */
enum { PER_PERIOD = 16, FEWEST = 720, LINE = 96 };

bool hci_csv_is_learned(const hci_csv *csv, size_t size)
{
    return size >= 4 && memcmp(csv->text, "HCIL", 4) == 0;
}

static const char *fault_of(hci_blob_verdict verdict)
{
    switch (verdict) {
    case HCI_BLOB_CUT_OFF:
        return "found the beginning of what a device has learnt, and not all of it";
    case HCI_BLOB_NEWER:
        return "found what a device with a newer hci/learn.h has learnt";
    default:
        return "found what a device has learnt, damaged: its CRC-32 is another";
    }
}

/* The value of one direction at an angle. which: 0 forward, 1 backward. */
static double value_at(const void *blob, uint32_t orders, uint32_t which, double theta_rad)
{
    double sum = (double)hci_blob_float(blob, 32 + 4 * which);
    for (uint32_t k = 0; k < orders; ++k) {
        const uint32_t at = HCI_LEARN_HEAD + k * HCI_LEARN_ORDER;
        const double n = hci_blob_u32(blob, at);
        sum += (double)hci_blob_float(blob, at + 4 + 8 * which) * cos(n * theta_rad) +
               (double)hci_blob_float(blob, at + 8 + 8 * which) * sin(n * theta_rad);
    }
    return sum;
}

/* Samples in a turn. */
static size_t samples_of(const void *blob, uint32_t orders)
{
    const size_t highest = hci_blob_u32(blob, HCI_LEARN_HEAD + (orders - 1) * HCI_LEARN_ORDER);
    return highest * PER_PERIOD > FEWEST ? highest * PER_PERIOD : FEWEST;
}

/* ---- noise ----
 *
 * A sum over turns has no noise any more, but an error. What is read as a recording has as much white noise
 * as makes that error, and none of it at the orders that were learnt: their values stay. */

/* Of a sample, so that both turns together give each coordinate of an order its error: root mean square of
 * the errors · √samples. */
static double deviation_of(const void *blob, uint32_t orders, size_t samples)
{
    double square = 0.0;
    for (uint32_t k = 0; k < orders; ++k) {
        const double error = (double)hci_blob_float(blob, HCI_LEARN_HEAD + k * HCI_LEARN_ORDER + 20);
        if (error > 0.0) square += error * error;
    }
    return sqrt(square / orders * (double)samples);
}

/* Takes the order n out of a turn. */
static void take_out(double *noise, size_t samples, double n)
{
    const double step = 2.0 * HCI_PI * n / (double)samples, share = (n > 0.0 ? 2.0 : 1.0) / (double)samples;
    double c = 0.0, s = 0.0;
    for (size_t k = 0; k < samples; ++k) {
        c += share * noise[k] * cos(step * (double)k);
        s += share * noise[k] * sin(step * (double)k);
    }
    for (size_t k = 0; k < samples; ++k)
        noise[k] -= c * cos(step * (double)k) + s * sin(step * (double)k);
}

/* Uniform numbers, the same at each call. */
static void make_noise(const void *blob, uint32_t orders, uint32_t which, double *noise, size_t samples)
{
    const double width = sqrt(12.0) * deviation_of(blob, orders, samples);
    uint32_t seed = 1 + which;
    for (size_t k = 0; k < samples; ++k) {
        seed = seed * 1664525u + 1013904223u;
        noise[k] = width * ((double)seed / 4294967296.0 - 0.5);
    }
    take_out(noise, samples, 0.0);
    for (uint32_t k = 0; k < orders; ++k)
        take_out(noise, samples, hci_blob_u32(blob, HCI_LEARN_HEAD + k * HCI_LEARN_ORDER));
}

/* ---- the recording ---- */

/* One direction's turn with its noise, after `text`. Returns the characters. */
static size_t write_turn(const void *blob, const hci_learn_facts *facts, uint32_t which, const double *noise,
                         char *text)
{
    const uint32_t orders = hci_blob_u16(blob, 6);
    const size_t samples = samples_of(blob, orders);
    const double speed = facts->speed_rad_per_s > 0.0f ? (double)facts->speed_rad_per_s : 0.1;
    const bool torque = facts->unit == HCI_LEARN_NEWTON_METRE;
    size_t length = 0;
    for (size_t k = 0; k < samples; ++k) {
        const size_t place = which == 0 ? k : samples - 1 - k;
        const double theta_rad = 2.0 * HCI_PI * (double)place / (double)samples;
        const double value = value_at(blob, orders, which, theta_rad) + noise[place];
        length += (size_t)snprintf(text + length, LINE, "%.12g,%.9g,%.9g,%.9g\n", theta_rad,
                                   which == 0 ? speed : -speed, torque ? 0.0 : value, torque ? -value : 0.0);
    }
    return length;
}

/* The turns that there are, after `text`. */
static void write_turns(const void *blob, const hci_learn_facts *facts, double *noise, char *text)
{
    const uint32_t orders = hci_blob_u16(blob, 6);
    for (uint32_t which = 0; which < 2; ++which) {
        if (hci_blob_u32(blob, 20 + 4 * which) == 0) continue;
        make_noise(blob, orders, which, noise, samples_of(blob, orders));
        text += write_turn(blob, facts, which, noise, text);
    }
}

static hci_status make_text(hci_csv *csv, const hci_learn_facts *facts, hci_note *note)
{
    static const char header[] = "theta_m_rad,speed_rad_per_s,iq_A,torque_Nm\n";
    const size_t samples = samples_of(csv->text, hci_blob_u16(csv->text, 6));
    char *text = hci_memory_malloc(sizeof header + 2 * samples * LINE);
    double *noise = hci_memory_new(samples, sizeof *noise);
    if (!text || !noise) {
        hci_memory_free(text);
        hci_memory_free(noise);
        return hci_note_memory(note, csv->path, "%zu samples", 2 * samples);
    }
    memcpy(text, header, sizeof header);
    write_turns(csv->text, facts, noise, text + sizeof header - 1);
    hci_memory_free(noise);
    hci_memory_free(csv->text);
    csv->text = text;
    return HCI_OK;
}

static hci_status refuse(const hci_csv *csv, const char *found, const char *remedy, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    return hci_note_set(note, HCI_ERROR_INPUT, "%s: %s; %s", hci_quote_path(csv->path, path), found, remedy);
}

hci_status hci_csv_read_learned(hci_csv *csv, size_t size, hci_note *note)
{
    hci_learn_facts facts;
    const hci_blob_verdict verdict = hci_learn_check(csv->text, (uint32_t)size, &facts);
    if (verdict != HCI_BLOB_GOOD)
        return refuse(csv, fault_of(verdict),
                      verdict == HCI_BLOB_NEWER ? "use the hci-solve of that version"
                                                : "read it from the device again",
                      note);
    if (hci_blob_u32(csv->text, 20) == 0 && hci_blob_u32(csv->text, 24) == 0)
        return refuse(csv, "found no whole turn in what the device has learnt",
                      "let it turn at least once in each direction", note);
    csv->learned_pole_pairs = (int)facts.pole_pairs;
    return make_text(csv, &facts, note);
}
