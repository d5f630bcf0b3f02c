/* Must be refused: "core-symbol: core_sincos.o uses sincos". Not in C99; GCC makes it of sin(x) and cos(x).
 */
void sincos(double x, double *s, double *c);
void hci_control_sincos(double x, double *out);

void hci_control_sincos(double x, double *out)
{
    sincos(x, out, out + 1);
}
