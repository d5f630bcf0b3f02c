/* Must be refused: "core-symbol: core_printf.o uses printf". */
#include <stdio.h>

void hci_control_printf(double x);

void hci_control_printf(double x)
{
    printf("%g\n", x);
}
