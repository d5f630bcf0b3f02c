/* The report of `tune`: what was read, found, solved and emitted, and what is left open. */
#ifndef HCI_HOST_REPORT_TUNE_TUNING_H
#define HCI_HOST_REPORT_TUNE_TUNING_H

#include "hci/host/recording/run.h"
#include "hci/host/solve/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Parts of the report, in their order. */
typedef enum {
    HCI_TUNING_CAVEATS, /* what the heading hangs on, and what else one has to know before the table is used
                         */
    HCI_TUNING_READ,    /* what was read, and how it was taken */
    HCI_TUNING_FOUND,   /* values with their standard errors */
    HCI_TUNING_WANTED,  /* the torque that was solved for, and why that */
    HCI_TUNING_UNKNOWN, /* what the recordings do not tell */
    HCI_TUNING_NEXT,    /* what to record next */
    HCI_TUNING_LOAD,    /* how the table gets into a drive */
    HCI_TUNING_ELSE,    /* the same for other drives and other torques */
    HCI_TUNING_PARTS
} hci_tuning_part;

/* Bytes of a part, and of the commands; points of a period, its ends included. */
enum { HCI_TUNING_TEXT = 16384, HCI_TUNING_POINTS = 2881 };

/* All of it. Start with {0}; texts are lines, each ended by '\n'. */
typedef struct {
    bool good;                                    /* everything could be done and is known */
    char verdict[64], heading[2048];              /* in a word, and as a sentence */
    char part[HCI_TUNING_PARTS][HCI_TUNING_TEXT]; /* "": nothing to say */
    char commands[HCI_TUNING_TEXT];               /* the steps, for a shell */
    const hci_solution *solution;                 /* the currents; NULL: none were solved */
    hci_status solved;                            /* what solving them answered */
    double table_Nm;                              /* ripple with the table, in the model; 0: not known */
    const hci_run *log;                           /* the recording that is shown; NULL: none */
    const char *log_name;                         /* as it was given */
    const double *open_Nm; /* torque without current over the period of the solution, HCI_TUNING_POINTS; NULL:
                            * none */
} hci_tuning;

/* The heading of a part; a static string. */
const char *hci_tuning_part_name(hci_tuning_part part);

/* Appends a line to a part; what has no room is cut off. */
void hci_tuning_say(hci_tuning *tuning, hci_tuning_part part, const char *format, ...) HCI_PRINTF(3, 4);

/* Peak to peak of the torque of the plain sine and of the currents, in N·m. solution: with orders. */
void hci_tuning_swing(const hci_solution *solution, double *before_Nm, double *after_Nm);

/* Whether a table was written: there is something to load. */
bool hci_tuning_has_table(const hci_tuning *tuning);

/* Whether a ripple was found: a model without one says nothing of the machine's. solution: with orders. */
bool hci_tuning_knows_ripple(const hci_solution *solution);

/* Writes `runs.csv`, a list of recordings that are all fitted, into `folder`; test: "holding" or "".
 * HCI_ERROR_INPUT for one that is not there, HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_tuning_write_list(const char *folder, const char *const *log, size_t count, const char *test,
                                 hci_note *note);

/* In a message that begins with the path of a recording as that list has it, puts the path as it was given.
 */
void hci_tuning_name_log(const char *folder, const char *const *log, size_t count, hci_note *note);

/* Writes target.csv, a torque without ripple, into `folder`. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_tuning_write_target(const char *folder, double mean_Nm, hci_note *note);

/* Writes effects.csv, which has the zero of a torque sensor alone, into the folder of a machine.
 * HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_tuning_write_sensor_zero(const char *folder, double offset_Nm, hci_note *note);

/* Writes report.html, summary.json and commands.sh into `folder`; all or none. HCI_ERROR_OUTPUT, _MEMORY. */
hci_status hci_tuning_write(const hci_tuning *tuning, const char *folder, hci_note *note);

/* As in summary.json of `tune`, to be freed with hci_text_free. */
char *hci_tuning_json(const hci_tuning *tuning);

#ifdef __cplusplus
}
#endif

#endif
