/* labels: slow */
/* test_waveform with the claims on standard errors that take hundreds of recordings each: one second and a
 * half more with sanitizers. */
#define AT_LENGTH

#include "hci/host/waveform/waveform.h"
#include "test_waveform.c"
