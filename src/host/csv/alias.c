#include "host/csv/alias.h"

#include <string.h>

#include "host/csv/channel_name.h"

#define MECHANICAL "the mechanical angle"
#define SR_AXES                                                                                              \
    "i_d as it stands; SyR-e's 'SR' axes have the magnet on -q: then i_d = -Iq and i_q = Id, rename them"
#define OWN_ESTIMATE "a torque that the drive has computed from its current, not measured"

#define FIRST_OF_THREE(quantity) "the " quantity " of phase a, and those after it as b and c"

#define BESIDE(other, name, column, unit, tool, meaning)                                                     \
    {                                                                                                        \
        name, column, unit, tool, meaning, other                                                             \
    }
#define TOLD(name, column, unit, tool, meaning) BESIDE(NULL, name, column, unit, tool, meaning)
#define PLAIN(name, column, unit, tool)         BESIDE(NULL, name, column, unit, tool, NULL)

/* A new name is one row here and one in the table of docs/files.md, which a test compares. A name that its
 * unit tells apart has a row for each meaning. */
const hci_alias hci_aliases[] = {
    PLAIN("t", "time_s", "s", "many"),
    PLAIN("ms_today", "time_s", "ms", "VESC Tool"),
    TOLD("millis", "time_s", "ms", "Arduino", "the time"),
    TOLD("micros", "time_s", "us", "Arduino", "the time"),
    TOLD("timestamp", "time_s", "s", "many", "the time"),
    PLAIN("timestamps", "time_s", "s", "asammdf"),
    TOLD("datetime", "time_s", "s", "many", "the time"),
    PLAIN("__time", "time_s", "s", "PlotJuggler"),
    TOLD("%time", "time_s", "ns", "ROS", "the time"),
    PLAIN("x-axis", "time_s", NULL, "Keysight"),
    PLAIN("Source", "time_s", NULL, "Siglent"),
    PLAIN("Second", "time_s", "s", "Siglent"),
    TOLD("X_Value", "time_s", "s", "LabVIEW", "the time"),
    BESIDE("Fd", "theta", "theta_e_rad", "deg", "SyR-e", "the electrical angle"),
    BESIDE("tau_M", "theta_m", "theta_e_rad", "rad", "motulator", "the electrical angle"),
    PLAIN("theta", NULL, NULL, "many"),
    PLAIN("phi", NULL, NULL, "many"),
    PLAIN("theta_r", NULL, NULL, "many"),
    PLAIN("rotor_angle", NULL, NULL, "many"),
    PLAIN("rotor_position", NULL, NULL, "many"),
    PLAIN("angle", NULL, NULL, "many"),
    PLAIN("mech angle", "theta_m_rad", "rad", "many"),
    PLAIN("elec angle", "theta_e_rad", "rad", "many"),
    TOLD("th", "theta_e_rad", "deg", "SyR-e", "the electrical angle"),
    TOLD("epsilon", "theta_e_rad", "rad", "GEM", "the electrical angle"),
    PLAIN("epsilon_el", "theta_e_rad", "rad", "many"),
    PLAIN("theta_el", "theta_e_rad", "rad", "many"),
    PLAIN("theta_elec", "theta_e_rad", "rad", "many"),
    PLAIN("electrical_angle", "theta_e_rad", "rad", "SimpleFOC"),
    PLAIN("thetam", "theta_m_rad", "rad", "Simulink"),
    PLAIN("theta_mech", "theta_m_rad", "rad", "many"),
    PLAIN("mechanical_angle", "theta_m_rad", "rad", "many"),
    PLAIN("shaft_angle", "theta_m_rad", "rad", "SimpleFOC"),
    TOLD("encoder_position", "theta_m_rad", "deg", "VESC Tool",
         "the mechanical angle of an encoder (a VESC without one writes its electrical phase there)"),
    TOLD("position", "theta_m_rad", "rev", "moteus", MECHANICAL),
    TOLD("pos_estimate", "theta_m_rad", "turn", "ODrive", MECHANICAL),
    TOLD(".pos_estimate", "theta_m_rad", "turn", "ODrive", MECHANICAL),
    TOLD(".pos_vel_mapper.pos_rel", "theta_m_rad", "turn", "ODrive", MECHANICAL),
    TOLD(".pos_vel_mapper.pos_abs", "theta_m_rad", "turn", "ODrive", MECHANICAL),
    TOLD(".servo_stats.position", "theta_m_rad", "rev", "moteus", MECHANICAL),
    TOLD("field.position0", "theta_m_rad", "rad", "ROS", MECHANICAL),
    TOLD("/joint_states/position[0]", "theta_m_rad", "rad", "PlotJuggler", MECHANICAL),
    PLAIN(".Position", "theta_m_rad", NULL, "Maxwell"),
    BESIDE("tau_M", "w_m", "speed_e_rad_per_s", "rad/s", "motulator",
           "the electrical speed, divided by the pole pairs"),
    TOLD("erpm", "speed_e_rad_per_s", "rpm", "VESC Tool", "the electrical speed, divided by the pole pairs"),
    PLAIN("omega_e", "speed_e_rad_per_s", "rad/s", "many"),
    PLAIN("omega_el", "speed_e_rad_per_s", "rad/s", "many"),
    PLAIN("w_e", "speed_e_rad_per_s", "rad/s", "many"),
    TOLD("rpm", "speed_rad_per_s", "rpm", "many", "the mechanical speed"),
    TOLD("n", "speed_rad_per_s", NULL, "many", "the mechanical speed"),
    TOLD("omega", "speed_rad_per_s", "rad/s", "GEM", "the mechanical speed"),
    PLAIN("omega_m", "speed_rad_per_s", "rad/s", "many"),
    TOLD("w_m", "speed_rad_per_s", "rad/s", "Simulink", "the mechanical speed"),
    PLAIN("shaft_velocity", "speed_rad_per_s", "rad/s", "SimpleFOC"),
    TOLD("motor_speed", "speed_rad_per_s", "rpm", "dyno", "the mechanical speed"),
    TOLD("rotor_speed", "speed_rad_per_s", "rpm", "dyno", "the mechanical speed"),
    TOLD("shaft_speed", "speed_rad_per_s", "rpm", "dyno", "the mechanical speed"),
    TOLD("velocity", "speed_rad_per_s", "rev/s", "moteus", "the mechanical speed"),
    TOLD("vel_estimate", "speed_rad_per_s", "turn/s", "ODrive", "the mechanical speed"),
    TOLD(".vel_estimate", "speed_rad_per_s", "turn/s", "ODrive", "the mechanical speed"),
    TOLD(".pos_vel_mapper.vel", "speed_rad_per_s", "turn/s", "ODrive", "the mechanical speed"),
    TOLD(".servo_stats.velocity", "speed_rad_per_s", "rev/s", "moteus", "the mechanical speed"),
    TOLD("field.velocity0", "speed_rad_per_s", "rad/s", "ROS", "the mechanical speed"),
    TOLD("/joint_states/velocity[0]", "speed_rad_per_s", "rad/s", "PlotJuggler", "the mechanical speed"),
    PLAIN(".Speed", "speed_rad_per_s", NULL, "Maxwell"),
    BESIDE("Fd", "Id", "id_A", "A", "SyR-e", SR_AXES),
    BESIDE("Fd", "id", "id_A", "A", "SyR-e", SR_AXES),
    PLAIN("i_d", "id_A", "A", "MathWorks"),
    PLAIN("i_q", "iq_A", "A", "MathWorks"),
    PLAIN("i_sd", "id_A", "A", "motulator"),
    PLAIN("i_sq", "iq_A", "A", "motulator"),
    PLAIN("d_axis_current", "id_A", "A", "VESC Tool"),
    PLAIN("q_axis_current", "iq_A", "A", "VESC Tool"),
    PLAIN("d_current", "id_A", "A", "moteus"),
    PLAIN("q_current", "iq_A", "A", "moteus"),
    PLAIN("Id_measured", "id_A", "A", "ODrive"),
    PLAIN("Iq_measured", "iq_A", "A", "ODrive"),
    PLAIN(".Id_measured", "id_A", "A", "ODrive"),
    PLAIN(".Iq_measured", "iq_A", "A", "ODrive"),
    PLAIN(".current_control.Id_measured", "id_A", "A", "ODrive"),
    PLAIN(".current_control.Iq_measured", "iq_A", "A", "ODrive"),
    PLAIN(".servo_stats.d", "id_A", "A", "moteus"),
    PLAIN(".servo_stats.q", "iq_A", "A", "moteus"),
    PLAIN("i_a", "ia_A", "A", "many"),
    PLAIN("i_b", "ib_A", "A", "many"),
    PLAIN("i_c", "ic_A", "A", "many"),
    PLAIN("i_sa", "ia_A", "A", "many"),
    PLAIN("i_sb", "ib_A", "A", "many"),
    PLAIN("i_sc", "ic_A", "A", "many"),
    PLAIN("i_u", "ia_A", "A", "many"),
    PLAIN("i_v", "ib_A", "A", "many"),
    PLAIN("i_w", "ic_A", "A", "many"),
    PLAIN("Current(PhaseA)", "ia_A", "A", "Maxwell"),
    PLAIN("Current(PhaseB)", "ib_A", "A", "Maxwell"),
    PLAIN("Current(PhaseC)", "ic_A", "A", "Maxwell"),
    PLAIN("Current(PhaseU)", "ia_A", "A", "Maxwell"),
    PLAIN("Current(PhaseV)", "ib_A", "A", "Maxwell"),
    PLAIN("Current(PhaseW)", "ic_A", "A", "Maxwell"),
    PLAIN("InputCurrent(PhaseA)", "ia_A", "A", "Maxwell"),
    PLAIN("InputCurrent(PhaseB)", "ib_A", "A", "Maxwell"),
    PLAIN("InputCurrent(PhaseC)", "ic_A", "A", "Maxwell"),
    PLAIN("Coil-U", "va_V", NULL, "JMAG"),
    PLAIN("Coil-V", "vb_V", NULL, "JMAG"),
    PLAIN("Coil-W", "vc_V", NULL, "JMAG"),
    TOLD("Coil-U", "ia_A", "A", "JMAG", FIRST_OF_THREE("current")),
    PLAIN("Coil-V", "ib_A", "A", "JMAG"),
    PLAIN("Coil-W", "ic_A", "A", "JMAG"),
    BESIDE("q_current", "torque", "torque_computed_Nm", "N*m", "moteus", OWN_ESTIMATE),
    TOLD("torque_estimate", "torque_computed_Nm", "N*m", "ODrive", OWN_ESTIMATE),
    TOLD(".torque_estimate", "torque_computed_Nm", "N*m", "ODrive", OWN_ESTIMATE),
    TOLD(".servo_stats.torque", "torque_computed_Nm", "N*m", "moteus", OWN_ESTIMATE),
    TOLD("field.effort0", "torque_computed_Nm", "N*m", "ROS", OWN_ESTIMATE),
    TOLD("/joint_states/effort[0]", "torque_computed_Nm", "N*m", "PlotJuggler", OWN_ESTIMATE),
    TOLD("torque_actual_value", "torque_computed_Nm", "N*m", "CiA 402", OWN_ESTIMATE),
    TOLD("estimated_torque", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("torque_estimated", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("torque_est", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("calculated_torque", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("torque_calculated", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("calc_torque", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("torque_calc", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    TOLD("computed_torque", "torque_computed_Nm", "N*m", "many", OWN_ESTIMATE),
    PLAIN("T", "temperature_C", NULL, "many"),
    TOLD("T", "torque_Nm", "N*m", "SyR-e", "the torque"),
    PLAIN("T_e", "torque_Nm", "N*m", "Simulink"),
    TOLD("tau", "torque_Nm", "N*m", "many", "the torque"),
    PLAIN("tau_M", "torque_Nm", "N*m", "motulator"),
    PLAIN("M", "torque_Nm", NULL, "many"),
    PLAIN("shaft_torque", "torque_Nm", "N*m", "dyno"),
    PLAIN("measured_torque", "torque_Nm", "N*m", "dyno"),
    PLAIN(".Torque", "torque_Nm", NULL, "Maxwell"),
    PLAIN("temp_motor", "temperature_C", "degC", "VESC Tool"),
    PLAIN("motor_temperature", "temperature_C", "degC", "moteus"),
    PLAIN("v_d", "vd_V", "V", "many"),
    PLAIN("v_q", "vq_V", "V", "many"),
    PLAIN("u_d", "vd_V", "V", "motulator"),
    PLAIN("u_q", "vq_V", "V", "motulator"),
    PLAIN("u_sd", "vd_V", "V", "motulator"),
    PLAIN("u_sq", "vq_V", "V", "motulator"),
    PLAIN("d_axis_voltage", "vd_V", "V", "VESC Tool"),
    PLAIN("q_axis_voltage", "vq_V", "V", "VESC Tool"),
    PLAIN("v_a", "va_V", "V", "many"),
    PLAIN("v_b", "vb_V", "V", "many"),
    PLAIN("v_c", "vc_V", "V", "many"),
    PLAIN("u_a", "va_V", "V", "GEM"),
    PLAIN("u_b", "vb_V", "V", "GEM"),
    PLAIN("u_c", "vc_V", "V", "GEM"),
    PLAIN("e_a", "va_V", "V", "many"),
    PLAIN("e_b", "vb_V", "V", "many"),
    PLAIN("e_c", "vc_V", "V", "many"),
    PLAIN("V(a)", "va_V", "V", "LTspice"),
    PLAIN("V(b)", "vb_V", "V", "LTspice"),
    PLAIN("V(c)", "vc_V", "V", "LTspice"),
    PLAIN("V(u)", "va_V", "V", "LTspice"),
    PLAIN("V(v)", "vb_V", "V", "LTspice"),
    PLAIN("V(w)", "vc_V", "V", "LTspice"),
    PLAIN("V(a,b)", "vab_V", "V", "LTspice"),
    PLAIN("V(b,c)", "vbc_V", "V", "LTspice"),
    PLAIN("V(c,a)", "vca_V", "V", "LTspice"),
    PLAIN("v_ab", "vab_V", "V", "many"),
    PLAIN("v_bc", "vbc_V", "V", "many"),
    PLAIN("v_ca", "vca_V", "V", "many"),
    PLAIN("u_ab", "vab_V", "V", "many"),
    PLAIN("u_bc", "vbc_V", "V", "many"),
    PLAIN("u_ca", "vca_V", "V", "many"),
    PLAIN("InducedVoltage(PhaseA)", "va_V", "V", "Maxwell"),
    PLAIN("InducedVoltage(PhaseB)", "vb_V", "V", "Maxwell"),
    PLAIN("InducedVoltage(PhaseC)", "vc_V", "V", "Maxwell"),
    PLAIN("InducedVoltage(Winding_A)", "va_V", "V", "Maxwell"),
    PLAIN("InducedVoltage(Winding_B)", "vb_V", "V", "Maxwell"),
    PLAIN("InducedVoltage(Winding_C)", "vc_V", "V", "Maxwell"),
    TOLD("Terminal-U", "va_V", "V", "JMAG", FIRST_OF_THREE("voltage")),
    PLAIN("Terminal-V", "vb_V", "V", "JMAG"),
    PLAIN("Terminal-W", "vc_V", "V", "JMAG"),
    TOLD("CH1", "va_V", "V", "oscilloscope", FIRST_OF_THREE("voltage")),
    PLAIN("CH2", "vb_V", "V", "oscilloscope"),
    PLAIN("CH3", "vc_V", "V", "oscilloscope"),
    TOLD("Channel A", "va_V", "V", "PicoScope", FIRST_OF_THREE("voltage")),
    PLAIN("Channel B", "vb_V", "V", "PicoScope"),
    PLAIN("Channel C", "vc_V", "V", "PicoScope"),
    TOLD("Channel 1", "va_V", "V", "WaveForms", FIRST_OF_THREE("voltage")),
    PLAIN("Channel 2", "vb_V", "V", "WaveForms"),
    PLAIN("Channel 3", "vc_V", "V", "WaveForms"),
    TOLD("1", "va_V", NULL, "Keysight", FIRST_OF_THREE("voltage")),
    PLAIN("2", "vb_V", NULL, "Keysight"),
    PLAIN("3", "vc_V", NULL, "Keysight"),
    PLAIN("harmonic_order", "order", "1", "many"),
    PLAIN("electrical_order", "order", "1", "many"),
    PLAIN("mechanical_order", "order", "1", "many"),
    PLAIN("L_aa", "La_H", "H", "many"),
    PLAIN("L_bb", "Lb_H", "H", "many"),
    PLAIN("L_cc", "Lc_H", "H", "many"),
    PLAIN("L_ab", "Mab_H", "H", "many"),
    PLAIN("L_bc", "Mbc_H", "H", "many"),
    PLAIN("L_ca", "Mca_H", "H", "many"),
    PLAIN("L(PhaseA,PhaseA)", "La_H", "H", "Maxwell"),
    PLAIN("L(PhaseB,PhaseB)", "Lb_H", "H", "Maxwell"),
    PLAIN("L(PhaseC,PhaseC)", "Lc_H", "H", "Maxwell"),
    PLAIN("L(PhaseA,PhaseB)", "Mab_H", "H", "Maxwell"),
    PLAIN("L(PhaseB,PhaseC)", "Mbc_H", "H", "Maxwell"),
    PLAIN("L(PhaseC,PhaseA)", "Mca_H", "H", "Maxwell"),
    PLAIN("Zeit", "time_s", "s", "German"),
    TOLD("Drehzahl", "speed_rad_per_s", "rpm", "German", "the mechanical speed"),
    TOLD("Drehmoment", "torque_Nm", "N*m", "German", "the torque"),
    TOLD("Wellenmoment", "torque_Nm", "N*m", "German", "the torque"),
    PLAIN("Winkel", NULL, NULL, "German"),
    PLAIN("Drehwinkel", NULL, NULL, "German"),
    PLAIN("Rotorwinkel", NULL, NULL, "German"),
    PLAIN("Läuferwinkel", NULL, NULL, "German"),
    PLAIN("Laeuferwinkel", NULL, NULL, "German"),
    PLAIN("mechanischer Winkel", "theta_m_rad", "rad", "German"),
    PLAIN("Winkel mech", "theta_m_rad", "rad", "German"),
    PLAIN("elektrischer Winkel", "theta_e_rad", "rad", "German"),
    PLAIN("Winkel el", "theta_e_rad", "rad", "German"),
    PLAIN("temps", "time_s", "s", "French"),
    TOLD("vitesse", "speed_rad_per_s", "rpm", "French", "the mechanical speed"),
    TOLD("vitesse de rotation", "speed_rad_per_s", "rpm", "French", "the mechanical speed"),
    TOLD("couple", "torque_Nm", "N*m", "French", "the torque"),
    PLAIN("angle mécanique", "theta_m_rad", "rad", "French"),
    PLAIN("angle mecanique", "theta_m_rad", "rad", "French"),
    PLAIN("angle électrique", "theta_e_rad", "rad", "French"),
    PLAIN("angle electrique", "theta_e_rad", "rad", "French"),
    PLAIN("tempo", "time_s", "s", "Italian"),
    TOLD("velocità", "speed_rad_per_s", "rpm", "Italian", "the mechanical speed"),
    TOLD("velocita", "speed_rad_per_s", "rpm", "Italian", "the mechanical speed"),
    TOLD("giri", "speed_rad_per_s", "rpm", "Italian", "the mechanical speed"),
    TOLD("coppia", "torque_Nm", "N*m", "Italian", "the torque"),
    PLAIN("angolo", NULL, NULL, "Italian"),
    PLAIN("angolo meccanico", "theta_m_rad", "rad", "Italian"),
    PLAIN("angolo elettrico", "theta_e_rad", "rad", "Italian"),
    PLAIN("tiempo", "time_s", "s", "Spanish"),
    TOLD("velocidad", "speed_rad_per_s", "rpm", "Spanish", "the mechanical speed"),
    TOLD("par", "torque_Nm", "N*m", "Spanish", "the torque"),
    PLAIN("ángulo", NULL, NULL, "Spanish"),
    PLAIN("angulo", NULL, NULL, "Spanish"),
    PLAIN("ángulo mecánico", "theta_m_rad", "rad", "Spanish"),
    PLAIN("angulo mecanico", "theta_m_rad", "rad", "Spanish"),
    PLAIN("ángulo eléctrico", "theta_e_rad", "rad", "Spanish"),
    PLAIN("angulo electrico", "theta_e_rad", "rad", "Spanish"),
    PLAIN("i_l1", "ia_A", "A", "many"),
    PLAIN("i_l2", "ib_A", "A", "many"),
    PLAIN("i_l3", "ic_A", "A", "many"),
    PLAIN("u_l1", "va_V", "V", "many"),
    PLAIN("u_l2", "vb_V", "V", "many"),
    PLAIN("u_l3", "vc_V", "V", "many"),
    PLAIN("i_1", "ia_A", "A", "many"),
    PLAIN("i_2", "ib_A", "A", "many"),
    PLAIN("i_3", "ic_A", "A", "many"),
    PLAIN("u_1", "va_V", "V", "many"),
    PLAIN("u_2", "vb_V", "V", "many"),
    PLAIN("u_3", "vc_V", "V", "many"),
    PLAIN("u_u", "va_V", "V", "many"),
    PLAIN("u_v", "vb_V", "V", "many"),
    PLAIN("u_w", "vc_V", "V", "many"),
    PLAIN("u_uv", "vab_V", "V", "many"),
    PLAIN("u_vw", "vbc_V", "V", "many"),
    PLAIN("u_wu", "vca_V", "V", "many"),
    PLAIN("u_12", "vab_V", "V", "many"),
    PLAIN("u_23", "vbc_V", "V", "many"),
    PLAIN("u_31", "vca_V", "V", "many"),
    PLAIN("u_l1l2", "vab_V", "V", "many"),
    PLAIN("u_l2l3", "vbc_V", "V", "many"),
    PLAIN("u_l3l1", "vca_V", "V", "many"),
};

const size_t hci_alias_count = sizeof hci_aliases / sizeof *hci_aliases;

static bool is_filler(char c)
{
    return c == ' ' || c == '_' || c == '-';
}

static char lower(char c)
{
    return (char)(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

/* The same of a capital with an accent, of two bytes: C3 80 to C3 9E. */
static char lower_after(char before, char c)
{
    const unsigned char byte = (unsigned char)c;
    if ((unsigned char)before == 0xC3 && byte >= 0x80 && byte <= 0x9E) return (char)(byte + 0x20);
    return lower(c);
}

/* Same letters. A leading '-' is a sign, which must not be lost. */
static bool is_alike(const char *name, size_t length, const char *alias)
{
    const char *end = name + length;
    char before = '\0', before_alias = '\0';
    if (length > 0 && *name == '-') return false;
    for (;;) {
        while (name < end && is_filler(*name))
            ++name;
        while (is_filler(*alias))
            ++alias;
        if (name == end || *alias == '\0') return name == end && *alias == '\0';
        if (lower_after(before, *name) != lower_after(before_alias, *alias)) return false;
        before = *name++;
        before_alias = *alias++;
    }
}

/* Where the last parts of a dotted path begin, as many as the alias has: behind a dot, or at the beginning
 * where the alias has several. The length where it has fewer. */
static size_t tail_of(const char *name, size_t length, const char *alias)
{
    size_t parts = 1, start = length;
    for (const char *at = alias; *at != '\0'; ++at)
        parts += *at == '.';
    const bool is_several = parts > 1;
    while (start > 0 && (name[start - 1] != '.' || --parts > 0))
        --start;
    return start > 1 || (start == 0 && is_several && parts == 1) ? start : length;
}

static bool is_path(const hci_alias *alias, const char *name, size_t length)
{
    const size_t start = tail_of(name, length, alias->name + 1);
    return start != length && name[0] != '-' && name[start] != ' ' && !hci_channel_is_wanted(name, start) &&
           is_alike(name + start, length - start, alias->name + 1);
}

static bool has_parts(const hci_alias *alias)
{
    return alias->name[0] == '.' && strchr(alias->name + 1, '.') != NULL;
}

/* One that ends as an alias of several parts is that, and no other. */
static bool is_longer_path(const char *name, size_t length)
{
    for (size_t k = 0; k < hci_alias_count; ++k)
        if (has_parts(&hci_aliases[k]) && is_path(&hci_aliases[k], name, length)) return true;
    return false;
}

bool hci_alias_is_name(const hci_alias *alias, const char *name, size_t length)
{
    const size_t own = strlen(alias->name);
    if (alias->beside != NULL || own == 1) return own == length && memcmp(alias->name, name, length) == 0;
    if (alias->name[0] != '.') return is_alike(name, length, alias->name);
    return is_path(alias, name, length) && (has_parts(alias) || !is_longer_path(name, length));
}
