#include "host/report/summary.h"

#include <stdio.h>
#include <string.h>

#include "hci/version.h"
#include "host/base/whole_file.h"

void hci_summary_begin(hci_json *json, const char *command)
{
    hci_json_begin(json);
    hci_json_text(json, "command", command);
    hci_json_text(json, "version", HCI_VERSION_STRING);
}

void hci_text_free(char *text)
{
    hci_json_free(text);
}

char *hci_summary_read(const char *folder)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/summary.json", folder);
    char *text = length < (int)sizeof path ? hci_whole_file(path) : NULL;
    const size_t end = text ? strlen(text) : 0;
    if (end > 0 && text[end - 1] == '\n') text[end - 1] = '\0';
    return text;
}

static void add_checksum(void *context, const char *name, const char *checksum)
{
    hci_json_text(context, name, checksum);
}

/* The text with the checksums; NULL when memory is out. */
static char *with_files(hci_output *out, const char *json, hci_status *status, hci_note *note)
{
    hci_json all;
    hci_json_continue(&all, json);
    hci_json_object(&all, "checksums");
    *status = hci_output_checksums(out, add_checksum, &all, note);
    if (!all.failed) hci_json_close(&all);
    return hci_json_end(&all);
}

hci_status hci_summary_write(hci_output *out, char *json, hci_note *note)
{
    hci_status status = HCI_OK;
    char *text = json ? with_files(out, json, &status, note) : NULL;
    if (!status && !text) status = hci_note_memory(note, NULL, "the summary");
    if (!status) status = hci_output_file(out, "summary.json", note);
    if (!status) hci_output_text(out, "%s\n", text);
    hci_text_free(json);
    hci_text_free(text);
    return status;
}
