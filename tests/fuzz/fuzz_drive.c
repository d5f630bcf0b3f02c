/* Any drive.csv with its loop.csv, and any scenario: refused with words, or values within their ranges. */
#include "fuzzing.h"

#include <math.h>
#include <string.h>

#include "hci/host/drive/drive.h"
#include "hci/host/simulate/simulate.h"

#define CHECK_RANGE(x, low, high)                                                                            \
    fuzz_require(isnan(x) || ((x) >= (low) && (x) <= (high)), "a value in its range");

static void read_drive(void)
{
    hci_drive_data drive;
    hci_note note = {{0}};
    memset(&drive, 0, sizeof drive);
    const hci_status status = hci_drive_read("drive.csv", &drive, &note);
    fuzz_check_note(status, &note);
    if (!status) {
#define CHECK_VALUE(field, name, unit, low, high, fallback, what) CHECK_RANGE(drive.field, low, high)
        HCI_DRIVE_VALUES(CHECK_VALUE)
#undef CHECK_VALUE
    }
    for (size_t k = 1; k < drive.response_count; ++k)
        fuzz_require(drive.response[k].frequency_Hz > drive.response[k - 1].frequency_Hz,
                     "ascending frequencies");
    hci_drive_release(&drive);
}

static void read_scenario(void)
{
    hci_scenario scenario;
    hci_note note = {{0}};
    const hci_status status = hci_scenario_read("scenario.csv", &scenario, &note);
    fuzz_check_note(status, &note);
    if (!status) {
#define CHECK_VALUE(field, name, unit, low, high, fallback, what) CHECK_RANGE(scenario.field, low, high)
        HCI_SCENARIO_VALUES(CHECK_VALUE)
#undef CHECK_VALUE
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_unpack(data, size);
    if (fuzz_exists("drive.csv")) read_drive();
    if (fuzz_exists("scenario.csv")) read_scenario();
    return 0;
}
