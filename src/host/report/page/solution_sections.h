/* Sections of the page of a solution, and what they share. */
#ifndef HCI_SRC_HOST_REPORT_PAGE_SOLUTION_SECTIONS_H
#define HCI_SRC_HOST_REPORT_PAGE_SOLUTION_SECTIONS_H

#include "host/plot/plot.h"
#include "host/report/page/page.h"

/* Rows of the tables over one turn, not at the same phase of each sixth of it, where the ripple repeats. */
enum { HCI_PAGE_STEPS = 32 };

/* Torque below this share of the tolerance is rounding. */
#define HCI_PAGE_ROUNDING 1e-3

typedef struct {
    hci_output *out;
    const hci_solution *solution;
    hci_plot_facts facts;
    hci_plot_point point[HCI_PAGE_STEPS + 1]; /* over the first electrical turn */
    char origin[HCI_PAGE_ORIGIN_SIZE];
} hci_solution_page;

/* ---- solution_panel.c: what the sections share ---- */

/* Whether the first order of the solution is the mean. */
bool hci_page_has_mean(const hci_solution *solution);

/* Electrical angle of a row over one turn. */
double hci_page_angle_deg(size_t step);

void hci_page_row(hci_output *out, const double *value, size_t count);

/* Least, most and their difference; least: what is below it is rounding. */
void hci_page_row_of_range(hci_output *out, const char *name, hci_range range, double least);

/* A panel of the picture with its tables beside it. numbers: the files that have them. */
void hci_page_panel(const hci_solution_page *page, hci_plot_panel panel,
                    void (*tables)(const hci_solution_page *page), const char *caption, const char *numbers);

/* ---- the sections ---- */

/* Torque over the angle and by order. */
void hci_page_torque(const hci_solution_page *page);

/* Phase currents and current vector. */
void hci_page_currents(const hci_solution_page *page);

/* The system that was solved. */
void hci_page_system(const hci_solution_page *page);

#endif
