#include "hci/host/base/note.h"

#include <stdarg.h>
#include <stdio.h>

#include "host/base/memory.h"
#include "host/base/quote.h"
#include "host/base/words.h"

hci_status hci_note_set(hci_note *note, hci_status status, const char *format, ...)
{
    if (note == NULL || note->text[0] != '\0') return status;
    va_list arguments;
    va_start(arguments, format);
    hci_words_say_list(&(hci_words){note->text, sizeof note->text}, format, arguments);
    va_end(arguments);
    hci_quote_mask(note->text);
    return status;
}

hci_status hci_note_memory(hci_note *note, const char *path, const char *what, ...)
{
    char text[HCI_NOTE_SIZE / 2], shown[HCI_QUOTE_PATH_SIZE];
    va_list arguments;
    va_start(arguments, what);
    vsnprintf(text, sizeof text, what, arguments);
    va_end(arguments);
    hci_memory_is_short();
    return hci_note_set(note, HCI_ERROR_MEMORY, "%s%sout of memory for %s",
                        path != NULL ? hci_quote_path(path, shown) : "", path != NULL ? ": " : "", text);
}

void hci_note_add(hci_note *remark, const char *format, ...)
{
    const hci_words words = {remark->text, sizeof remark->text};
    va_list arguments;
    va_start(arguments, format);
    if (remark->text[0] != '\0') hci_words_say(&words, "; ");
    hci_words_say_list(&words, format, arguments);
    va_end(arguments);
    hci_quote_mask(remark->text);
}
