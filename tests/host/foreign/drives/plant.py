"""A machine with surface magnets, from its tables by their formulas, and a drive whose phases b and c may be swapped.

Nothing here is taken from the program: torque = sum of e_s i_s + cogging, e_s = A sin(n (theta - 2 pi s/3) + phase).
"""
import csv
import functools
import math


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Plant:
    def __init__(self, folder):
        values = {row["name"]: row["value"] for row in table(folder + "/machine.csv")}
        self.pole_pairs = int(values["pole_pairs"])
        speed = 2 * math.pi * float(values["emf_frequency"]) / self.pole_pairs
        self.emf = [(int(r["order"]), float(r["amplitude_V"]) / speed, float(r["phase_rad"])) for r in table(folder + "/back_emf.csv")]
        self.cogging = [(float(r["order"]), float(r["amplitude_Nm"]), float(r["phase_rad"])) for r in table(folder + "/cogging.csv")]
        self.torque_constant = 1.5 * self.emf[0][1]

    def emf_at(self, theta):
        return [sum(a * math.sin(n * (theta - 2 * math.pi * s / 3) + g) for n, a, g in self.emf) for s in range(3)]

    def cogging_at(self, theta):
        return sum(a * math.sin(n * theta + g) for n, a, g in self.cogging)

    @functools.lru_cache(maxsize=None)
    def grid(self, angles):
        """(mechanical angle, back-EMF, cogging torque) in equal steps of a mechanical turn."""
        steps = [2 * math.pi * (k + 0.5) / angles for k in range(angles)]
        return [(m, self.emf_at(self.pole_pairs * m), self.cogging_at(self.pole_pairs * m)) for m in steps]


SIN_THIRD = math.sin(2 * math.pi / 3)


def phases(theta, d, q):
    """Phase currents in the frame of docs/theory.md: ia = iq sin(theta) - id cos(theta), ib and ic a third of a turn later each."""
    sine, cosine = math.sin(theta), math.cos(theta)
    a, across = q * sine - d * cosine, q * cosine + d * sine
    return a, -0.5 * a - SIN_THIRD * across, -0.5 * a + SIN_THIRD * across


class Mounted:
    """A drive on a machine: its angle is zero_deg + offset_deg + direction*theta, in turns; with direction -1 its
    phases b and c are those of the machine swapped, so that it turns the other way."""

    def __init__(self, plant, drive, offset_deg=0.0, direction=1):
        self.plant, self.drive, self.offset_deg, self.direction = plant, drive, offset_deg, direction

    def currents(self, theta_m, own_q):
        """Phase currents of the machine; own_q: what the drive asks for besides, in the sense of the machine."""
        theta = self.plant.pole_pairs * theta_m
        angle = theta if self.drive.electrical else theta_m
        turn = (self.drive.zero_deg + self.offset_deg) / 360 + self.direction * angle / (2 * math.pi)
        d, q = self.drive.add(turn - math.floor(turn), self.direction * own_q)
        a, b, c = phases(self.direction * theta, d, self.direction * own_q + q)
        return (a, b, c) if self.direction == 1 else (a, c, b)

    def torques(self, own_q, angles):
        values = []
        for m, emf, cogging in self.plant.grid(angles):
            a, b, c = self.currents(m, own_q)
            values.append(emf[0] * a + emf[1] * b + emf[2] * c + cogging)
        return values

    def ripple(self, torque, angles=40009, constant=None):
        """Peak to peak, where the drive's own current makes what is missing of the mean torque. constant: by which it
        makes a current of a torque."""
        own = torque / (constant or self.plant.torque_constant)
        coarse = self.torques(own, 4999)
        own += (torque - sum(coarse) / len(coarse)) / self.plant.torque_constant
        values = self.torques(own, angles) + self.at_steps(own)
        return max(values) - min(values)

    def at_steps(self, own_q):
        """Torques at both sides of each step, of an electrical table without lines between its values."""
        pairs, zero = self.plant.pole_pairs, (self.drive.zero_deg + self.offset_deg) / 360
        turns = [(k + side) / self.drive.steps for k in range(self.drive.steps) for side in (-1e-7, 1e-7)] if hasattr(self.drive, "steps") else []
        angles = [2 * math.pi * (self.direction * (turn - zero) + j) / pairs for turn in turns for j in range(pairs)]
        return [sum(e * i for e, i in zip(self.plant.emf_at(pairs * m), self.currents(m, own_q))) + self.plant.cogging_at(pairs * m) for m in angles]
