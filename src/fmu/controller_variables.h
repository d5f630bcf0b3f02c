/* Variables of the FMU of a controller: X(KEY, name, type, causality, unit, description). */
#ifndef HCI_SRC_FMU_CONTROLLER_VARIABLES_H
#define HCI_SRC_FMU_CONTROLLER_VARIABLES_H

#include "fmu/variable.h"

#define HCI_FMU_CONTROLLER_VARIABLES(X)                                                                      \
    X(TORQUE_REFERENCE, "torque_reference", REAL, INPUT, "N.m", "torque that is asked for")                  \
    X(IA, "ia", REAL, INPUT, "A", "current of phase a as its sensor reads it, into the machine")             \
    X(IB, "ib", REAL, INPUT, "A", "the same of phase b")                                                     \
    X(IC, "ic", REAL, INPUT, "A", "the same of phase c")                                                     \
    X(ANGLE, "angle", REAL, INPUT, "rad", "mechanical, as the encoder reads it")                             \
    X(SPEED, "speed", REAL, INPUT, "rad/s", "mechanical, as it is read")                                     \
    X(VA, "va", REAL, OUTPUT, "V", "voltage of phase a that the inverter is to hold on average")             \
    X(VB, "vb", REAL, OUTPUT, "V", "the same of phase b")                                                    \
    X(VC, "vc", REAL, OUTPUT, "V", "the same of phase c")                                                    \
    X(ID_REFERENCE, "id_reference", REAL, OUTPUT, "A",                                                       \
      "what the current loop is asked for along the magnets' flux, amplitude-invariant")                     \
    X(IQ_REFERENCE, "iq_reference", REAL, OUTPUT, "A", "the same of the current that leads it")              \
    X(REMEDY, "remedy", INTEGER, PARAMETER, "",                                                              \
      "what is done about the current loop: 1 table, 2 lead, 3 compensation, 4 feedforward")                 \
    X(KP, "current_kp", REAL, PARAMETER, "V/A", "of the PI current loop")                                    \
    X(KI, "current_ki", REAL, PARAMETER, "V/(A.s)", "of the PI current loop")                                \
    X(DC_LINK, "dc_link_voltage", REAL, PARAMETER, "V", "of the inverter")                                   \
    X(QUANTUM, "current_quantum", REAL, PARAMETER, "A", "step of the reading of currents; 0: none")          \
    X(COUNTS, "encoder_counts", REAL, PARAMETER, "", "in a mechanical turn; 0: the angle is not quantised")  \
    X(DEAD_TIME_VOLTAGE, "dead_time_voltage", REAL, PARAMETER, "V",                                          \
      "what is added for the inverter's dead time: dc link x dead time / period; 0: nothing")                \
    X(DEAD_TIME_CROSSING, "dead_time_crossing", REAL, PARAMETER, "A",                                        \
      "current below which that is added in part")                                                           \
    X(KP_Q, "current_kp_q", REAL, PARAMETER, "V/A", "of q in the PI current loop")                           \
    X(KI_Q, "current_ki_q", REAL, PARAMETER, "V/(A.s)", "the same")                                          \
    X(FILTER, "current_filter_time", REAL, PARAMETER, "",                                                    \
      "share of a new reading in what the PI sees of the current; 0: no filter")

enum {
#define HCI_FMU_KEY(key, name, type, causality, unit, description) HCI_FMU_CONTROLLER_##key,
    HCI_FMU_CONTROLLER_VARIABLES(HCI_FMU_KEY)
#undef HCI_FMU_KEY
        HCI_FMU_CONTROLLER_COUNT
};

#endif
