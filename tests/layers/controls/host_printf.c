/* Must be refused: "host-prints: host_printf.o uses puts". */
#include <stdio.h>

void hci_control_host_printf(void);

void hci_control_host_printf(void)
{
    printf("hello\n");
}
