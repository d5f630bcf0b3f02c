/* Long work that the user may end, and is told of. */
#ifndef HCI_SRC_HOST_BASE_WATCH_H
#define HCI_SRC_HOST_BASE_WATCH_H

#include <stddef.h>

#include "hci/host/base/progress.h"

/* Any pointer may be NULL. */
typedef struct {
    hci_stop *stop;
    void *stop_context;
    hci_progress *progress;
    void *context;
    bool stopped; /* false to begin with */
} hci_watch;

/* Whether to end with what there is. Once it is so it stays so, and nobody is asked any more. watch: may be
 * NULL. */
static inline bool hci_watch_stops(hci_watch *watch)
{
    if (watch && !watch->stopped && watch->stop) watch->stopped = watch->stop(watch->stop_context);
    return watch && watch->stopped;
}

/* Tells what is done, and which share of it. watch: may be NULL. */
static inline void hci_watch_tell(const hci_watch *watch, const char *what, double share)
{
    if (watch && watch->progress) watch->progress(watch->context, what, share);
}

#endif
