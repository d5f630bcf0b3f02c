/* Must be refused: "host-ends: host_exit.o uses exit". */
#include <stdlib.h>

void hci_control_host_exit(void);

void hci_control_host_exit(void)
{
    exit(1);
}
