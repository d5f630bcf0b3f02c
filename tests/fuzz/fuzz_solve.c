/* `solve` on any machine folder, target and set of components. */
#include "cli/commands.h"
#include "fuzzing.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const words[] = {"machine", "--target", "target.csv", "-o", "out", NULL};
    fuzz_unpack(data, size);
    fuzz_command(&cli_solve, words);
    return 0;
}
