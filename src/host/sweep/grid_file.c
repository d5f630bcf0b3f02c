#include "hci/host/sweep/grid_file.h"

#include <math.h>

#include "hci/host/csv/csv.h"
#include "host/base/memory.h"

/* What one column holds, into one member of each point. */
static hci_status take_column(const hci_csv *csv, const char *column, double *value, double *member,
                              hci_note *note)
{
    const size_t stride = sizeof(hci_grid_point) / sizeof *member;
    const hci_status status = hci_csv_numbers(csv, column, value, note);
    for (size_t k = 0; k < hci_csv_rows(csv) && !status; ++k)
        member[k * stride] = value[k];
    return status;
}

static hci_status check(const hci_csv *csv, const hci_grid_point *point, hci_note *note)
{
    for (size_t k = 0; k < hci_csv_rows(csv); ++k)
        if (!isnan(point[k].link_V) && !(point[k].link_V > 0.0))
            return hci_csv_error(csv, "dc_link_V", k, note, "a voltage above 0",
                                 "leave the column out where the dc link of machine.csv holds");
    return HCI_OK;
}

static hci_status take(const hci_csv *csv, hci_grid_point *point, hci_note *note)
{
    const size_t count = hci_csv_rows(csv);
    double *value = hci_memory_new(count, sizeof *value);
    hci_status status = value ? HCI_OK : hci_note_memory(note, hci_csv_path(csv), "the points");
    for (size_t k = 0; k < count; ++k)
        point[k] = (hci_grid_point){NAN, 0.0, NAN, NAN, NAN};
    if (!status) status = take_column(csv, "torque_Nm", value, &point->torque_Nm, note);
    if (!status) status = take_column(csv, "speed_rad_per_s", value, &point->speed_rad_per_s, note);
    if (!status && hci_csv_has(csv, "dc_link_V"))
        status = take_column(csv, "dc_link_V", value, &point->link_V, note);
    hci_memory_free(value);
    return status ? status : check(csv, point, note);
}

hci_status hci_grid_read(const char *path, hci_grid_point **point, size_t *count, hci_note *note)
{
    hci_csv *csv;
    hci_status status = hci_csv_read(path, &csv, note);
    *point = NULL;
    *count = 0;
    if (status) return status;
    *count = hci_csv_rows(csv);
    *point = hci_memory_new(*count, sizeof **point);
    if (!*point)
        status = hci_note_memory(note, path, "the points");
    else if (*count == 0)
        status = hci_note_set(note, HCI_ERROR_INPUT,
                              "%s: no rows; expected a point in each, torque_Nm,speed_rpm", path);
    else
        status = take(csv, *point, note);
    hci_csv_free(csv);
    if (status) {
        hci_grid_points_free(*point);
        *point = NULL, *count = 0;
    }
    return status;
}

void hci_grid_points_free(hci_grid_point *point)
{
    hci_memory_free(point);
}
