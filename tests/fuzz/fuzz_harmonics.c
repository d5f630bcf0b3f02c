/* `harmonics` on any recording. */
#include "cli/commands.h"
#include "fuzzing.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const words[] = {"run.csv", "-o", "out", NULL};
    fuzz_unpack(data, size);
    fuzz_command(&cli_harmonics, words);
    return 0;
}
