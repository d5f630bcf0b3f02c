#include "host/foreign/as_recording.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "host/base/memory.h"
#include "host/foreign/text.h"

/* Rows of a map of harmonics, rows between two nodes that straight lines join, and bytes of a row at most. */
enum { ROWS_OF_HARMONICS = 2048, ROWS_OF_A_LINE = 4, ROW_SIZE = 4 * 32 };

static size_t rows_of(const hci_foreign_map *map)
{
    if (map->points == 0) return ROWS_OF_HARMONICS;
    return map->points * (map->type->in_middle ? 1 : ROWS_OF_A_LINE);
}

const hci_foreign_type *hci_foreign_recognise(const char *text)
{
    if (memchr(text, '\0', HCI_FOREIGN_MOST_BYTES) == NULL) return NULL;
    for (int k = 0; k < HCI_FOREIGN_TARGET_COUNT; ++k)
        if (hci_foreign_types[k]->recognises(text)) return hci_foreign_types[k];
    return NULL;
}

hci_status hci_foreign_read(const hci_foreign_type *type, const char *path, const char *text,
                            hci_foreign_map *map, hci_note *note)
{
    hci_foreign_map_init(map, type);
    hci_status status = hci_foreign_read_head(path, text, map, note);
    if (!status) status = type->read(path, text, map, note);
    if (status) hci_foreign_map_release(map);
    return status;
}

static const char *header(const hci_foreign_map *map)
{
    const bool electrical = map->type->is_electrical;
    switch (map->type->kind) {
    case HCI_FOREIGN_TORQUE:
        return electrical ? "theta_e_rad,torque_Nm\n" : "theta_m_rad,torque_Nm\n";
    case HCI_FOREIGN_DQ:
    case HCI_FOREIGN_Q:
        break;
    }
    return electrical ? "theta_e_rad,id_A,iq_A,torque_Nm\n" : "theta_m_rad,id_A,iq_A,torque_Nm\n";
}

/* What the drive adds at standstill, in the sense of the machine. */
static int row(const hci_foreign_map *map, double turn, char text[ROW_SIZE])
{
    double add[2];
    char theta[32], d[32], q[32];
    map->type->at(map, turn, 0.0, add);
    hci_number_text(hci_foreign_theta_rad(map, turn), theta);
    hci_number_text(add[0], d);
    hci_number_text(map->direction * add[1] + 0.0, q);
    if (map->type->kind == HCI_FOREIGN_TORQUE) {
        hci_number_text(-map->direction * add[1] + 0.0, q);
        return snprintf(text, ROW_SIZE, "%s,%s\n", theta, q);
    }
    return snprintf(text, ROW_SIZE, "%s,%s,%s,0\n", theta, d, q);
}

hci_status hci_foreign_as_csv(const hci_foreign_map *map, char **csv, hci_note *note)
{
    const size_t rows = rows_of(map);
    const char *const names = header(map);
    size_t used = strlen(names);
    *csv = hci_memory_malloc(used + rows * ROW_SIZE + 1);
    if (*csv == NULL) return hci_note_memory(note, NULL, "a map of %zu rows", rows);
    memcpy(*csv, names, used + 1);
    for (size_t k = 0; k < rows; ++k)
        used += (size_t)row(map, ((double)k + 0.5) / (double)rows, *csv + used);
    return HCI_OK;
}
