/* What can be read in several ways: one row a slip. */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "host/check/convention_errors.h"

#define SQRT2  1.4142135623730951
#define DEGREE (HCI_PI / 180.0)
#define RPM    (2.0 * HCI_PI / 60.0)

/* One table in a hundred has a given slip; what many tools get wrong is twice as frequent, and what needs two
 * mistakes or a rare unit half as frequent or less. A sheet's value is of one kind only, so that the kinds of
 * the back-EMF share what a slip of it may have. */
#define OFTEN  0.02
#define SELDOM 0.005
#define SLIP   0.01

#define FIELD(name) offsetof(check_view, name)

#define UNLOADED "a recording of voltages, angle and speed of the motor driven without current"
#define LOADED   "a recording of currents, angle, speed and torque, with voltages if possible"
#define RATINGS  "rated_torque and rated_current in machine.csv, or a recording under load"

const check_choice HCI_CHECK_CHOICES[] = {
    {"poles_for_pole_pairs", OF_POLES, OFTEN, FIELD(pole_pairs), 0.5, 0.0, AT_POLES,
     "pole_pairs is the number of poles", "%s",
     "the number of magnets counted, or a recording of currents or voltages with the angle"},
    {"emf_rms", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_RMS, AT_EMF,
     "the back-EMF is given as rms of a phase, not as peak", "%s", UNLOADED},
    {"emf_line", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_LINE, AT_EMF,
     "the back-EMF is given line to line, not line to star point", "%s", UNLOADED},
    {"emf_line_rms", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_LINE_RMS, AT_EMF,
     "the back-EMF is given as rms line to line, not as peak of a phase", "%s", UNLOADED},
    {"emf_volt_per_krpm", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_VOLT_PER_KRPM, AT_EMF,
     "the back-EMF is given in V per 1000 rpm (peak of a phase)", "%s", UNLOADED},
    {"emf_volt_per_krpm_line", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_VOLT_PER_KRPM_LINE, AT_EMF,
     "the back-EMF is given in V per 1000 rpm, peak line to line", "%s", UNLOADED},
    {"emf_volt_per_krpm_line_rms", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_VOLT_PER_KRPM_LINE_RMS, AT_EMF,
     "the back-EMF is given in V per 1000 rpm, rms line to line", "%s", UNLOADED},
    {"emf_kv", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_KV, AT_EMF,
     "the back-EMF is given as Kv in rpm per V (peak line to line)", "%s", UNLOADED},
    {"emf_volt_per_hz", OF_EMF, SELDOM, FIELD(emf_kind), 0.0, EMF_VOLT_PER_HZ, AT_EMF,
     "the back-EMF is given in V per electrical Hz (peak of a phase)", "%s", UNLOADED},
    {"emf_flux_linkage", OF_EMF, SLIP, FIELD(emf_kind), 0.0, EMF_FLUX_LINKAGE, AT_EMF,
     "the back-EMF is given as flux linkage in Wb, per electrical radian", "%s", UNLOADED},
    {"emf_sign", OF_EMF_SIGN, SELDOM, FIELD(emf_sign), -1.0, 0.0, AT_EMF_SIGN,
     "the back-EMF has the opposite sign", "%s, and so in every row",
     "nothing has to: both put the fundamental's rising zero crossing at angle 0"},
    {"emf_orders_mechanical", OF_EMF_ORDER, SLIP, FIELD(emf_mechanical), 0.0, 1.0, AT_EMF_ORDER,
     "the orders of back_emf.csv are per mechanical turn", "%s: every order divided by pole_pairs", UNLOADED},
    {"cogging_orders_mechanical", OF_COGGING_ORDER, SLIP, FIELD(cogging_mechanical), 0.0, 1.0,
     AT_COGGING_ORDER, "the orders of cogging.csv are per mechanical turn",
     "%s: every order divided by pole_pairs",
     "a recording of torque over the angle without current, or `slots` in machine.csv"},
    {"phases_in_degrees", OF_PHASE, SLIP, FIELD(phase_unit), DEGREE, 0.0, AT_PHASE,
     "the phases of both tables are in degrees", "phase_deg", "a table with phases above 2π"},
    {"phases_in_degrees", OF_PHASE, SELDOM, FIELD(emf_phase_unit), DEGREE, 0.0, AT_EMF_PHASE,
     "the phases of back_emf.csv are in degrees", "phase_deg", "a table with phases above 2π"},
    {"phases_in_degrees", OF_PHASE, SELDOM, FIELD(cogging_phase_unit), DEGREE, 0.0, AT_COGGING_PHASE,
     "the phases of cogging.csv are in degrees", "phase_deg", "a table with phases above 2π"},
    {"angle_zero_d_axis", OF_ZERO, SLIP, FIELD(zero_rad), 0.0, HCI_PI, AT_ZERO,
     "the tables count the angle from the magnet axis (e_a = -sin), not from the rising zero crossing of "
     "the back-EMF",
     "%s: in every table, phase - order x pi",
     "nothing has to: both put the fundamental's rising zero crossing at angle 0"},
    {"angle_zero_q_axis", OF_ZERO, SLIP, FIELD(zero_rad), 0.0, 0.5 * HCI_PI, AT_ZERO,
     "the tables count the angle from the crest of the back-EMF (e_a = cos), not from its rising zero "
     "crossing",
     "%s: in every table, phase - order x pi/2", UNLOADED},
    {"angle_zero_q_axis", OF_ZERO, SLIP, FIELD(zero_rad), 0.0, -0.5 * HCI_PI, AT_ZERO,
     "the tables count the angle from the trough of the back-EMF (e_a = -cos), not from its rising zero "
     "crossing",
     "%s: in every table, phase + order x pi/2", UNLOADED},
    {"rated_current_rms", OF_RATED_CURRENT, OFTEN, FIELD(rated_current), SQRT2, 0.0, AT_RATED_CURRENT,
     "rated_current is rms, not peak", "%s", LOADED},
    {"inductance_per_electrical_radian", OF_SLOPE, SLIP, FIELD(slope_electrical), 0.0, 1.0, AT_SLOPE,
     "the slopes of inductance.csv are per electrical radian, not per mechanical one",
     "%s: all slopes times pole_pairs",
     "inductance_d and inductance_q in machine.csv, or a recording with i_d"},
    {"resistance_line", OF_RESISTANCE, SLIP, FIELD(resistance), 0.5, 0.0, AT_RESISTANCE,
     "resistance is between two terminals, not of a phase", "%s", LOADED},
    {"theta_electrical_for_mechanical", OF_THETA, SLIP, FIELD(theta_m_is_electrical), 0.0, 1.0, AT_THETA_M,
     "the angle of the recordings is electrical, not mechanical", "theta_e_rad",
     "phase currents or voltages beside the angle"},
    {"theta_mechanical_for_electrical", OF_THETA, SLIP, FIELD(theta_e_is_mechanical), 0.0, 1.0, AT_THETA_E,
     "the angle of the recordings is mechanical, not electrical", "theta_m_rad",
     "phase currents or voltages beside the angle"},
    {"theta_degrees_for_radians", OF_THETA_UNIT, SLIP, FIELD(theta_unit), DEGREE, 0.0, AT_THETA,
     "the angle of the recordings is in degrees", "the unit _deg in the column's name",
     "phase currents or voltages beside the angle"},
    {"run_angle_zero_d_axis", OF_RUN_ZERO, SLIP, FIELD(run_zero_rad), 0.0, HCI_PI, AT_THETA,
     "the recordings count the angle from the magnet axis (e_a = -sin)", "the electrical angle + pi",
     UNLOADED},
    {"run_angle_zero_q_axis", OF_RUN_ZERO, SLIP, FIELD(run_zero_rad), 0.0, 0.5 * HCI_PI, AT_THETA,
     "the recordings count the angle from the crest of the back-EMF (e_a = cos)",
     "the electrical angle + pi/2", UNLOADED},
    {"run_angle_zero_q_axis", OF_RUN_ZERO, SLIP, FIELD(run_zero_rad), 0.0, -0.5 * HCI_PI, AT_THETA,
     "the recordings count the angle from the trough of the back-EMF (e_a = -cos)",
     "the electrical angle - pi/2", UNLOADED},
    {"direction_reversed", OF_DIRECTION, SELDOM, FIELD(direction), -1.0, 0.0, AT_THETA,
     "the angle of the recordings is counted backward", "the angle with the opposite sign",
     "a speed of its own beside time and angle (angle and speed reversed together look like b and c "
     "swapped)"},
    {"phases_swapped", OF_PHASES, SLIP, FIELD(swapped), 0.0, 1.0, AT_PHASES,
     "phases b and c of the recordings are swapped", "b and c the other way round", UNLOADED},
    {"current_rms", OF_CURRENT, SELDOM, FIELD(current), SQRT2, 0.0, AT_ABC,
     "the phase currents are scaled to rms values", "every current times sqrt(2)", LOADED},
    {"current_power_invariant", OF_CURRENT, SLIP, FIELD(current), 0.81649658092772603, 0.0, AT_DQ,
     "id and iq are power-invariant, not amplitude-invariant", "id and iq times sqrt(2/3)", LOADED},
    {"current_power_invariant", OF_CURRENT, SLIP, FIELD(dq), 0.81649658092772603, 0.0, AT_DRIVE,
     "id, iq, vd and vq are power-invariant, not amplitude-invariant", "id, iq, vd and vq times sqrt(2/3)",
     LOADED},
    {"current_dq_rms", OF_CURRENT, SLIP, FIELD(current), SQRT2, 0.0, AT_DQ, "id and iq are rms values",
     "id and iq times sqrt(2)", LOADED},
    {"current_dq_rms", OF_CURRENT, SLIP, FIELD(dq), SQRT2, 0.0, AT_DRIVE, "id, iq, vd and vq are rms values",
     "id, iq, vd and vq times sqrt(2)", LOADED},
    {"current_sign", OF_CURRENT_SIGN, SLIP, FIELD(current), -1.0, 0.0, AT_CURRENT,
     "the currents are counted out of the machine", "every current with the opposite sign",
     "voltages beside currents and torque, at a current with a clear copper loss"},
    {"voltage_line", OF_VOLTAGE, SLIP, FIELD(voltage_is_line), 0.0, 1.0, AT_PHASE_VOLTAGE,
     "the voltages are line to line: va holds v_ab, vb v_bc, vc v_ca", "vab_V, vbc_V, vca_V", UNLOADED},
    {"voltage_sign", OF_VOLTAGE_SIGN, SLIP, FIELD(voltage), -1.0, 0.0, AT_VOLTAGE,
     "the voltages have the opposite sign", "every voltage with the opposite sign",
     "voltages beside currents, speed and torque under load"},
    {"torque_sign", OF_TORQUE, SLIP, FIELD(torque), -1.0, 0.0, AT_TORQUE,
     "the torque is that of a generator: positive against the rotation", "the torque with the opposite sign",
     "voltages beside currents and torque, at a current with a clear copper loss"},
    {"torque_millinewton", OF_TORQUE_UNIT, SLIP, FIELD(torque), 1e-3, 0.0, AT_TORQUE, "the torque is in mN·m",
     "torque_mNm", LOADED},
    {"speed_electrical", OF_SPEED, SLIP, FIELD(speed_electrical), 0.0, 1.0, AT_SPEED_M,
     "the speed is electrical, not mechanical", "the speed divided by pole_pairs",
     "time, angle and phase currents or voltages beside the speed"},
    {"speed_rpm_for_rad_per_s", OF_SPEED, SLIP, FIELD(speed), RPM, 0.0, AT_SPEED, "the speed is in rpm",
     "speed_rpm", "time and angle beside the speed"},
    {"time_milliseconds", OF_TIME, SLIP, FIELD(time), 1e-3, 0.0, AT_TIME, "the time is in milliseconds",
     "time_ms", "a speed beside time and angle"},
};
const size_t HCI_CHECK_CHOICE_COUNT = sizeof HCI_CHECK_CHOICES / sizeof *HCI_CHECK_CHOICES;

/* Volts at a frequency that is given are seldom volts at another, or another thing. */
double hci_check_choice_prior(const check_choice *choice, const check_figures *f)
{
    const bool of_unit = choice->aspect == OF_EMF && choice->plus >= EMF_VOLT_PER_KRPM;
    return of_unit && f->emf_in_volts ? 0.1 * choice->prior : choice->prior;
}

void hci_check_view_take(check_view *view, const check_choice *choice)
{
    double field;
    char *at = (char *)view + choice->field;
    memcpy(&field, at, sizeof field);
    field = field * choice->times + choice->plus;
    memcpy(at, &field, sizeof field);
}
