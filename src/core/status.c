#include "hci/status.h"

const char *hci_status_text(hci_status status)
{
    static const char *const text[] = {
#define HCI_STATUS_TEXT(name, exit_code, words) words,
        HCI_STATUS_LIST(HCI_STATUS_TEXT)
#undef HCI_STATUS_TEXT
    };
    const unsigned k = (unsigned)status;
    return k < sizeof text / sizeof text[0] ? text[k] : "unknown status";
}

int hci_status_exit_code(hci_status status)
{
    static const unsigned char code[] = {
#define HCI_STATUS_EXIT(name, exit_code, words) exit_code,
        HCI_STATUS_LIST(HCI_STATUS_EXIT)
#undef HCI_STATUS_EXIT
    };
    const unsigned k = (unsigned)status;
    return k < sizeof code ? code[k] : 4;
}
