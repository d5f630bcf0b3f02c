"""moteus: motor.cogging_dq_comp. From its description: 1024 bytes over the turn of the commutation encoder, node k at
k/1024, linear between nodes, the last goes on to the first, times motor.cogging_dq_scale, added to the q current."""


class Drive:
    electrical, zero_deg = False, 0.0
    emit = []
    file = "cfg"

    def __init__(self, base):
        with open(base + ".cfg", encoding="utf-8") as file:
            pairs = dict(line.split("#")[0].split() for line in file if line.split("#")[0].strip())
        self.scale = float(pairs["motor.cogging_dq_scale"])
        self.comp = [int(pairs["motor.cogging_dq_comp.%d" % k]) for k in range(1024)]
        assert len(pairs) == 1025 and all(-128 <= c <= 127 for c in self.comp)

    def add(self, turn, own_q):
        left = min(int(1024 * turn), 1023)
        share = 1024 * turn - left
        a, b = self.comp[left] * self.scale, self.comp[(left + 1) % 1024] * self.scale
        return 0.0, a + share * (b - a)

    # what the rounding may do to the torque, in A
    def step(self):
        return self.scale
