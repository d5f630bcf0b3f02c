/* What went wrong, in words for the user: file, line, column, what was found, what was expected and the
 * remedy. */
#ifndef HCI_HOST_BASE_NOTE_H
#define HCI_HOST_BASE_NOTE_H

#include "hci/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bytes of a note. */
#define HCI_NOTE_SIZE 1024

/* A text for the user, in UTF-8 and without control characters whatever it quotes. Start with {0}. The first
 * error wins: a note that already has a text is not overwritten. */
typedef struct {
    char text[HCI_NOTE_SIZE]; /* "" for nothing to say */
} hci_note;

/* Lets a compiler check the arguments of a function like printf. */
#if defined(__GNUC__)
#define HCI_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define HCI_PRINTF(format_index, first)
#endif

/* Writes the note (unless it has a text already; note may be NULL) and returns `status`, so that a failing
 * function can end with `return hci_note_set(note, HCI_ERROR_INPUT, "...")`. Long texts are cut at the
 * end. */
hci_status hci_note_set(hci_note *note, hci_status status, const char *format, ...) HCI_PRINTF(3, 4);

/* HCI_ERROR_MEMORY with "PATH: out of memory for WHAT"; path: the file that is read or written, or NULL;
 * what: as of printf. */
hci_status hci_note_memory(hci_note *note, const char *path, const char *what, ...) HCI_PRINTF(3, 4);

/* Appends to a remark, behind "; " where it has a text already. Long texts are cut at the end. */
void hci_note_add(hci_note *remark, const char *format, ...) HCI_PRINTF(2, 3);

#ifdef __cplusplus
}
#endif

#endif
