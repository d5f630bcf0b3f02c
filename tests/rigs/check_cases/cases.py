"""The cases: each makes a folder and recordings of one machine, and says what is wrong with them: nothing, or a slip.

A case is a function of a random generator; it returns (files, truth, alike): truth is None for a correct machine or the name
of the slip, alike those that leave the same trace in these files.
"""

import math

import bench
from bench import TURN, Columns, Machine

CASES = {}


def case(function):
    CASES[function.__name__] = function
    return function


def with_runs(m, columns, runs, **shows):
    """runs: {name: (samples, columns)}."""
    files = m.folder(**shows)
    for name, (samples, names) in runs.items():
        files["runs/%s.csv" % name] = columns.write(samples, names)
    return files


def correct(files):
    return files, None, ()


def value(files, name, factor):
    table = files["machine/machine.csv"]
    k = table["name"].index(name)
    table["value"][k] = factor * table["value"][k]


def column(files, names, factor):
    for path, table in files.items():
        for name in names.split():
            if path.startswith("runs/") and name in table:
                table[name] = [factor * x for x in table[name]]


def rename(files, old, new):
    for path in list(files):
        if old in files[path]:
            files[path] = {new if name == old else name: x for name, x in files[path].items()}


def emf(files, factor):
    table = files["machine/back_emf.csv"]
    table["amplitude_Nm_per_A"] = [factor * x for x in table["amplitude_Nm_per_A"]]


def ripple(rng, samples, m, share=0.03):
    """A current that is not still: i_q as a loop lets it swing. The torque follows it."""
    for x in samples:
        extra = rng.gauss(0, share * m.I)
        x["torque"] += m.mean_torque(x["d"], x["q"] + extra) - m.mean_torque(x["d"], x["q"])
        x["q"] += extra
    return samples


# ---- kinds of recordings

DYNO = "time_s theta_m_rad speed_rad_per_s abc vabc torque_Nm"
DYNO_QUIET = "time_s theta_m_rad speed_rad_per_s abc torque_Nm"
LOG = "time_s theta_e_rad_wrapped speed_e_rad_per_s id_A iq_A vd_V vq_V"
LOG_BLIND = "time_s speed_e_rad_per_s id_A iq_A vd_V vq_V"
BACK = "time_s theta_m_rad speed_rad_per_s vabc torque_Nm"


def dyno(m, share=0.8, speed=0.5, names=DYNO):
    d, q = m.best(share * m.I)
    return {"load": (bench.steady(m, speed * m.speed, d, q), names)}


def back(m, speed=0.5, names=BACK):
    return {"back": (bench.steady(m, speed * m.speed, 0, 0), names)}


def log(rng, m, names=LOG, low=0.15, high=0.9, d_share=0.0):
    points = [(rng.uniform(low, high) * m.speed, d_share * -rng.uniform(0.2, 1) * m.I, rng.uniform(0.3, 1.0) * m.I) for _ in range(10)]
    return {"log": (ripple(rng, bench.plateaus(m, points), m), names)}


def map_points(m, signs=(1,)):
    samples = []
    for sign in signs:
        for k in range(6):
            for j in range(1, 6):
                d, q = -m.I * k / 5, sign * m.I * j / 5
                x = m.at(0.0, 0.0, 0.4 * m.speed, d, q)
                x["torque"] = m.mean_torque(d, q) - m.drag(0.4 * m.speed)
                samples.append(x)
    return samples


def holding(rng, m, turns=1.0, names="theta_m_rad iq_A held_Nm"):
    return {"hold": (bench.slow(m, rng, turns=turns), names)}


# ---- correct machines, some of them odd

@case
def plain_dyno(rng):
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), {**dyno(m), **back(m)}))


@case
def plain_log(rng):
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), log(rng, m)))


@case
def salient_emf_only_map(rng):
    """Interior magnets, of which only the back-EMF is declared; table over i_d, i_q without angle, speed or time."""
    m = Machine(rng, kind="ipm")
    return correct(with_runs(m, Columns(rng, m), {"map": (map_points(m), "id_A iq_A torque_Nm")}, inductances=False, ratings=False))


@case
def salient_emf_only_point(rng):
    """One operating point at the best angle, dq."""
    m = Machine(rng, kind="ipm")
    return correct(with_runs(m, Columns(rng, m), dyno(m, 1.0, names="time_s theta_m_rad speed_rad_per_s id_A iq_A torque_Nm"), inductances=False, ratings=False))


@case
def salient_emf_only_dyno(rng):
    m = Machine(rng, kind="ipm")
    return correct(with_runs(m, Columns(rng, m), {**dyno(m, 0.9), **back(m)}, inductances=False, ratings=False))


@case
def salient_emf_only_log(rng):
    m = Machine(rng, kind="ipm")
    return correct(with_runs(m, Columns(rng, m), log(rng, m, LOG + " torque_Nm", d_share=0.7), inductances=False, ratings=False))


@case
def salient_ratings(rng):
    """The rated torque holds the reluctance torque; no inductances."""
    m = Machine(rng, kind="ipm")
    m.torque = m.mean_torque(*m.best(m.I))
    return correct(m.folder(inductances=False))


@case
def reluctance_assisted(rng):
    """Ferrite in a reluctance rotor: three quarters of the torque are reluctance."""
    m = Machine(rng, kind="ipm", saliency=4.0)
    m.k_e *= 0.35
    return correct(with_runs(m, Columns(rng, m), dyno(m, 1.0, names="time_s theta_m_rad speed_rad_per_s id_A iq_A torque_Nm"), inductances=False, ratings=False))


@case
def salient_known(rng):
    m = Machine(rng, kind="ipm", saturates_at=1.4)
    return correct(with_runs(m, Columns(rng, m), {**dyno(m, 0.9), **back(m)}))


@case
def overload(rng):
    """2.5 times the rated current: the iron yields."""
    m = Machine(rng, kind="servo", saturates_at=2.0)
    return correct(with_runs(m, Columns(rng, m), dyno(m, 2.5, 0.3, names=rng.choice([DYNO, DYNO_QUIET]))))


@case
def hot_ferrite(rng):
    """80 to 110 K above the table: ferrite loses 0.2 % for each."""
    m = Machine(rng, magnets=rng.uniform(0.78, 0.84), copper=1.4)
    return correct(with_runs(m, Columns(rng, m), {**dyno(m), **back(m)}))


@case
def hot_ferrite_torque_only(rng):
    m = Machine(rng, magnets=rng.uniform(0.78, 0.84), copper=1.4)
    return correct(with_runs(m, Columns(rng, m), dyno(m, names=DYNO_QUIET), ratings=False))


@case
def cold_magnets(rng):
    m = Machine(rng, magnets=rng.uniform(1.07, 1.12), copper=0.85)
    return correct(with_runs(m, Columns(rng, m), {**dyno(m), **back(m)}))


@case
def long_leads(rng):
    """As much again in leads and switches as in the copper; the drive's log at low speed."""
    m = Machine(rng, kind="drone", copper=rng.uniform(1.7, 2.1))
    return correct(with_runs(m, Columns(rng, m), log(rng, m, low=0.03, high=0.1)))


@case
def stiff_gearbox(rng):
    """Torque behind a friction of half of what the current makes."""
    m = Machine(rng, coulomb=rng.uniform(0.25, 0.35))
    return correct(with_runs(m, Columns(rng, m), dyno(m, rng.uniform(0.5, 0.7), names=DYNO_QUIET)))


@case
def light_load(rng):
    """A twentieth of the rated torque at full speed: friction and iron take a good part."""
    m = Machine(rng, coulomb=0.03, iron=0.02)
    return correct(with_runs(m, Columns(rng, m), dyno(m, 0.12, 0.9)))


@case
def no_load_current(rng):
    """Nothing at the shaft: the sensor reads its zero."""
    m = Machine(rng, coulomb=0.06, iron=0.03)
    q = (m.coulomb + m.iron + m.viscous * m.speed) / (1.5 * m.k_e)
    columns = Columns(rng, m)
    columns.torque_zero = rng.uniform(-0.01, 0.01) * m.torque
    return correct(with_runs(m, columns, {"idle": (bench.steady(m, 0.9 * m.speed, 0, q), DYNO)}))


@case
def iron_at_speed(rng):
    m = Machine(rng, kind="drone", iron=0.12, viscous=0.08)
    return correct(with_runs(m, Columns(rng, m), dyno(m, 0.7, 0.95)))


@case
def drag_there_and_back(rng):
    m = Machine(rng, coulomb=0.04)
    return correct(with_runs(m, Columns(rng, m), {"drag": (bench.there_and_back(m, 0.3 * m.speed, 0, 0), BACK)}))


@case
def load_there_and_back(rng):
    m = Machine(rng)
    d, q = m.best(0.7 * m.I)
    return correct(with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.3 * m.speed, d, q), rng.choice([DYNO, DYNO.replace("speed_rad_per_s ", "")]))}))


@case
def hoist(rng):
    """Up and down with the same weight: speed and power change their sign, torque and current do not."""
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.2 * m.speed, 0, 0.7 * m.I, reverse=-1.0), DYNO)}))


@case
def log_there_and_back(rng):
    m = Machine(rng)
    points = [(sign * rng.uniform(0.2, 0.8) * m.speed, 0, sign * rng.uniform(0.3, 1) * m.I) for sign in (1, -1, 1, -1, 1, -1)]
    return correct(with_runs(m, Columns(rng, m), {"log": (ripple(rng, bench.plateaus(m, points), m), LOG + " torque_Nm")}))


@case
def free_shaft(rng):
    """2 Hz current on a free shaft; no torque sensor."""
    m = Machine(rng, kind="gimbal", cogging=0.02)
    swing = lambda t, w: 0.6 * m.I * math.sin(4 * math.pi * t)
    samples = bench.free_shaft(m, m.torque / (m.speed * 8), swing, 2.0, 0.001)
    return correct(with_runs(m, Columns(rng, m), {"free": (samples, "time_s theta_m_rad speed_rad_per_s iq_A")}))


@case
def propeller(rng):
    """Current against the speed squared; no torque sensor, no angle."""
    m = Machine(rng, kind="drone")
    points = [(k / 10 * m.speed, 0, 0.9 * m.I * (k / 10) ** 2) for k in range(2, 11)]
    return correct(with_runs(m, Columns(rng, m), {"prop": (ripple(rng, bench.plateaus(m, points), m), rng.choice(["time_s speed_rpm iq_A", "time_s speed_rpm id_A iq_A vd_V vq_V"]))}))


def computed(rng, m, names):
    """The torque that the drive computes of its current, with a constant of its own."""
    constant = 1.5 * m.k_e * rng.choice([0.6, 0.67, 0.707, 0.816, 1.225, 1.414])
    points = [(rng.uniform(0.2, 0.9) * m.speed, 0, rng.uniform(-0.3, 1.0) * m.I) for _ in range(8)]
    files = with_runs(m, Columns(rng, m), {"log": (ripple(rng, bench.plateaus(m, points), m), names)}, ratings=False)
    table = files["runs/log.csv"]
    table["torque_Nm"] = [constant * x for x in table["iq_A"]]
    return correct(files)


@case
def computed_torque(rng):
    m = Machine(rng)
    return computed(rng, m, "time_s theta_m_rad speed_rad_per_s iq_A")


@case
def computed_torque_log(rng):
    m = Machine(rng)
    return computed(rng, m, LOG)


@case
def no_angle_log(rng):
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), log(rng, m, rng.choice([LOG_BLIND, LOG_BLIND + " torque_Nm"]))))


@case
def points_without_time(rng):
    """Operating points of a dynamometer: speed, current, torque; neither time nor angle."""
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), {"points": (map_points(m, (1, -1))[::3], "speed_rpm id_A iq_A torque_Nm")}))


@case
def temperatures(rng):
    """A log of nothing that could be compared."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"log": (bench.steady(m, m.speed, 0, 0), "time_s speed_rpm")})
    files["runs/log.csv"]["temperature_C"] = [20 + 0.01 * k for k in range(len(files["runs/log.csv"]["time_s"]))]
    return correct(files)


@case
def alias(rng):
    """A slow logger: the electrical angle has gone round once or more between two lines."""
    m = Machine(rng, kind="drone")
    h = rng.uniform(0.6, 3.3) * TURN / (m.p * 0.6 * m.speed)
    points = [(rng.uniform(0.5, 0.9) * m.speed, 0, rng.uniform(0.3, 0.9) * m.I) for _ in range(8)]
    return correct(with_runs(m, Columns(rng, m), {"log": (bench.plateaus(m, points, each=60, step_s=h), LOG)}))


@case
def holding_map(rng):
    """Slots and poles uneven; friction; no cogging table."""
    m = Machine(rng, kind="gimbal", uneven=rng.uniform(0.2, 1.0), coulomb=rng.uniform(0.01, 0.05))
    return correct(with_runs(m, Columns(rng, m), holding(rng, m), cogging=False, ratings=False, slots=rng.random() < 0.5))


@case
def holding_map_clean(rng):
    m = Machine(rng, kind="gimbal", layout=(12, 7))
    return correct(with_runs(m, Columns(rng, m), holding(rng, m), ratings=False))


@case
def slow_there_and_back(rng):
    """6 rpm under speed control: no torque column."""
    m = Machine(rng, kind="gimbal", uneven=0.3, coulomb=0.04)
    names = rng.choice(["time_s theta_m_rad speed_rad_per_s iq_A", "time_s theta_m_rad speed_rad_per_s iq_A held_Nm"])
    return correct(with_runs(m, Columns(rng, m), holding(rng, m, 2.0, names)))


@case
def uneven_cogging(rng):
    """The table holds what uneven magnets and teeth make: no multiples of six, mostly."""
    m = Machine(rng, kind="gimbal", uneven=2.0)
    return correct(with_runs(m, Columns(rng, m), holding(rng, m)))


@case
def softened_ripple(rng):
    """Ripple without current at speed through a shaft that is soft: a third of it, late."""
    m = Machine(rng, kind="servo")
    saved, m.cogging = m.cogging, [(n, a * 0.35, g - 1.6) for n, a, g in m.cogging]
    runs = {"drag": (bench.steady(m, 0.5 * m.speed, 0, 0, per_period=4 * m.cogging[-1][0] // m.p + 40), BACK)}
    files = with_runs(m, Columns(rng, m), runs)
    m.cogging = saved
    files["machine/cogging.csv"] = m.folder()["machine/cogging.csv"]
    return correct(files)


@case
def two_clamps(rng):
    """ia and ib by clamps, one of them 10 to 20 % off; ic is their negative sum."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), dyno(m))
    table, gain = files["runs/load.csv"], rng.choice([0.8, 0.85, 1.12, 1.2])
    table["ib_A"] = [gain * x for x in table["ib_A"]]
    table["ic_A"] = [-a - b for a, b in zip(table["ia_A"], table["ib_A"])]
    if rng.random() < 0.4:
        del table["ic_A"]
    return correct(files)


@case
def third_harmonic(rng):
    """Order 3 of a fifth, and a neutral point that is measured against."""
    m = Machine(rng, third=0.2)
    return correct(with_runs(m, Columns(rng, m), {**dyno(m), **back(m)}))


@case
def weak_phase(rng):
    m = Machine(rng, phase_gain=[1.0, 0.85, 1.0])
    return correct(with_runs(m, Columns(rng, m), {**dyno(m), **back(m)}))


@case
def dead_time(rng):
    """v_d, v_q as they were asked for: at low speed most of it is dead time, along the current."""
    m = Machine(rng, kind="servo")
    files = with_runs(m, Columns(rng, m), log(rng, m, low=0.02, high=0.08))
    table, extra = files["runs/log.csv"], rng.uniform(0.5, 1.0) * m.R * m.I
    for k, (d, q) in enumerate(zip(table["id_A"], table["iq_A"])):
        table["vd_V"][k] += extra * d / math.hypot(d, q)
        table["vq_V"][k] += extra * q / math.hypot(d, q)
    return correct(files)


@case
def filtered_voltages(rng):
    """Probes with a filter: 20 degrees late, 6 % small at speed."""
    m = Machine(rng)
    samples = bench.steady(m, 0.8 * m.speed, 0, 0)
    late = [m.at(x["t"], x["theta_m"] - 0.35 / m.p, x["w"], 0, 0) for x in samples]
    for x, y in zip(samples, late):
        x["v"] = [0.94 * v for v in y["v"]]
    return correct(with_runs(m, Columns(rng, m), {"back": (samples, BACK)}))


@case
def run_up(rng):
    """The sensor sits behind an inertia: while the speed rises, the torque is short of what the current makes."""
    m = Machine(rng, kind="servo")
    q, inertia = 0.9 * m.I, 0.35
    seconds, samples = 6 * TURN / m.speed, []
    for k in range(800):
        t = seconds * k / 800
        w, theta = m.speed * (0.1 + 0.8 * t / seconds), m.speed * (0.1 * t + 0.4 * t * t / seconds)
        samples.append(m.at(t, theta, w, 0, q, alpha=1.0, inertia=inertia * m.torque))
    return correct(with_runs(m, Columns(rng, m), {"up": (samples, DYNO_QUIET)}, ratings=False))


@case
def locked_rotor(rng):
    """Direct current in a against b and c, the shaft turned by hand over the torque sensor."""
    m = Machine(rng, kind="ipm")
    samples = []
    for k in range(180):
        theta = TURN * k / 180
        i = 0.5 * m.I
        x = m.at(0.0, theta / m.p, 0.0, -i * math.cos(theta), i * math.sin(theta))
        samples.append(x)
    names = rng.choice(["theta_e_rad abc torque_Nm", "theta_m_rad abc torque_Nm"])
    return correct(with_runs(m, Columns(rng, m), {"locked": (samples, names)}, inductances=False, ratings=False))


@case
def coarse_encoder(rng):
    """Hall sensors: six angles a period."""
    m = Machine(rng, kind="drone")
    files = with_runs(m, Columns(rng, m), {**dyno(m), **back(m)})
    for path in ("runs/load.csv", "runs/back.csv"):
        step = TURN / 6 / m.p
        files[path]["theta_m_rad"] = [step * (math.floor(x / step) + 0.5) for x in files[path]["theta_m_rad"]]
    return correct(files)


@case
def weakening(rng):
    """Deep field weakening, inductances saturate by a third."""
    m = Machine(rng, kind="ipm", saturates_at=1.0)
    points = [(rng.uniform(0.8, 1.6) * m.speed, -rng.uniform(0.5, 1.1) * m.I, rng.uniform(0.1, 0.5) * m.I) for _ in range(8)]
    return correct(with_runs(m, Columns(rng, m), {"log": (ripple(rng, bench.plateaus(m, points), m), LOG + " torque_Nm")}))


@case
def cautious_sheet(rng):
    """The sheet gives the torque for ever and the current for a while."""
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), back(m), rated=rng.uniform(0.6, 0.75)))


@case
def all_columns_log(rng):
    """Phase currents beside i_d, i_q, v_d, v_q."""
    m = Machine(rng)
    return correct(with_runs(m, Columns(rng, m), {"log": (bench.steady(m, 0.5 * m.speed, -0.1 * m.I, 0.7 * m.I), LOG + " abc torque_Nm")}))


@case
def scope(rng):
    """Three voltages against time, without current; one channel with an offset, two only in some."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"scope": (bench.steady(m, 0.3 * m.speed, 0, 0), rng.choice(["time_s vabc", "time_s vabc speed_rpm"]))})
    table = files["runs/scope.csv"]
    table["vc_V"] = [x + 0.05 * m.k_e * m.speed for x in table["vc_V"]]
    if rng.random() < 0.3:
        del table["vc_V"]
    return correct(files)


# ---- slips

def slip(name, alike=()):
    """A case that makes correct files, and what is then done to them."""
    def decorate(function):
        def made(rng):
            return function(rng), name, alike
        made.__doc__ = function.__doc__
        CASES["slip_" + function.__name__] = made
        return made
    return decorate


POLES = ("pole_pairs_miscounted", "poles_for_pole_pairs")


def wrong_poles_holding(rng, p):
    m = Machine(rng, kind="gimbal", layout=(12, 7), uneven=rng.uniform(0.2, 0.8), coulomb=0.02)
    m.cogging += [(7, 0.6 * m.cogging[0][1], rng.uniform(-3, 3)), (21, 0.3 * m.cogging[0][1], rng.uniform(-3, 3))]  # zero of a current sensor
    files = with_runs(m, Columns(rng, m), holding(rng, m), cogging=False, ratings=False, slots=rng.random() < 0.7)
    value(files, "pole_pairs", p / 7)
    return files


@slip(POLES[0], POLES)
def holding_4_for_7(rng):
    return wrong_poles_holding(rng, 4)


@slip(POLES[0], POLES)
def holding_6_for_7(rng):
    return wrong_poles_holding(rng, 6)


@slip(POLES[1], POLES)
def holding_14_for_7(rng):
    return wrong_poles_holding(rng, 14)


@slip(POLES[0], POLES)
def holding_clean_4_for_7(rng):
    """Even magnets and teeth: 84 and 168 a turn, and the slots are known."""
    m = Machine(rng, kind="gimbal", layout=(12, 7))
    files = with_runs(m, Columns(rng, m), holding(rng, m), cogging=False, ratings=False)
    value(files, "pole_pairs", 4 / 7)
    return files


@slip(POLES[0], POLES)
def holding_phases_6_for_7(rng):
    """Held by phase currents: they commutate p times a turn, with either sign."""
    m = Machine(rng, kind="gimbal", layout=(12, 7))
    files = with_runs(m, Columns(rng, m), holding(rng, m, names="theta_m_rad abc held_Nm"), cogging=False, ratings=False, slots=False)
    value(files, "pole_pairs", 6 / 7)
    return files


@slip(POLES[0], POLES)
def dyno_5_for_7(rng):
    m = Machine(rng, layout=(12, 7), kind="drone")
    files = with_runs(m, Columns(rng, m), {**dyno(m), **back(m)})
    value(files, "pole_pairs", 5 / 7)
    return files


@slip(POLES[0], POLES + ("speed_electrical",))
def log_10_for_7(rng):
    """Electrical and mechanical angle in one log."""
    m = Machine(rng, layout=(12, 7), kind="drone")
    files = with_runs(m, Columns(rng, m), log(rng, m, "time_s theta_m_rad theta_e_rad_wrapped speed_rad_per_s id_A iq_A vd_V vq_V"))
    value(files, "pole_pairs", 10 / 7)
    return files


@slip(POLES[1])
def poles_there_and_back(rng):
    m = Machine(rng)
    d, q = m.best(0.7 * m.I)
    files = with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.3 * m.speed, d, q), DYNO)})
    value(files, "pole_pairs", 2)
    return files


@slip(POLES[1], ("pole_pairs_miscounted", "emf_volt_per_hz", "emf_rms", "emf_line", "emf_line_rms", "emf_flux_linkage"))
def poles_blind_log(rng):
    """The flux k_e/p is half of what the log shows."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), log(rng, m, LOG_BLIND))
    value(files, "pole_pairs", 2)
    return files


@slip("emf_line")
def emf_line_dyno(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {**dyno(m), **back(m)})
    emf(files, math.sqrt(3))
    return files


@slip("emf_rms", ("current_rms", "current_dq_rms", "rated_current_rms"))
def emf_rms_torque(rng):
    """Currents and torque only, and the ratings."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"load": (bench.steady(m, 0.4 * m.speed, 0, 0.9 * m.I), DYNO_QUIET)})
    emf(files, 1 / math.sqrt(2))
    return files


@slip("emf_rms")
def emf_rms_drag_there_and_back(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"drag": (bench.there_and_back(m, 0.3 * m.speed, 0, 0), BACK)})
    emf(files, 1 / math.sqrt(2))
    return files


@slip("emf_line_rms")
def emf_line_rms_hot(rng):
    """And warm magnets on top."""
    m = Machine(rng, magnets=0.95)
    files = with_runs(m, Columns(rng, m), {**dyno(m), **back(m)})
    emf(files, math.sqrt(1.5))
    return files


@slip("emf_flux_linkage", ("emf_volt_per_hz",))
def flux_log(rng):
    m = Machine(rng, kind="drone")
    files = with_runs(m, Columns(rng, m), log(rng, m))
    emf(files, 1 / m.p)
    return files


@slip("emf_flux_linkage", ("emf_volt_per_hz",))
def flux_salient(rng):
    """Interior magnets without declared inductances: p is no reluctance torque."""
    m = Machine(rng, kind="ipm", layout=(48, 4))
    files = with_runs(m, Columns(rng, m), {**dyno(m), **back(m)}, inductances=False, ratings=False)
    emf(files, 1 / m.p)
    return files


@slip("current_dq_rms", ("current_rms",))
def dq_rms_torque(rng):
    """A surface machine with declared inductances, back-driven and loaded."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"load": (bench.steady(m, 0.4 * m.speed, 0, 0.9 * m.I), "time_s theta_m_rad speed_rad_per_s id_A iq_A torque_Nm"), **back(m)})
    column(files, "id_A iq_A", 1 / math.sqrt(2))
    return files


@slip("current_dq_rms", ("current_rms",))
def dq_rms_beside_phases(rng):
    """Phase currents beside them tell; a salient machine without inductances."""
    m = Machine(rng, kind="ipm")
    d, q = m.best(0.8 * m.I)
    files = with_runs(m, Columns(rng, m), {"log": (bench.steady(m, 0.5 * m.speed, d, q), LOG + " abc torque_Nm")}, inductances=False, ratings=False)
    column(files, "id_A iq_A vd_V vq_V", 1 / math.sqrt(2))
    return files


@slip("current_power_invariant", ("current_rms",))
def invariant_beside_phases(rng):
    """No torque is recorded: the phase currents alone tell."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"log": (bench.steady(m, 0.5 * m.speed, -0.1 * m.I, 0.7 * m.I), LOG + " abc")}, ratings=False)
    column(files, "id_A iq_A vd_V vq_V", math.sqrt(1.5))
    return files


@slip("current_dq_rms", ("current_rms", "current_power_invariant"))
def dq_rms_log(rng):
    m = Machine(rng, kind="ipm")
    files = with_runs(m, Columns(rng, m), log(rng, m, LOG + " torque_Nm", d_share=0.6))
    column(files, "id_A iq_A vd_V vq_V", 1 / math.sqrt(2))
    return files


@slip("current_power_invariant")
def power_invariant_map(rng):
    m = Machine(rng, kind="servo")
    files = with_runs(m, Columns(rng, m), {"map": (map_points(m, (1, -1)), "id_A iq_A torque_Nm"), **back(m)})
    column(files, "id_A iq_A", math.sqrt(1.5))
    return files


@slip("torque_millinewton")
def millinewton_points(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"points": (map_points(m)[::2], "speed_rpm id_A iq_A torque_Nm")})
    column(files, "torque_Nm", 1000)
    return files


@slip("torque_millinewton")
def millinewton_salient(rng):
    m = Machine(rng, kind="ipm")
    files = with_runs(m, Columns(rng, m), dyno(m), inductances=False, ratings=False)
    column(files, "torque_Nm", 1000)
    return files


@slip("current_milliampere")
def milliampere_points(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"points": (map_points(m)[::2], "speed_rpm id_A iq_A torque_Nm")})
    column(files, "id_A iq_A", 1000)
    return files


@slip("torque_sign", ("current_sign", "run_angle_zero_d_axis"))
def generator_there_and_back(rng):
    m = Machine(rng)
    d, q = m.best(0.8 * m.I)
    files = with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.3 * m.speed, d, q), DYNO_QUIET)})
    column(files, "torque_Nm", -1)
    return files


@slip("current_sign", ("torque_sign",))
def current_out_there_and_back(rng):
    m = Machine(rng, kind="gimbal")
    files = with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.3 * m.speed, 0, 0.8 * m.I), DYNO)})
    column(files, "ia_A ib_A ic_A", -1)
    return files


@slip("phases_swapped", ("direction_reversed",))
def swapped_dyno(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {**dyno(m), **back(m)})
    for table in (files["runs/load.csv"], files["runs/back.csv"]):
        for x in ("i%s_A", "v%s_V"):
            if x % "b" in table:
                table[x % "b"], table[x % "c"] = table[x % "c"], table[x % "b"]
    return files


@slip("phases_swapped", ("direction_reversed",))
def swapped_there_and_back(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.3 * m.speed, 0, 0.8 * m.I), DYNO)})
    table = files["runs/load.csv"]
    for x in ("i%s_A", "v%s_V"):
        table[x % "b"], table[x % "c"] = table[x % "c"], table[x % "b"]
    return files


@slip("theta_electrical_for_mechanical")
def electrical_there_and_back(rng):
    m = Machine(rng, layout=(24, 14), kind="drone")
    files = with_runs(m, Columns(rng, m), {"load": (bench.there_and_back(m, 0.3 * m.speed, 0, 0.8 * m.I), DYNO)})
    column(files, "theta_m_rad", m.p)
    return files


@slip("theta_degrees_for_radians")
def degrees_drag(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"drag": (bench.there_and_back(m, 0.3 * m.speed, 0, 0), BACK)})
    column(files, "theta_m_rad", 180 / math.pi)
    return files


@slip("resistance_line")
def line_resistance_slow_log(rng):
    m = Machine(rng, kind="gimbal")
    files = with_runs(m, Columns(rng, m), log(rng, m, low=0.03, high=0.15))
    value(files, "resistance", 2)
    return files


@slip("resistance_line")
def line_resistance_fast_log(rng):
    """At full speed, but with currents from a tenth to the whole: the slope of v_q over i_q is the resistance."""
    m = Machine(rng, kind="servo")
    points = [(rng.uniform(0.85, 0.95) * m.speed, 0, m.I * (0.1 + 0.9 * k / 11)) for k in range(12)]
    files = with_runs(m, Columns(rng, m), {"log": (bench.plateaus(m, points), LOG)})
    value(files, "resistance", 2)
    return files


@slip("speed_electrical")
def erpm_free_shaft(rng):
    m = Machine(rng, kind="gimbal", layout=(12, 7), cogging=0.02)
    swing = lambda t, w: 0.6 * m.I * math.sin(4 * math.pi * t)
    samples = bench.free_shaft(m, m.torque / (m.speed * 8), swing, 2.0, 0.001)
    files = with_runs(m, Columns(rng, m), {"free": (samples, "time_s theta_m_rad speed_rad_per_s iq_A")})
    column(files, "speed_rad_per_s", m.p)
    return files


@slip("time_milliseconds")
def milliseconds_log(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"log": (bench.steady(m, 0.3 * m.speed, 0, 0.7 * m.I), LOG)})
    column(files, "time_s", 1000)
    return files


@slip("voltage_line")
def line_voltages_drag(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"drag": (bench.there_and_back(m, 0.3 * m.speed, 0, 0), BACK)})
    table = files["runs/drag.csv"]
    a, b, c = table["va_V"], table["vb_V"], table["vc_V"]
    table["va_V"], table["vb_V"], table["vc_V"] = ([x - y for x, y in zip(*pair)] for pair in ((a, b), (b, c), (c, a)))
    return files


@slip("cogging_orders_mechanical")
def cogging_orders_slow(rng):
    m = Machine(rng, kind="gimbal", coulomb=0.04)
    files = with_runs(m, Columns(rng, m), holding(rng, m))
    files["machine/cogging.csv"]["order"] = [n * m.p for n in files["machine/cogging.csv"]["order"]]
    return files


@slip("voltage_line", ("emf_line", "emf_rms", "emf_line_rms", "emf_flux_linkage", "emf_volt_per_hz", "poles_for_pole_pairs"))
def scope_lines(rng):
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"scope": (bench.steady(m, 0.3 * m.speed, 0, 0), "time_s vabc speed_rpm")})
    table = files["runs/scope.csv"]
    a, b, c = table["va_V"], table["vb_V"], table["vc_V"]
    table["va_V"], table["vb_V"], table["vc_V"] = ([x - y for x, y in zip(*pair)] for pair in ((a, b), (b, c), (c, a)))
    return files


@slip("speed_unsigned")
def unsigned_speed(rng):
    """A tachometer has no sign; the shaft turns backward."""
    m = Machine(rng)
    files = with_runs(m, Columns(rng, m), {"back": (bench.steady(m, -0.5 * m.speed, 0, 0), BACK), "load": (bench.steady(m, -0.5 * m.speed, 0, -0.6 * m.I), DYNO)})
    for table in (files["runs/back.csv"], files["runs/load.csv"]):
        table["speed_rad_per_s"] = [abs(x) for x in table["speed_rad_per_s"]]
    return files
