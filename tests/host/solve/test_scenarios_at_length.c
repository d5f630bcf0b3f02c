/* labels: slow */
/* The claims of test_scenarios, the choice of few components for all twelve scenarios: a quarter of a minute
 * with sanitizers. */
#define AT_LENGTH

#include "hci/host/solve/solve.h"
#include "test_scenarios.c"
