#include "host/foreign/text.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "hci/host/base/number.h"
#include "hci/version.h"
#include "host/base/quote.h"

void hci_foreign_write_head(const hci_foreign_map *map, const hci_foreign_files *files, const char *mark,
                            const char *what, hci_output *output)
{
    char text[32];
    hci_output_text(
        output, "%s %s\n%s Written by hci-solve " HCI_VERSION_STRING "; emit it again rather than edit it.\n",
        mark, what, mark);
    for (const char *const *line = files->lines; *line != NULL; ++line)
        hci_output_text(output, "%s %s\n", mark, *line);
    hci_number_text(map->offset_deg, text);
    hci_output_text(output, "%s encoder_offset_deg %s\n%s encoder_direction %d\n", mark, text, mark,
                    map->direction);
    if (map->type->has_wave) hci_output_text(output, "%s wave %s\n", mark, hci_foreign_wave_word(map->wave));
    if (!map->type->has_counts) return;
    hci_number_text(map->counts_per_A, text);
    hci_output_text(output, "%s counts_per_ampere %s\n", mark, text);
}

const char *hci_foreign_wave_word(hci_foreign_wave wave)
{
    static const char *const WORD[] = {
#define HCI_FOREIGN_WAVE_WORD(value, word) [value] = word,
        HCI_FOREIGN_WAVES(HCI_FOREIGN_WAVE_WORD)
#undef HCI_FOREIGN_WAVE_WORD
    };
    return WORD[wave];
}

bool hci_foreign_number(const char *text, const char **end, double *value)
{
    char word[64];
    while (*text == ' ' || *text == '\t')
        ++text;
    size_t length = strspn(text, "+-.0123456789eE");
    for (; length > 0 && length < sizeof word; --length) {
        memcpy(word, text, length);
        word[length] = '\0';
        if (hci_number_parse(word, value)) {
            *end = text + length;
            return true;
        }
    }
    return false;
}

static bool is_part_of_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

bool hci_foreign_said(const char *text, const char *word, double *value)
{
    const size_t length = strlen(word);
    const char *end;
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word))
        if ((at == text || !is_part_of_word(at[-1])) && !is_part_of_word(at[length]) &&
            hci_foreign_number(at + length, &end, value))
            return true;
    return false;
}

/* `wave cosine`; a sine without it. */
static void read_wave(const char *text, hci_foreign_map *map)
{
    const char *word = strstr(text, "wave ");
    for (int k = 0; word != NULL && k <= HCI_FOREIGN_COSINE_LAG; ++k) {
        const char *name = hci_foreign_wave_word((hci_foreign_wave)k);
        const size_t length = strlen(name);
        if (strncmp(word + 5, name, length) == 0 && word[5 + length] <= ' ') map->wave = (hci_foreign_wave)k;
    }
}

hci_status hci_foreign_read_head(const char *path, const char *text, hci_foreign_map *map, hci_note *note)
{
    char shown[HCI_QUOTE_PATH_SIZE];
    double direction = 1.0;
    hci_foreign_said(text, "encoder_offset_deg", &map->offset_deg);
    hci_foreign_said(text, "encoder_direction", &direction);
    const bool counts = hci_foreign_said(text, "counts_per_ampere", &map->counts_per_A);
    if (map->type->has_wave) read_wave(text, map);
    if (direction != 1.0 && direction != -1.0)
        return hci_note_set(note, HCI_ERROR_INPUT, "%s: found encoder_direction %g, expected 1 or -1",
                            hci_quote_path(path, shown), direction);
    map->direction = direction > 0.0 ? 1 : -1;
    if (map->type->has_counts && !(counts && map->counts_per_A > 0.0))
        return hci_note_set(
            note, HCI_ERROR_INPUT,
            "%s: found no comment `counts_per_ampere N` with a number above 0; put it into the file: "
            "the drive's counts of one A",
            hci_quote_path(path, shown));
    return HCI_OK;
}

const char *hci_foreign_float(double value, char text[32])
{
    snprintf(text, 32, "%.9g", value);
    for (char *c = text; *c != '\0'; ++c)
        if (*c == ',') *c = '.';
    return text;
}
