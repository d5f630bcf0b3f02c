#include "cli/tune/tune_sensor_zero.h"

#include "cli/tune/tune_commands.h"
#include "cli/tune/tune_read.h"
#include "cli/tune/tune_suspect.h"

/* Under load the means of several currents tell the zero from the rest. */
static bool has_measured_load(const cli_tuning *t)
{
    for (size_t k = 0; k < t->runs.count; ++k) {
        const hci_run *r = &t->runs.run[k];
        if (r->torque_source != HCI_TORQUE_MEASURED) continue;
        for (size_t n = 0; n < 3 * r->count; ++n)
            if (r->i_A[n] != 0.0) return true;
    }
    return false;
}

hci_status cli_tune_take_sensor_zero(cli_tuning *t, hci_note *note)
{
    if (!t->is_own || !(t->drives_Nm > 0.0) || cli_tune_is_blocked(t) || has_measured_load(t)) return HCI_OK;
    const double offset_Nm = cli_tune_torque_way_of(t).mean_Nm;
    const hci_status status = hci_tuning_write_sensor_zero(t->machine, offset_Nm, note);
    if (status) return status;
    cli_tune_note(t,
                  "printf 'effect,parameter,value,unit\\ntorque_sensor,offset,%.9g,Nm\\n' "
                  ">\"$OUT\"/machine/effects.csv\n",
                  offset_Nm);
    hci_tuning_say(
        &t->tuning, HCI_TUNING_READ,
        "the mean of the torque without current, %.3g N·m, drives the shaft: it is taken for the zero "
        "of the sensor (torque_sensor, offset in machine/effects.csv), and tells no friction",
        offset_Nm);
    t->has_sensor_zero = true;
    return cli_tune_read_inputs(t, note);
}
