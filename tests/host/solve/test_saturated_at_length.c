/* labels: slow */
/* The claims of test_saturated at more angles, for more torques, and on the machines that take long: half a
 * minute with sanitizers. */
#define AT_LENGTH

#include "hci/host/solve/solve.h"
#include "test_saturated.c"
