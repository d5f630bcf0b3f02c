/* The sources that FMUs consist of, put into the library when it is built (cmake/hci_embed.cmake). */
#ifndef HCI_SRC_HOST_FMU_SOURCES_H
#define HCI_SRC_HOST_FMU_SOURCES_H

#include <stddef.h>

typedef struct {
    const char *name; /* without folders */
    const unsigned char *bytes;
    size_t size;
} hci_fmu_source;

extern const hci_fmu_source hci_fmu_sources[];
extern const size_t hci_fmu_source_count;

#endif
