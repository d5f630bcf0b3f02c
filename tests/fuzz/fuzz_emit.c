/* `emit` on any folder of results. */
#include "cli/commands.h"
#include "fuzzing.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const words[] = {"results", "--name", "table", "-o", "out", NULL};
    fuzz_unpack(data, size);
    fuzz_command(&cli_emit, words);
    return 0;
}
