/* One interval of the machine's table, in line for the right-hand side of the plant. */
#ifndef HCI_SRC_CORE_DRIVE_PLANT_TABLE_H
#define HCI_SRC_CORE_DRIVE_PLANT_TABLE_H

#include "hci/drive/plant.h"

/* A row: the values, then as many slopes by the table's step. */
enum { HCI_ROW_E, HCI_ROW_COGGING = 2, HCI_ROW_L, HCI_ROW_VALUES = 6, HCI_ROW = 2 * HCI_ROW_VALUES };

/* The row before an angle, and the way u in 0 … 1 to the next one. What is not a sensible angle reads the
 * first row, so that no state of the plant, not a number included, reads outside the table. */
static inline const double *hci_plant_table_row(const hci_plant_table *table, double theta_m_rad, double *u)
{
    double position = theta_m_rad * table->points_per_rad;
    if (!(position > -1e9 && position < 1e9)) position = 0.0;
    const int points = table->points, before = (int)position - (position < 0.0);
    *u = position - (double)before;
    int row = before;
    if (row < 0 || row >= points) {
        row %= points;
        row += row < 0 ? points : 0;
    }
    return table->rows + (size_t)row * HCI_ROW;
}

/* Cubic Hermite: y = y_0 + (y_1 − y_0) h_01 + y'_0 h_10 + y'_1 h_11, and its derivative for L. */
static inline void hci_plant_table_point(const hci_plant_table *table, double theta_m_rad, hci_plant_point *p)
{
    double u, value[HCI_ROW_VALUES];
    const double *y0 = hci_plant_table_row(table, theta_m_rad, &u), *s0 = y0 + HCI_ROW_VALUES;
    const double *y1 = y0 + HCI_ROW, *s1 = y1 + HCI_ROW_VALUES;
    const double rest = 1.0 - u, uu = u * u;
    const double h01 = uu * (3.0 - 2.0 * u), h10 = u * rest * rest, h11 = -uu * rest;
    const double g01 = 6.0 * u * rest, g10 = rest * (1.0 - 3.0 * u), g11 = u * (3.0 * u - 2.0);
    for (int k = 0; k < HCI_ROW_VALUES; ++k)
        value[k] = y0[k] + ((y1[k] - y0[k]) * h01 + (s0[k] * h10 + s1[k] * h11));
    for (int k = 0; k < 3; ++k) {
        p->inductance_H[k] = value[HCI_ROW_L + k];
        p->magnetic.slope[k] = 0.0;
    }
    if (table->salient) {
        const double *l0 = y0 + HCI_ROW_L, *l1 = y1 + HCI_ROW_L, *d0 = s0 + HCI_ROW_L, *d1 = s1 + HCI_ROW_L;
        for (int k = 0; k < 3; ++k)
            p->magnetic.slope[k] =
                table->points_per_rad * ((l1[k] - l0[k]) * g01 + (d0[k] * g10 + d1[k] * g11));
    }
    p->magnetic.e[0] = value[HCI_ROW_E];
    p->magnetic.e[1] = value[HCI_ROW_E + 1];
    p->magnetic.cogging_Nm = value[HCI_ROW_COGGING];
    p->shaft_Nm = 0.0;
}

#endif
