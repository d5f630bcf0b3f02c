/* What the library writes through a set of output files, into the folder of support/files.h, and read back.
 * Prefix written_. */
#ifndef WRITTEN_H
#define WRITTEN_H

#include "hci/host/base/output.h"
#include "support/files.h"

static inline hci_output *written_begin(const char *name)
{
    hci_output *out;
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_open(files_root, &out, &note), note.text);
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_file(out, name, &note), note.text);
    return out;
}

/* Its text, as files_read keeps it. */
static inline char *written_end(hci_output *out, const char *name)
{
    hci_note note = {{0}};
    TEST_ASSERT_EQUAL_MESSAGE(HCI_OK, hci_output_commit(out, &note), note.text);
    return files_read(files_path(name));
}

#endif
