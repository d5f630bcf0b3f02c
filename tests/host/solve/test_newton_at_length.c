/* labels: slow */
/* The claims of test_newton on more machines, every strategy and more components: a quarter of a minute with
 * sanitizers. */
#define AT_LENGTH

#include "hci/host/solve/solve.h"
#include "test_newton.c"
