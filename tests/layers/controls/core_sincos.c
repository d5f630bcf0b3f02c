/* Must be refused: "core-symbol: core_sincos.o uses sincos". GCC merges the two calls unless it is told not to. */
#include <math.h>

void hci_control_sincos(double x, double *s, double *c);

void hci_control_sincos(double x, double *s, double *c)
{
    *s = sin(x);
    *c = cos(x);
}
