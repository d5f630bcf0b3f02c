/* Pieces of text that the files of several targets have in common. */
#ifndef HCI_SRC_HOST_FOREIGN_TEXT_H
#define HCI_SRC_HOST_FOREIGN_TEXT_H

#include "host/foreign/map.h"

/* The head of a file, each line behind `mark`: what it is, the lines of `files`, and what reading it back
 * asks for. `what` is of one line. */
void hci_foreign_write_head(const hci_foreign_map *map, const hci_foreign_files *files, const char *mark,
                            const char *what, hci_output *output);

/* What the head said: encoder_offset_deg, encoder_direction, counts_per_ampere. They are found anywhere in a
 * text, so that they can be put into one that a drive has given. HCI_ERROR_INPUT for a direction that is
 * neither 1 nor −1. */
hci_status hci_foreign_read_head(const char *path, const char *text, hci_foreign_map *map, hci_note *note);

/* The number behind a word, the first time that it stands in a text by itself. */
bool hci_foreign_said(const char *text, const char *word, double *value);

/* Whether a number of plain text begins here; *end is behind it. Decimal points and exponents as in C, in any
 * locale. */
bool hci_foreign_number(const char *text, const char **end, double *value);

/* The word of a wave; a static string. */
const char *hci_foreign_wave_word(hci_foreign_wave wave);

/* Nine digits, as a float is read back. */
const char *hci_foreign_float(double value, char text[32]);

#endif
