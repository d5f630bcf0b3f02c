#include "host/foreign/map.h"

#include <math.h>
#include <string.h>

#include "hci/math/harmonic.h"
#include "host/base/memory.h"

void hci_foreign_map_init(hci_foreign_map *map, const hci_foreign_type *type)
{
    *map = (hci_foreign_map){.type = type, .direction = 1, .counts_per_A = 1.0};
    map->columns = type->kind == HCI_FOREIGN_DQ ? 4 : 1;
}

hci_status hci_foreign_map_points(hci_foreign_map *map, size_t points, hci_note *note)
{
    map->value = hci_memory_new(points * map->columns, sizeof *map->value);
    if (map->value == NULL) return hci_note_memory(note, NULL, "a map of %zu points", points);
    map->points = points;
    return HCI_OK;
}

void hci_foreign_map_release(hci_foreign_map *map)
{
    hci_memory_free(map->value);
    map->value = NULL;
    map->points = 0;
}

/* ---- angles ---- */

/* x without its whole part, in [0, 1). */
static double fraction_of(double x)
{
    const double f = x - floor(x);
    return f < 1.0 ? f : 0.0;
}

static double zero_in_turns(const hci_foreign_map *map)
{
    return (map->type->zero_deg + map->offset_deg) / 360.0;
}

double hci_foreign_turn(const hci_foreign_map *map, double theta_rad)
{
    return fraction_of(zero_in_turns(map) + map->direction * theta_rad / (2.0 * HCI_PI));
}

double hci_foreign_theta_rad(const hci_foreign_map *map, double turn)
{
    return 2.0 * HCI_PI * map->direction * (turn - zero_in_turns(map));
}

/* ---- values ---- */

void hci_foreign_line(const hci_foreign_map *map, double turn, double *value)
{
    const double at = turn * (double)map->points;
    const size_t left = (size_t)at % map->points, right = (left + 1) % map->points;
    const double share = at - floor(at);
    for (size_t c = 0; c < map->columns; ++c) {
        const double a = map->value[left * map->columns + c], b = map->value[right * map->columns + c];
        value[c] = a + share * (b - a);
    }
}

double hci_foreign_sum(const hci_foreign_map *map, double turn)
{
    double sum = 0.0;
    for (size_t k = 0; k < map->terms; ++k)
        sum +=
            map->term[k].amplitude * sin(2.0 * HCI_PI * map->term[k].order * turn + map->term[k].phase_rad);
    return sum;
}

hci_status hci_foreign_balance(hci_foreign_map *map, hci_note *note)
{
    const size_t n = map->points, m = map->columns;
    double *const smooth = hci_memory_new(n * m, sizeof *smooth);
    if (smooth == NULL) return hci_note_memory(note, NULL, "a map of %zu points", n);
    memcpy(smooth, map->value, n * m * sizeof *smooth);
    for (size_t k = 0; k < n; ++k) {
        const size_t before = (k + n - 1) % n, after = (k + 1) % n;
        for (size_t c = 0; c < m; ++c)
            map->value[k * m + c] -=
                (smooth[before * m + c] - 2.0 * smooth[k * m + c] + smooth[after * m + c]) / 16.0;
    }
    hci_memory_free(smooth);
    return HCI_OK;
}

double hci_foreign_largest(const hci_foreign_map *map, size_t column)
{
    double largest = 0.0;
    for (size_t k = 0; k < map->points; ++k)
        largest = fmax(largest, fabs(map->value[k * map->columns + column]));
    return largest;
}

size_t hci_foreign_index(const hci_foreign_map *map, double turn)
{
    const size_t index = (size_t)(turn * (double)map->points);
    return index < map->points ? index : map->points - 1;
}

/* ---- terms ---- */

static hci_foreign_term term_of(const double *value, size_t count, size_t order)
{
    double sine = 0.0, cosine = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const double x = 2.0 * HCI_PI * (double)(order * k % count) / (double)count;
        sine += value[k] * sin(x) * 2.0 / (double)count;
        cosine += value[k] * cos(x) * 2.0 / (double)count;
    }
    return (hci_foreign_term){(double)order, hypot(sine, cosine), atan2(cosine, sine)};
}

/* Keeps the terms in the order of their amplitudes; returns the one for which there is no room. */
static hci_foreign_term put_in(hci_foreign_map *map, hci_foreign_term term)
{
    size_t place = map->terms;
    while (place > 0 && map->term[place - 1].amplitude < term.amplitude)
        --place;
    for (size_t k = place; k < map->terms; ++k) {
        const hci_foreign_term moved = map->term[k];
        map->term[k] = term;
        term = moved;
    }
    if (map->terms == map->type->most_terms) return term;
    map->term[map->terms++] = term;
    return (hci_foreign_term){0.0, 0.0, 0.0};
}

void hci_foreign_find_terms(hci_foreign_map *map, const double *value, size_t count)
{
    double largest = 0.0;
    for (size_t k = 0; k < count; ++k)
        largest = fmax(largest, fabs(value[k]));
    map->terms = 0;
    for (size_t order = 1; (double)order <= map->type->most_order && order < count / 2; ++order) {
        const hci_foreign_term term = term_of(value, count, order);
        if (term.amplitude < 1e-4 * largest) continue;
        const hci_foreign_term lost = put_in(map, term);
        map->left_out += lost.amplitude > 0.0;
        map->left_out_amplitude = fmax(map->left_out_amplitude, lost.amplitude);
    }
}

static bool lags(const hci_foreign_map *map)
{
    return map->wave == HCI_FOREIGN_SINE_LAG || map->wave == HCI_FOREIGN_COSINE_LAG;
}

/* By how much a term's own sine is ahead of its phase. */
static double lead_rad(const hci_foreign_map *map)
{
    return map->wave == HCI_FOREIGN_COSINE || map->wave == HCI_FOREIGN_COSINE_LAG ? HCI_PI / 2.0 : 0.0;
}

double hci_foreign_phase_in_file(const hci_foreign_map *map, double phase_rad)
{
    const double phase = (phase_rad - lead_rad(map)) * (lags(map) ? -1.0 : 1.0);
    return 2.0 * HCI_PI * fraction_of(phase / (2.0 * HCI_PI));
}

double hci_foreign_phase_of_file(const hci_foreign_map *map, double phase_rad)
{
    return (lags(map) ? -phase_rad : phase_rad) + lead_rad(map);
}
