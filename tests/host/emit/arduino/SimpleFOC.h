// The names of SimpleFOC that the sketch uses, with nothing behind them; and its own transformation of
// currents.
#ifndef SIMPLEFOC_H
#define SIMPLEFOC_H

#include <cmath>
#include <cstdint>

enum { A0 = 14, A2 = 16 };
enum class TorqueControlType { voltage, dc_current, foc_current };
enum class MotionControlType { torque, velocity, angle };
struct MagneticSensorI2CConfig_s {
};
static const MagneticSensorI2CConfig_s AS5600_I2C = {};
struct MagneticSensorI2C {
    explicit MagneticSensorI2C(MagneticSensorI2CConfig_s)
    {
    }
    void init()
    {
    }
};
struct BLDCDriver3PWM {
    BLDCDriver3PWM(int, int, int, int)
    {
    }
    int init()
    {
        return 1;
    }
};
struct InlineCurrentSense {
    InlineCurrentSense(float, float, int, int)
    {
    }
    void linkDriver(BLDCDriver3PWM *)
    {
    }
    int init()
    {
        return 1;
    }
};
struct DQCurrent_s {
    float d, q;
};
struct BLDCMotor {
    TorqueControlType torque_controller = TorqueControlType::voltage;
    MotionControlType controller = MotionControlType::angle;
    DQCurrent_s feed_forward_current = {0.0f, 0.0f};
    float target = 0.0f, shaft_velocity = 0.0f, electrical_angle = 0.0f;
    int8_t enabled = 0;
    explicit BLDCMotor(int)
    {
    }
    void linkSensor(MagneticSensorI2C *)
    {
    }
    void linkDriver(BLDCDriver3PWM *)
    {
    }
    void linkCurrentSense(InlineCurrentSense *)
    {
    }
    int init()
    {
        return 1;
    }
    int initFOC()
    {
        enabled = 1;
        return 1;
    }
    void disable()
    {
        enabled = 0;
    }
    void loopFOC()
    {
    }
    void move()
    {
    }
    float electricalAngle()
    {
        return electrical_angle;
    }
};
inline uint32_t &micros_now()
{
    static uint32_t now = 0;
    return now;
}
inline uint32_t micros()
{
    return micros_now() += 1000;
}

#endif
