"""More benches, odder ones: combinations by chance, joints that cannot turn round, tables of means, loggers once a second,
captures of eight bits, and what a catalogue lacks. Imported by world.py, whose registry it fills."""
import numpy as np
from plant import *
from benches import *

ALL = TWELVE + [(.6, .9, -.3, "fit"), (1, 1, .3, "fit"), (.4, -.8, -.6, "fit"), (.8, .7, .6, "fit")]
WARM = [(37 * j) % 60 for j in range(17)]
CHOICE = ["friction", "offset", "gain", "offset_angle", "eccentric", "resolver", "back_emf", "cogging", "imbalance", "order", "temperature",
          "lag", "delay", "torque_gain", "zero", "magnet", "iron_drag", "reluctance", "filter"]
APART = [{"gain", "imbalance"}, {"lag", "delay"}, {"delay", "filter"}, {"order", "magnet"}, {"torque_gain", "back_emf"}, {"lag", "filter"}, {"eccentric", "magnet"}]


def some(r, number):
    """So many effects by chance that these runs can tell apart."""
    while True:
        pick = set(r.choice(CHOICE, number, replace=False))
        if not any(a <= pick for a in APART):
            break
    also = ({"back_emf"} if "imbalance" in pick else set()) | ({"mechanical_order"} if "magnet" in pick else set()) | ({"channel_delay"} if "filter" in pick else set())
    return usual(r, ALL, HEAT, hidden=sorted(pick), also=also, vary=lambda m, j: dict(temp=20.0 + WARM[j]), p=int(r.choice([2, 3, 4, 5])))


for name, number in (("chance_two", 2), ("chance_three", 3), ("chance_four", 4), ("chance_three_again", 3), ("chance_two_again", 2)):
    f = lambda r, number=number: some(r, number)
    f.__name__, f.__doc__ = name, f"{number} effects by chance."
    kind(f)


# Motions.

def moved(name, doc, motions, hidden, n=6000, cols=FULL, prep=None, **k):
    """Runs of any motion: (share of current, angle, T, function of t to angle, speed, acceleration)."""
    def f(r):
        d = motor(r, k.get("p"))
        m, b = d.copy(), bench(r, d)
        w = World(d, m, hide(r, m, b, *hidden), bound=k.get("bound", True), also=set(k.get("also", ())))
        if prep:
            prep(r, w, m, b)
        for j, (share, angle, T, motion) in enumerate(motions(m)):
            q = dict(id=-share * m.amps * np.sin(angle), iq=share * m.amps * np.cos(angle), w=1.0, n=n, T=T, motion=motion)
            w.add(f"run{j}", record(m, b, q, r), cols, "holdout" if j == 4 else "fit")
        return w
    f.__name__, f.__doc__ = name, doc
    kind(f)


def to_and_fro(a, w, c=0.0):
    return lambda t: (c + a * np.sin(w * t), a * w * np.cos(w * t), -a * w * w * np.sin(w * t))


def up_and_down(w, T):
    return lambda t: (np.where(t < T / 2, w * t * t / T, -w * T / 2 + 2 * w * t - w * t * t / T), w * (1 - abs(2 * t / T - 1)), np.where(t < T / 2, 2 * w / T, -2 * w / T))


def ramp_hold(w, T=6.0):
    """Up in a fifth of the time, steady, down in the last fifth."""
    u, a = T / 5, 5 * w / T
    x = lambda t: np.where(t < u, a * t * t / 2, np.where(t < 4 * u, a * u * u / 2 + w * (t - u), a * u * u / 2 + 3 * w * u + w * (t - 4 * u) - a * (t - 4 * u) ** 2 / 2))
    return lambda t: (x(t), np.where(t < u, a * t, np.where(t < 4 * u, w, w - a * (t - 4 * u))), np.where(t < u, a, np.where(t < 4 * u, 0 * t, -a)))


def inertia_of(r, w, m, b):
    j = .3 * m.rated / (2 * m.speed / 4)
    m.drag.append(lambda s: j * s.acc)
    w.hidden["rotor_inertia"] = {"inertia": j}


moved("limited_joint", "A joint that cannot go further than half a radian either way.", lambda m: [(s, a, 10.0, to_and_fro(.5, 2 + j, .2 * j)) for j, (s, a) in enumerate(
    [(0, 0), (.5, 0), (1, .4), (1, PI), (.7, -.4)])], ("friction", "cogging"), p=7)
moved("clean_joint", "The same, nothing hidden.", lambda m: [(s, a, 10.0, to_and_fro(.5, 2 + j, .2 * j)) for j, (s, a) in enumerate(
    [(0, 0), (.5, 0), (1, .4), (1, PI), (.7, -.4)])], (), p=7)
moved("ramps", "Up and down within a file: friction and the rotor's inertia before the sensor.", lambda m: [(s, a, 4.0, up_and_down(g * m.speed, 4.0)) for s, a, g in (
    (0, 0, 1), (0, 0, -.8), (.6, 0, .9), (1, .4, -.6), (.8, -.3, .7))], ("friction",), prep=inertia_of, n=9000)
moved("clean_reversing", "A shaft that swings over two turns, nothing hidden.", lambda m: [(s, a, 6.0, to_and_fro(6.0, 2 + j)) for j, (s, a) in enumerate(
    [(0, 0), (.5, 0), (1, .4), (1, PI), (.7, -.4)])], ())


# Loggers.

@kind
def logger_once_a_second(r):
    """A thermal run logged once a second: samples many turns apart, the angle wrapped."""
    w = World(motor(r), None)
    m, b = w.d.copy(), bench(r, w.d)
    w.m, w.hidden = m, hide(r, m, b, "temperature")
    for j, (share, angle, speed, role) in enumerate([(0, 0, .5, "fit"), (.9, 0, .6, "fit"), (1, .4, .8, "fit"), (.5, -.3, -.7, "fit"), (.8, .2, .7, "holdout")]):
        q = run(m, r, share, angle, speed, 2000, temp=22.0, heat=60.0 * (share > 0))
        q["T"] = 2000.0
        x = record(m, b, q, r)
        x["thm"] = x["thm"] % (2 * PI)
        w.add(f"hour{j}", x, HEAT, role)
    return w


@kind
def table_of_means(r):
    """A dynamometer's table: a row for each steady point with its speed, no angle: friction and reluctance."""
    d = motor(r)
    m, b = salient(r, d.copy()), bench(r, d)
    w = World(d, m, {"reluctance": {"Ld-Lq": m.ld - m.lq}, **h_friction(r, m, b, 1.0)}, bound=False)
    for name, n, role in (("table", 120, "fit"), ("later", 30, "holdout")):
        i_d, i_q, s = m.amps * r.uniform(-1, .2, n), m.amps * r.uniform(-1, 1, n), m.speed * r.uniform(.1, 1, n) * r.choice([-1, 1], n)
        T = 1.5 * m.k * i_q + 1.5 * m.p * (m.ld - m.lq) * i_d * i_q - m.drag[0](NS(w=s)) + r.normal(0, .003 * m.rated, n)
        w.add(name, dict(id=i_d, iq=i_q, T=T, rpm=30 / PI * s), [("speed_rpm", "rpm"), ("id_A", "id"), ("iq_A", "iq"), ("torque_Nm", "T")], role)
    return w


@kind
def logger_slow_currents(r):
    """Currents come eight rows at a time from the drive, torque and angle each row."""
    w = usual(r, hidden=("offset",), n=16000)
    w.runs = [(n, q, cells(s, lambda x, j, last=[None]: x[:3] + (last.__setitem__(0, x[3:6]) or x[3:6] if j % 8 == 0 else last[0]) + x[6:])) for n, q, s in w.runs]
    return w


@kind
def no_clock(r):
    """Neither time nor speed: angle, currents and torque; the index is off."""
    return usual(r, hidden=("offset_angle",), cols=[("theta_m_rad", "thm")] + FULL[3:])


@kind
def hub_motor(r):
    """A hub motor of 27 slots and 30 poles whose stator is not round: cogging once a slot."""
    def change(w, d, m, b):
        a, g = .03 * m.rated, r.uniform(-PI, PI)
        add_to(m.cog, 1.8, a * np.cos(g), a * np.sin(g))
        w.hidden = {"cogging": {"sine_1.8": a * np.cos(g), "cosine_1.8": a * np.sin(g)}}
    return usual(r, change=change, p=15, also={"mechanical_order"})


@kind
def warm_reference(r):
    """The declared back-EMF is that of 90 degrees."""
    def change(w, d, m, b):
        m.tref = 90.0
        w.hidden = {**hide(r, m, b, "temperature")}
    return usual(r, change=change, also={"back_emf"}, cols=HEAT, vary=lambda m, j: dict(temp=30.0 + [0, 10, 75, 30, 5, 60, 40, 85][j]))


@kind
def butterworth(r):
    """The amplifier of the torque sensor has a filter of second order."""
    def change(w, d, m, b):
        b.fn, b.zeta = 1.1 * m.c * m.p * m.speed / 2 / PI, .707
        w.hidden = {"torque_sensor": {"natural_frequency": b.fn, "damping": .707}}
    return usual(r, TWELVE, change=change, also={"channel_delay"})


@kind
def mains_at_one_speed(r):
    """1500 rpm in all runs and 50 Hz in the torque channel, of another phase each time."""
    def change(w, d, m, b):
        m.speed = d.speed = 50 * PI
        b.hum, b.hum_phase = 4 * b.sT, lambda: r.uniform(0, 2 * PI)
    return usual(r, [(a, g, 1.0, q) for a, g, s, q in EIGHT], change=change, outside=True, slip="Hz|does not repeat", bound=False)


@kind
def weight_on_joint(r):
    """A joint turned slowly with an arm that hangs on it: once a turn, beside cogging."""
    d, m, b, tc, hidden = gimbal(r)
    a = m.rated * .1
    m.cog[1 / m.p] = (a * .8, a * .6)
    hidden["mechanical_order"] = {f"sine_{1 / m.p:g}": .8 * a, f"cosine_{1 / m.p:g}": .6 * a}
    w = World(d, m, hidden, bound=False, also={"cogging"})
    return slow_turn(w, m, b, r, tc, [("time_s", "t"), ("theta_m_deg", "thm", 180 / PI), ("speed_rpm", "rpm"), ("iq_A", "iq")])


@kind
def free_run_up(r):
    """A free shaft driven up and down by steps of current: the magnets are 8 % weaker, and friction."""
    d, m, hidden = coasting(r, .4, "linear")
    m.emf = {n: (.92 * s, .92 * c) for n, (s, c) in m.emf.items()}
    hidden["back_emf"] = {"sine_1": -.08 * d.k}
    w = World(d, m, hidden, bound=False, also={"magnet_temperature", "current_gain", "phase_imbalance"})
    for j, (w0, share, T) in enumerate([(.1, .3, 1.0), (-.1, -.3, 1.0), (.9, -.2, 1.0), (.2, .5, .6), (.9, 0, 2.0), (-.9, 0, 2.0), (-.2, -.45, .6)]):
        coasts(w, m, r, d.inertia, [w0 * m.speed], T, 2500, share * m.amps, cols=[("time_s", "t"), ("theta_m_rad", "thm"), ("speed_rpm", "rpm"), ("iq_A", "iq")])
        w.runs[-1] = (f"up{j}.csv", "holdout" if j == 6 else "fit", w.runs[-1][2])
    return w


@kind
def hall_angle(r):
    """The angle is that of Hall sensors: six steps a turn."""
    w = usual(r, hidden=("cogging",), outside=True, refusal=True, also={"position_offset"}, bound=False)
    k = 6 * w.m.p / 2 / PI
    w.runs = [(n, q, cells(s, lambda x, j: [x[0], "%.6f" % (np.floor(float(x[1]) * k) / k)] + x[2:])) for n, q, s in w.runs]
    return w


@kind
def long_files(r):
    """Eight runs of sixty thousand rows."""
    return usual(r, hidden=("cogging", "friction"), plan=TWELVE[:8], n=60000, turns=40.3, p=4)


@kind
def forty_runs(r):
    """Forty short runs and three effects."""
    plan = [(float(r.uniform(0, 1)) * (j % 5 > 0), float(r.uniform(-.6, 1)) + PI * (j % 3 == 0), float(r.uniform(.05, 1) * r.choice([-1, 1])), "holdout" if j % 9 == 8 else "fit") for j in range(40)]
    return usual(r, plan, hidden=("friction", "gain", "eccentric"), n=2500, p=3)


@kind
def drive_logs_dq(r):
    """The drive's own i_d and i_q, turned by an angle whose zero is off, with friction and an offset of one sensor."""
    return usual(r, TWELVE, DQ, hidden=("offset_angle", "friction", "offset"))


@kind
def id_never_used(r):
    """Three currents, never an i_d: harmonic 5 or 7 of the back-EMF, and a saliency that no run shows."""
    def change(w, d, m, b):
        h_back_emf(r, m, b, 1.0, int(r.choice([5, 7])))
        salient(r, m)
        w.hidden = {"back_emf": {}}
    return usual(r, [(a, 0 if g < 2 else PI, s, q) for a, g, s, q in TWELVE], change=change)


@kind
def fe_beyond(r):
    """Saturated iron from a field solver, and a torque a quarter above all that was computed."""
    d = motor(r, int(r.choice([3, 4])))
    m = iron(r, salient(r, d.copy()))
    w = solver_runs(World(d, m, {"saturation": {}}, also={"reluctance", "back_emf", "cogging"}), m, FE, grid(m))
    w.top *= 2.27
    return w


@kind
def fe_few_levels(r):
    """The same from five current levels only."""
    d = motor(r, int(r.choice([3, 4])))
    m = iron(r, salient(r, d.copy()))
    g = grid(m)
    return solver_runs(World(d, m, {"saturation": {}}, also={"reluctance", "back_emf", "cogging"}), m, FE, [g[j] for j in (0, 4, 6, 9, 11, 12)])


# Noise that is not white, nothing hidden.

def clean(name, doc, f, plan=EIGHT, **k):
    mangled(name, f, (), plan, doc, **k)


def last_column(s, f):
    """The file with its torques changed by f(array)."""
    y = iter(f(np.array([float(x.rsplit(",", 1)[1]) for x in s.rstrip("\n").split("\n")[1:]])))
    return cells(s, lambda x, j: x[:-1] + ["%.7g" % next(y)])


def coloured(y, r):
    e, x = r.normal(0, 1, len(y)), 0.0
    s, out = np.std(y - np.roll(y, 1)) / 1.5, np.empty(len(y))
    for j in range(len(y)):
        x = .95 * x + .31 * e[j]
        out[j] = x
    return y + s * out


def spikes(y, r):
    y = y.copy()
    at = r.choice(len(y), len(y) // 300, replace=False)
    y[at] += r.normal(0, 40, len(at)) * np.std(y - np.roll(y, 1))
    return y


clean("clean_coloured_noise", "Noise that creeps (autoregressive).", lambda s, r: last_column(s, lambda y: coloured(y, r)))
clean("clean_spikes", "One torque in three hundred is a spike.", lambda s, r: last_column(s, lambda y: spikes(y, r)), slip="spike|outlier")
clean("clean_eight_bits", "The torque comes in steps of a capture of eight bits.", lambda s, r: last_column(s, lambda y: np.round(y / (np.ptp(y) / 60 + 1e-9)) * (np.ptp(y) / 60 + 1e-9)))


@kind
def clean_clipped(r):
    """The range of the torque sensor ends 2 % above the rated torque, where the crests of full load are cut."""
    w = usual(r)
    w.runs = [(n, q, last_column(x, lambda y: np.clip(y, -1.02 * w.m.rated, 1.02 * w.m.rated))) for n, q, x in w.runs]
    return w


# Slips.

def slip(name, doc, words, hidden=None, **k):
    def deco(change):
        def f(r):
            w = usual(r, slip=words, outside=True, bound=False, change=lambda w, d, m, b: change(r, w, d, m, b), **k)
            return w
        f.__name__, f.__doc__ = name, doc
        kind(f)
        return change
    return deco


nothing = lambda r, w, d, m, b: None
slip("wrong_phase_order", "Columns b and c are swapped in all recordings.", "swap|phase", cols=FULL[:4] + [("ib_A", "ic"), ("ic_A", "ib"), FULL[6]])(nothing)
slip("wrong_degrees", "The angle is in degrees, its column says rad.", "degree", cols=[FULL[0], ("theta_m_rad", "thm", 180 / PI)] + FULL[2:])(nothing)
slip("wrong_current_sign", "The currents have the other sign.", "sign", cols=FULL[:3] + [(c[0], c[1], -1) for c in FULL[3:6]] + [FULL[6]])(nothing)
slip("wrong_gear", "The torque sensor is behind a gear of one to five, the angle before it.", "gear|5 times|factor", cols=FULL[:6] + [("torque_Nm", "T", 5)])(nothing)


@kind
def wrong_zero_far(r):
    """The index of the encoder was never aligned: one radian off."""
    def change(w, d, m, b):
        b.off = sgn(r) * 1.0
        w.hidden = {"position_offset": {"angle": b.off}}
    return usual(r, change=change, slip="angle-offset")


@kind
def wrong_line_to_line(r):
    """The back-EMF was entered line to line."""
    def change(w, d, m, b):
        d.emf = {n: (3 ** .5 * s, 3 ** .5 * c) for n, (s, c) in d.emf.items()}
        w.hidden = {"back_emf": {"sine_1": m.k - d.emf[1][0]}}
    return usual(r, change=change, also={"magnet_temperature", "current_gain", "phase_imbalance"})


@kind
def two_motors_one_list(r):
    """Half of the runs are of another copy of the motor: 7 % stronger, other cogging."""
    d = motor(r)
    b = bench(r, d)
    m = d.copy()
    w = World(d, m, {}, outside=True, bound=False)
    o = d.copy()
    o.emf = {n: (1.07 * s, 1.07 * c) for n, (s, c) in d.emf.items()}
    o.cog = {n: (s * .5, c * 1.5) for n, (s, c) in d.cog.items()}
    for j, (share, angle, speed, role) in enumerate(TWELVE):
        x = o if j % 2 else m
        w.add(f"run{j}", record(x, b, run(m, r, share, angle, speed), r), FULL, role)
    return w


# More that no catalogue has.

@outside("out_scale_by_direction", "The torque sensor reads 3 % more in one direction.", TWELVE)
def _(r, w, d, m, b):
    b.two_sided = .03


@outside("out_cogging_hysteresis", "Cogging that lags: its phase depends on the direction.", TWELVE)
def _(r, w, d, m, b):
    a = dict(m.cog)
    m.cog = {}
    m.air.append(lambda s: wave(a, s.th - .03 * np.sign(s.w)))


@outside("out_cogging_falls", "Cogging that eddy currents shield: less at speed.", TWELVE)
def _(r, w, d, m, b):
    a = dict(m.cog)
    m.air.append(lambda s: wave(a, s.th) * (1 / (1 + (s.w / m.speed / .6) ** 2) - 1))


@outside("out_lost_counts", "The encoder loses counts: a tenth of a radian, electrical, a turn.", TWELVE)
def _(r, w, d, m, b):
    b.lost = .1 / (2 * PI)


@outside("out_zero_by_heat", "The zero of the torque sensor follows its temperature, which is logged.", TWELVE, cols=HEAT, vary=lambda m, j: dict(temp=20.0 + WARM[j]), also={"torque_sensor"})
def _(r, w, d, m, b):
    m.drag.append(lambda s: .001 * m.rated * (s.temp - 20))


@outside("out_two_filters", "Four poles in the torque amplifier.", TWELVE, also={"torque_sensor", "channel_delay"}, slip=".")
def _(r, w, d, m, b):
    b.fn, b.zeta, b.tau = 1.2 * m.c * m.p * m.speed / 2 / PI, .6, .2 / (m.c * m.p * m.speed)


# Benches that came to mind last.

def blocks(m, share):
    """Currents of six steps, with edges of ten degrees."""
    return dict(abc=lambda t, th: share * m.amps * np.tanh(np.clip(6 * (np.sin(th - LAG) - np.sin(th - LAG - 2 * PI / 3)) / 1.732, -60, 60)) * .5
                + share * m.amps * np.tanh(6 * (np.sin(th - LAG) - np.sin(th - LAG + 2 * PI / 3)) / 1.732) * .5)


@kind
def six_steps(r):
    """A trapezoidal machine commutated in blocks; the sheet knows the fundamental only."""
    def change(w, d, m, b):
        d.emf = {1: (d.k, 0.0)}
        m.emf = {1: (m.k, 0.0), 5: (.06 * m.k, 0.0), 7: (-.03 * m.k, 0.0), 11: (.012 * m.k, 0.0)}
        w.hidden = {"back_emf": {"sine_5": .06 * m.k, "sine_7": -.03 * m.k, "sine_11": .012 * m.k}}
    return usual(r, change=change, vary=lambda m, j: blocks(m, [0, 0, 1, .5, -1, .8, .3, .7][j]))


@kind
def one_probe(r):
    """One current probe only."""
    return usual(r, cols=[c for c in FULL if c[1] not in ("ib", "ic")], outside=True, refusal=True, bound=False, slip="current|phase")


@kind
def torque_without_sign(r):
    """The display of the dynamometer has no sign."""
    w = usual(r, outside=True, bound=False, slip="sign|never below")
    w.runs = [(n, q, last_column(x, np.abs)) for n, q, x in w.runs]
    return w


@kind
def encoder_counts(r):
    """The angle in counts of an encoder of 12 bits, named on the command line; friction and a gain."""
    w = usual(r, TWELVE, [("time_s", "t"), ("ENC1", "thm", 4096 / 2 / PI)] + FULL[2:], hidden=("friction", "gain"), also={"position_offset"})  # counts are cut: half of one
    w.args = ["--column", "theta_m=ENC1/4096"]
    w.runs = [(n, q, cells(x, lambda y, j: [y[0], str(int(float(y[1]) // 1 % 4096))] + y[2:])) for n, q, x in w.runs]
    return w


@kind
def one_averaged_turn(r):
    """Each file is one turn, averaged before: 720 points."""
    return usual(r, hidden=("cogging", "back_emf"), n=1440, turns=1.0, p=int(r.choice([2, 3, 4])), noise=.25)


@kind
def clean_duplicates(r):
    """The same recordings twice under other names."""
    w = usual(r)
    w.runs += [("copy_" + n, q, x) for n, q, x in w.runs]
    return w


@kind
def clean_dead_time(r):
    """A drive whose currents are distorted by dead times, more at small loads: measured as they are."""
    return usual(r, vary=lambda m, j: dict(inject=[(5, -1, .04 * m.amps), (7, 1, .025 * m.amps), (11, -1, .01 * m.amps)]))


moved("clean_start_stop", "From rest to speed, steady, and to rest, in each file; nothing hidden.", lambda m: [(s, a, 6.0, ramp_hold(g * m.speed)) for s, a, g in (
    (0, 0, .5), (.6, 0, .9), (1, .4, -.6), (.8, -.3, .7), (.5, .2, -.8))], (), n=12000)
moved("start_stop_friction", "The same with friction and a gain.", lambda m: [(s, a, 6.0, ramp_hold(g * m.speed)) for s, a, g in (
    (0, 0, .5), (.6, 0, .9), (1, .4, -.6), (.8, -.3, .7), (.5, .2, -.8), (0, 0, -.7))], ("friction", "gain"), n=12000)


@kind
def tiny_motor(r):
    """A motor for lenses: milliampere and micronewton metres, in SI."""
    def change(w, d, m, b):
        f = 1e-3 / 1.0
        for x in (d, m):
            x.k, x.amps, x.rated = x.k * f, x.amps * .02, x.rated * f * .02
            x.emf = {n: (s * f, c * f) for n, (s, c) in x.emf.items()}
            x.cog = {n: (s * f * .02, c * f * .02) for n, (s, c) in x.cog.items()}
        b.sT, b.si = b.sT * f * .02, b.si * .02
        w.hidden = hide(r, m, b, "friction", "cogging")
    return usual(r, TWELVE, change=change)


@kind
def huge_generator(r):
    """A direct-drive generator: kilonewton metres, one turn in six seconds."""
    def change(w, d, m, b):
        f = 2000.0
        for x in (d, m):
            x.k, x.amps, x.rated, x.speed = x.k * f, x.amps * 20, x.rated * f * 20, 1.1
            x.emf = {n: (s * f, c * f) for n, (s, c) in x.emf.items()}
            x.cog = {n: (s * f * 20, c * f * 20) for n, (s, c) in x.cog.items()}
        b.sT, b.si = b.sT * f * 20, b.si * 20
        w.hidden = hide(r, m, b, "friction", "cogging")
    return usual(r, TWELVE, change=change, p=10)


@kind
def dead_torque_sensor(r):
    """The cable of the torque sensor was not plugged in: noise about zero."""
    w = usual(r, outside=True, bound=False, slip="stands still|dead|no torque|sensor is|not measured", innocent="electrical zero|swapped|sign of|pole")
    w.runs = [(n, q, last_column(x, lambda y: r.normal(0, .004 * w.m.rated, len(y)))) for n, q, x in w.runs]
    return w


@kind
def wrong_rms_currents(r):
    """The phase currents are scaled as if they were rms values: 1/sqrt 2 of the truth."""
    return usual(r, cols=FULL[:3] + [(c[0], c[1], .5 ** .5) for c in FULL[3:6]] + [FULL[6]], outside=True, slip="rms val|are rms|rms for|for rms", bound=False,
                 also={"back_emf", "current_gain", "phase_imbalance", "torque_gain", "magnet_temperature"})


@outside("out_two_loggers", "The torque comes from a second logger, whose clock is 0.3 % fast.", TWELVE, also={"channel_delay"})
def _(r, w, d, m, b):
    b.clock = .003


@outside("out_grease", "The grease warms up: half of the friction is gone by the end of each run.", TWELVE, also={"friction", "torque_drift"})
def _(r, w, d, m, b):
    m.drag.append(lambda s: .05 * m.rated * np.sign(s.w) * (.5 + .5 * np.exp(-2 * abs(s.thm) / 60)))
