/* `diagnose` on any machine folder and list of tiny recordings. */
#include "cli/commands.h"
#include "fuzzing.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const words[] = {"machine", "--runs", "runs.csv", "-o", "out", NULL};
    fuzz_unpack(data, size);
    fuzz_command(&cli_diagnose, words);
    return 0;
}
