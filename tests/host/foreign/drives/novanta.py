"""Novanta: a table over the electrical angle in A; the index is a part of the turn, 0 to 511 (range of the index register),
values are floats (type of the value register). Nothing between the values. Angle zero taken: magnet on the axis of phase a."""
import struct


class Drive:
    electrical, zero_deg = True, 180.0
    emit = []
    file = "csv"
    steps = 512

    def __init__(self, base):
        with open(base + ".csv", encoding="utf-8") as file:
            lines = [line.strip() for line in file if not line.startswith("#")]
        assert lines[0] == "COGGING_COMP_TABLE_INDEX,COGGING_COMP_TABLE_VALUE"
        rows = [line.split(",") for line in lines[1:]]
        assert [int(row[0]) for row in rows] == list(range(512))
        self.value = [struct.unpack("<f", struct.pack("<f", float(row[1])))[0] for row in rows]

    def add(self, turn, own_q):
        return 0.0, self.value[min(int(512 * turn), 511)]

    def step(self):
        return 0.15  # between two values there are steps: harmonics reads the middles
