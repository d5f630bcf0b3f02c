/* How recordings are read, from the options that every command that reads them has, and what is said of files
 * that several commands read. Uses option. */
#ifndef HCI_CLI_READING_H
#define HCI_CLI_READING_H

#include "cli/command/option.h"
#include "hci/host/drive/drive.h"
#include "hci/host/recording/run.h"

/* The options of reading, and what they own. */
typedef struct {
    hci_run_options run; /* pole pairs and inertia are the caller's to fill in */
    hci_column_names columns;
} cli_reading;

/* Takes --column and, where they are given, --strict and --angle-offset (NULL: not). *reading is to be
 * released even after a failure, and not to be moved. HCI_ERROR_ARGUMENT, HCI_ERROR_MEMORY. */
hci_status cli_reading_take(const cli_arguments *arguments, bool strict, const char *angle_offset,
                            cli_reading *reading, hci_note *note);
void cli_reading_release(cli_reading *reading);

/* The words of a command line, from word `first` on recordings, without a `columns.csv`: what a shell makes
 * of a pattern names it too, but it is no recording. to: out. */
void cli_reading_without_lists(const cli_arguments *from, size_t first, cli_arguments *to);

/* The remarks of recordings: remark(context, k) for k < count. */
typedef struct {
    const hci_note *(*remark)(const void *context, size_t k);
    const void *context;
    size_t count;
} cli_remarks;

/* Says each remark once: first how recordings were read, then the columns that were not used. first: the
 * first recording that it is of; alike: how many it is of. */
void cli_remarks_group(const cli_remarks *all,
                       void (*say)(void *to, size_t first, size_t alike, const char *text), void *to);

/* The same as remarks on standard error. */
void cli_remark_each(const hci_note *(*remark)(const void *context, size_t k), const void *context,
                     size_t count);

/* What was taken for what drive.csv does not say, and that L_d and L_q of the drive differ, which currents do
 * not count on. folder: of the machine. */
void cli_remark_drive(const hci_drive_data *drive, const hci_machine_data *machine, const char *folder);

/* That loop.csv is not what the gains make. */
void cli_remark_response(const hci_drive_data *drive, const hci_machine_data *machine);

/* Says that the encoder has too few counts for the orders of a table; as hci_drive_remark_counts. */
void cli_remark_counts(const hci_drive_data *drive, const hci_machine_data *machine, double highest_order,
                       double torque_Nm, double mean_Nm);

/* Says of currents that repeat after more turns than a rotor angle tells apart. pole_pairs: 0: not known. */
void cli_remark_period(size_t period_turns, int pole_pairs);

#endif
