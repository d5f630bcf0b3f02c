/* Must pass: libm, memory moves, constants (one with an address), a static function. */
#include <math.h>
#include <string.h>

double hci_control_good(double x, double *out, int k);

static const double table[3] = {1.0, 2.0, 3.0};
static const char *const name[2] = {"one", "two"};

double hci_control_good(double x, double *out, int k)
{
    memset(out, 0, 1000 * sizeof *out);
    return sin(x) + cos(2.0 * x) + table[k & 1] + (double)name[k & 1][0] + fmod(x, 2.0);
}
