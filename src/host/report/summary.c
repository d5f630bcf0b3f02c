#include "host/report/summary.h"

#include "hci/version.h"

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
