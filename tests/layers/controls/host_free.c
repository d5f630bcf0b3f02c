/* Must be refused: "host-allocates: host_free.o uses free". */
#include <stdlib.h>

void hci_control_host_free(void *p);

void hci_control_host_free(void *p)
{
    free(p);
}
