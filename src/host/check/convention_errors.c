#include "host/check/convention_errors.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "hci/host/check/check.h"

#define SQRT2  1.4142135623730951
#define DEGREE (HCI_PI / 180.0)
#define RPM    (2.0 * HCI_PI / 60.0)

/* One table in a hundred has a given error; what many tools get wrong is twice as frequent, and what needs
 * two mistakes or a rare unit half as frequent or less. A sheet's value is of one kind only, so that the
 * kinds of the back-EMF share what an error of it may have. */
#define OFTEN   0.02
#define USUALLY 0.01
#define SELDOM  0.005

/* The index of an encoder is where it was screwed on. */
#define INDEX 0.1

#define FIELD(name) offsetof(check_interpretation, name)

#define UNLOADED "a recording of voltages, angle and speed of the motor driven without current"
#define LOADED   "a recording of currents, angle, speed and torque, with voltages if possible"
#define RATINGS  "rated_torque and rated_current in machine.csv, or a recording under load"

const check_error HCI_CHECK_ERRORS[] = {
    {"poles_for_pole_pairs", CHECK_OF_POLES, OFTEN, FIELD(pole_pairs), 0.5, 0.0, CHECK_AT_POLES,
     "pole_pairs is the number of poles", "%s",
     "the number of magnets counted, or a recording of currents or voltages with the angle"},
    {"pole_pairs_miscounted", CHECK_OF_POLES, SELDOM, FIELD(pole_pairs_counted), 0.0, 1.0, CHECK_AT_POLES,
     "pole_pairs is not the number that the recordings count, or their angle is of a shaft behind a gear",
     "%s", "the number of magnets counted, or a recording of currents or voltages with the angle"},
    {"emf_rms", CHECK_OF_EMF, USUALLY, FIELD(emf_kind), 0.0, CHECK_EMF_RMS, CHECK_AT_EMF,
     "the back-EMF is given as rms of a phase, not as peak", "%s", UNLOADED},
    {"emf_line", CHECK_OF_EMF, USUALLY, FIELD(emf_kind), 0.0, CHECK_EMF_LINE, CHECK_AT_EMF,
     "the back-EMF is given line to line, not line to star point", "%s", UNLOADED},
    {"emf_line_rms", CHECK_OF_EMF, USUALLY, FIELD(emf_kind), 0.0, CHECK_EMF_LINE_RMS, CHECK_AT_EMF,
     "the back-EMF is given as rms line to line, not as peak of a phase", "%s", UNLOADED},
    {"emf_taken_for_rms", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_TAKEN_FOR_RMS, CHECK_AT_EMF,
     "the back-EMF was converted as rms, and is a peak", "%s", UNLOADED},
    {"emf_taken_for_line", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_TAKEN_FOR_LINE, CHECK_AT_EMF,
     "the back-EMF was converted as line to line, and is of a phase", "%s", UNLOADED},
    {"emf_taken_for_line_rms", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_TAKEN_FOR_LINE_RMS,
     CHECK_AT_EMF, "the back-EMF was converted as rms line to line, and is the peak of a phase", "%s",
     UNLOADED},
    {"emf_volt_per_krpm", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_VOLT_PER_KRPM, CHECK_AT_EMF,
     "the back-EMF is given in V per 1000 rpm (peak of a phase)", "%s", UNLOADED},
    {"emf_volt_per_krpm_line", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_VOLT_PER_KRPM_LINE,
     CHECK_AT_EMF, "the back-EMF is given in V per 1000 rpm, peak line to line", "%s", UNLOADED},
    {"emf_volt_per_krpm_line_rms", CHECK_OF_EMF, USUALLY, FIELD(emf_kind), 0.0,
     CHECK_EMF_VOLT_PER_KRPM_LINE_RMS, CHECK_AT_EMF,
     "the back-EMF is given in V per 1000 rpm, rms line to line", "%s", UNLOADED},
    {"emf_kv", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_KV, CHECK_AT_EMF,
     "the back-EMF is given as Kv in rpm per V (peak line to line)", "%s", UNLOADED},
    {"emf_volt_per_hz", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_VOLT_PER_HZ, CHECK_AT_EMF,
     "the back-EMF is given in V per electrical Hz (peak of a phase)", "%s", UNLOADED},
    {"emf_flux_linkage", CHECK_OF_EMF, USUALLY, FIELD(emf_kind), 0.0, CHECK_EMF_FLUX_LINKAGE, CHECK_AT_EMF,
     "the back-EMF is given as flux linkage in Wb, per electrical radian", "%s", UNLOADED},
    {"emf_taken_per_krpm", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_TAKEN_PER_KRPM, CHECK_AT_EMF,
     "the back-EMF is in V s/rad, but was taken for V per 1000 rpm (peak of a phase)", "%s", UNLOADED},
    {"emf_taken_per_krpm_line", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0, CHECK_EMF_TAKEN_PER_KRPM_LINE,
     CHECK_AT_EMF, "the back-EMF is in V s/rad, but was taken for V per 1000 rpm, peak line to line", "%s",
     UNLOADED},
    {"emf_taken_per_krpm_line_rms", CHECK_OF_EMF, SELDOM, FIELD(emf_kind), 0.0,
     CHECK_EMF_TAKEN_PER_KRPM_LINE_RMS, CHECK_AT_EMF,
     "the back-EMF is in V s/rad, but was taken for V per 1000 rpm, rms line to line", "%s", UNLOADED},
    {"emf_sign", CHECK_OF_EMF_SIGN, SELDOM, FIELD(emf_sign), -1.0, 0.0, CHECK_AT_EMF_SIGN,
     "the back-EMF has the opposite sign", "%s, and so in every row",
     "nothing has to: both put the fundamental's rising zero crossing at angle 0"},
    {"emf_orders_mechanical", CHECK_OF_EMF_ORDER, USUALLY, FIELD(emf_mechanical), 0.0, 1.0,
     CHECK_AT_EMF_ORDER, "the orders of back_emf.csv are per mechanical turn",
     "%s: every order divided by pole_pairs", UNLOADED},
    {"cogging_orders_mechanical", CHECK_OF_COGGING_ORDER, USUALLY, FIELD(cogging_mechanical), 0.0, 1.0,
     CHECK_AT_COGGING_ORDER, "the orders of cogging.csv are per mechanical turn",
     "%s: every order divided by pole_pairs",
     "a recording of torque over the angle without current, or `slots` in machine.csv"},
    {"phases_in_degrees", CHECK_OF_PHASE, USUALLY, FIELD(phase_unit), DEGREE, 0.0, CHECK_AT_PHASE,
     "the phases of both tables are in degrees", "phase_deg", "a table with phases above 2π"},
    {"phases_in_degrees", CHECK_OF_PHASE, SELDOM, FIELD(emf_phase_unit), DEGREE, 0.0, CHECK_AT_EMF_PHASE,
     "the phases of back_emf.csv are in degrees", "phase_deg", "a table with phases above 2π"},
    {"phases_in_degrees", CHECK_OF_PHASE, SELDOM, FIELD(cogging_phase_unit), DEGREE, 0.0,
     CHECK_AT_COGGING_PHASE, "the phases of cogging.csv are in degrees", "phase_deg",
     "a table with phases above 2π"},
    {"angle_zero_d_axis", CHECK_OF_ZERO, USUALLY, FIELD(zero_rad), 0.0, HCI_PI, CHECK_AT_ZERO,
     "the tables count the angle from the magnet axis (e_a = -sin), not from the rising zero crossing of "
     "the back-EMF",
     "%s: in every table, phase - order x pi",
     "nothing has to: both put the fundamental's rising zero crossing at angle 0"},
    {"angle_zero_q_axis", CHECK_OF_ZERO, USUALLY, FIELD(zero_rad), 0.0, 0.5 * HCI_PI, CHECK_AT_ZERO,
     "the tables count the angle from the crest of the back-EMF (e_a = cos), not from its rising zero "
     "crossing",
     "%s: in every table, phase - order x pi/2", UNLOADED},
    {"angle_zero_q_axis", CHECK_OF_ZERO, USUALLY, FIELD(zero_rad), 0.0, -0.5 * HCI_PI, CHECK_AT_ZERO,
     "the tables count the angle from the trough of the back-EMF (e_a = -cos), not from its rising zero "
     "crossing",
     "%s: in every table, phase + order x pi/2", UNLOADED},
    {"rated_current_rms", CHECK_OF_RATED_CURRENT, OFTEN, FIELD(rated_current), SQRT2, 0.0,
     CHECK_AT_RATED_CURRENT, "rated_current is rms, not peak", "%s", LOADED},
    {"inductance_per_electrical_radian", CHECK_OF_SLOPE, USUALLY, FIELD(slope_electrical), 0.0, 1.0,
     CHECK_AT_SLOPE, "the slopes of inductance.csv are per electrical radian, not per mechanical one",
     "%s: all slopes times pole_pairs",
     "inductance_d and inductance_q in machine.csv, or a recording with i_d"},
    {"resistance_line", CHECK_OF_RESISTANCE, USUALLY, FIELD(resistance), 0.5, 0.0, CHECK_AT_RESISTANCE,
     "resistance is between two terminals, not of a phase", "%s", LOADED},
    {"theta_electrical_for_mechanical", CHECK_OF_THETA, USUALLY, FIELD(theta_m_is_electrical), 0.0, 1.0,
     CHECK_AT_THETA_M, "the angle of the recordings is electrical, not mechanical", "theta_e_rad",
     "phase currents or voltages beside the angle"},
    {"angle_geared", CHECK_OF_THETA, SELDOM, FIELD(theta_geared), 0.0, 1.0, CHECK_AT_THETA_M,
     "the angle of the recordings is of a shaft behind a gear", "the angle of the rotor",
     "phase currents or voltages beside the angle"},
    {"theta_mechanical_for_electrical", CHECK_OF_THETA, USUALLY, FIELD(theta_e_is_mechanical), 0.0, 1.0,
     CHECK_AT_THETA_E, "the angle of the recordings is mechanical, not electrical", "theta_m_rad",
     "phase currents or voltages beside the angle"},
    {"theta_degrees_for_radians", CHECK_OF_THETA_UNIT, USUALLY, FIELD(theta_unit), DEGREE, 0.0,
     CHECK_AT_THETA, "the angle of the recordings is in degrees", "the unit _deg in the column's name",
     "phase currents or voltages beside the angle"},
    {"theta_radians_for_degrees", CHECK_OF_THETA_UNIT, SELDOM, FIELD(theta_unit), 1.0 / DEGREE, 0.0,
     CHECK_AT_THETA, "the angle of the recordings was read as degrees, and is in radians",
     "the unit _rad in the column's name", "phase currents or voltages beside the angle"},
    {"theta_turns_for_radians", CHECK_OF_THETA_UNIT, USUALLY, FIELD(theta_unit), 2.0 * HCI_PI, 0.0,
     CHECK_AT_THETA, "the angle of the recordings is in turns", "the unit _turn in the column's name",
     "phase currents or voltages beside the angle"},
    {"run_angle_zero_d_axis", CHECK_OF_RUN_ZERO, USUALLY, FIELD(run_zero_rad), 0.0, HCI_PI, CHECK_AT_THETA,
     "the recordings count the angle from the magnet axis (e_a = -sin)", "the electrical angle + pi",
     UNLOADED},
    {"run_angle_zero_q_axis", CHECK_OF_RUN_ZERO, USUALLY, FIELD(run_zero_rad), 0.0, 0.5 * HCI_PI,
     CHECK_AT_THETA, "the recordings count the angle from the crest of the back-EMF (e_a = cos)",
     "the electrical angle + pi/2", UNLOADED},
    {"run_angle_zero_q_axis", CHECK_OF_RUN_ZERO, USUALLY, FIELD(run_zero_rad), 0.0, -0.5 * HCI_PI,
     CHECK_AT_THETA, "the recordings count the angle from the trough of the back-EMF (e_a = -cos)",
     "the electrical angle - pi/2", UNLOADED},
    {HCI_CHECK_RUN_OFFSET, CHECK_OF_RUN_ZERO, INDEX, FIELD(run_zero_free), 0.0, 1.0, CHECK_AT_THETA,
     "the electrical zero of the angle in the recordings is off", "--angle-offset",
     "voltages with the angle, terminals open and turned by another motor"},
    {"direction_reversed", CHECK_OF_DIRECTION, SELDOM, FIELD(direction), -1.0, 0.0, CHECK_AT_THETA,
     "the angle of the recordings is counted backward", "the angle with the opposite sign",
     "a speed of its own beside time and angle (angle and speed reversed together look like b and c "
     "swapped)"},
    {"phases_swapped", CHECK_OF_PHASES, USUALLY, FIELD(swapped), 0.0, 1.0, CHECK_AT_PHASES,
     "phases b and c of the recordings are swapped, or another two with another zero of the angle, or angle "
     "and speed are both counted backward",
     "b and c the other way round", UNLOADED},
    {"phases_swapped", CHECK_OF_PHASES, SELDOM, FIELD(swapped), 0.0, CHECK_SWAPPED_CA, CHECK_AT_PHASES,
     "phases a and c of the recordings are swapped", "a and c the other way round", UNLOADED},
    {"phases_swapped", CHECK_OF_PHASES, SELDOM, FIELD(swapped), 0.0, CHECK_SWAPPED_AB, CHECK_AT_PHASES,
     "phases a and b of the recordings are swapped", "a and b the other way round", UNLOADED},
    {"phases_rotated", CHECK_OF_RUN_ZERO, SELDOM, FIELD(run_zero_rad), 0.0, 2.0 * HCI_PI / 3.0,
     CHECK_AT_PHASES,
     "the columns a, b, c of the recordings hold the phases c, a, b, or the zero of their angle is a third "
     "of an electrical turn off",
     "c, a, b in this order", UNLOADED},
    {"phases_rotated", CHECK_OF_RUN_ZERO, SELDOM, FIELD(run_zero_rad), 0.0, -2.0 * HCI_PI / 3.0,
     CHECK_AT_PHASES,
     "the columns a, b, c of the recordings hold the phases b, c, a, or the zero of their angle is a third "
     "of an electrical turn off",
     "b, c, a in this order", UNLOADED},
    {"currents_swapped", CHECK_OF_PHASES, SELDOM, FIELD(currents_swapped), 0.0, 1.0, CHECK_AT_CLAMPS,
     "phases b and c of the currents are swapped, and those of the voltages are not",
     "b and c of the currents the other way round", LOADED},
    {"currents_swapped", CHECK_OF_PHASES, SELDOM, FIELD(currents_swapped), 0.0, CHECK_SWAPPED_CA,
     CHECK_AT_CLAMPS, "phases a and c of the currents are swapped, and those of the voltages are not",
     "a and c of the currents the other way round", LOADED},
    {"currents_swapped", CHECK_OF_PHASES, SELDOM, FIELD(currents_swapped), 0.0, CHECK_SWAPPED_AB,
     CHECK_AT_CLAMPS, "phases a and b of the currents are swapped, and those of the voltages are not",
     "a and b of the currents the other way round", LOADED},
    {"voltages_swapped", CHECK_OF_PHASES, SELDOM, FIELD(voltages_swapped), 0.0, 1.0, CHECK_AT_PROBES,
     "phases b and c of the voltages are swapped, and those of the currents are not",
     "b and c of the voltages the other way round", LOADED},
    {"voltages_swapped", CHECK_OF_PHASES, SELDOM, FIELD(voltages_swapped), 0.0, CHECK_SWAPPED_CA,
     CHECK_AT_PROBES, "phases a and c of the voltages are swapped, and those of the currents are not",
     "a and c of the voltages the other way round", LOADED},
    {"voltages_swapped", CHECK_OF_PHASES, SELDOM, FIELD(voltages_swapped), 0.0, CHECK_SWAPPED_AB,
     CHECK_AT_PROBES, "phases a and b of the voltages are swapped, and those of the currents are not",
     "a and b of the voltages the other way round", LOADED},
    {"current_rms", CHECK_OF_CURRENT, SELDOM, FIELD(current), SQRT2, 0.0, CHECK_AT_ABC,
     "the phase currents are scaled to rms values", "every current times sqrt(2)", LOADED},
    {"current_power_invariant", CHECK_OF_CURRENT, USUALLY, FIELD(current), 0.81649658092772603, 0.0,
     CHECK_AT_DQ, "id and iq are power-invariant, not amplitude-invariant", "id and iq times sqrt(2/3)",
     LOADED},
    {"current_power_invariant", CHECK_OF_CURRENT, USUALLY, FIELD(dq), 0.81649658092772603, 0.0,
     CHECK_AT_DRIVE, "id, iq, vd and vq are power-invariant, not amplitude-invariant",
     "id, iq, vd and vq times sqrt(2/3)", LOADED},
    {"current_dq_rms", CHECK_OF_CURRENT, USUALLY, FIELD(current), SQRT2, 0.0, CHECK_AT_DQ,
     "id and iq are rms values", "id and iq times sqrt(2)", LOADED},
    {"current_dq_rms", CHECK_OF_CURRENT, USUALLY, FIELD(dq), SQRT2, 0.0, CHECK_AT_DRIVE,
     "id, iq, vd and vq are rms values", "id, iq, vd and vq times sqrt(2)", LOADED},
    {"current_milliampere", CHECK_OF_CURRENT_UNIT, USUALLY, FIELD(current), 1e-3, 0.0, CHECK_AT_CURRENT,
     "the currents are in mA", "iq_mA",
     "rated_current in machine.csv, or a recording of currents, angle and torque"},
    {"current_sign", CHECK_OF_CURRENT_SIGN, USUALLY, FIELD(current), -1.0, 0.0, CHECK_AT_CURRENT,
     "the currents are counted out of the machine", "every current with the opposite sign",
     "voltages beside currents and torque, at a current with a clear copper loss"},
    {"voltage_line", CHECK_OF_VOLTAGE, USUALLY, FIELD(voltage_is_line), 0.0, 1.0, CHECK_AT_PHASE_VOLTAGE,
     "the voltages are line to line: va holds v_ab, vb v_bc, vc v_ca", "vab_V, vbc_V, vca_V", UNLOADED},
    {"voltage_sign", CHECK_OF_VOLTAGE_SIGN, USUALLY, FIELD(voltage), -1.0, 0.0, CHECK_AT_VOLTAGE,
     "the voltages have the opposite sign", "every voltage with the opposite sign",
     "voltages beside currents, speed and torque under load"},
    {"torque_sign", CHECK_OF_TORQUE, USUALLY, FIELD(torque), -1.0, 0.0, CHECK_AT_TORQUE,
     "the torque is that of a generator: positive against the rotation", "the torque with the opposite sign",
     "voltages beside currents and torque, at a current with a clear copper loss"},
    {"torque_millinewton", CHECK_OF_TORQUE_UNIT, USUALLY, FIELD(torque), 1e-3, 0.0, CHECK_AT_TORQUE,
     "the torque is in mN·m", "torque_mNm", LOADED},
    {"torque_newton_centimetre", CHECK_OF_TORQUE_UNIT, USUALLY, FIELD(torque), 1e-2, 0.0, CHECK_AT_TORQUE,
     "the torque is in N·cm", "torque_Ncm", LOADED},
    {"torque_pound_inch", CHECK_OF_TORQUE_UNIT, SELDOM, FIELD(torque), 0.1129848290276167, 0.0,
     CHECK_AT_TORQUE, "the torque is in lbf·in", "torque_lbfin", LOADED},
    {"torque_ounce_inch", CHECK_OF_TORQUE_UNIT, SELDOM, FIELD(torque), 0.00706155181422604, 0.0,
     CHECK_AT_TORQUE, "the torque is in ozf·in", "torque_ozfin", LOADED},
    {"torque_kilogram_centimetre", CHECK_OF_TORQUE_UNIT, SELDOM, FIELD(torque), 0.0980665, 0.0,
     CHECK_AT_TORQUE, "the torque is in kgf·cm", "torque_kgfcm", LOADED},
    {"speed_electrical", CHECK_OF_SPEED, USUALLY, FIELD(speed_electrical), 0.0, 1.0, CHECK_AT_SPEED_M,
     "the speed is electrical, not mechanical", "the speed divided by pole_pairs",
     "time, angle and phase currents or voltages beside the speed"},
    {"speed_mechanical", CHECK_OF_SPEED, USUALLY, FIELD(speed_mechanical), 0.0, 1.0, CHECK_AT_SPEED_E,
     "the speed is mechanical, not electrical", "the mechanical speed",
     "time, angle and phase currents or voltages beside the speed"},
    {"speed_rpm_for_rad_per_s", CHECK_OF_SPEED, USUALLY, FIELD(speed), RPM, 0.0, CHECK_AT_SPEED,
     "the speed is in rpm", "speed_rpm", "time and angle beside the speed"},
    {"speed_turn_per_s_for_rad_per_s", CHECK_OF_SPEED, USUALLY, FIELD(speed), 2.0 * HCI_PI, 0.0,
     CHECK_AT_SPEED, "the speed is in turn/s", "speed_turn_per_s", "time and angle beside the speed"},
    {"speed_unsigned", CHECK_OF_SPEED_SIGN, USUALLY, FIELD(speed_unsigned), 0.0, 1.0, CHECK_AT_SPEED_SIGN,
     "the speed has no sign: it is positive backward, too", "the speed with the sign of the angle's change",
     "the direction in which the shaft has turned"},
    {"time_milliseconds", CHECK_OF_TIME, USUALLY, FIELD(time), 1e-3, 0.0, CHECK_AT_TIME,
     "the time is in milliseconds", "time_ms", "a speed beside time and angle"},
    {"time_microseconds", CHECK_OF_TIME, USUALLY, FIELD(time), 1e-6, 0.0, CHECK_AT_TIME,
     "the time is in microseconds", "time_us", "a speed beside time and angle"},
    {"time_nanoseconds", CHECK_OF_TIME, SELDOM, FIELD(time), 1e-9, 0.0, CHECK_AT_TIME,
     "the time is in nanoseconds", "time_ns", "a speed beside time and angle"},
};
const size_t HCI_CHECK_ERROR_COUNT = sizeof HCI_CHECK_ERRORS / sizeof *HCI_CHECK_ERRORS;

/* Volts at a frequency that is given are seldom volts at another, or another thing. */
double hci_check_error_prior(const check_error *error, const check_data *data)
{
    const bool of_unit = error->aspect == CHECK_OF_EMF && error->plus >= CHECK_EMF_VOLT_PER_KRPM;
    return of_unit && data->emf_in_volts ? 0.1 * error->prior : error->prior;
}

void hci_check_error_apply(check_interpretation *as, const check_error *error)
{
    double field;
    char *at = (char *)as + error->field;
    memcpy(&field, at, sizeof field);
    field = field * error->times + error->plus;
    memcpy(at, &field, sizeof field);
}

const char *hci_check_slip_topic(const char *slip)
{
    static const char *const TOPICS[] = {[CHECK_OF_POLES] = "the pole pairs",
                                         [CHECK_OF_EMF] = "kind and unit of the back-EMF",
                                         [CHECK_OF_EMF_SIGN] = "the sign of the back-EMF",
                                         [CHECK_OF_EMF_ORDER] = "what the orders of the back-EMF count",
                                         [CHECK_OF_COGGING_ORDER] =
                                             "what the orders of the cogging torque count",
                                         [CHECK_OF_PHASE] = "the unit of the phases in the tables",
                                         [CHECK_OF_ZERO] = "the zero of the angle in the tables",
                                         [CHECK_OF_RATED_CURRENT] = "whether rated_current is peak or rms",
                                         [CHECK_OF_RESISTANCE] = "whether resistance is of a phase",
                                         [CHECK_OF_SLOPE] = "what the slopes of the inductance are over",
                                         [CHECK_OF_THETA] = "whether the angle is that of the rotor",
                                         [CHECK_OF_THETA_UNIT] = "the unit of the angle",
                                         [CHECK_OF_DIRECTION] = "the direction of the angle",
                                         [CHECK_OF_RUN_ZERO] = "the zero of the angle in the recordings",
                                         [CHECK_OF_PHASES] = "the order of the phases",
                                         [CHECK_OF_CURRENT] = "whether currents are peak or rms",
                                         [CHECK_OF_CURRENT_UNIT] = "the unit of the currents",
                                         [CHECK_OF_CURRENT_SIGN] = "the sign of the currents",
                                         [CHECK_OF_VOLTAGE] = "whether voltages are of phases",
                                         [CHECK_OF_VOLTAGE_SIGN] = "the sign of the voltages",
                                         [CHECK_OF_TORQUE] = "the sign of the torque",
                                         [CHECK_OF_TORQUE_UNIT] = "the unit of the torque",
                                         [CHECK_OF_SPEED] = "the unit of the speed",
                                         [CHECK_OF_SPEED_SIGN] = "the sign of the speed",
                                         [CHECK_OF_TIME] = "the unit of the time"};
    for (size_t k = 0; k < HCI_CHECK_ERROR_COUNT; ++k)
        if (strcmp(HCI_CHECK_ERRORS[k].name, slip) == 0) return TOPICS[HCI_CHECK_ERRORS[k].aspect];
    return "";
}
