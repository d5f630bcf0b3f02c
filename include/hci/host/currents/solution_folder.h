/* The folder of a solution: which files it has, and how their currents are read again. */
#ifndef HCI_HOST_CURRENTS_SOLUTION_FOLDER_H
#define HCI_HOST_CURRENTS_SOLUTION_FOLDER_H

#include <stdbool.h>

#include "hci/host/currents/currents.h"
#include "hci/host/machine/machine.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The files. Those of the two parts are there only where the currents are linear in the mean torque, the
 * report only where it was asked for. */
typedef enum {
    HCI_SOLUTION_CURRENTS,          /* currents.csv: what flows, in A */
    HCI_SOLUTION_CURRENTS_PER_NM,   /* currents_per_Nm.csv: for each N·m of mean torque, in A/(N·m) */
    HCI_SOLUTION_CURRENTS_CONSTANT, /* currents_constant.csv: the rest, in A */
    HCI_SOLUTION_SPECTRUM,          /* spectrum.csv: torque order by order */
    HCI_SOLUTION_WAVEFORM,          /* waveform.csv: currents and torque over the angle */
    HCI_SOLUTION_PICTURE,           /* solution.svg */
    HCI_SOLUTION_SUMMARY,           /* summary.json */
    HCI_SOLUTION_REPORT,            /* report.html */
    HCI_SOLUTION_FILES              /* how many there are */
} hci_solution_file;

/* The name of a file in the folder; a static string. */
const char *hci_solution_file_name(hci_solution_file file);

/* Whether a path that names currents is a folder; else it is one file of them. */
bool hci_solution_is_folder(const char *path);

/* Whether the folder has the currents in the two parts that a torque scales. */
bool hci_solution_has_parts(const char *folder);

/* Whether its spectrum.csv is there, from which its mean torque is read. */
bool hci_solution_has_spectrum(const char *folder);

/* Reads one of the three files of currents. path: the folder, or with HCI_SOLUTION_CURRENTS also one file.
 * HCI_ERROR_INPUT, _MEMORY. */
hci_status hci_solution_read_currents(const char *path, hci_solution_file part, hci_currents *currents,
                                      hci_note *note);

/* The mean torque in N·m that the folder's currents were solved for. HCI_ERROR_INPUT when it has none,
 * _MEMORY. */
hci_status hci_solution_read_mean_torque(const char *folder, double *torque_Nm, hci_note *note);

/* The same, 0 where it was solved without a mean torque. */
hci_status hci_solution_read_wanted_torque(const char *folder, double *torque_Nm, hci_note *note);

/* The mean torque in N·m that the currents of such a folder make, which limits may keep below the wanted one;
 * 0: not known. */
double hci_solution_read_made_torque(const char *path);

/* What `solve` expects of them on the machine, peak to peak in N·m (95 %); 0: not known, or one file. */
double hci_solution_read_expected_ripple(const char *path);

/* How the currents of a folder stand to what was asked of `solve`. */
typedef enum {
    HCI_SOLUTION_GOOD,         /* as wanted, or nothing is known of them */
    HCI_SOLUTION_NOT_REACHED,  /* the nearest to a torque that is not reached */
    HCI_SOLUTION_OUT_OF_LIMITS /* a limit is not kept */
} hci_solution_verdict;

/* The peak of a phase current in A that a solution was limited to; NAN where it was not, or does not say. */
double hci_solution_read_current_limit(const char *path);

/* By summary.json of the folder; good for one file, and where there is none. */
hci_solution_verdict hci_solution_read_verdict(const char *path);

enum { HCI_SOLUTION_WORDS = 240 };

/* In words, and by how much a torque is missed; "" where they are good. words[size]: HCI_SOLUTION_WORDS are
 * enough. */
void hci_solution_verdict_words(const char *path, char *words, size_t size);

/* HCI_ERROR_INPUT for a folder without currents.csv: what it is, and what to do. */
hci_status hci_solution_check_folder(const char *folder, hci_note *note);

/* Adds these words to a remark, with the folder; and, where summary.json names another machine than the given
 * one, or one of the same name with other files, both. machine: that the currents are for, or NULL. */
void hci_solution_remark(const char *path, const hci_machine_data *machine, hci_note *remark);

#ifdef __cplusplus
}
#endif

#endif
