/* Sweeps whose figures are made up, to be shown. Prefix grid_. */
#ifndef GRID_BY_HAND_H
#define GRID_BY_HAND_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/sweep/sweep.h"
#include "support/reference.h"

enum { GRID_MOST = 12 };

static hci_machine_data grid_machine;
static hci_solve_options grid_options;
static hci_grid_point grid_point[GRID_MOST];
static hci_grid_row grid_row[GRID_MOST];
static bool grid_done[GRID_MOST];

static inline double grid_rad_per_s(double rpm)
{
    return rpm * 2.0 * REF_PI / 60.0;
}

/* All figures from one number, no two of them alike. */
static inline hci_grid_figures grid_figures(double x)
{
    return (hci_grid_figures){.mean_Nm = x,
                              .T_ripple_percent = 2.0 * x,
                              .worst_Nm = 0.1 * x,
                              .worst_order = 6.0,
                              .mean_square_A2 = 30.0 * x,
                              .loss_to_plain = 1.0 + 0.01 * x,
                              .peak_A = 7.0 * x,
                              .rms_A = 4.0 * x,
                              .line_V = 11.0 * x};
}

static inline hci_grid_figures grid_no_figures(void)
{
    return (hci_grid_figures){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, {false}};
}

static inline hci_grid grid_of(hci_grid_kind kind, size_t count)
{
    hci_grid s;
    memset(&s, 0, sizeof s);
    memset(&grid_machine, 0, sizeof grid_machine);
    memset(&grid_options, 0, sizeof grid_options);
    grid_machine.resistance_ohm = 0.5;
    s.request.kind = kind;
    s.request.machine = &grid_machine;
    s.request.options = &grid_options;
    s.plan.point = grid_point;
    s.plan.count = count;
    s.row = grid_row;
    s.done = grid_done;
    for (size_t k = 0; k < count; ++k) {
        grid_point[k] = (hci_grid_point){NAN, NAN, NAN, NAN, NAN};
        memset(&grid_row[k], 0, sizeof grid_row[k]);
        grid_row[k].best = grid_row[k].most = grid_row[k].sine = grid_no_figures();
        grid_done[k] = true;
    }
    return s;
}

/* Each row has its point. */
static inline void grid_finish(const hci_grid *s)
{
    for (size_t k = 0; k < s->plan.count; ++k)
        grid_row[k].point = grid_point[k];
}

/* 100, 200 and 400 rpm by 1 and 3 N·m; point k has the figures of k + 1. The last but one reaches less torque
 * within its limits, the last has no result. */
static inline hci_grid grid_map(void)
{
    static const double RPM[] = {100.0, 200.0, 400.0};
    const hci_grid s = grid_of(HCI_GRID_MAP, 6);
    for (size_t k = 0; k < 6; ++k) {
        grid_point[k].speed_rad_per_s = grid_rad_per_s(RPM[k % 3]);
        grid_point[k].torque_Nm = k < 3 ? 1.0 : 3.0;
        grid_row[k].best = grid_figures((double)k + 1.0);
        grid_row[k].verdict = k < 2 ? HCI_GRID_REACHED : HCI_GRID_RIPPLE;
    }
    grid_row[1].best.binds[HCI_LIMIT_CURRENT] = true;
    grid_row[2].best.binds[HCI_LIMIT_VOLTAGE] = true;
    grid_row[3].best.binds[HCI_LIMIT_CURRENT] = grid_row[3].best.binds[HCI_LIMIT_COPPER] = true;
    grid_row[4].best.binds[HCI_LIMIT_RMS] = true;
    grid_row[4].verdict = HCI_GRID_TORQUE;
    grid_row[5].best = grid_no_figures();
    grid_row[5].verdict = HCI_GRID_FAILED;
    snprintf(grid_row[5].reason, sizeof grid_row[5].reason, "no step was found");
    grid_finish(&s);
    return s;
}

/* 1000, 2000, 3000 rpm: torques of 3, 2 N·m and none with little ripple; with any ripple and of the plain
 * sine something at each. Where two is asked for, with links of 24 and 48 V, the second of a half more. */
static inline hci_grid grid_envelope(size_t links)
{
    hci_grid s = grid_of(HCI_GRID_ENVELOPE, 3 * links);
    s.request.ripple_percent = 2.5;
    s.request.speed_rad_per_s.count = 3;
    s.request.link_V.count = links;
    for (size_t k = 0; k < 3 * links; ++k) {
        const double factor = k < 3 ? 1.0 : 1.5, at = (double)(k % 3);
        grid_point[k].speed_rad_per_s = grid_rad_per_s(1000.0 * (at + 1.0));
        grid_point[k].link_V = links < 2 ? (double)NAN : k < 3 ? 24.0 : 48.0;
        grid_row[k].verdict = k % 3 == 2 ? HCI_GRID_RIPPLE : HCI_GRID_REACHED;
        if (k % 3 < 2) grid_row[k].best = grid_figures(factor * (3.0 - at));
        grid_row[k].most = grid_figures(factor * (4.0 - at));
        grid_row[k].sine = grid_figures(factor * (2.5 - at));
        if (k % 3 < 2) grid_row[k].best.T_ripple_percent = 0.5 * (at + 1.0);
    }
    grid_row[1].best.binds[HCI_LIMIT_VOLTAGE] = true;
    grid_finish(&s);
    return s;
}

/* 2 N·m: limits of 10, 12, 15 and 20 A of the current, of which the first does not do, and of 1.05, 1.2
 * and 1.5 of the copper. The ripple falls to 0. The plain sine has 14 A and 8 %. */
static inline hci_grid grid_trade_off(void)
{
    static const double LIMIT[] = {10.0, 12.0, 15.0, 20.0, 1.05, 1.2, 1.5};
    static const double RIPPLE[] = {NAN, 5.0, 0.8, 0.0, 6.0, 3.0, 0.005};
    hci_grid s = grid_of(HCI_GRID_TRADE_OFF, 7);
    s.plan.by_current = 4;
    for (size_t k = 0; k < 7; ++k) {
        grid_point[k].torque_Nm = 2.0;
        grid_point[k].speed_rad_per_s = grid_rad_per_s(600.0);
        if (k < 4)
            grid_point[k].limit_current_A = LIMIT[k];
        else
            grid_point[k].limit_copper = LIMIT[k];
        grid_row[k].verdict = k == 0 ? HCI_GRID_TORQUE : k == 3 ? HCI_GRID_REACHED : HCI_GRID_RIPPLE;
        grid_row[k].best = grid_figures(2.0);
        grid_row[k].best.T_ripple_percent = RIPPLE[k];
        grid_row[k].best.peak_A = k < 4 ? LIMIT[k] - 0.5 : 16.0 + 4.0 * (double)k;
        grid_row[k].best.loss_to_plain = k < 4 ? 1.4 - 0.02 * LIMIT[k] : LIMIT[k];
        grid_row[k].sine = grid_figures(2.0);
        grid_row[k].sine.T_ripple_percent = 8.0;
        grid_row[k].sine.peak_A = 14.0;
        grid_row[k].sine.loss_to_plain = 1.0;
    }
    grid_finish(&s);
    return s;
}

#endif
