"""Beckhoff AX8000, object 0x32CB: subindices 07 to 24 hold ten times n, phi (degrees), r (N·m); 02 is a gain. Taken here:
the torque is gain·sum of r·cos(n·angle - phi), angle of the mechanical turn, and the drive divides it by its torque constant."""
import math
import struct


def single(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


class Drive:
    electrical, zero_deg = False, 0.0
    torque_constant = 0.25
    emit = ["--wave", "cosine-lag", "--torque-constant", "0.25"]
    file = "csv"

    def __init__(self, base):
        value = {}
        with open(base + ".csv", encoding="utf-8") as file:
            lines = [line.strip() for line in file if not line.startswith("#")]
        assert lines[0] == "index,subindex,type,value,name"
        for line in lines[1:]:
            index, sub, form, number, _ = line.split(",")
            assert index == "0x32CB" and form == ("INT16" if sub == "0x01" else "UINT32" if int(sub, 16) % 3 == 1 and sub != "0x02" else "REAL32")
            value[int(sub, 16)] = float(number)
        assert sorted(value) == [1, 2] + list(range(7, 0x25)) and value[1] == 3
        self.gain = value[2]
        self.term = [(value[7 + 3 * k], single(value[8 + 3 * k]), single(value[9 + 3 * k])) for k in range(10)]
        assert all(0 <= n <= 200 and n == int(n) and 0 <= phi <= 360 and r >= 0 for n, phi, r in self.term)

    def add(self, turn, own_q):
        torque = self.gain * sum(r * math.cos(2 * math.pi * n * turn - math.radians(phi)) for n, phi, r in self.term)
        return 0.0, torque / self.torque_constant

    def step(self):
        return 1e-5
