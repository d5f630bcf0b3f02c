#include "host/csv/most_rows.h"

#include "host/base/quote.h"

hci_status hci_csv_check_rows(const hci_csv *csv, size_t most, const char *remedy, hci_note *note)
{
    char path[HCI_QUOTE_PATH_SIZE];
    if (hci_csv_rows(csv) <= most) return HCI_OK;
    return hci_note_set(note, HCI_ERROR_INPUT, "%s: found %zu rows, expected at most %zu; %s",
                        hci_quote_path(hci_csv_path(csv), path), hci_csv_rows(csv), most, remedy);
}
