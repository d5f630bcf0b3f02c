#include "hci/host/base/text.h"

#include <string.h>

static char lower(char c)
{
    return (char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

bool hci_text_begins(const char *text, const char *start, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (lower(text[i]) != lower(start[i])) return false;
    }
    return true;
}

bool hci_text_is(const char *text, const char *word)
{
    return hci_text_begins(text, word, strlen(word) + 1);
}
