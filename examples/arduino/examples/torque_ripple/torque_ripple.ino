// Torque without ripple on SimpleFOC: the difference between the currents of the table and the plain i_q is fed forward. Put
// smooth.h and smooth.c beside this file:
//   hci-solve emit currents --name smooth --format i16 --frame dq --per-torque --machine MACHINE -o torque_ripple
#include <SimpleFOC.h>
#include <hci_tables.h>

#include "smooth.h"

BLDCMotor motor = BLDCMotor(smooth_POLE_PAIRS);
BLDCDriver3PWM driver = BLDCDriver3PWM(9, 5, 6, 8);
MagneticSensorI2C sensor = MagneticSensorI2C(AS5600_I2C);
InlineCurrentSense current_sense = InlineCurrentSense(0.01f, 50.0f, A0, A2);

static const float MOST_A = 30.0f;        // of what is fed forward
static const float FADES_rad_per_s = 20.0f; // mechanical: the current loop follows up to here, and nothing is left at twice it

static hci_guard_ramp ramp;
static uint32_t last_us;

void setup()
{
    sensor.init();
    motor.linkSensor(&sensor);
    driver.init();
    motor.linkDriver(&driver);
    current_sense.linkDriver(&driver);
    current_sense.init();
    motor.linkCurrentSense(&current_sense);
    motor.torque_controller = TorqueControlType::foc_current;
    motor.controller = MotionControlType::torque;
    motor.init();
    motor.initFOC();
    if (hci_table_i16_check(&smooth) != HCI_TABLE_GOOD) motor.disable();
    hci_guard_ramp_start(&ramp, 0.5f, 1e-3f);
}

// The currents for the torque that the target asks for, less the target itself, which SimpleFOC adds.
hci_currents_dq fed_forward(float target_A, float torque_constant_Nm_per_A)
{
    // SimpleFOC counts from the flux on phase a: half a turn from the table.
    const uint32_t angle = hci_angle_from_rad(motor.electricalAngle()) + 0x80000000u;
    const float share = hci_guard_ramp_next(&ramp, motor.enabled) *
                        hci_guard_fade(motor.shaft_velocity, FADES_rad_per_s, 2.0f * FADES_rad_per_s);
    hci_currents_dq i = hci_table_i16_dq_torque(&smooth, angle, target_A * torque_constant_Nm_per_A);
    i.id_A *= share;
    i.iq_A = share * (i.iq_A - target_A);
    return hci_guard_dq(i, MOST_A);
}

void loop()
{
    const uint32_t now_us = micros();
    if (now_us - last_us >= 1000u) { // the ramp counts milliseconds
        last_us = now_us;
        const hci_currents_dq i = fed_forward(motor.target, 0.21f);
        motor.feed_forward_current.d = i.id_A;
        motor.feed_forward_current.q = i.iq_A;
    }
    motor.loopFOC();
    motor.move();
}
