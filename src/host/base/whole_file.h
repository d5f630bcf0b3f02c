/* A small file of ours as one text. */
#ifndef HCI_SRC_HOST_BASE_WHOLE_FILE_H
#define HCI_SRC_HOST_BASE_WHOLE_FILE_H

/* To be freed with hci_memory_free; NULL where it is no plain file, cannot be read (which path.h keeps), or
 * memory is out. */
char *hci_whole_file(const char *path);

#endif
