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

double hci_foreign_fraction(double x)
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
    return hci_foreign_fraction(zero_in_turns(map) + map->direction * theta_rad / (2.0 * HCI_PI));
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
