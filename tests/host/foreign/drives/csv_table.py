"""csv: rows in equal steps of the encoder's turn, linear between them; (constant) + (per A)·(own i_q)."""
import math


class Drive:
    electrical, zero_deg = False, 0.0
    emit = ["--points", "512"]
    emit_loaded = ["--per-torque"]
    file = "csv"

    def __init__(self, base):
        with open(base + ".csv", encoding="utf-8") as file:
            lines = [line.strip() for line in file if not line.startswith("#")]
        assert lines[0] == "theta_m_rad,id_A,iq_A,torque_Nm,id_A_per_A,iq_A_per_A"
        self.row = [[float(cell) for cell in line.split(",")] for line in lines[1:]]
        for k, row in enumerate(self.row):
            assert abs(row[0] - 2 * math.pi * k / len(self.row)) < 1e-12 and row[3] == 0
        assert len(self.row) == 512

    def add(self, turn, own_q):
        n = len(self.row)
        left = min(int(n * turn), n - 1)
        share = n * turn - left
        d, q, _, dd, qq = [a + share * (b - a) for a, b in zip(self.row[left][1:], self.row[(left + 1) % n][1:])]
        return d + own_q * dd, q + own_q * qq

    def step(self):
        return 1e-3
