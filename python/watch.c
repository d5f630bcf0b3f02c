/* Between long work and Python: the library may ask and tell often, Python is asked twenty times a second. */
#include <math.h>
#include <stdbool.h>
#include <time.h>

typedef struct {
    void *handle; /* of the object that is asked */
    double next_s;
    int stopped; /* once it is, it stays so */
} hci_python_watch;

static int hci_python_tick(void *handle, const char *what, double share);

static bool hci_python_is_due(hci_python_watch *watch)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const double now_s = (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
    if (now_s < watch->next_s) return false;
    watch->next_s = now_s + 0.05;
    return true;
}

/* Of the library that is linked in. */
static const char *hci_python_version(void)
{
    return HCI_VERSION_STRING;
}

/* An hci_progress. */
static void hci_python_progress(void *context, const char *what, double share)
{
    hci_python_watch *watch = context;
    if (watch->stopped || !hci_python_is_due(watch)) return;
    watch->stopped = hci_python_tick(watch->handle, what, share);
}

/* An hci_stop. */
static bool hci_python_stop(void *context)
{
    hci_python_watch *watch = context;
    if (!watch->stopped && hci_python_is_due(watch)) watch->stopped = hci_python_tick(watch->handle, "", NAN);
    return watch->stopped != 0;
}
