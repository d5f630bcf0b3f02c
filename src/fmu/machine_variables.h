/* Variables of the FMU of a machine: X(KEY, name, type, causality, unit, description). Which of the inputs an
 * FMU has depends on whether voltages or currents are imposed; those that it does not have are kept all the
 * same. */
#ifndef HCI_SRC_FMU_MACHINE_VARIABLES_H
#define HCI_SRC_FMU_MACHINE_VARIABLES_H

#include "fmu/variable.h"

#define HCI_FMU_MACHINE_VARIABLES(X)                                                                         \
    X(VA, "va", REAL, INPUT, "V", "voltage of phase a, to any common point, held for a communication step")  \
    X(VB, "vb", REAL, INPUT, "V", "the same of phase b")                                                     \
    X(VC, "vc", REAL, INPUT, "V", "the same of phase c")                                                     \
    X(IA_IMPOSED, "ia_imposed", REAL, INPUT, "A",                                                            \
      "current that flows in phase a, less the mean of the three, for a communication step")                 \
    X(IB_IMPOSED, "ib_imposed", REAL, INPUT, "A", "the same of phase b")                                     \
    X(IC_IMPOSED, "ic_imposed", REAL, INPUT, "A", "the same of phase c")                                     \
    X(LOAD_TORQUE, "load_torque", REAL, INPUT, "N.m", "on the shaft, against positive rotation")             \
    X(SPEED_PRESCRIBED, "speed_prescribed", REAL, INPUT, "rad/s",                                            \
      "mechanical speed of the shaft where speed_is_prescribed; else not used")                              \
    X(TEMPERATURE, "magnet_temperature", REAL, INPUT, "degC", "temperature of the magnets")                  \
    X(TORQUE, "torque", REAL, OUTPUT, "N.m", "of the machine on its rotor")                                  \
    X(SPEED, "speed", REAL, OUTPUT, "rad/s", "mechanical")                                                   \
    X(ANGLE, "angle", REAL, OUTPUT, "rad", "mechanical, not wrapped")                                        \
    X(ANGLE_ELECTRICAL, "angle_electrical", REAL, OUTPUT, "rad",                                             \
      "pole pairs times the mechanical angle, 0 to 2 pi; 0 at the rising zero crossing of the fundamental "  \
      "of phase a's back-EMF")                                                                               \
    X(IA, "ia", REAL, OUTPUT, "A", "current of phase a, into the machine")                                   \
    X(IB, "ib", REAL, OUTPUT, "A", "the same of phase b")                                                    \
    X(IC, "ic", REAL, OUTPUT, "A", "the same of phase c")                                                    \
    X(ID, "id", REAL, OUTPUT, "A",                                                                           \
      "current along the magnets' flux, amplitude-invariant: ia = iq sin(theta) - id cos(theta)")            \
    X(IQ, "iq", REAL, OUTPUT, "A", "the current that leads it by a quarter turn")                            \
    X(IA_MEASURED, "ia_measured", REAL, OUTPUT, "A", "what the sensor of phase a reads")                     \
    X(IB_MEASURED, "ib_measured", REAL, OUTPUT, "A", "the same of phase b")                                  \
    X(IC_MEASURED, "ic_measured", REAL, OUTPUT, "A", "the same of phase c")                                  \
    X(ANGLE_MEASURED, "angle_measured", REAL, OUTPUT, "rad", "what the encoder reads, from 0 to 2 pi")       \
    X(SPEED_MEASURED, "speed_measured", REAL, OUTPUT, "rad/s", "what is read of the speed")                  \
    X(TORQUE_MEASURED, "torque_measured", REAL, OUTPUT, "N.m",                                               \
      "what a torque sensor has read, one internal step ago")                                                \
    X(RESISTANCE, "resistance", REAL, PARAMETER, "Ohm", "of a phase")                                        \
    X(INERTIA, "inertia", REAL, PARAMETER, "kg.m2", "of the rotor and what turns with it")                   \
    X(VISCOUS, "viscous_friction", REAL, PARAMETER, "N.m.s/rad", "torque by speed")                          \
    X(COULOMB, "coulomb_friction", REAL, PARAMETER, "N.m", "moving and at rest")                             \
    X(IS_PRESCRIBED, "speed_is_prescribed", BOOLEAN, PARAMETER, "",                                          \
      "true: the shaft turns with speed_prescribed, whatever the torque")                                    \
    X(SPEED_START, "speed_start", REAL, PARAMETER, "rad/s", "mechanical, of a shaft that turns freely")      \
    X(ANGLE_START, "angle_start", REAL, PARAMETER, "rad", "mechanical")                                      \
    X(STEP, "step", REAL, PARAMETER, "s",                                                                    \
      "longest internal step; a communication step is divided into equal ones")                              \
    X(DEAD_TIME_VOLTAGE, "dead_time_voltage", REAL, PARAMETER, "V",                                          \
      "what the inverter's dead time takes of a phase voltage: dc link x dead time / period; 0: none")       \
    X(DEAD_TIME_CROSSING, "dead_time_crossing", REAL, PARAMETER, "A",                                        \
      "current below which dead time acts in part")

enum {
#define HCI_FMU_KEY(key, name, type, causality, unit, description) HCI_FMU_MACHINE_##key,
    HCI_FMU_MACHINE_VARIABLES(HCI_FMU_KEY)
#undef HCI_FMU_KEY
        HCI_FMU_MACHINE_COUNT
};

#endif
