/* Must be refused: "host-ends: host_abort.o uses abort". */
#include <stdlib.h>

void hci_control_host_abort(int x);

void hci_control_host_abort(int x)
{
    if (x) abort();
}
