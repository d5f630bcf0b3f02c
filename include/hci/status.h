/* What a function can answer: one list of code, text and exit code of the command line. */
#ifndef HCI_STATUS_H
#define HCI_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* X(name, exit code, text). Values follow the order of the list; HCI_OK is 0. */
#define HCI_STATUS_LIST(X)                                                                                   \
    X(HCI_OK, 0, "done")                                                                                     \
    X(HCI_NOT_REACHED, 1, "done, but the answer is no; the nearest result is given")                         \
    X(HCI_ERROR_ARGUMENT, 2, "an argument is outside its range")                                             \
    X(HCI_ERROR_INPUT, 3, "the input is wrong")                                                              \
    X(HCI_ERROR_CAPACITY, 4, "the caller's buffer is too small")                                             \
    X(HCI_ERROR_SINGULAR, 4, "the matrix is singular to working precision")                                  \
    X(HCI_ERROR_NOT_FINITE, 4, "a value is infinite or not a number")                                        \
    X(HCI_ERROR_NUMERIC, 4, "the numerical method did not succeed")                                          \
    X(HCI_ERROR_MEMORY, 4, "out of memory")                                                                  \
    X(HCI_ERROR_OUTPUT, 5, "could not write")                                                                \
    X(HCI_ERROR_STOPPED, 4, "it was asked to stop")

/* What a function returns. Values above HCI_NOT_REACHED are failures. */
typedef enum {
#define HCI_STATUS_NAME(name, exit_code, text) name,
    HCI_STATUS_LIST(HCI_STATUS_NAME)
#undef HCI_STATUS_NAME
} hci_status;

/* The text of a status, never NULL; a static string. May run in an interrupt. */
const char *hci_status_text(hci_status status);

/* The exit code (0 to 5) that the command line gives for a status. */
int hci_status_exit_code(hci_status status);

#ifdef __cplusplus
}
#endif

#endif
