#!/usr/bin/env python3
"""Recordings like those of the tutorial, for readers who do not have them: hold.csv, acceleration.csv, speed_control.csv.

    python3 examples/mn4004/recordings.py FOLDER

The tutorial follows a T-Motor MN4004-KV300 on an ODRI driver, recorded by Heitor Andrade (github.com/heitor-andrade/laas_anti_cogging,
BSD-3-Clause). What is made here is a motor on paper with the constants that were read out of those recordings: cogging torque, friction,
inertia, back-EMF and resistance as found there, noise of the same size. The columns are the same, the figures come out near, not equal.
"""
import math
import os
import random
import sys

POLE_PAIRS = 12
TORQUE_CONSTANT = 0.02786        # N·m per ampere of i_q, peak: 3/2 of the back-EMF of a phase
BACK_EMF = 0.01857               # V·s/rad, of u_q
RESISTANCE = 0.703               # ohm
INERTIA = 5.3e-6                 # kg·m²
COULOMB = 1.48e-3                # N·m
CURRENT_NOISE = 0.012            # A, mostly the regulator at work
SPEED_NOISE = 0.6                # rad/s, of a counter
CURRENT_STEP = 0.000977          # A, of the analogue-digital converter
ANGLE_STEP = 2 * math.pi / 20000  # rad, of the encoder

# Mechanical order, amplitude in N·m and phase of T = A sin(order·theta_m + phase), from the recorded holding current.
COGGING = [(12, 8.41e-4, 3.035), (13, 3.9e-5, 1.2), (18, 1.169e-3, -2.974), (19, 7.0e-5, 0.5), (24, 5.10e-4, -1.727), (36, 4.02e-4, 2.862),
           (48, 2.39e-4, 0.865), (54, 1.36e-4, 1.540), (55, 9.17e-5, 2.894), (70, 5.32e-5, 0.334), (71, 2.62e-4, 0.808), (72, 5.167e-3, 0.707),
           (73, 2.42e-4, -2.527), (74, 5.04e-5, -2.003), (90, 1.20e-4, -2.586), (108, 5.17e-5, -1.796), (143, 6.2e-5, 1.442),
           (144, 6.77e-4, 1.354), (145, 4.8e-5, -1.701), (162, 3.0e-5, -1.725), (216, 2.08e-4, 2.015), (288, 3.6e-5, 2.483),
           (360, 2.3e-5, -2.584), (432, 5.0e-5, 1.091), (576, 2.1e-5, 2.418)]
TABLE = [sum(a * math.sin(n * k * 2 * math.pi / 7200 + g) for n, a, g in COGGING) for k in range(7201)]


def cogging(theta_m):
    at = theta_m / (2 * math.pi) % 1.0 * 7200
    k = int(at)
    return TABLE[k] + (at - k) * (TABLE[k + 1] - TABLE[k])


def measured(current):
    return round((current + random.gauss(0, CURRENT_NOISE)) / CURRENT_STEP) * CURRENT_STEP


def counted(theta_m):
    return round(theta_m / ANGLE_STEP) * ANGLE_STEP


def write(folder, name, header, rows):
    with open(os.path.join(folder, name), "w", encoding="ascii") as file:
        file.write(header + "\n")
        file.writelines(",".join("%.7g" % value for value in row) + "\n" for row in rows)


def hold():
    """The shaft is held at one angle after another, a turn forward and a turn back; nothing pulls at it, so the current carries the cogging."""
    steps = [k * 0.002 for k in range(3143)]
    time = 0.0
    for direction, angles in ((1, steps), (-1, steps[::-1])):
        for theta_m in angles:
            current = (direction * COULOMB - cogging(theta_m)) / TORQUE_CONSTANT
            for _ in range(5):
                yield time, counted(theta_m), 0, measured(current), measured(current) * RESISTANCE, 0
                time += 0.003


def free_shaft(current_of, duration):
    """J dω/dt = K i_q + T_cog − friction, by the midpoint rule; a row each millisecond: time, angle, speed, current."""
    theta_m, speed, time, step = 0.0, 0.0, 0.0, 2.5e-4

    def acceleration(theta_m, speed, current):
        friction = COULOMB * math.tanh(speed / 0.3)
        return (TORQUE_CONSTANT * current + cogging(theta_m) - friction) / INERTIA

    for row in range(int(duration * 1000)):
        current = current_of(time, theta_m, speed)
        yield time, theta_m, speed, current
        for _ in range(4):
            half = speed + 0.5 * step * acceleration(theta_m, speed, current)
            speed += step * acceleration(theta_m + 0.5 * step * speed, half, current)
            theta_m += step * half
        time += 1e-3


def acceleration():
    """A sine of 2 Hz and 0.4 A turns the shaft to and fro; the driver's voltage u_q is recorded too."""
    for time, theta_m, speed, current in free_shaft(lambda time, *_: 0.4 * math.sin(4 * math.pi * time), 27.0):
        voltage = RESISTANCE * current + BACK_EMF * speed + random.gauss(0, 0.05)
        yield time, counted(theta_m), speed + random.gauss(0, 0.3), measured(current), voltage


def speed_control():
    """A proportional speed regulator at one turn a second, then the same with the cogging torque fed forward."""
    def regulated(time, theta_m, speed):
        fed_forward = -0.85 * cogging(theta_m) / TORQUE_CONSTANT if time > 15.0 else 0.0
        return max(-1.0, min(1.0, 0.08 * (2 * math.pi - speed) + fed_forward + 0.02))

    for time, theta_m, speed, current in free_shaft(regulated, 30.0):
        yield time, counted(theta_m), speed + random.gauss(0, SPEED_NOISE), 2 * math.pi, measured(current), int(time > 15.0)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    random.seed(4004)
    write(folder, "hold.csv", "time_s,theta_m_rad,speed_rad_per_s,iq_A,uq_V,torque_Nm", hold())
    write(folder, "acceleration.csv", "time_s,theta_m_rad,speed_rad_per_s,iq_A,uq_V", acceleration())
    write(folder, "speed_control.csv", "time_s,theta_m_rad,speed_rad_per_s,speed_ref_rad_per_s,iq_A,compensation", speed_control())


if __name__ == "__main__":
    main()
