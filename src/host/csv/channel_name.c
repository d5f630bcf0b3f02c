#include "host/csv/channel_name.h"

#include <string.h>

enum { WORD_SIZE = 32 };

static const char WANTED[] =
    " soll sollwert sollwerte vorgabe vorgaben last lastmoment grenze max min ref reference references "
    "command "
    "commands cmd setpoint setpoints demand target targets limit limits load consigne consignes riferimento "
    "consigna referencia true model residual desired error control ";

/* Of controllers and their programs, in which an actual value stands; types of variables before a name. */
static const char PLACES[] = " axis axes achse achsen asse assi drive drives servo inverter motor machine "
                             "spindle term terminal box module "
                             "modul main plc prg gvl application app program global device daq task inputs "
                             "nctoplc nc to status state st fb "
                             "g r f lr x fbaxis encoder act actual measured data scope ";

static bool is_capital(char c)
{
    return c >= 'A' && c <= 'Z';
}

static bool is_letter(char c)
{
    return is_capital(c) || (c >= 'a' && c <= 'z');
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* The next run of letters in lower case, cut before a capital behind a small letter; false: none is left. */
static bool next_word(const char **at, const char *end, char word[WORD_SIZE])
{
    size_t used = 0;
    while (*at < end && !is_letter(**at))
        ++*at;
    for (; *at < end && is_letter(**at) && used + 1 < WORD_SIZE; ++*at) {
        if (used > 0 && is_capital(**at) && !is_capital((*at)[-1])) break;
        word[used++] = (char)(is_capital(**at) ? **at - 'A' + 'a' : **at);
    }
    word[used] = '\0';
    return used > 0;
}

static bool is_in(const char *list, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = list; (at = strstr(at, word)) != NULL; ++at)
        if (at[-1] == ' ' && at[length] == ' ') return true;
    return false;
}

/* "Model Root" is where dSPACE begins its paths. */
bool hci_channel_is_wanted(const char *text, size_t length)
{
    static const char ROOT[] = "Model Root/";
    const size_t begin =
        length >= sizeof ROOT && strncmp(text, ROOT, sizeof ROOT - 1) == 0 ? sizeof ROOT - 1 : 0;
    const char *at = text + begin, *end = text + length;
    char word[WORD_SIZE];
    while (next_word(&at, end, word))
        if (is_in(WANTED, word)) return true;
    return false;
}

/* Words of places, and types of terminals as EL3702. */
static bool is_place(const char *text, size_t length)
{
    const char *at = text, *end = text + length;
    char word[WORD_SIZE];
    while (next_word(&at, end, word)) {
        const bool is_type = at < end && is_digit(*at) && is_capital(at[-1]) && strlen(word) < 4;
        if (!is_type && !is_in(PLACES, word)) return false;
    }
    return true;
}

static bool take(const char *from, size_t length, char name[HCI_CHANNEL_SIZE])
{
    if (length == 0 || length >= HCI_CHANNEL_SIZE) return false;
    memcpy(name, from, length);
    name[length] = '\0';
    return true;
}

/* "/'Group'/'Channel'". */
static bool take_last_quoted(const char *header, char name[HCI_CHANNEL_SIZE])
{
    const size_t length = strlen(header);
    if (header[0] != '/' || header[1] != '\'' || length < 4 || header[length - 1] != '\'') return false;
    const char *last = header;
    for (const char *at = header; (at = strstr(at, "/'")) != NULL; ++at)
        last = at;
    return last > header && !hci_channel_is_wanted(header, (size_t)(last - header)) &&
           take(last + 2, length - 1 - (size_t)(last + 2 - header), name);
}

/* "Channel\Source: 1 [Nm]": the unit is the channel's. */
static bool take_before_source(const char *header, char name[HCI_CHANNEL_SIZE])
{
    const char *source = strchr(header, '\\');
    if (source == NULL || hci_channel_is_wanted(source, strlen(source))) return false;
    const char *unit = strrchr(source, '[');
    if (!take(header, (size_t)(source - header), name)) return false;
    const size_t used = strlen(name), more = unit != NULL ? strlen(unit) : 0;
    if (used + more + 2 > HCI_CHANNEL_SIZE) return false;
    if (unit != NULL) {
        name[used] = ' ';
        memcpy(name + used + 1, unit, more + 1);
    }
    return true;
}

/* "Axis 1.ActPos (deg)". */
static bool take_behind_places(const char *header, char name[HCI_CHANNEL_SIZE])
{
    const char *last = NULL;
    for (const char *at = header + 1; *header != '\0' && *at != '\0' && *at != '['; ++at)
        if (*at == '.' && is_letter(at[1])) last = at;
    if (last == NULL || !is_place(header, (size_t)(last - header))) return false;
    return take(last + 1, strlen(last + 1), name);
}

bool hci_channel_name(const char *header, char name[HCI_CHANNEL_SIZE], bool *is_of_place)
{
    *is_of_place = false;
    if (take_last_quoted(header, name) || take_before_source(header, name)) return true;
    *is_of_place = take_behind_places(header, name);
    return *is_of_place;
}
