"""OpenFFBoard: twenty times float amplitude, float phase, uint16 order and two bytes of nothing, from 0x08010000 on. The
compensation is the sum of amplitude·sin(order·angle + phase) over the mechanical turn, cut to whole counts, and added to
the torque command, and the sum limited to +-32767; orders whose amplitude is not above 0 are passed over."""
import math
import struct


def image(path):
    """The bytes of an Intel HEX file, from its address on."""
    base, data, ended = 0, {}, False
    with open(path, encoding="ascii") as file:
        for line in file:
            record = bytes.fromhex(line.strip()[1:])
            assert line[0] == ":" and sum(record) % 256 == 0 and len(record) == record[0] + 5 and not ended
            address, kind, content = record[1] << 8 | record[2], record[3], record[4:-1]
            if kind == 4:
                base = int.from_bytes(content, "big") << 16
            elif kind == 0:
                data.update({base + address + k: byte for k, byte in enumerate(content)})
            else:
                ended = kind == 1
    assert ended and sorted(data) == list(range(0x08010000, 0x08010000 + 240))
    return bytes(data[k] for k in sorted(data))


class Drive:
    electrical, zero_deg = False, 0.0
    counts = 436.7
    emit = ["--counts-per-ampere", "436.7"]
    file = "txt"

    def __init__(self, base):
        self.term = [struct.unpack("<ffHH", image(base + ".hex")[12 * k:12 * k + 12]) for k in range(20)]
        with open(base + ".txt", encoding="utf-8") as file:
            answer = [line for line in file if not line.startswith("#")][0].strip().split(",")
        for text, term in zip(answer, self.term):
            order, amplitude, phase = text.split(":")
            pack = struct.unpack("<ff", struct.pack("<ff", float(amplitude), float(phase)))
            assert (pack[0], pack[1], int(order)) == term[:3]
        assert all(term[3] == 0 for term in self.term)

    def add(self, turn, own_q):
        total = sum(a * math.sin(2 * math.pi * turn * n + phase) for a, phase, n, _ in self.term if a > 0)
        own = max(-32767, min(32767, own_q * self.counts))
        return 0.0, max(-32767, min(32767, own + int(total))) / self.counts - own_q

    def step(self):
        return 1 / self.counts
