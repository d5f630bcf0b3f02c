"""SimpleFOC: electrical_angle in rad, 0 to 2 pi, is 0 with the magnet on the axis of phase a. loopFOC asks for current_sp +
feed_forward_current.q in q and feed_forward_current.d in d. The emitted table is linear between its rows."""
import math
import os

import source

MAIN = r"""
#include <cmath>
#include <cstdio>
struct DQ { float d, q; };
struct Motor { float electrical_angle, current_sp, current_limit, shaft_velocity; int pole_pairs; DQ feed_forward_current; };
#include "HEADER"
int main()
{
    for (int k = -5; k <= 2005; ++k) {
        Motor motor = {6.28318531f * k / 2000, 0.37f * (k % 7), k % 3 ? 10.0f : 1.0f, 0.0f, 2, {0, 0}};
        NAME_feed(motor);
        std::printf("%.9g %.9g %.9g %.9g\n", motor.electrical_angle, std::fmax(-motor.current_limit, std::fmin(motor.current_sp, motor.current_limit)), motor.feed_forward_current.d, motor.feed_forward_current.q);
    }
    Motor late = {1.0f, 2.0f, 10.0f, 50.0f, 2, {0, 0}}, ahead = {1.0f + 0.01f, 2.0f, 10.0f, 0.0f, 2, {0, 0}};
    NAME_feed(late, 0.0001f);
    NAME_feed(ahead);
    std::printf("%.9g %.9g %.9g %.9g\n", ahead.electrical_angle, 2.0f, late.feed_forward_current.d, late.feed_forward_current.q);
}
"""


class Drive:
    electrical, zero_deg = True, 180.0
    emit = ["--points", "512"]
    emit_loaded = ["--per-torque"]
    file = "h"

    def __init__(self, base):
        self.base = base
        self.row = source.rows(base + ".h")
        assert len(self.row) == 512
        if len(self.row[0]) == 2:
            self.row = [row + [0.0, 0.0] for row in self.row]

    def add(self, turn, own_q):
        left = min(int(512 * turn), 511)
        share = 512 * turn - left
        d, q, dd, qq = [a + share * (b - a) for a, b in zip(self.row[left], self.row[(left + 1) % 512])]
        return d + own_q * dd, q + own_q * qq

    def compiled(self):
        """The largest difference of the compiled function, in A; None: no compiler."""
        name = os.path.basename(self.base)
        found = source.run("c++", os.path.dirname(self.base), {}, (name + ".cpp", MAIN.replace("HEADER", name + ".h").replace("NAME", name)))
        if found is None:
            return None
        worst = 0.0
        for angle, own, d, q in found:
            turn = angle / (2 * math.pi)
            there = self.add(turn - math.floor(turn), own)
            worst = max(worst, abs(d - there[0]), abs(q - there[1]))
        return worst / 2e-3  # single precision over 512 rows of some amperes

    def step(self):
        return 1e-3
