/* The files of `tune` itself: its list of recordings, its target, its report and its commands. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/output.h"
#include "hci/host/report/summary.h"
#include "host/base/memory.h"
#include "host/base/path.h"
#include "host/base/quote.h"
#include "host/csv/write.h"
#include "host/report/summary.h"
#include "host/report/tune/page_tuning.h"

/* ---- inputs of its steps ---- */

static hci_status end_of(hci_output *out, hci_status status, hci_note *note)
{
    if (!status) return hci_output_commit(out, note);
    hci_output_discard(out);
    return status;
}

static hci_status row_write(hci_output *out, const char *log, const char *folder, const char *test,
                            hci_note *note)
{
    char *file;
    const hci_status status = hci_path_relative(log, folder, &file, note);
    if (status) return status;
    hci_csv_write_cell(out, file, true);
    hci_output_text(out, "fit,%s\n", test);
    hci_memory_free(file);
    return HCI_OK;
}

hci_status hci_tuning_write_list(const char *folder, const char *const *log, size_t count, const char *test,
                                 hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_output_file(out, "runs.csv", note);
    if (!status) hci_output_text(out, "file,role,test\n");
    for (size_t k = 0; k < count && !status; ++k)
        status = row_write(out, log[k], folder, test, note);
    return end_of(out, status, note);
}

/* Of one recording; false: the message is of another. */
static bool name_log(const char *folder, const char *log, hci_note *note)
{
    char joined[HCI_QUOTE_PATH_SIZE], listed[HCI_QUOTE_PATH_SIZE], given[HCI_QUOTE_PATH_SIZE], *file;
    hci_note unused = {{0}}, changed = {{0}};
    if (hci_path_relative(log, folder, &file, &unused)) return false;
    snprintf(joined, sizeof joined, "%s%s%s", folder, folder[strlen(folder) - 1] == '/' ? "" : "/", file);
    hci_memory_free(file);
    hci_quote_path(joined, listed);
    const size_t length = strlen(listed);
    const char *at = strstr(note->text, listed);
    if (at == NULL || strchr(":; ,", at[length]) == NULL) return false;
    hci_note_set(&changed, HCI_OK, "%.*s%s%s", (int)(at - note->text), note->text, hci_quote_path(log, given),
                 at + length);
    *note = changed;
    return true;
}

void hci_tuning_name_log(const char *folder, const char *const *log, size_t count, hci_note *note)
{
    for (size_t k = 0; k < count; ++k)
        if (name_log(folder, log[k], note)) return;
}

hci_status hci_tuning_write_sensor_zero(const char *folder, double offset_Nm, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_output_file(out, "effects.csv", note);
    if (!status) {
        hci_output_text(out, "effect,parameter,value,unit\ntorque_sensor,offset,");
        hci_output_number(out, offset_Nm, ',');
        hci_output_text(out, "Nm\n");
    }
    return end_of(out, status, note);
}

hci_status hci_tuning_write_target(const char *folder, double mean_Nm, hci_note *note)
{
    hci_output *out;
    hci_status status = hci_output_open(folder, &out, note);
    if (status) return status;
    status = hci_output_file(out, "target.csv", note);
    if (!status) {
        hci_output_text(out, "order,amplitude_Nm,phase_rad\n0,");
        hci_output_number(out, mean_Nm, ',');
        hci_output_text(out, "0\n");
    }
    return end_of(out, status, note);
}

/* ---- the report ---- */

static void put_lines(hci_json *json, const char *name, const char *text)
{
    hci_json_array(json, name);
    while (*text) {
        char line[2048];
        const size_t length = strcspn(text, "\n");
        snprintf(line, sizeof line, "%.*s", (int)(length < sizeof line ? length : sizeof line - 1), text);
        hci_json_text(json, NULL, line);
        text += length + (text[length] == '\n');
    }
    hci_json_close(json);
}

static void put_solution(hci_json *json, const hci_tuning *t)
{
    const hci_solution *s = t->solution;
    double before_Nm, after_Nm;
    hci_tuning_swing(s, &before_Nm, &after_Nm);
    if (!hci_tuning_knows_ripple(s)) before_Nm = after_Nm = (double)NAN;
    hci_json_object(json, "before");
    hci_json_number(json, "mean_Nm", s->order_count ? s->order[0].before_Nm.cosine : (double)NAN);
    hci_json_number(json, "peak_phase_A", s->plain_amplitude_A);
    hci_json_number(json, "peak_to_peak_Nm", before_Nm);
    hci_json_close(json);
    hci_json_object(json, "after");
    hci_json_number(json, "mean_Nm", s->order_count ? s->order[0].torque_Nm.cosine : (double)NAN);
    hci_json_number(json, "peak_phase_A", s->peak_phase_current_A);
    hci_json_number(json, "loss_ratio_to_plain", s->loss_to_plain);
    hci_json_number(json, "peak_to_peak_Nm", after_Nm);
    hci_json_number(json, "table_peak_to_peak_Nm", t->table_Nm > 0.0 ? t->table_Nm : (double)NAN);
    hci_json_close(json);
    hci_summary_expected(json, &s->expected);
    hci_summary_loop(json, &s->loop);
}

char *hci_tuning_json(const hci_tuning *t)
{
    static const char *const KEYS[] = {"caveats", "read",         "found", "wanted",
                                       "unknown", "measure_next", "load",  "load_else"};
    hci_json json;
    hci_summary_begin(&json, "tune");
    hci_json_bool(&json, "good", t->good);
    hci_json_text(&json, "verdict", t->verdict);
    hci_json_text(&json, "words", t->heading);
    if (t->solution) put_solution(&json, t);
    for (int k = 0; k < HCI_TUNING_PARTS; ++k)
        put_lines(&json, KEYS[k], t->part[k]);
    put_lines(&json, "commands", t->commands);
    return hci_json_end(&json);
}

hci_status hci_tuning_write(const hci_tuning *t, const char *folder, hci_note *note)
{
    char *json = hci_tuning_json(t);
    hci_output *out;
    hci_status status =
        json ? hci_output_open(folder, &out, note) : hci_note_memory(note, NULL, "the summary");
    if (status) {
        hci_text_free(json);
        return status;
    }
    status = hci_output_file(out, "report.html", note);
    if (!status) hci_page_tuning(out, t);
    if (!status) status = hci_output_file(out, "summary.json", note);
    if (!status) hci_output_text(out, "%s\n", json);
    if (!status) status = hci_output_file(out, "commands.sh", note);
    if (!status) hci_output_text(out, "%s", t->commands);
    hci_text_free(json);
    return end_of(out, status, note);
}
