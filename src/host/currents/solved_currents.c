/* The currents that stand beside a diagnosis, and what was promised of them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/currents/played.h"
#include "hci/host/currents/solution_folder.h"
#include "host/base/json.h"
#include "host/base/memory.h"
#include "host/base/whole_file.h"

static bool path_make(char to[HCI_SOLVED_PATH_SIZE], const char *folder, const char *name)
{
    const int length = snprintf(to, HCI_SOLVED_PATH_SIZE, "%s%s", folder, name);
    return length > 0 && length < HCI_SOLVED_PATH_SIZE;
}

/* The folder currents beside LAST: "out/diagnose" gives "out/currents", and "diagnosed" gives "currents". */
static bool path_beside(char to[HCI_SOLVED_PATH_SIZE], const char *last, const char *name)
{
    size_t length = strlen(last);
    while (length > 1 && last[length - 1] == '/')
        --length;
    while (length > 0 && last[length - 1] != '/')
        --length;
    const int made = snprintf(to, HCI_SOLVED_PATH_SIZE, "%.*s%s", (int)length, last, name);
    return length < HCI_SOLVED_PATH_SIZE && made > 0 && made < HCI_SOLVED_PATH_SIZE;
}

static bool has_currents(const char *folder)
{
    return hci_solution_is_folder(folder) && hci_solution_check_folder(folder, NULL) == HCI_OK;
}

/* Whether the summary of a solution names the machine of the diagnosis. */
static bool is_for(const char *folder, const hci_machine_data *machine)
{
    char path[HCI_SOLVED_PATH_SIZE], digest[sizeof machine->identity.digest] = "";
    char *text = path_make(path, folder, "/summary.json") ? hci_whole_file(path) : NULL;
    const bool found = text && hci_json_find_text(text, "machine", "digest", digest, sizeof digest);
    hci_memory_free(text);
    return found && digest[0] && strcmp(digest, machine->identity.digest) == 0;
}

/* Of `tune`, whose bound has the cut of the table in it; NAN where LAST is no part of one. */
static double promise_of_tune(const char *last)
{
    char path[HCI_SOLVED_PATH_SIZE], command[16] = "";
    double promised_Nm = (double)NAN;
    bool is_known = false;
    char *text = path_beside(path, last, "summary.json") ? hci_whole_file(path) : NULL;
    if (text && hci_json_find_text(text, NULL, "command", command, sizeof command) &&
        strcmp(command, "tune") == 0 && hci_json_find_bool(text, "expected", "known", &is_known) && is_known)
        hci_json_find_number(text, "expected", "peak_to_peak_Nm_95", &promised_Nm);
    hci_memory_free(text);
    return promised_Nm;
}

/* Which folder it is; solved->folder is "" where there is none. */
static hci_status folder_find(const char *last, hci_solved_currents *s, hci_note *note)
{
    hci_machine_data machine = {0};
    if (!path_make(s->machine, last, "/machine") || !path_make(s->folder, last, "/solution")) {
        s->folder[0] = '\0';
        return HCI_OK;
    }
    if (has_currents(s->folder)) return HCI_OK;
    if (!path_beside(s->folder, last, "currents") || !has_currents(s->folder)) {
        s->folder[0] = '\0';
        return HCI_OK;
    }
    const hci_status status = hci_machine_read(s->machine, &machine, note);
    if (!status && !is_for(s->folder, &machine)) {
        snprintf(s->why, sizeof s->why, "those in %.300s were solved for another machine", s->folder);
        s->folder[0] = '\0';
    }
    hci_machine_release(&machine);
    return status;
}

static hci_status currents_read(const char *last, hci_solved_currents *s, hci_note *note)
{
    const hci_status status = hci_solution_read_currents(s->folder, HCI_SOLUTION_CURRENTS, &s->table, note);
    if (status) return status;
    const double of_tune_Nm = promise_of_tune(last),
                 of_solve_Nm = hci_solution_read_expected_ripple(s->folder);
    if (of_solve_Nm > 0.0) s->promised_Nm = fmax(of_solve_Nm, of_tune_Nm);
    return HCI_OK;
}

hci_status hci_solved_currents_find(const char *last, hci_solved_currents *s, hci_note *note)
{
    hci_note why = {{0}};
    memset(s, 0, sizeof *s);
    s->promised_Nm = (double)NAN;
    hci_status status = folder_find(last, s, &why);
    if (!status && s->folder[0]) status = currents_read(last, s, &why);
    if (status == HCI_ERROR_MEMORY) *note = why;
    if (status) {
        snprintf(s->why, sizeof s->why, "%.500s", why.text);
        s->folder[0] = '\0';
    } else if (!s->folder[0] && !s->why[0]) {
        snprintf(s->why, sizeof s->why,
                 "none stand in LAST/solution or in the folder currents beside LAST, the folder of --again");
    }
    return status == HCI_ERROR_MEMORY ? status : HCI_OK;
}

void hci_solved_currents_release(hci_solved_currents *s)
{
    hci_currents_release(&s->table);
    memset(s, 0, sizeof *s);
}
