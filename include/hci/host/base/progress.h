/* How long work tells how far it has come. */
#ifndef HCI_HOST_BASE_PROGRESS_H
#define HCI_HOST_BASE_PROGRESS_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Is called with what is being done, one line of text that is not kept, and the share 0 … 1 of it that is
 * done. context: as given with the function. It may be called often and should be quick. */
typedef void hci_progress(void *context, const char *what, double share);

/* Whether long work is to end with what it has so far. It is asked often and should be quick. context: as
 * given with the function. */
typedef bool hci_stop(void *context);

/* How such work came to its end. */
typedef enum {
    HCI_WORK_COMPLETE,    /* all of it was done */
    HCI_WORK_INTERRUPTED, /* it was asked to stop */
    HCI_WORK_LIMITED      /* it had done as much as it may */
} hci_work_end;

#ifdef __cplusplus
}
#endif

#endif
