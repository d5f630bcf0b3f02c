/* `predict` on any machine folder and recording. */
#include "cli/commands.h"
#include "fuzzing.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const words[] = {"machine", "run.csv", NULL};
    fuzz_unpack(data, size);
    fuzz_command(&cli_predict, words);
    return 0;
}
