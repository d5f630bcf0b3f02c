"""Salient machines in equations of their own, and a sampled current loop: theory.md, sections 2 and 16, with nothing of libhci.

Machines have inductances that are given in d and q as cosines of the angle, so that L(theta) of the phases, its slope and the torque
follow by rotation and differences. theta is electrical, e in V s/rad of the mechanical speed."""
import csv
import os

import numpy as np

TURN = 2 * np.pi
PHASES = TURN * np.arange(3) / 3
PLANE = np.linalg.qr(np.array([[1, -0.5, -0.5], [0, 0.75**0.5, -(0.75**0.5)]]).T)[0]  # star currents as two coordinates


def axes(theta):
    """Phase currents of i_d and i_q: (..., 3, 2)."""
    at = np.asarray(theta)[..., None] - PHASES
    return np.stack([-np.cos(at), np.sin(at)], -1)


def to_dq(theta, phases):
    return 2 / 3 * np.einsum("...ji,...j", axes(theta), phases)


def to_phases(theta, dq):
    return np.einsum("...ij,...j", axes(theta), dq)


class Machine:
    def __init__(self, pole_pairs, emf, cogging, inductance_dq, resistance, of_phases=None):
        """emf, cogging: (order, amplitude, phase). inductance_dq(theta): (..., 2, 2) in H. of_phases(theta, L): changes of phases."""
        self.pole_pairs, self.emf_terms, self.cogging_terms = pole_pairs, emf, cogging
        self.inductance_dq, self.resistance, self.of_phases = inductance_dq, resistance, of_phases

    def emf(self, theta):
        at = np.asarray(theta)[..., None] - PHASES
        return sum(a * np.sin(n * at + g) for n, a, g in self.emf_terms)

    def inductance(self, theta):
        c = axes(theta)
        of = np.einsum("...ij,...jk,...lk->...il", c, self.inductance_dq(np.asarray(theta)), c) * 2 / 3 + 3e-4
        return of if self.of_phases is None else self.of_phases(np.asarray(theta), of)

    def slope(self, theta, step=1e-4):
        return (self.inductance(theta + step) - self.inductance(theta - step)) / (2 * step)

    def torque(self, theta, phases):
        cogging = sum((a * np.sin(n * theta + g) for n, a, g in self.cogging_terms), 0 * theta)
        reluctance = 0.5 * self.pole_pairs * np.einsum("...i,...ij,...j", phases, self.slope(theta), phases)
        return (self.emf(theta) * phases).sum(-1) + reluctance + cogging

    def mean_inductances(self):
        of = np.mean([to_dq(t, (self.inductance(t) @ axes(t)).T).T for t in np.linspace(0, TURN, 361)[:-1]], 0)
        return of[0, 0], of[1, 1]

    def write(self, folder, dc_link_V):
        os.makedirs(folder, exist_ok=True)
        rows = [("pole_pairs", self.pole_pairs, "1"), ("resistance", self.resistance, "ohm"), ("dc_link_voltage", dc_link_V, "V")]
        write_table(f"{folder}/machine.csv", "name,value,unit", rows)
        write_table(f"{folder}/back_emf.csv", "order,amplitude_Nm_per_A,phase_rad", self.emf_terms)
        write_table(f"{folder}/cogging.csv", "order,amplitude_Nm,phase_rad", self.cogging_terms)
        theta = np.linspace(0, TURN, 361)[:-1]
        of = self.inductance(theta)
        values = [theta] + [of[:, a, b] for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))]
        write_table(f"{folder}/inductance.csv", "theta_e_rad,La_H,Lb_H,Lc_H,Mab_H,Mbc_H,Mca_H", np.transpose(values).tolist())


def write_table(path, header, rows):
    with open(path, "w") as f:
        f.write(header + "\n" + "".join(",".join(x if isinstance(x, str) else repr(x) for x in row) + "\n" for row in rows))


def currents_of(folder):
    """i(theta) of a folder of solve."""
    with open(f"{folder}/currents.csv") as f:
        rows = [r for r in csv.DictReader(f)]
    sequence = {"pos": 1, "neg": -1}
    terms = [(float(r["order"]), sequence[r["set"]], float(r["amplitude_A"]), float(r["phase_rad"])) for r in rows]
    return lambda theta: sum(a * np.sin(n * np.asarray(theta)[..., None] - s * PHASES + g) for n, s, a, g in terms)


def loop_ripple(machine, speed_e, reference, sample_s=1e-4, settle_s=0.1, turns=3, sub=10):
    """Mean torque and T_ripple in % behind a PI loop (k_p 0.2 L/T, k_i 0.2 R/T, a delay of one sample, decoupling `constant`) with a
    voltage without end; reference(theta): i_d, i_q at the sample."""
    d, q = machine.mean_inductances()
    proportional, integral = 0.2 * 0.5 * (d + q) / sample_s, 0.2 * machine.resistance / sample_s
    flux = machine.emf_terms[0][1] / machine.pole_pairs
    grid = np.arange(3600) * TURN / 3600
    inverse = np.linalg.inv(PLANE.T @ machine.inductance(grid) @ PLANE)
    slope, emf = PLANE.T @ machine.slope(grid) @ PLANE, machine.emf(grid) @ PLANE / machine.pole_pairs
    theta, i, memory, voltage, step = 0.1, np.zeros(2), np.zeros(2), np.zeros(2), sample_s / sub
    log = []

    def rate(at, i):
        k = int(at / TURN * 3600 + 0.5) % 3600
        return inverse[k] @ (voltage - machine.resistance * i - speed_e * (slope[k] @ i + emf[k]))

    evaluated = settle_s
    for sample in range(int(settle_s / sample_s) + int(turns * TURN / speed_e / sample_s)):
        dq = to_dq(theta, PLANE @ i)
        error = reference(theta) - dq
        asked = proportional * error + memory + speed_e * np.array([-q * dq[1], d * dq[0] + flux])
        memory = memory + integral * sample_s * error
        coming = to_phases(theta + 1.5 * speed_e * sample_s, asked) @ PLANE
        for _ in range(sub):
            if sample * sample_s >= evaluated:
                log.append((theta, *(PLANE @ i)))
            a = rate(theta, i)
            b = rate(theta + 0.5 * speed_e * step, i + 0.5 * step * a)
            c = rate(theta + 0.5 * speed_e * step, i + 0.5 * step * b)
            i = i + step / 6 * (a + 2 * b + 2 * c + rate(theta + speed_e * step, i + step * c))
            theta += speed_e * step
        voltage = coming
    log = np.array(log)
    torque = machine.torque(log[:, 0], log[:, 1:])
    return torque.mean(), 100 * np.ptp(torque) / abs(torque.mean())
