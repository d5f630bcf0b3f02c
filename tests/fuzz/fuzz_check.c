/* `check` on any machine folder, with a recording where there is one. */
#include "cli/commands.h"
#include "fuzzing.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const alone[] = {"machine", "-o", "out", NULL};
    static const char *const with_run[] = {"machine", "run.csv", "-o", "out", NULL};
    fuzz_unpack(data, size);
    fuzz_command(&cli_check, fuzz_exists("run.csv") ? with_run : alone);
    return 0;
}
