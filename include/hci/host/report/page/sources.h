/* report.html: results as one page for people, with pictures and the tables behind them. It stands on its
 * own: no script, font or picture from elsewhere. */
#ifndef HCI_HOST_REPORT_PAGE_SOURCES_H
#define HCI_HOST_REPORT_PAGE_SOURCES_H

#ifdef __cplusplus
extern "C" {
#endif

/* Where the numbers of a report come from, as the user named it: shown as it stands. NULL where there is no
 * such file. */
typedef struct {
    const char *machine;             /* folder */
    const char *target, *harmonics;  /* of a solution */
    const char *scenario, *currents; /* of a simulation */
    const char *runs;                /* of a diagnosis */
    const char *drive;               /* drive.csv */
} hci_report_sources;

#ifdef __cplusplus
}
#endif

#endif
