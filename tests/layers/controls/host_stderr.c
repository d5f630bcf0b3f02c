/* Must be refused: "host-prints: host_stderr.o uses stderr". */
#include <stdio.h>

void hci_control_host_stderr(double x);

void hci_control_host_stderr(double x)
{
    fprintf(stderr, "%g\n", x);
}
