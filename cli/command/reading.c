#include "cli/command/reading.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/terminal/say.h"
#include "hci/host/drive/drive_facts.h"

hci_status cli_reading_take(const cli_arguments *a, bool strict, const char *angle_offset,
                            cli_reading *reading, hci_note *note)
{
    char offset[200], from[240];
    hci_status status = HCI_OK;
    memset(reading, 0, sizeof *reading);
    reading->run.inertia_kgm2 = NAN;
    reading->run.strict = strict;
    reading->run.columns = &reading->columns;
    for (size_t k = 0; k < a->repeats && !status; ++k)
        status = hci_column_names_add(&reading->columns, a->repeated[k], note);
    if (status || angle_offset == NULL) return status;
    snprintf(offset, sizeof offset, "angle_offset=%s", angle_offset);
    snprintf(from, sizeof from, "--angle-offset %s", angle_offset);
    status = hci_column_names_add_text(&reading->columns, offset, from, note);
    return status == HCI_ERROR_INPUT ? HCI_ERROR_ARGUMENT : status;
}

void cli_reading_release(cli_reading *reading)
{
    hci_column_names_release(&reading->columns);
}

/* ---- recordings among words ---- */

static bool is_column_list(const char *path)
{
    const char *slash = strrchr(path, '/');
    return strcmp(slash ? slash + 1 : path, "columns.csv") == 0;
}

void cli_reading_without_lists(const cli_arguments *from, size_t first, cli_arguments *to)
{
    *to = *from;
    to->words = first < from->words ? first : from->words;
    for (size_t k = to->words; k < from->words; ++k)
        if (!is_column_list(from->word[k])) to->word[to->words++] = from->word[k];
    if (to->words == first) *to = *from; /* nothing else: the reader says why */
}

/* ---- remarks of several recordings ---- */

#define UNUSED "columns not used: "

/* What is said of a recording: first how it was read, then which columns were not. */
typedef enum { READ, NOT_USED } part_of_remark;

typedef struct {
    const char *text;
    size_t length;
} remark_part;

static remark_part part_of(const hci_note *remark, part_of_remark which)
{
    const char *unused = strstr(remark->text, UNUSED);
    if (which == NOT_USED) return (remark_part){unused ? unused : "", unused ? strlen(unused) : 0};
    size_t length = unused ? (size_t)(unused - remark->text) : strlen(remark->text);
    while (unused && length > 0 && strchr("; ", remark->text[length - 1]))
        --length;
    return (remark_part){remark->text, length};
}

static bool is_same(remark_part a, remark_part b)
{
    return a.length == b.length && memcmp(a.text, b.text, a.length) == 0;
}

/* How many recordings say what one says; 0 where one before it does, or nothing is said. */
static size_t alike_from(const cli_remarks *all, size_t first, part_of_remark which, remark_part one)
{
    size_t alike = 0;
    for (size_t j = 0; j < all->count && one.length > 0; ++j) {
        if (!is_same(part_of(all->remark(all->context, j), which), one)) continue;
        if (j < first) return 0;
        ++alike;
    }
    return alike;
}

void cli_remarks_group(const cli_remarks *all,
                       void (*say)(void *to, size_t first, size_t alike, const char *text), void *to)
{
    for (size_t k = 0; k < 2 * all->count; ++k) {
        const part_of_remark which = k < all->count ? READ : NOT_USED;
        const size_t first = k % all->count;
        const remark_part one = part_of(all->remark(all->context, first), which);
        const size_t alike = alike_from(all, first, which, one);
        char text[HCI_NOTE_SIZE];
        if (alike == 0) continue;
        snprintf(text, sizeof text, "%.*s", (int)one.length, one.text);
        say(to, first, alike, text);
    }
}

static void say_each(void *to, size_t first, size_t alike, const char *text)
{
    const cli_remarks *all = to;
    hci_note note = {{0}};
    (void)first;
    if (alike > 1)
        hci_note_set(&note, HCI_OK, "%zu of %zu recordings: %s", alike, all->count, text);
    else
        hci_note_set(&note, HCI_OK, "%s", text);
    cli_remark(&note);
}

void cli_remark_each(const hci_note *(*remark)(const void *context, size_t k), const void *context,
                     size_t count)
{
    cli_remarks all = {remark, context, count};
    if (count == 1)
        cli_remark(remark(context, 0));
    else
        cli_remarks_group(&all, say_each, &all);
}

void cli_remark_drive(const hci_drive_data *drive, const hci_machine_data *machine, const char *folder)
{
    hci_note decoupling = {{0}}, saliency = {{0}}, units = {{0}};
    hci_drive_remark_units(drive, machine, &units);
    cli_remark(&units);
    hci_drive_remark(drive, &decoupling);
    cli_remark(&decoupling);
    hci_drive_remark_saliency(drive, machine, folder, &saliency);
    cli_remark(&saliency);
}

void cli_remark_response(const hci_drive_data *drive, const hci_machine_data *machine)
{
    hci_note remark = {{0}};
    hci_drive_remark_response(drive, machine, &remark);
    cli_remark(&remark);
}

void cli_remark_counts(const hci_drive_data *drive, const hci_machine_data *machine, double highest_order,
                       double torque_Nm, double mean_Nm)
{
    hci_note remark = {{0}};
    hci_drive_remark_counts(drive, machine->model.pole_pairs, highest_order, torque_Nm, mean_Nm, &remark);
    cli_remark(&remark);
}

void cli_remark_period(size_t period_turns, int pole_pairs)
{
    hci_note remark = {{0}};
    if (pole_pairs < 1 || period_turns < 1 || (size_t)pole_pairs % period_turns == 0) return;
    hci_note_set(
        &remark, HCI_OK,
        "everything repeats after %zu electrical turns only, which is no part of the mechanical turn of %d; "
        "a rotor angle cannot drive it",
        period_turns, pole_pairs);
    cli_remark(&remark);
}
