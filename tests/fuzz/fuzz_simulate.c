/* `simulate` on any machine folder and scenario, of some thousand steps at most. */
#include <math.h>

#include "cli/commands.h"
#include "fuzzing.h"
#include "hci/host/simulate/simulate.h"

enum { MOST_STEPS = 5000 };

/* Time that is simulated in at most so many steps; a step that is not given is 1 µs or more. */
static bool is_short(const char *path)
{
    hci_scenario scenario;
    hci_note note = {{0}};
    if (hci_scenario_read(path, &scenario, &note)) return true;
    const double step_s = isnan(scenario.step_s) ? 1e-6 : scenario.step_s;
    return scenario.duration_s / fmin(step_s, fmin(1e-6, scenario.duration_s)) <= 10.0 * MOST_STEPS &&
           scenario.duration_s / step_s <= MOST_STEPS;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const words[] = {"machine", "scenario.csv", "-o", "out", NULL};
    fuzz_unpack(data, size);
    if (!is_short("scenario.csv")) return -1;
    fuzz_command(&cli_simulate, words);
    return 0;
}
