/* labels: slow */
/* The claims of test_choose on so many problems that the share of those in which the search misses the best
 * subset can be told: half a minute with sanitizers. */
#define AT_LENGTH

#include "hci/host/solve/solve.h"
#include "test_choose.c"
