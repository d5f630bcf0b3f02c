/* A table beside other currents. In: its waves, a recording over the angle, what its sensors are off by. A
 * load, and friction with the direction, add a sine to what is played, so that the harmonics alone tell the
 * table; and readings that are the table as they stand are those of sensors that nobody corrected. */
#include "hci/host/currents/table_beside.h"

#include <math.h>
#include <string.h>

#include "hci/host/machine/corrections.h"
#include "hci/math/harmonic.h"

/* ---- beside a sine */

enum { DIRECT, QUADRATURE, HARMONICS, MEASURED, PARTS, WAYS = 2 };

typedef struct {
    double gram[WAYS][PARTS][PARTS];
    double table_d, table_q; /* the fundamental of the table in the same two waves */
    size_t count[WAYS];
} sums;

static void wave_at(double theta, double direct[3], double quadrature[3])
{
    for (int s = 0; s < 3; ++s) {
        direct[s] = cos(theta - 2.0 * HCI_PI * s / 3.0);
        quadrature[s] = sin(theta - 2.0 * HCI_PI * s / 3.0);
    }
}

/* The table at an angle: its fundamental of positive sequence, and the rest. */
static void table_at(const hci_currents *table, double theta, double first[3], double rest[3])
{
    double wave[3];
    memset(first, 0, 3 * sizeof *first);
    memset(rest, 0, 3 * sizeof *rest);
    for (size_t k = 0; k < table->count; ++k) {
        const hci_wave *w = &table->wave[k];
        double *to = fabs(w->order - 1.0) < 10.0 * HCI_ORDER_TOLERANCE && w->sequence == 1 ? first : rest;
        hci_waves_at(w, 1, theta, wave);
        for (int s = 0; s < 3; ++s)
            to[s] += wave[s];
    }
}

static int way_of(const hci_run *run, size_t k)
{
    return run->speed_rad_per_s && run->speed_rad_per_s[k] < 0.0;
}

static void add(sums *x, int way, double part[PARTS][3])
{
    for (int s = 0; s < 3; ++s)
        for (int a = 0; a < PARTS; ++a)
            for (int b = 0; b < PARTS; ++b)
                x->gram[way][a][b] += part[a][s] * part[b][s];
    x->count[way]++;
}

static void sum_up(const hci_currents *table, const hci_run *run, int pole_pairs, double rotation_rad,
                   sums *x)
{
    double first[3], rest[3], part[PARTS][3];
    memset(x, 0, sizeof *x);
    for (size_t k = 0; k < run->count; ++k) {
        const double theta = pole_pairs * run->theta_m_rad[k] + rotation_rad;
        wave_at(theta, part[DIRECT], part[QUADRATURE]);
        table_at(table, theta, first, rest);
        memcpy(part[HARMONICS], rest, sizeof rest);
        for (int s = 0; s < 3; ++s)
            part[MEASURED][s] = run->i_A[3 * k + (size_t)s] - first[s];
        add(x, way_of(run, k), part);
    }
}

static void take_out(double gram[PARTS][PARTS], int first)
{
    double row[PARTS];
    memcpy(row, gram[first], sizeof row);
    for (int a = 0; a < PARTS && row[first] > 0.0; ++a)
        for (int b = 0; b < PARTS; ++b)
            gram[a][b] -= row[a] * row[b] / row[first];
}

/* Both directions have the harmonics in common, and a sine each. */
static void harmonics_find(sums *x, hci_table_beside *to)
{
    double hh = 0.0, hm = 0.0, mm = 0.0, before = 0.0;
    size_t n = 0;
    for (int way = 0; way < WAYS; ++way) {
        before += x->gram[way][MEASURED][MEASURED];
        take_out(x->gram[way], DIRECT);
        take_out(x->gram[way], QUADRATURE);
        hh += x->gram[way][HARMONICS][HARMONICS];
        hm += x->gram[way][HARMONICS][MEASURED];
        mm += x->gram[way][MEASURED][MEASURED];
        n += x->count[way];
    }
    to->beside_A = n > 0 ? sqrt(fmax(0.0, before - mm) / (1.5 * (double)n)) : 0.0;
    if (!(hh > 0.0) || n == 0) return;
    to->harmonics = hm / hh;
    to->harmonics_error = sqrt(fmax(0.0, mm - hm * hm / hh) / (2.0 * (double)n) / hh);
}

/* ---- corrections */

enum { MOST_EFFECTS = 32, MOST_TERMS = 128 };

/* What a drive is told to correct. */
typedef struct {
    hci_effect effect[MOST_EFFECTS];
    hci_effect_term term[MOST_TERMS];
    size_t effects, terms;
} asked_corrections;

static void asked_add(const hci_effect *effect, asked_corrections *to)
{
    hci_effect *as = &to->effect[to->effects];
    *as = (hci_effect){.type = effect->type, .term = to->term + to->terms};
    for (size_t k = 0; k < effect->count && to->terms < MOST_TERMS; ++k) {
        if (!hci_correction_is_asked(effect->type, &effect->term[k])) continue;
        to->term[to->terms++] = effect->term[k];
        ++as->count;
    }
    to->effects += as->count > 0;
}

/* Of an effect with parts that a drive is not asked to correct the others alone. */
static hci_effects asked_of(const hci_effects *all, asked_corrections *asked)
{
    asked->effects = asked->terms = 0;
    for (size_t k = 0; all && k < all->count && asked->effects < MOST_EFFECTS; ++k)
        asked_add(&all->effect[k], asked);
    return (hci_effects){asked->effect, asked->effects};
}

/* The readings and what the drive makes of them, each less the table at its angle. */
static void departures_at(const hci_currents *table, const hci_run *run, int pole_pairs, size_t k,
                          const hci_effects *sensors, double raw[3], double mended[3])
{
    hci_sample reading = {.theta_m_rad = run->theta_m_rad[k],
                          .speed_rad_per_s = run->speed_rad_per_s ? run->speed_rad_per_s[k] : 0.0,
                          .temperature_C = (double)NAN,
                          .computed_phase = run->computed_phase};
    double at[3];
    memcpy(reading.i_abc, run->i_A + 3 * k, sizeof reading.i_abc);
    const hci_sample truth = hci_effects_undo(sensors, pole_pairs, &reading);
    hci_waves_at(table->wave, table->count, pole_pairs * reading.theta_m_rad, at);
    for (int s = 0; s < 3; ++s)
        raw[s] = reading.i_abc[s] - at[s];
    hci_waves_at(table->wave, table->count, pole_pairs * truth.theta_m_rad, at);
    for (int s = 0; s < 3; ++s)
        mended[s] = truth.i_abc[s] - at[s];
}

/* Currents of a rotor frame are of an angle that may have been corrected or not. */
static bool are_phases(const hci_run *run)
{
    return run->has_sum || run->computed_phase != 0;
}

static void corrections_find(const hci_currents *table, const hci_run *run, int pole_pairs,
                             const hci_effects *effects, hci_table_beside *to)
{
    asked_corrections asked;
    const hci_effects sensors = asked_of(effects, &asked);
    double rr = 0.0, rd = 0.0, dd = 0.0, raw[3], mended[3];
    to->corrected = to->corrected_error = (double)NAN;
    if (sensors.count == 0 || !are_phases(run)) return;
    for (size_t k = 0; k < run->count; ++k) {
        departures_at(table, run, pole_pairs, k, &sensors, raw, mended);
        for (int s = 0; s < 3; ++s) {
            const double d = raw[s] - mended[s];
            rr += raw[s] * raw[s], rd += raw[s] * d, dd += d * d;
        }
    }
    if (!(dd > 0.0)) return;
    to->corrected = rd / dd;
    to->corrected_error = sqrt(fmax(0.0, rr - rd * rd / dd) / (2.0 * (double)run->count) / dd);
    to->corrections_A = sqrt(dd / (3.0 * (double)run->count));
}

hci_table_beside hci_table_beside_of(const hci_currents *table, const hci_run *run, int pole_pairs,
                                     double rotation_rad, const hci_effects *effects)
{
    hci_table_beside x = {0};
    sums s;
    sum_up(table, run, pole_pairs, rotation_rad, &s);
    harmonics_find(&s, &x);
    corrections_find(table, run, pole_pairs, effects, &x);
    return x;
}
