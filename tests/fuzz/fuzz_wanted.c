/* Any bytes as a target, a set of components, currents, points of a grid: refused with words, or finite
 * values in order. */
#include "fuzzing.h"

#include <math.h>
#include <string.h>

#include "hci/host/currents/currents.h"
#include "hci/host/currents/target.h"
#include "hci/host/sweep/grid_file.h"

static void read_target(hci_order_base base)
{
    hci_target target;
    hci_note note = {{0}}, remark = {{0}};
    memset(&target, 0, sizeof target);
    fuzz_check_note(hci_target_read_orders("target.csv", base, 7, &target, &remark, &note), &note);
    for (size_t k = 0; k < target.count; ++k) {
        const hci_target_order *order = &target.order[k];
        fuzz_require(isfinite(order->torque_Nm.sine) && isfinite(order->torque_Nm.cosine), "finite torque");
        fuzz_require(order->weight >= 0.0 && isfinite(order->weight), "a weight");
        fuzz_require(k == 0 || order->torque_Nm.order > order[-1].torque_Nm.order, "ascending orders");
    }
    hci_target_release(&target);
}

static void read_set(bool has_neutral)
{
    hci_component_set set;
    hci_note note = {{0}};
    memset(&set, 0, sizeof set);
    fuzz_check_note(hci_component_set_read("harmonics.csv", has_neutral, &set, &note), &note);
    for (size_t k = 0; k < set.count; ++k)
        fuzz_require(set.component[k].order >= 0.0 && isfinite(set.component[k].order), "an order");
    hci_component_set_release(&set);
}

static void read_currents(bool per_Nm)
{
    hci_currents currents;
    hci_note note = {{0}};
    memset(&currents, 0, sizeof currents);
    fuzz_check_note(hci_currents_read("currents.csv", per_Nm, &currents, &note), &note);
    for (size_t k = 0; k < currents.count; ++k)
        fuzz_require(isfinite(currents.wave[k].sine) && isfinite(currents.wave[k].cosine), "finite currents");
    hci_currents_release(&currents);
}

static void read_grid(void)
{
    hci_grid_point *point = NULL;
    size_t count = 0;
    hci_note note = {{0}};
    fuzz_check_note(hci_grid_read("grid.csv", &point, &count, &note), &note);
    for (size_t k = 0; k < count; ++k)
        fuzz_require(isfinite(point[k].torque_Nm), "finite points");
    hci_grid_points_free(point);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_unpack(data, size);
    if (fuzz_exists("target.csv")) read_target(HCI_ORDER_ELECTRICAL), read_target(HCI_ORDER_MECHANICAL);
    if (fuzz_exists("harmonics.csv")) read_set(false), read_set(true);
    if (fuzz_exists("currents.csv")) read_currents(false), read_currents(true);
    if (fuzz_exists("grid.csv")) read_grid();
    return 0;
}
