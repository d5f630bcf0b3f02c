/* Levels of torque from the folders of solutions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hci/host/currents/solution_folder.h"
#include "hci/host/drive/drive.h"
#include "host/base/memory.h"

static hci_status allocate(size_t count, hci_loop_levels *x, hci_note *note)
{
    x->level = hci_memory_new(count, sizeof *x->level);
    x->currents = hci_memory_new(count, sizeof *x->currents);
    if (!x->level || !x->currents) return hci_note_memory(note, NULL, "%zu levels of torque", count);
    x->count = count;
    return HCI_OK;
}

static hci_status read_level(const char *folder, size_t k, hci_loop_levels *x, hci_note *note)
{
    hci_status status = hci_solution_read_wanted_torque(folder, &x->level[k].torque_Nm, note);
    if (!status) status = hci_solution_read_currents(folder, HCI_SOLUTION_CURRENTS, &x->currents[k], note);
    if (status) return status;
    x->level[k].waves = x->currents[k].wave;
    x->level[k].count = x->currents[k].count;
    x->hash = x->hash * 31u ^ x->currents[k].hash;
    return HCI_OK;
}

/* B + T·A as one list. */
static hci_status add_parts(const hci_currents *constant, const hci_currents *per_Nm, double torque_Nm,
                            hci_currents *sum)
{
    sum->wave = hci_memory_new(constant->count + per_Nm->count, sizeof *sum->wave);
    if (!sum->wave) return HCI_ERROR_MEMORY;
    for (size_t k = 0; k < constant->count; ++k)
        sum->wave[sum->count++] = constant->wave[k];
    for (size_t k = 0; k < per_Nm->count; ++k) {
        hci_wave w = per_Nm->wave[k];
        w.sine *= torque_Nm;
        w.cosine *= torque_Nm;
        sum->wave[sum->count++] = w;
    }
    sum->count = hci_waves_join(sum->wave, sum->count, 0.0);
    return HCI_OK;
}

static hci_status read_parts(const char *folder, hci_loop_levels *x, hci_note *note)
{
    hci_currents constant = {.count = 0}, per_Nm = {.count = 0};
    double torque_Nm = 0.0;
    hci_status status = HCI_OK;
    if (!hci_solution_has_parts(folder))
        status =
            hci_note_set(note, HCI_ERROR_INPUT,
                         "%s: no currents_per_Nm.csv: these currents are not linear in the mean torque; give "
                         "several folders, each solved for a torque of its own",
                         folder);
    if (!status) status = hci_solution_read_mean_torque(folder, &torque_Nm, note);
    if (!status) status = hci_solution_read_currents(folder, HCI_SOLUTION_CURRENTS_CONSTANT, &constant, note);
    if (!status) status = hci_solution_read_currents(folder, HCI_SOLUTION_CURRENTS_PER_NM, &per_Nm, note);
    for (size_t k = 0; k < 2 && !status; ++k) {
        x->level[k].torque_Nm = (k == 0 ? -1.0 : 1.0) * fabs(torque_Nm);
        status = add_parts(&constant, &per_Nm, x->level[k].torque_Nm, &x->currents[k]);
        if (status) status = hci_note_memory(note, folder, "its currents");
        x->level[k].waves = x->currents[k].wave;
        x->level[k].count = x->currents[k].count;
    }
    x->hash = constant.hash * 31u ^ per_Nm.hash;
    hci_currents_release(&constant);
    hci_currents_release(&per_Nm);
    return status;
}

static int by_torque(const void *a, const void *b)
{
    const double x = ((const hci_loop_level *)a)->torque_Nm, y = ((const hci_loop_level *)b)->torque_Nm;
    return (x > y) - (x < y);
}

static hci_status check_levels(const hci_loop_levels *x, hci_note *note)
{
    for (size_t k = 0; k < x->count; ++k)
        for (size_t w = 0; w < x->level[k].count; ++w)
            if (x->level[k].waves[w].sequence == 0)
                return hci_note_set(
                    note, HCI_ERROR_INPUT,
                    "currents of order %g are a zero sequence, which a loop in d and q does not "
                    "make; solve for a star without neutral conductor",
                    x->level[k].waves[w].order);
    for (size_t k = 1; k < x->count; ++k)
        if (!(x->level[k].torque_Nm > x->level[k - 1].torque_Nm))
            return hci_note_set(note, HCI_ERROR_ARGUMENT,
                                "levels of torque: found %g N·m twice; give each torque once",
                                x->level[k].torque_Nm);
    return HCI_OK;
}

hci_status hci_loop_levels_read(const char *const *folders, size_t count, bool per_torque,
                                hci_loop_levels *levels, hci_note *note)
{
    memset(levels, 0, sizeof *levels);
    hci_status status = allocate(per_torque ? 2 : count, levels, note);
    if (!status && per_torque && count != 1)
        status = hci_note_set(note, HCI_ERROR_ARGUMENT,
                              "--per-torque takes one folder; without it each folder is a level of torque");
    if (!status && per_torque) status = read_parts(folders[0], levels, note);
    for (size_t k = 0; k < count && !per_torque && !status; ++k)
        status = read_level(folders[k], k, levels, note);
    if (!status) {
        qsort(levels->level, levels->count, sizeof *levels->level, by_torque);
        status = check_levels(levels, note);
    }
    if (status) hci_loop_levels_release(levels);
    return status;
}

void hci_loop_levels_release(hci_loop_levels *levels)
{
    for (size_t k = 0; k < levels->count; ++k)
        hci_currents_release(&levels->currents[k]);
    hci_memory_free(levels->currents);
    hci_memory_free(levels->level);
    memset(levels, 0, sizeof *levels);
}
