"""ST MCSDK: s16 angle, 65536 to the electrical turn. MCM_Clarke: alpha = a, beta = -(2b + a)/sqrt 3; MCM_Park: q = alpha cos - beta
sin, d = alpha sin + beta cos. Currents are digits, int16. The emitted table is linear between its rows, in whole numbers that are cut
towards 0."""
import math
import os

import source

TYPES = "#include <stdint.h>\ntypedef struct { int16_t q; int16_t d; } qd_t;\n"
MAIN = r"""
#include <stdio.h>
#include "HEADER"
int main(void)
{
    for (int k = -32768; k < 32768; k += 31) {
        const qd_t own = {(int16_t)(k % 6000), 0}, there = NAME_feed(own, (int16_t)k);
        printf("%d %d %d %d\n", k, own.q, there.d, there.q);
    }
    return 0;
}
"""


def cut(a, b):
    """a/b towards 0."""
    return abs(a) // b * (1 if a >= 0 else -1)


def frame_offset_deg():
    """The drive's angle where that of the machine is 0, from its transforms: the angle at which the currents of i_q alone,
    ia = sin(theta), ib = sin(theta - 120°), come out as q = 1 and d = 0."""
    theta = 0.3
    a, b = math.sin(theta), math.sin(theta - 2 * math.pi / 3)
    alpha, beta = a, -(2 * b + a) / math.sqrt(3)
    found = [k for k in range(360) if abs(alpha * math.cos(x(theta, k)) - beta * math.sin(x(theta, k)) - 1) < 1e-9
             and abs(alpha * math.sin(x(theta, k)) + beta * math.cos(x(theta, k))) < 1e-9]
    assert len(found) == 1
    return float(found[0])


def x(theta, k):
    return theta + math.radians(k)


class Drive:
    electrical, zero_deg = True, frame_offset_deg()
    counts = 611.0
    emit = ["--counts-per-ampere", "611"]
    emit_loaded = ["--per-torque"]
    file = "h"

    def __init__(self, base):
        self.base = base
        self.row = [[int(cell) for cell in row] for row in source.rows(base + ".h")]
        if len(self.row[0]) == 2:
            self.row = [row + [0, 0] for row in self.row]
        assert len(self.row) == 256

    def digits(self, angle, own):
        left, share = divmod(angle % 65536, 256)
        d, q, dd, qq = [a + cut((b - a) * share, 256) for a, b in zip(self.row[left], self.row[(left + 1) % 256])]
        return d + cut(own * dd, 8192), own + q + cut(own * qq, 8192)

    def add(self, turn, own_q):
        own = math.floor(own_q * self.counts + 0.5)
        d, q = self.digits(int(turn * 65536), own)
        return d / self.counts, q / self.counts - own_q

    def compiled(self):
        name = os.path.basename(self.base)
        found = source.run("cc", os.path.dirname(self.base), {"mc_type.h": TYPES}, (name + ".c", MAIN.replace("HEADER", name + ".h").replace("NAME", name)))
        if found is None:
            return None
        return max(max(abs(a - b) for a, b in zip((d, q), self.digits(int(k), int(own)))) * 1e9 for k, own, d, q in found)

    def step(self):
        return 3 / self.counts
