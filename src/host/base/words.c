#include "host/base/words.h"

#include <stdio.h>
#include <string.h>

#include "hci/host/base/utf8.h"

/* Drops a UTF-8 sequence that vsnprintf has cut in two. */
static void mend_end(char *text)
{
    size_t lead = strlen(text);
    while (lead > 0 && !hci_utf8_begins(text[lead - 1]))
        lead--;
    if (lead > 0 && hci_utf8_length(text + lead - 1) == 0) text[lead - 1] = '\0';
}

void hci_words_say_list(const hci_words *words, const char *format, va_list arguments)
{
    const size_t used = strlen(words->text), room = words->size - used;
    const int length = vsnprintf(words->text + used, room, format, arguments);
    if (length < 0) words->text[used] = '\0';
    if (length >= 0 && (size_t)length >= room) mend_end(words->text);
}

void hci_words_say(const hci_words *words, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    hci_words_say_list(words, format, arguments);
    va_end(arguments);
}
