/* Any list of recordings with its columns.csv and their files: refused with words, or finite samples. */
#include "fuzzing.h"

#include <math.h>
#include <string.h>

#include "hci/host/recording/run.h"

static void check_samples(const double *value, size_t count)
{
    for (size_t k = 0; value != NULL && k < count; ++k)
        fuzz_require(isfinite(value[k]), "finite samples");
}

static void check_run(const hci_run *run)
{
    fuzz_check_shown(run->remark.text);
    check_samples(run->theta_m_rad, run->count);
    check_samples(run->speed_rad_per_s, run->count);
    check_samples(run->i_A, 3 * run->count);
    check_samples(run->torque_Nm, run->count);
    check_samples(run->v_V, 3 * run->count);
    for (size_t k = 1; run->time_s != NULL && k < run->count; ++k)
        fuzz_require(run->time_s[k] > run->time_s[k - 1], "ascending time");
}

static void read_list(bool strict)
{
    const hci_runs_options options = {.run = {.pole_pairs = 3, .inertia_kgm2 = 1e-3, .strict = strict}};
    hci_runs runs;
    hci_note note = {{0}};
    memset(&runs, 0, sizeof runs);
    fuzz_check_note(hci_runs_read("runs.csv", &options, &runs, &note), &note);
    for (size_t k = 0; k < runs.count; ++k)
        check_run(&runs.run[k]);
    hci_runs_release(&runs);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_unpack(data, size);
    read_list(false);
    read_list(true);
    return 0;
}
