#include "host/fmu/long_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "host/base/memory.h"

/* Room for so many more bytes and the zero behind them. */
static bool make_room(hci_long_text *t, size_t more)
{
    if (t->failed) return false;
    if (t->size + more < t->room) return true;
    const size_t room = 2 * (t->size + more) + 4096;
    char *text = hci_memory_resize(t->text, room, 1);
    t->failed = !text;
    if (!text) return false;
    t->text = text;
    t->room = room;
    return true;
}

void hci_long_text_add(hci_long_text *t, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, arguments);
    if (length >= 0 && make_room(t, (size_t)length)) {
        vsnprintf(t->text + t->size, (size_t)length + 1, format, again);
        t->size += (size_t)length;
    }
    va_end(again);
    va_end(arguments);
}

void hci_long_text_number(hci_long_text *t, double value)
{
    char text[32];
    hci_number_text(isfinite(value) ? value : 0.0, text);
    hci_long_text_add(t, "%s%s", text, strpbrk(text, ".e") ? "" : ".0");
}

void hci_long_text_release(hci_long_text *t)
{
    hci_memory_free(t->text);
    memset(t, 0, sizeof *t);
}
