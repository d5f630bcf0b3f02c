#include "hci/host/base/note.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/utf8.h"
#include "host/base/quote.h"

/* Drops a UTF-8 sequence that vsnprintf has cut in two. */
static void mend_end(char *text)
{
    size_t lead = strlen(text);
    while (lead > 0 && !hci_utf8_begins(text[lead - 1]))
        lead--;
    if (lead > 0 && hci_utf8_length(text + lead - 1) == 0) text[lead - 1] = '\0';
}

hci_status hci_note_set(hci_note *note, hci_status status, const char *format, ...)
{
    if (note == NULL || note->text[0] != '\0') return status;
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(note->text, sizeof note->text, format, arguments);
    va_end(arguments);
    if (length < 0) note->text[0] = '\0';
    if (length >= (int)sizeof note->text) mend_end(note->text);
    return status;
}

hci_status hci_note_memory(hci_note *note, const char *path, const char *what, ...)
{
    char text[HCI_NOTE_SIZE / 2], shown[HCI_QUOTE_PATH_SIZE];
    va_list arguments;
    va_start(arguments, what);
    vsnprintf(text, sizeof text, what, arguments);
    va_end(arguments);
    return hci_note_set(note, HCI_ERROR_MEMORY, "%s%sout of memory for %s",
                        path != NULL ? hci_quote_path(path, shown) : "", path != NULL ? ": " : "", text);
}

void hci_note_add(hci_note *remark, const char *format, ...)
{
    char *text = remark->text;
    const size_t used = strlen(text), size = sizeof remark->text;
    va_list arguments;
    va_start(arguments, format);
    const size_t start = used + (size_t)snprintf(text + used, size - used, "%s", used > 0 ? "; " : "");
    if (start < size) vsnprintf(text + start, size - start, format, arguments);
    va_end(arguments);
    mend_end(text);
}
