"""Slips of convention, written into files that were correct: what the mistaken engineer would have written, and where it shows.

A setting says which motor, runs and columns make a slip visible at all, and which other slips look the same on exactly these
files. A slip that the files cannot show is not seeded.
"""

import copy
import math
import os
import random

import bench
import relations
from bench import CURRENTS, CURRENTS_DQ, VOLTAGES
from motor import TURN, draw, wrap

KRPM = 1000 * TURN / 60  # rad/s
KV = 60 / (TURN * math.sqrt(3))  # rpm per volt of the line-to-line peak is KV / k_e


class Case:
    """Files as {path: Table}, and what only the bench knows."""

    def __init__(self, name, rng, wish, kinds, form):
        self.name, self.rng = name, rng
        self.motor = draw(rng, wish)
        self.form = bench.draw_form(rng, form)
        self.files = self.motor.folder()
        sensors = bench.Sensors(rng, self.motor)
        for kind in kinds:
            self.files["runs/%s.csv" % kind] = bench.record(self.motor, sensors, self.form, rng, kind)
        self.separator = ";" if rng.random() < 0.1 else ","
        self.truths = {}  # slip: its Truth

    @property
    def runs(self):
        return [table for path, table in self.files.items() if path.startswith("runs/")]

    def machine(self, name):
        return self.files["machine/%s.csv" % name]

    def write(self, folder):
        for path, table in self.files.items():
            target = os.path.join(folder, path)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            with open(target, "w") as out:
                out.write(table.text(self.separator))


class Truth:
    def __init__(self, files, should_be, alike):
        self.files, self.should_be, self.alike = files, should_be, set(alike)


# The tables of the machine. Each function changes the files and gives the number that should have stood there, if it is one.


def poles_for_pole_pairs(case):
    case.machine("machine").set_value("pole_pairs", 2 * case.motor.pole_pairs)
    return case.motor.pole_pairs


def emf_times(factor):
    """factor: of the motor."""
    def apply(case):
        table = case.machine("back_emf")
        name = list(table.columns)[1]
        before = table[name]
        table[name] = [factor(case.motor) * E for E in before]
        return before[0]
    return apply


def emf_orders_mechanical(case):
    table = case.machine("back_emf")
    table["order"] = [case.motor.pole_pairs * n for n in table["order"]]


def cogging_orders_mechanical(case):
    table = case.machine("cogging")
    table["order"] = [case.motor.pole_pairs * n for n in table["order"]]


def phases_in_degrees(case):
    names = [name for name in ("back_emf", "cogging") if "machine/%s.csv" % name in case.files]
    crooked = [name for name in names if any(abs(math.degrees(x)) > 1.5 * TURN for x in case.machine(name)["phase_rad"])]
    if case.rng.random() < 0.5 and len(crooked) > 1:
        names = [case.rng.choice(crooked)]
    for name in names:
        table = case.machine(name)
        table["phase_rad"] = [math.degrees(x) for x in table["phase_rad"]]


def shift_tables(case, shift):
    """Tables over an angle that is larger than the project's by shift."""
    for name in ("back_emf", "cogging"):
        if "machine/%s.csv" % name in case.files:
            table = case.machine(name)
            table["phase_rad"] = [wrap(g - n * shift) for n, g in zip(table["order"], table["phase_rad"])]
    if "machine/inductance.csv" in case.files:
        table = case.machine("inductance")
        rows = sorted([((row[0] + shift + 1e-9) % TURN - 1e-9,) + row[1:] for row in zip(*table.columns.values())])
        for name, values in zip(list(table.columns), zip(*rows)):
            table[name] = [abs(x) if name == "theta_e_rad" else x for x in values]


def angle_zero_d_axis(case):
    """Magnet flux on the axis of phase a at zero: e_a = -sin."""
    shift_tables(case, math.pi)


def angle_zero_q_axis(case):
    """Back-EMF of phase a at its crest at zero: e_a = cos, or -cos where the magnet is on the -q axis."""
    shift_tables(case, case.rng.choice([-1, 1]) * math.pi / 2)


def emf_sign(case):
    table = case.machine("back_emf")
    name = list(table.columns)[1]
    if case.rng.random() < 0.5:
        table[name] = [-E for E in table[name]]
    else:
        table["phase_rad"] = [wrap(x + math.pi) for x in table["phase_rad"]]


def rated_current_rms(case):
    case.machine("machine").set_value("rated_current", case.motor.rated_current_A / math.sqrt(2))
    return case.motor.rated_current_A


def inductance_per_electrical_radian(case):
    table = case.machine("inductance")
    for name in list(table.columns)[1:]:
        table[name] = [x / case.motor.pole_pairs for x in table[name]]


def resistance_line(case):
    case.machine("machine").set_value("resistance", 2 * case.motor.resistance)
    return case.motor.resistance


# The recordings.


def angle_column(run):
    return next(name for name in run.columns if name.startswith("theta_"))


def change_angle(case, change, turn=TURN):
    """change: of the angle in the unit of its column; wrapped again into turn where it was wrapped."""
    for run in case.runs:
        name = angle_column(run)
        run[name] = [change(x) for x in run[name]]
        if case.form["wrapped"]:
            run[name] = [x % turn for x in run[name]]


def theta_electrical_for_mechanical(case):
    change_angle(case, lambda x: case.motor.pole_pairs * x)


def theta_mechanical_for_electrical(case):
    case.form["wrapped"] = case.rng.random() < 0.5  # the setting asks for runs that count on
    change_angle(case, lambda x: x / case.motor.pole_pairs)


def theta_degrees_for_radians(case):
    change_angle(case, math.degrees, 360.0)


def shift_run_angle(case, shift):
    in_column = shift / (case.motor.pole_pairs if case.form["theta"] == "m" else 1) * (180 / math.pi if case.form["degrees"] else 1)
    change_angle(case, lambda x: x + in_column, 360.0 if case.form["degrees"] else TURN)


def run_angle_zero_d_axis(case):
    shift_run_angle(case, math.pi)


def run_angle_zero_q_axis(case):
    shift_run_angle(case, case.rng.choice([-1, 1]) * math.pi / 2)


def direction_reversed(case):
    """An encoder that counts backward beside a speed that does not."""
    change_angle(case, lambda x: -x, 360.0 if case.form["degrees"] else TURN)


def phases_swapped(case):
    for run in case.runs:
        for names in (VOLTAGES, CURRENTS):
            if names[1] in run:
                run[names[1]], run[names[2]] = run[names[2]], run[names[1]]


def swapped_alone(names):
    """Clamps or probes b and c the other way round."""
    def apply(case):
        for run in case.runs:
            if names[1] in run:
                run[names[1]], run[names[2]] = run[names[2]], run[names[1]]
    return apply


def columns_times(names, factor):
    """factor: of the motor."""
    def apply(case):
        for run in case.runs:
            for name in names:
                if name in run:
                    run[name] = [factor(case.motor) * x for x in run[name]]
    return apply


def voltage_line(case):
    for run in case.runs:
        if VOLTAGES[0] in run:
            a, b, c = (run[name] for name in VOLTAGES)
            run["va_V"], run["vb_V"], run["vc_V"] = ([x - y for x, y in zip(*pair)] for pair in ((a, b), (b, c), (c, a)))


ANY_CURRENT = CURRENTS + CURRENTS_DQ
APPLY = {
    "poles_for_pole_pairs": poles_for_pole_pairs,
    "emf_rms": emf_times(lambda m: 1 / math.sqrt(2)),
    "emf_line": emf_times(lambda m: math.sqrt(3)),
    "emf_line_rms": emf_times(lambda m: math.sqrt(1.5)),
    "emf_volt_per_krpm": emf_times(lambda m: KRPM),
    "emf_volt_per_krpm_line": emf_times(lambda m: KRPM * math.sqrt(3)),
    "emf_volt_per_krpm_line_rms": emf_times(lambda m: KRPM * math.sqrt(1.5)),
    "emf_taken_per_krpm": emf_times(lambda m: 1 / KRPM),
    "emf_taken_per_krpm_line": emf_times(lambda m: 1 / KRPM / math.sqrt(3)),
    "emf_taken_per_krpm_line_rms": emf_times(lambda m: 1 / KRPM / math.sqrt(1.5)),
    "emf_kv": emf_times(lambda m: KV / m.k_e ** 2),
    "emf_volt_per_hz": emf_times(lambda m: TURN / m.pole_pairs),
    "emf_flux_linkage": emf_times(lambda m: 1 / m.pole_pairs),
    "emf_orders_mechanical": emf_orders_mechanical,
    "cogging_orders_mechanical": cogging_orders_mechanical,
    "phases_in_degrees": phases_in_degrees,
    "angle_zero_d_axis": angle_zero_d_axis,
    "angle_zero_q_axis": angle_zero_q_axis,
    "emf_sign": emf_sign,
    "rated_current_rms": rated_current_rms,
    "inductance_per_electrical_radian": inductance_per_electrical_radian,
    "resistance_line": resistance_line,
    "theta_electrical_for_mechanical": theta_electrical_for_mechanical,
    "theta_mechanical_for_electrical": theta_mechanical_for_electrical,
    "theta_degrees_for_radians": theta_degrees_for_radians,
    "run_angle_zero_d_axis": run_angle_zero_d_axis,
    "run_angle_zero_q_axis": run_angle_zero_q_axis,
    "phases_swapped": phases_swapped,
    "currents_swapped": swapped_alone(CURRENTS),
    "voltages_swapped": swapped_alone(VOLTAGES),
    "direction_reversed": direction_reversed,
    "current_sign": columns_times(ANY_CURRENT, lambda m: -1),
    "current_rms": columns_times(ANY_CURRENT, lambda m: 1 / math.sqrt(2)),
    "current_milliampere": columns_times(ANY_CURRENT, lambda m: 1000),
    "current_power_invariant": columns_times(CURRENTS_DQ, lambda m: math.sqrt(1.5)),
    "current_dq_rms": columns_times(CURRENTS_DQ, lambda m: 1 / math.sqrt(2)),
    "voltage_line": voltage_line,
    "voltage_sign": columns_times(VOLTAGES, lambda m: -1),
    "torque_sign": columns_times(["torque_Nm"], lambda m: -1),
    "torque_millinewton": columns_times(["torque_Nm"], lambda m: 1000),
    "speed_electrical": columns_times(["speed_rad_per_s", "speed_rpm"], lambda m: m.pole_pairs),
    "speed_rpm_for_rad_per_s": columns_times(["speed_rad_per_s"], lambda m: 60 / TURN),
    "time_milliseconds": columns_times(["time_s"], lambda m: 1000),
}
MACHINE_FILE = {"poles_for_pole_pairs": "machine.csv", "rated_current_rms": "machine.csv", "resistance_line": "machine.csv",
                "cogging_orders_mechanical": "cogging.csv", "inductance_per_electrical_radian": "inductance.csv"}
MACHINE_SLIPS = list(APPLY)[: list(APPLY).index("theta_electrical_for_mechanical")]

# Settings: (wishes of the motor, runs, wishes of the columns, slips that look the same).

SURFACE = {"saliency": "none", "shows_ratings": True, "shows_dc_link": True}
RADIANS = dict(degrees=False, time=True, speed="speed_rad_per_s")
ABC = dict(RADIANS, theta="m", currents="abc", load_voltages=True)
DQ = dict(RADIANS, theta="m", currents="dq", load_voltages=True)
ABC_NO_V, DQ_NO_V = dict(ABC, load_voltages=False), dict(DQ, load_voltages=False)
MECHANICAL, COUNTING = dict(RADIANS, theta="m"), dict(RADIANS, theta="e", wrapped=False, currents="abc")


def at_least(low):
    return lambda x: x >= low


def wish(**wishes):
    return wishes


def surface(**wishes):
    return dict(SURFACE, **wishes)


def known(**wishes):
    """Without inductances a reluctance torque may be there, and without ratings friction may be anything: torque alone tells no factor."""
    return dict(wishes, shows_inductance=True, shows_ratings=True)


def none_of(*values):
    return lambda x: x not in values


def apart(factor):
    """Whether a factor of the EMF is far from 1; a condition on k_e or on the pole pairs."""
    return lambda x: abs(math.log(factor(x))) > 0.2


MANY = none_of(1, 2, 9, 10)  # pole pairs that no other factor equals
FULL = at_least(0.95)  # rated torque near what the rated current makes
BY_SPEED = dict(emf_in_volts=False)
CROOKED = wish(crookedness=at_least(1.5 * TURN), shows_cogging=True)

SETTINGS = {
    "poles_for_pole_pairs": [(surface(emf_in_volts=True), [], {}, []),
                             (wish(pole_pairs=at_least(2)), ["back"], dict(MECHANICAL), [])],
    "emf_rms": [(surface(rating_ratio=FULL), [], {}, []), (wish(), ["back"], RADIANS, [])],
    "emf_line": [(surface(), [], {}, []), (wish(), ["back"], RADIANS, [])],
    "emf_line_rms": [(wish(), ["back"], RADIANS, []), (surface(), ["back", "load"], ABC, [])],
    "emf_volt_per_krpm": [(wish(**BY_SPEED), ["back"], RADIANS, []), (surface(**BY_SPEED), [], {}, [])],
    "emf_volt_per_krpm_line": [(wish(**BY_SPEED), ["back"], RADIANS, []), (surface(**BY_SPEED), [], {}, [])],
    "emf_volt_per_krpm_line_rms": [(wish(**BY_SPEED), ["back"], RADIANS, []), (surface(**BY_SPEED), [], {}, [])],
    "emf_taken_per_krpm": [(wish(), ["back"], RADIANS, []), (surface(), ["back", "load"], ABC, [])],
    "emf_taken_per_krpm_line": [(wish(), ["back"], RADIANS, []), (surface(), ["back", "load"], ABC, [])],
    "emf_taken_per_krpm_line_rms": [(wish(), ["back"], RADIANS, []), (surface(), ["back", "load"], ABC, [])],
    "emf_kv": [(wish(k_e=apart(lambda k: KV / k ** 2), **BY_SPEED), ["back"], RADIANS, []),
               (surface(k_e=apart(lambda k: 0.5 * KV / k ** 2), kind="drone", **BY_SPEED), [], {}, [])],
    "emf_volt_per_hz": [(wish(pole_pairs=apart(lambda p: TURN / p), **BY_SPEED), ["back"], RADIANS, []),
                        (surface(pole_pairs=lambda p: p <= 3 or p >= 15, **BY_SPEED), [], {}, [])],
    "emf_flux_linkage": [(surface(pole_pairs=at_least(3), **BY_SPEED), [], {}, []),
                         (wish(pole_pairs=at_least(2), **BY_SPEED), ["back"], RADIANS, [])],
    "emf_orders_mechanical": [(wish(pole_pairs=at_least(2)), [], {}, []), (wish(pole_pairs=at_least(2)), ["back"], RADIANS, [])],
    "cogging_orders_mechanical": [(wish(pole_pairs=at_least(3), shows_slots=True, shows_cogging=True, uneven=False), [], {}, []),
                                  (wish(pole_pairs=at_least(2), shows_cogging=True, uneven=False), ["slow"], RADIANS, [])],
    "phases_in_degrees": [(CROOKED, [], {}, []), (CROOKED, ["back"], RADIANS, [])],
    "angle_zero_d_axis": [(wish(), [], {}, ["emf_sign"]), (wish(), ["back"], RADIANS, ["emf_sign"])],
    "angle_zero_q_axis": [(wish(), [], {}, []), (wish(), ["back"], RADIANS, [])],
    "emf_sign": [(wish(), [], {}, ["angle_zero_d_axis"]), (wish(), ["back", "load"], ABC, ["angle_zero_d_axis"])],
    "rated_current_rms": [(surface(rating_ratio=FULL), ["back"], RADIANS, []),
                          (surface(rating_ratio=FULL), ["back", "load"], ABC, [])],
    "inductance_per_electrical_radian": [
        (wish(saliency="high", inductance_form="slope", shows_inductance=True, pole_pairs=at_least(3)), [], {}, []),
        (wish(saliency="interior", inductance_form="slope", shows_inductance=True, pole_pairs=at_least(2)), ["load"], ABC, [])],
    "resistance_line": [(wish(shows_resistance=True), ["crawl"], ABC, []), (wish(shows_resistance=True), ["load", "crawl"], DQ, [])],
    "theta_electrical_for_mechanical": [(wish(pole_pairs=MANY), ["back"], MECHANICAL, []),
                                        (wish(pole_pairs=MANY), ["load", "brake"], ABC_NO_V, [])],
    "theta_mechanical_for_electrical": [(wish(pole_pairs=MANY), ["back"], COUNTING, []),
                                        (wish(pole_pairs=MANY), ["load", "reverse"], COUNTING, [])],
    "theta_degrees_for_radians": [(wish(), ["back"], RADIANS, []), (wish(), ["load"], ABC_NO_V, [])],
    "run_angle_zero_d_axis": [(wish(), ["back", "load"], ABC, []), (wish(), ["back"], RADIANS, ["voltage_sign"])],
    "run_angle_zero_q_axis": [(wish(), ["back"], RADIANS, []), (wish(saliency="none"), ["load", "brake"], ABC_NO_V, [])],
    "phases_swapped": [(wish(), ["back"], RADIANS, ["direction_reversed"]),
                       (wish(), ["load", "brake"], ABC, ["direction_reversed"])],
    "currents_swapped": [(wish(), ["load", "back"], ABC, []), (wish(), ["load", "back", "brake"], ABC, [])],
    "voltages_swapped": [(wish(), ["load", "back"], ABC, []), (wish(), ["load", "back", "brake"], ABC, [])],
    "direction_reversed": [(wish(), ["back"], RADIANS, []), (wish(), ["load", "back"], ABC, [])],
    "current_sign": [(wish(), ["load", "back"], ABC, ["torque_sign"]), (wish(), ["load"], DQ_NO_V, ["torque_sign"])],
    "current_rms": [(known(), ["back", "load", "brake"], ABC_NO_V, []), (surface(), ["load", "brake"], ABC, [])],
    "current_milliampere": [(wish(), ["load"], ABC, []), (wish(shows_cogging=True), ["load", "slow"], DQ_NO_V, [])],
    "current_power_invariant": [(known(), ["back", "load", "brake"], DQ_NO_V, []), (surface(), ["load", "brake"], DQ, [])],
    "current_dq_rms": [(known(), ["back", "load", "brake"], DQ_NO_V, ["current_rms"]), (surface(), ["load", "brake"], DQ, ["current_rms"])],
    "voltage_line": [(wish(), ["back"], RADIANS, []), (wish(), ["back", "load"], ABC, [])],
    "voltage_sign": [(wish(), ["back"], RADIANS, ["run_angle_zero_d_axis"]), (wish(), ["load", "back"], ABC, [])],
    "torque_sign": [(wish(), ["load", "back"], ABC, ["current_sign"]),
                    (wish(), ["load", "slow"], ABC_NO_V, ["current_sign", "run_angle_zero_d_axis"])],
    "torque_millinewton": [(wish(), ["load"], ABC, []), (wish(shows_cogging=True), ["load", "slow"], DQ_NO_V, [])],
    "speed_electrical": [(wish(pole_pairs=MANY), ["back"], RADIANS, []), (wish(pole_pairs=MANY), ["load", "brake"], ABC, [])],
    "speed_rpm_for_rad_per_s": [(wish(pole_pairs=MANY), ["back"], RADIANS, []), (wish(pole_pairs=MANY), ["load", "reverse"], ABC, [])],
    "time_milliseconds": [(wish(), ["back"], RADIANS, []), (wish(), ["load", "brake"], ABC, [])],
}

ALL = ["back", "load", "brake", "slow"]
SIGNS = {"current_sign": ["torque_sign"], "torque_sign": ["current_sign"]}
# Two at a time, on runs and columns that would show each of them alone.
PAIRS = [
    (("poles_for_pole_pairs", "emf_rms"), wish(pole_pairs=at_least(2)), ABC),
    (("poles_for_pole_pairs", "phases_swapped"), wish(pole_pairs=at_least(2)), ABC),
    (("emf_line", "current_sign"), wish(), ABC),
    (("emf_volt_per_krpm_line_rms", "torque_millinewton"), wish(**BY_SPEED), ABC),
    (("emf_kv", "theta_degrees_for_radians"), wish(k_e=apart(lambda k: KV / k ** 2), **BY_SPEED), ABC),
    (("emf_flux_linkage", "speed_rpm_for_rad_per_s"), wish(pole_pairs=MANY, **BY_SPEED), ABC),
    (("angle_zero_q_axis", "cogging_orders_mechanical"), wish(pole_pairs=MANY, shows_cogging=True, uneven=False), ABC),
    (("emf_orders_mechanical", "phases_in_degrees"), dict(CROOKED, pole_pairs=at_least(2)), ABC),
    (("rated_current_rms", "emf_line_rms"), surface(rating_ratio=FULL), ABC),
    (("resistance_line", "rated_current_rms"), surface(rating_ratio=FULL, shows_resistance=True), ABC),
    (("theta_electrical_for_mechanical", "current_sign"), wish(pole_pairs=MANY), ABC),
    (("theta_mechanical_for_electrical", "torque_sign"), wish(pole_pairs=MANY), dict(ABC, theta="e", wrapped=False)),
    (("run_angle_zero_q_axis", "voltage_line"), wish(), ABC),
    (("run_angle_zero_d_axis", "time_milliseconds"), wish(), ABC),
    (("current_power_invariant", "speed_electrical"), wish(pole_pairs=MANY), DQ),
    (("current_dq_rms", "emf_volt_per_hz"), wish(pole_pairs=apart(lambda p: TURN / p), **BY_SPEED), DQ),
    (("voltage_sign", "torque_millinewton"), wish(), ABC),
    (("angle_zero_d_axis", "run_angle_zero_d_axis"), wish(), ABC),
    (("angle_zero_q_axis", "run_angle_zero_q_axis"), wish(), ABC),
    (("phases_in_degrees", "emf_rms"), CROOKED, ABC),
    (("inductance_per_electrical_radian", "emf_line"),
     wish(saliency="high", inductance_form="slope", shows_inductance=True, pole_pairs=at_least(3)), ABC),
    (("phases_swapped", "current_rms"), wish(), ABC),
    (("cogging_orders_mechanical", "torque_sign"), wish(pole_pairs=MANY, shows_cogging=True, uneven=False), ABC),
    (("emf_volt_per_krpm", "current_dq_rms"), wish(**BY_SPEED), DQ),
]
PAIR_ALIKE = dict(SIGNS, phases_swapped=["direction_reversed"], angle_zero_d_axis=["emf_sign"], current_dq_rms=["current_rms"])


def emf_readings(case):
    """What k_e would be under each slip that scales it, from what is written now."""
    table, motor = case.machine("back_emf"), case.motor
    written = abs(list(table.columns.values())[1][0])
    per_speed = "amplitude_Nm_per_A" in table
    k = written if per_speed else written * case.machine("machine").value("pole_pairs") / (TURN * motor.emf_frequency_Hz)
    readings = {"emf_rms": k * math.sqrt(2), "emf_line": k / math.sqrt(3), "emf_line_rms": k / math.sqrt(1.5)}
    if per_speed:
        readings.update(emf_volt_per_krpm=k / KRPM, emf_volt_per_krpm_line=k / KRPM / math.sqrt(3), emf_kv=KV / k,
                        emf_volt_per_krpm_line_rms=k / KRPM / math.sqrt(1.5), emf_volt_per_hz=k * motor.pole_pairs / TURN,
                        emf_flux_linkage=k * motor.pole_pairs, emf_taken_per_krpm=k * KRPM, emf_taken_per_krpm_line=k * KRPM * math.sqrt(3),
                        emf_taken_per_krpm_line_rms=k * KRPM * math.sqrt(1.5))
    elif not case.runs:
        readings["poles_for_pole_pairs"] = k / 2
    return readings


def rivals(case, truth):
    """Slips of the EMF's size that fit as well as the truth: a bench tells k_e to 10 %, the ratings to what ratings are honest."""
    k_e, measured = case.motor.k_e, any(path.startswith(("runs/back", "runs/load")) for path in case.files)
    readings = emf_readings(case)
    if measured:
        return {name for name, k in readings.items() if abs(math.log(k / k_e)) < 0.1} - {truth}

    def honest(k, current):
        return 0.78 < case.motor.rating_ratio * k_e / k * current < 1.25 and 1.0 < case.motor.dc_link_ratio * k_e / k < 3.0
    found = {name for name, k in readings.items() if honest(k, 1.0)}
    if truth == "emf_rms":
        found.add("rated_current_rms")  # the ratings' product of both is what is seen
    return found - {truth}


def seed_slip(case, name, alike):
    if name in ("phases_in_degrees",):
        files = ["back_emf.csv", "cogging.csv"]
    elif name in MACHINE_SLIPS:
        files = [MACHINE_FILE.get(name, "back_emf.csv")] + (["cogging.csv", "inductance.csv"] if name.startswith("angle_zero") else [])
    else:
        files = [os.path.basename(path) for path in case.files if path.startswith("runs/")]
    case.truths[name] = Truth(files, APPLY[name](case), alike)


def seeded_case(name, seed, wishes, kinds, form, alike):
    """alike: {slip: those that look the same}. Draws again until each slip alone would show."""
    for attempt in range(50):
        case = Case("%s.%d" % (name, seed), random.Random("%s %d %d" % (name, seed, attempt)), wishes, kinds, form)
        if all(shows(case, slip) for slip in alike):
            break
    case.before = copy.deepcopy(case.files)
    for slip in alike:
        seed_slip(case, slip, alike[slip])
    add_rivals(case)
    return case


def shows(case, slip):
    alone = copy.deepcopy(case)
    APPLY[slip](alone)
    return bool(relations.off(alone.files))


def single(name, setting, seed):
    wishes, kinds, form, alike = SETTINGS[name][setting]
    return seeded_case(name + "." + "AB"[setting], seed, wishes, kinds, form, {name: alike})


def pair(index, seed):
    names, wishes, form = PAIRS[index]
    return seeded_case("+".join(names), seed, wishes, ALL + ["crawl"], form, {name: PAIR_ALIKE.get(name, []) for name in names})


def add_rivals(case):
    for name, truth in case.truths.items():
        if name in emf_readings(case):
            truth.alike |= rivals(case, name) - set(case.truths)


CORRECT_RUNS = [[], [], [], [], ["back"], ["back", "back_reverse"], ["load"], ["load", "brake"], ["back", "load"], ["slow"],
                ["load", "slow", "reverse"], ["back", "load", "brake", "crawl", "slow"]]


def correct(seed):
    rng = random.Random("correct %d" % seed)
    return Case("correct.%d" % seed, rng, {}, rng.choice(CORRECT_RUNS), {"scope": rng.random() < 0.08})


def seeded(seed):
    """All cases of a seed: each slip in both settings, then the pairs; as (function, arguments)."""
    return [(single, (name, k, seed)) for name in SETTINGS for k in (0, 1)] + [(pair, (k, seed)) for k in range(len(PAIRS))]
