/* Sections of the page of a solution, each a sentence and the picture that shows it. */
#ifndef HCI_SRC_HOST_REPORT_PAGE_SOLUTION_SECTIONS_H
#define HCI_SRC_HOST_REPORT_PAGE_SOLUTION_SECTIONS_H

#include "host/draw/html.h"
#include "host/plot/plot.h"
#include "host/report/page/page.h"

/* Torque below this share of the tolerance is rounding. */
#define HCI_PAGE_ROUNDING 1e-3

typedef struct {
    hci_output *out;
    const hci_solution *solution;
    hci_plot_facts facts;
    bool ripple_is_unknown; /* the model has none, and that is not what was measured */
    char origin[HCI_PAGE_ORIGIN_SIZE];
} hci_solution_page;

/* ---- solution_words.c: what the page says first ---- */

/* Verdict, and before and after in large figures. verdict: what hci_solve returned. */
void hci_page_solution_verdict(const hci_solution_page *page, hci_status verdict, const char *machine);

/* The table of before and after; in words what to expect of the real machine. */
void hci_page_before_and_after(const hci_solution_page *page);
void hci_page_expectation(const hci_solution_page *page);

/* "3.8 N·m"; "less than 2 µN·m" where it is below the tolerance of the orders. */
enum { HCI_PAGE_SWING_SIZE = HCI_HTML_NUMBER_SIZE + 16 };
void hci_page_swing(char text[HCI_PAGE_SWING_SIZE], hci_range range, double tolerance_Nm);

/* Of the copper losses, with four digits: 1.005 is not 1. */
void hci_page_ratio(char text[HCI_HTML_NUMBER_SIZE], double ratio);

/* Whether there is a plain sine to compare with. */
bool hci_page_has_plain(const hci_solution *solution);

/* ---- the sections ---- */

/* What is drawn of the torque, and of that to expect on the machine. */
void hci_page_torque_caption(const hci_solution *solution, char text[256]);

/* Torque over the angle, and by order. */
void hci_page_torque(const hci_solution_page *page);
void hci_page_torque_orders(const hci_solution_page *page);

/* Phase currents, and the current vector. */
void hci_page_currents(const hci_solution_page *page);
void hci_page_vector(const hci_solution_page *page);

/* How the currents stand to their limits; nothing where there are none. */
void hci_page_limits(const hci_solution_page *page);

#endif
