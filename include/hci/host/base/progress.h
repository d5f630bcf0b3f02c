/* How long work tells how far it has come. */
#ifndef HCI_HOST_BASE_PROGRESS_H
#define HCI_HOST_BASE_PROGRESS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Is called with what is being done, one line of text that is not kept, and the share 0 … 1 of it that is
 * done. context: as given with the function. It may be called often and should be quick. */
typedef void hci_progress(void *context, const char *what, double share);

#ifdef __cplusplus
}
#endif

#endif
