/* Must be refused: "core-symbol: core_malloc.o uses malloc". */
#include <stdlib.h>

double *hci_control_malloc(size_t n);

double *hci_control_malloc(size_t n)
{
    return malloc(n * sizeof(double));
}
