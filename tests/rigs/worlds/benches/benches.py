"""Benches that people have. Fills the registry of plant.py."""
from plant import *

# Usual benches: nothing, one effect, several.

single("clean_dyno")
single("clean_salient", prep=lambda r, d: (salient(r, d), setattr(d, "declares_l", True)))
single("clean_dc_link_ripple", vary=lambda r, m, j: dict(dc=.06 * m.amps))
single("clean_injection", vary=lambda r, m, j: dict(inject=[(5, -1, .1 * m.amps * (j > 1)), (7, 1, .06 * m.amps * (j > 1))]))
single("thesis_clamp_gain", "gain")
single("thesis_offset", "offset")
single("thesis_lag", "lag")
single("thesis_resonance", "resonance")
single("thesis_friction", "friction", plan=TWELVE)
single("thesis_zero", "zero", "friction", plan=TWELVE)
single("repair_demagnetised", "magnet", p=4, also={"mechanical_order"})
single("repair_shorted_turns", "imbalance", also={"back_emf"})
single("repair_hot_cold", "temperature", cols=HEAT, vary=lambda r, m, j: dict(temp=[25, 30, 60, 75, 90, 40, 85, 65][j]))
single("wind_gear_mesh", "order", "friction", p=10, vary=lambda r, m, j: {}, plan=[(a, PI + g if g < PI else PI, abs(w) * (1 if j % 2 else -1), q)
       for j, (a, g, w, q) in enumerate(EIGHT)])
single("traction_thermal", "temperature", cols=HEAT, vary=lambda r, m, j: dict(temp=20 + 9 * j, heat=20 + 5 * (j % 3)))
single("traction_weakening", "reluctance", plan=MANY, cols=DQ)
single("regen_iron_drag", "iron_drag", plan=TWELVE)
single("encoder_eccentric", "eccentric")
single("resolver_harmonics", "resolver")
single("observer_load", "load", plan=MANY, also={"reluctance", "saturation"}, prep=lambda r, d: (salient(r, d), setattr(d, "declares_l", True)))
single("filtered_currents", "filter", plan=TWELVE, also={"channel_delay"})
single("late_currents", "delay", plan=TWELVE)
single("stribeck_slow", "stribeck", plan=TWELVE + [(0, 0, .03, "fit"), (.3, 0, -.1, "fit"), (.3, .2, -.04, "fit")])
single("torque_gain", "torque_gain", prep=lambda r, d: d.cog.update({d.c: (d.rated * .05, .02)}))
single("three_bench", "friction", "offset", "offset_angle", plan=TWELVE)
single("three_iron", "back_emf", "cogging", "reluctance", plan=MANY)
single("three_sensors", "lag", "gain", "temperature", cols=HEAT, plan=TWELVE, vary=lambda r, m, j: dict(temp=20 + 6 * ((5 * j) % 12)))
single("three_turns", "order", "eccentric", "friction", plan=TWELVE)
single("tenth_of_noise_offset", "offset", z=.08, noise=4.0)
single("tenth_of_noise_back_emf", "back_emf", z=.1, noise=3.0)
single("injected_harmonics", "back_emf", vary=lambda r, m, j: dict(inject=[(5, -1, .12 * m.amps * (j % 3)), (7, 1, .1 * m.amps * (j % 2))]))
single("german_file", "offset_angle", sep=";", comma=True, cols=[("Zeit in ms", "t", 1e3), ("mechanischer Winkel (°)", "thm", 180 / PI),
       ("Drehzahl 1/min", "rpm"), ("Strom L1 (A)", "ia"), ("Strom L2 (A)", "ib"), ("Strom L3 (A)", "ic"), ("Drehmoment (Nm)", "T")])
single("jmag_form", "cogging", head=["Study: load", "Model,v12", "Solver,2D transient"], cols=[("Time(s)", "t"), ("theta_m(deg)", "thm", 180 / PI),
       ("Coil-U(A)", "ia"), ("Coil-V(A)", "ib"), ("Coil-W(A)", "ic"), ("Torque(Nm)", "T")])
single("few_samples", "cogging", n=1180, turns=12.3, p=2)
single("one_speed_delay", "delay", also={"current_filter"}, plan=[(a, g, .9, q) for a, g, w, q in EIGHT])
single("one_direction", "friction", same={"torque_sensor"}, plan=[(a, g, .5, q) for a, g, w, q in EIGHT])
single("ten_equal", "back_emf", same={"cogging", "reluctance", "saturation"}, also={"back_emf"}, plan=[(.8, 0, .5, "fit")] * 9 + [(.8, 0, .5, "holdout")])
single("one_run", "cogging", same={"back_emf", "reluctance", "saturation"}, plan=[(.8, 0, .5, "fit")])


def usual(r, plan=EIGHT, cols=FULL, hidden=(), p=None, change=None, z=1.0, noise=1.0, vary=None, big=False, **k):
    """A world on a usual bench, whose plant or bench `change` alters before it is recorded."""
    d = motor(r, p, big)
    m, b = d.copy(), bench(r, d, noise)
    w = World(d, m, hide(r, m, b, *hidden, z=z), **{a: v for a, v in k.items() if a not in ("n", "turns", "sep", "comma", "head")})
    if change:
        change(w, d, m, b)
    w.off = b.off
    return fill(w, b, r, plan, cols, vary=(lambda j: vary(m, j)) if vary else (lambda j: {}),
                **{a: v for a, v in k.items() if a in ("n", "turns", "sep", "comma", "head")})


@kind
def clean_hum(r):
    """The torque channel hums with the mains; nothing is missing in the machine."""
    return usual(r, change=lambda w, d, m, b: setattr(b, "hum", 1.5 * b.sT), slip="Hz")


@kind
def clean_regenerating(r):
    """A generator that only ever brakes, its friction declared."""
    def change(w, d, m, b):
        tc, bv = m.rated * .03, m.rated * .02 / m.speed
        m.drag.append(lambda s: tc * np.sign(s.w) + bv * s.w)
        w.effects = f"friction,coulomb,{tc},Nm\nfriction,viscous,{bv},Nms_per_rad\n"
    return usual(r, [(a, PI + .4 * (j % 3 - 1), abs(w), q) for j, (a, g, w, q) in enumerate(EIGHT)], change=change, p=10)


@kind
def clean_quiet_captures(r):
    """All recordings without current, at four speeds: nothing hidden that they could show."""
    return usual(r, [(0, 0, s, q) for s, q in ((.2, "fit"), (-.3, "fit"), (.6, "fit"), (-.8, "fit"), (.5, "holdout"))])


@kind
def tenth_of_noise_cogging(r):
    """A declared cogging torque of the second order that is wrong by a tenth (rms) of the noise of a sample."""
    def change(w, d, m, b):
        a = .1 * b.sT * 2 ** .5
        add_to(m.cog, 2 * m.c, a * .6, a * .8)
        w.hidden = {"cogging": {f"sine_{2 * m.c}": .6 * a, f"cosine_{2 * m.c}": .8 * a}}
    return usual(r, change=change, noise=2.0)


@kind
def late_torque(r):
    """The torque channel is 0.3 to 3 ms late."""
    def change(w, d, m, b):
        m.speed = d.speed = 290 / m.p
        b.d_T = r.uniform(.3e-3, 3e-3)
        w.hidden = {"channel_delay": {"torque": b.d_T}}
    return usual(r, TWELVE, change=change)


@kind
def robot_harmonic_drive(r):
    """A joint: the torque sensor behind a harmonic drive sees two and four events a turn of the wave generator, and its friction."""
    def change(w, d, m, b):
        for k in (2, 4):
            for e, v in h_order(r, m, b, 1.0 if k == 2 else .5, k).items():
                w.hidden.setdefault(e, {}).update(v)
    return usual(r, TWELVE, hidden=("friction",), change=change, also={"cogging"}, p=int(r.choice([5, 7])))


@kind
def repair_eccentric(r):
    """An eccentric rotor: torque per ampere varies once a turn."""
    return usual(r, change=lambda w, d, m, b: w.hidden.update(h_order(r, m, b, 1.0, 1, True)), also={"unequal_magnets"})


@kind
def pump_swing(r):
    """The load machine's blades swing the speed; the rotor's inertia does not reach the sensor."""
    def change(w, d, m, b):
        j = .12 * m.rated / (5 * .01 * (.9 * m.speed) ** 2)
        m.drag.append(lambda s: j * s.acc)
        w.hidden = {"rotor_inertia": {"inertia": j}}
    return usual(r, change=change, vary=lambda m, j: dict(swing=.01, swing_k=5))


@kind
def thesis_two_clamps(r):
    """Two clamps that both have a zero error; the third current is made of them."""
    def change(w, d, m, b):
        b.ofs[:2, 0] = m.amps * r.uniform(.01, .03, 2)
        w.hidden = {"current_offset": {"a": b.ofs[0, 0], "b": b.ofs[1, 0]}}
    return usual(r, change=change, cols=[c for c in FULL if c[1] != "ic"])


@kind
def wind_two_rates(r):
    """The torque is read by a slow device: one value for eight rows of the drive."""
    w = usual(r, hidden=("cogging",), n=16000)
    out = []
    for name, role, s in w.runs:
        rows = [x.split(",") for x in s.split("\n")[1:-1]]
        for j, x in enumerate(rows):
            x[6] = rows[j // 8 * 8][6]
        out.append((name, role, "\n".join([s.split("\n")[0]] + [",".join(x) for x in rows]) + "\n"))
    w.runs = out
    return w


# No torque sensor: held, turned slowly, free.

def answering(m, th, push, b, r):
    """The i_q that holds the shaft: torque of it and of cogging is `push`."""
    per = (m.e(th) * phases(0, 1, th)).sum(0)
    return (push - wave(m.cog, th)) / per + r.normal(0, b.si, th.shape)


def slow_turn(w, m, b, r, tc, cols, rpm=6.0, torque=False, **k):
    """Forward and back under control, the current logged."""
    for j, (way, role) in enumerate([(1, "fit"), (-1, "fit"), (1, "holdout"), (-1, "holdout")]):
        n, turns = int(720 * m.p ** .5) * 2, 2.2
        thm = r.uniform(0, .1) + way * 2 * PI * turns * np.arange(n) / n
        t = np.arange(n) * 60 * turns / rpm / n
        i_q = answering(m, m.p * thm, way * tc, b, r)
        w.add(f"turn{j}", dict(t=t, thm=thm, rpm=way * rpm + r.normal(0, .05, n), iq=i_q, id=r.normal(0, b.si, n), T=0 * t, rev=thm / 2 / PI,
                               vel=way * rpm / 60 + 0 * t, kt=1.5 * m.k * i_q), cols, role, **k)
    return w


def gimbal(r, cogless=True):
    d = motor(r, 7)
    m, b = d.copy(), bench(r, d)
    tc = m.rated * r.uniform(.02, .05)
    if cogless:
        d.cog = {}
    hidden = {"friction": {"coulomb": tc}, "cogging": {f"{a}_{n}": v for n, sc in m.cog.items() for a, v in zip(("sine", "cosine"), sc)}}
    return d, m, b, tc, hidden


@kind
def gimbal_holding_map(r):
    """A holding map, forward and back."""
    d, m, b, tc, hidden = gimbal(r)
    return slow_turn(World(d, m, hidden, bound=False), m, b, r, tc, [("theta_m_rad", "thm"), ("iq_A", "iq"), ("torque_Nm", "T")])


@kind
def gimbal_slow_turn(r):
    """6 rpm forward and back, i_q logged, no torque sensor, no column of zeros."""
    d, m, b, tc, hidden = gimbal(r)
    return slow_turn(World(d, m, hidden, bound=False), m, b, r, tc, [("time_s", "t"), ("theta_m_deg", "thm", 180 / PI), ("speed_rpm", "rpm"), ("id_A", "id"), ("iq_A", "iq")])


@kind
def robot_moteus(r):
    """A log of moteus, whose torque is its current times a constant."""
    d, m, b, tc, hidden = gimbal(r)
    return slow_turn(World(d, m, hidden, bound=False), m, b, r, tc, [("time_s", "t"), ("position", "rev"), ("velocity", "vel"), ("d_current", "id"),
                                                                    ("q_current", "iq"), ("torque", "kt")])


@kind
def holding_wrong_poles(r):
    """A holding map of 12 slots and 14 poles; the folder says 4, 6 or 14 pairs and the right cogging torque for 7."""
    d, m, b, tc, hidden = gimbal(r, False)
    d.p = int(r.choice([4, 6, 14]))
    return slow_turn(World(d, m, {}, outside=True, also={"friction"}, slip="pole", bound=False), m, b, r, tc,
                     [("theta_m_rad", "thm"), ("iq_A", "iq"), ("torque_Nm", "T")])


def free(m, inertia, w0, T, n, iq=0.0, load=0.0, sub=4):
    """A free shaft by Runge and Kutta: angle and speed at n instants, and the work of the friction."""
    cog, per = list(m.cog.items()), 1.5 * m.k
    drag = lambda w: float(sum(f(NS(w=w, id=0.0, iq=iq)) for f in m.drag))
    th_w = lambda x: (m.e(np.array([x])) * phases(0, iq, np.array([x]))).sum() if iq else 0.0

    def acc(x, w):
        th = m.p * x
        return (th_w(th) + sum(s * np.sin(k * th) + c * np.cos(k * th) for k, (s, c) in cog) - load - drag(w)) / inertia
    h, x, w, out, work = T / n / sub, 0.3, w0, [], 0.0
    for j in range(n * sub):
        if j % sub == 0:
            out.append((x, w, work))
        a1 = acc(x, w); a2 = acc(x + h / 2 * w, w + h / 2 * a1)
        a3 = acc(x + h / 2 * (w + h / 2 * a1), w + h / 2 * a2); a4 = acc(x + h * (w + h / 2 * a2), w + h * a3)
        dx, dw = h * (w + h / 6 * (a1 + a2 + a3)), h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        work += drag(w + dw / 2) * dx
        x, w = x + dx, w + dw
    x, w, work = np.array(out).T
    return x, w, work


def coasts(w, m, r, inertia, starts, T, n=2500, iq=0.0, load=0.0, cols=None):
    for j, w0 in enumerate(starts):
        J = inertia if np.isscalar(inertia) else inertia[j]
        x, s, _ = free(m, J, w0, T, n, iq, load)
        stop = np.nonzero(s * np.sign(w0) < .04 * abs(w0))[0]
        x, s = (x[:stop[0]], s[:stop[0]]) if len(stop) else (x, s)
        x = np.round(x * 2 ** 17 / 2 / PI) * 2 * PI / 2 ** 17
        w.add(f"coast{j}", dict(t=np.arange(len(x)) * T / n, thm=x, rpm=30 / PI * (s + r.normal(0, 5e-5 * m.speed, len(x))), iq=iq + r.normal(0, 1e-9, len(x))),
              cols or [("time_s", "t"), ("theta_m_rad", "thm"), ("speed_rpm", "rpm")], "holdout" if j == 3 else "fit")
    return w


def coasting(r, share, law, cog=True):
    """A motor with an inertia such that it coasts for the wanted share of its time, and a law of friction."""
    d = motor(r, int(r.choice([2, 4])))
    m = d.copy()
    tc, tv = m.rated * .03, m.rated * .03
    m.drag.append({"linear": lambda s: tc * np.sign(s.w) + tv * s.w / m.speed, "windage": lambda s: tc * np.sign(s.w) + tv * s.w * abs(s.w) / m.speed ** 2}[law])
    d.inertia = m.inertia = share * m.rated / m.speed
    return d, m, {"friction": {"coulomb": tc, **({"viscous": tv / m.speed} if law == "linear" else {"quadratic": tv / m.speed ** 2})}}


@kind
def coast_down_bare(r):
    """Coast-downs of the bare rotor, both ways: friction, and a cogging torque that nobody declared."""
    d, m, hidden = coasting(r, .1, "linear")
    d.cog = {}
    hidden["cogging"] = {f"{a}_{n}": v for n, sc in m.cog.items() if n == m.c for a, v in zip(("sine", "cosine"), sc)}
    return coasts(World(d, m, hidden, bound=False), m, r, d.inertia, [m.speed, -m.speed, .7 * m.speed, -.8 * m.speed], 2.2)


@kind
def coast_down_flywheel(r):
    """Coast-downs with a flywheel and its windage, the inertia declared."""
    d, m, hidden = coasting(r, 1.0, "windage")
    return coasts(World(d, m, hidden, bound=False), m, r, d.inertia, [m.speed, -m.speed, .7 * m.speed, -.8 * m.speed], 20.0)


@kind
def coast_down_two_inertias(r):
    """With and without flywheel in one list; the folder has the inertia without."""
    d, m, hidden = coasting(r, .3, "linear")
    return coasts(World(d, m, {}, outside=True, also={"friction"}, bound=False), m, r, [d.inertia, d.inertia, 3 * d.inertia, 3 * d.inertia],
                  [m.speed, -m.speed, .9 * m.speed, -.9 * m.speed], 6.0)


@kind
def cable_drum(r):
    """A free shaft that lifts a weight: only the speed's ripple tells, the mean is the load's."""
    d, m, _ = coasting(r, .05, "linear")
    d.cog = {}
    cog = {f"{a}_{n}": v for n, sc in m.cog.items() if n == m.c for a, v in zip(("sine", "cosine"), sc)}
    w, cols = World(d, m, {"cogging": cog}, bound=False), [("time_s", "t"), ("theta_m_rad", "thm"), ("speed_rpm", "rpm"), ("iq_A", "iq")]
    for j, (share, speed) in enumerate([(.3, .2), (.3, -.2), (.5, .3), (.5, -.3)]):
        w0, i_q = speed * m.speed, share * m.amps
        load = 1.5 * m.k * i_q - float(m.drag[0](NS(w=w0)))
        x, s, _ = free(m, m.inertia, w0, 16 * PI / abs(w0), 3000, i_q, load, 2)
        w.add(f"lift{j}", dict(t=np.arange(3000) * 16 * PI / abs(w0) / 3000, thm=np.round(x * 2 ** 17 / 2 / PI) * 2 * PI / 2 ** 17, iq=i_q + r.normal(0, .002 * m.amps, 3000),
                               rpm=30 / PI * (s + r.normal(0, 5e-5 * m.speed, 3000))), cols, "holdout" if j == 3 else "fit")
    return w


# Few points, maps, field solvers.

@kind
def wrench_blocked(r):
    """A wrench on a blocked rotor: twelve angles at three direct currents; the magnets are a tenth weaker than declared."""
    d = motor(r)
    m, b = d.copy(), bench(r, d)
    m.emf = {n: (.9 * s, .9 * c) for n, (s, c) in m.emf.items()}
    w = World(d, m, {"back_emf": {"sine_1": m.emf[1][0] - d.k}}, also={"magnet_temperature", "phase_imbalance", "torque_gain", "current_gain"}, bound=False)
    for j, share in enumerate((0, .4, .7, 1, .85)):
        th = np.arange(12) * 2 * PI / 12 + .1 + .05 * j
        i = share * m.amps * np.array([1, -.5, -.5])[:, None] + 0 * th
        i_d, i_q = park(i, th)
        s = NS(th=th, thm=th / m.p, i=i, id=i_d, iq=i_q, temp=20 + 0 * th, w=0 * th)
        w.add(f"wrench{j}", dict(thm=th / m.p, ia=i[0], ib=i[1], ic=i[2], T=m.torque(s) + r.normal(0, .01 * m.rated, 12), true=s),
              [("theta_m_rad", "thm"), ("ia_A", "ia"), ("ib_A", "ib"), ("ic_A", "ic"), ("torque_Nm", "T")], "holdout" if j == 4 else "fit")
    return w


@kind
def stall_and_drag(r):
    """Locked at six angles with a rising current, and plateaus of speed without load; the angle's zero is off."""
    d = motor(r)
    m, b = d.copy(), bench(r, d)
    w = World(d, m, hide(r, m, b, "offset_angle"))
    for j in range(6):
        place = .2 + 1.03 * j
        q = dict(iq=m.amps, w=0.0, n=600, T=3.0, steps=lambda t: place + 0 * t, amp=lambda t: t / 3)
        w.add(f"stall{j}", record(m, b, q, r), FULL, "holdout" if j == 5 else "fit")
    for j, s in enumerate((.2, -.4, .8)):
        w.add(f"drag{j}", record(m, b, run(m, r, 0, 0, s), r))
    return w


@kind
def torque_map(r):
    """A table over i_d and i_q with the mean torque, no angle: reluctance is not declared."""
    d = motor(r)
    m, b = salient(r, d.copy()), bench(r, d)
    w = World(d, m, {"reluctance": {"Ld-Lq": m.ld - m.lq}}, bound=False)
    for name, g, role in (("map", np.linspace(-1, 1, 9), "fit"), ("check", np.linspace(-.9, .9, 4), "holdout")):
        i_d, i_q = [x.ravel() * m.amps for x in np.meshgrid(g[g < .3], g)]
        T = 1.5 * m.k * i_q + 1.5 * m.p * (m.ld - m.lq) * i_d * i_q + r.normal(0, .004 * m.rated, i_d.shape)
        w.add(name, dict(id=i_d, iq=i_q, T=T), [("id_A", "id"), ("iq_A", "iq"), ("torque_Nm", "T")], role)
    return w


@kind
def two_points(r):
    """An interior magnet, declared without inductances, at two currents and one current angle."""
    return usual(r, [(.5, .6, .3, "fit"), (1, .6, .3, "fit"), (.8, .6, .3, "holdout")], hidden=("reluctance",), p=4,
                 also={"position_load", "saturation"})


def solver_runs(w, m, cols, levels, n=61, noise=0.0, r=None):
    for j, (i_d, i_q, role) in enumerate(levels):
        th = np.arange(n) * PI / 3 / (n - 1)
        i = phases(i_d, i_q, th)
        s = NS(th=th, thm=th / m.p, i=i, id=i_d + 0 * th, iq=i_q + 0 * th, temp=20 + 0 * th, w=0 * th)
        w.add(f"level{j}", dict(the=th, id=s.id, iq=s.iq, T=m.torque(s), true=s), cols, role)
    return w


FE = [("theta_e_deg", "the", 180 / PI), ("id_A", "id"), ("iq_A", "iq"), ("torque_Nm", "T")]


def grid(m):
    pts = [(0, 0), (0, .25), (0, .5), (0, .75), (0, 1), (0, -.6), (-.5, .5), (-.5, 1), (-1, .5), (-1, 1), (.4, .5), (.4, 1), (-.3, -.8), (-.8, .25), (-.25, .9), (-.6, .75)]
    return [(a * m.amps, c * m.amps, "holdout" if j in (12, 14, 15) else "fit") for j, (a, c) in enumerate(pts)]


@kind
def fe_levels(r):
    """A field solver's export, one file per current level, a sector of 60 degrees, no noise: saturated iron."""
    d = motor(r, int(r.choice([3, 4])))
    m = iron(r, salient(r, d.copy()))
    w = World(d, m, {"saturation": {}}, also={"reluctance", "back_emf", "cogging"})
    return solver_runs(w, m, FE, grid(m))


@kind
def fe_back_emf(r):
    """The same of a machine with surface magnets, of which one harmonic was entered wrongly."""
    d = motor(r, int(r.choice([3, 4])))
    m = d.copy()
    w = World(d, m, h_back_emf(r, m, None, 1.0))
    return solver_runs(w, m, FE, grid(m))


@kind
def traction_saturated(r):
    """A traction motor at seventeen operating points, saturated, declared without inductances."""
    def change(w, d, m, b):
        iron(r, salient(r, m))
        w.hidden = {"saturation": {}}
    return usual(r, MANY, change=change, big=True, also={"reluctance", "back_emf", "cogging"}, p=4)


# Oscilloscopes and phases.

@kind
def scope_line_voltages(r):
    """Without current, with two line voltages: the declared back-EMF is 8 % too large, which no torque can show."""
    cols = [c for c in FULL if c[1] not in ("ia", "ib", "ic")] + [("vab_V", "vab"), ("vbc_V", "vbc")]
    w = usual(r, [(0, 0, s, q) for s, q in ((.2, "fit"), (-.3, "fit"), (.6, "fit"), (.5, "holdout"))], cols, slip="voltage|back-EMF", outside=True, also={"back_emf"})
    w.d.emf = {n: (1.08 * s, 1.08 * c) for n, (s, c) in w.d.emf.items()}
    w.bound = False
    return w


def scope(r, same_start):
    """Torque over time at a steady speed, no angle."""
    d = motor(r)
    d.emf = {1: (d.k, 0.0)}
    m, b = d.copy(), bench(r, d)
    d.cog = {}
    w = World(d, m, {"cogging": {}}, bound=False, outside=not same_start, also={"cogging"} if not same_start else set())
    for j, (share, speed) in enumerate([(0, .3), (.5, .3), (1, .3), (.7, .3)]):
        q = run(m, r, share, 0, speed, turns=8)
        q["th0"], q["t"] = (.4 if same_start else q["th0"]), np.arange(q["n"]) * q["T"] / q["n"]
        w.add(f"scope{j}", record(m, b, q, r), [("time_ms", "t", 1e3), ("speed_rpm", "rpm"), ("id_A", "id"), ("iq_A", "iq"), ("torque_Nm", "T")], "holdout" if j == 3 else "fit")
    return w


@kind
def scope_trigger(r):
    """Each capture is triggered by the same index: unknown cogging, phases from that index."""
    return scope(r, True)


@kind
def scope_free_running(r):
    """Captures that begin anywhere: cogging of no common phase."""
    return scope(r, False)


@kind
def open_phase(r):
    """Runs with phase c open beside usual ones; a harmonic of the back-EMF is wrong."""
    def vary(m, j):
        return dict(abc=lambda t, th: .5 * m.amps * np.sin(th + .5) * np.array([1, -1, 0])[:, None]) if j in (3, 6, 7) else {}
    return usual(r, hidden=("back_emf",), vary=vary)


@kind
def neutral_third(r):
    """A machine with a neutral conductor and a third harmonic in its currents; order 3 of the back-EMF is not declared."""
    def change(w, d, m, b):
        d.neutral = m.neutral = True
        m.emf[3] = (.08 * m.k, 0.0)
        w.hidden = {"back_emf": {"sine_3|zero_sine_3": .08 * m.k}}
    return usual(r, change=change, vary=lambda m, j: dict(inject=[(3, 0, .15 * m.amps * (j % 3))]))


# Wrong machines and files.

@kind
def wrong_motor(r):
    """Recordings of another motor of the same pole pairs."""
    def change(w, d, m, b):
        o = motor(r, m.p)
        w.d.k, w.d.emf, w.d.cog = m.k * 1.35, {n: (1.35 * m.k / o.k * s, 0.0) for n, (s, c) in o.emf.items()}, {n: (-2 * s, 2 * c) for n, (s, c) in m.cog.items()}
        w.hidden = {"back_emf": {}, "cogging": {}}
    return usual(r, change=change, also={"torque_gain", "magnet_temperature"})


@kind
def wrong_pole_pairs(r):
    """The folder says poles for pole pairs."""
    def change(w, d, m, b):
        d.p = 2 * m.p
    return usual(r, change=change, outside=True, slip="pole", bound=False)


@kind
def wrong_torque_sign(r):
    """The torque of all recordings has the other sign."""
    return usual(r, cols=FULL[:-1] + [("torque_Nm", "T", -1)], outside=True, slip="sign", bound=False)


@kind
def wrong_unit(r):
    """The torque is in N·cm, its column says N·m."""
    return usual(r, cols=FULL[:-1] + [("torque_Nm", "T", 100)], outside=True, slip="100|unit|newton|N·cm|Ncm", bound=False)


@kind
def wrong_one_file(r):
    """In one of eight files two clamps were swapped."""
    w = usual(r, disagrees="run4.csv")
    w.runs = [(n, q, s.replace("ia_A,ib_A", "ib_A,ia_A", 1) if n == w.disagrees else s) for n, q, s in w.runs]
    return w


def mangled(name, f, hidden, plan=EIGHT, doc="", **k):
    """A usual bench of which each file is spoilt by f(text, random)."""
    def g(r):
        w = usual(r, plan, hidden=hidden, **k)
        w.runs = [(n, q, f(s, r)) for n, q, s in w.runs]
        return w
    g.__name__, g.__doc__ = name, doc
    return kind(g)


def cells(s, f):
    """The file with each row changed by f(row of strings, number)."""
    head, *rows = s.rstrip("\n").split("\n")
    return "\n".join([head] + [",".join(f(x.split(","), j)) for j, x in enumerate(rows)]) + "\n"


def holes(s, r):
    n, at = s.count("\n"), {}
    for j in r.choice(np.arange(3, n - 3), n // 100, replace=False):
        at[j] = (int(r.integers(7)), str(r.choice(["", "NaN", "nan", "#DIV/0!"])))
    s = cells(s, lambda x, j: [at[j][1] if a == at[j][0] else v for a, v in enumerate(x)] if j in at else x)
    return s[:-int(r.integers(5, 40))]


mangled("coarse_clock", lambda s, r: cells(s, lambda x, j: ["%.3f" % float(x[0])] + x[1:]), ("friction", "offset_angle"), TWELVE)
mangled("jitter", lambda s, r: cells(s, lambda x, j: ["%.6f" % (float(x[0]) + r.uniform(0, 1e-3))] + x[1:]), ("friction", "back_emf"), TWELVE, n=1500)
mangled("holes", holes, ("offset", "back_emf"))
mangled("typed_torque", lambda s, r: cells(s, lambda x, j: x[:-1] + ["1.25"]), (), outside=True, refusal=True, bound=False)
mangled("electrical_wrapped", lambda s, r: s, ("friction", "offset_angle"), TWELVE, cols=[("time_s", "t"), ("theta_e_rad", "wrapped")] + FULL[3:])


@kind
def zero_creeps(r):
    """The zero of the torque sensor creeps by three times the noise in each run."""
    def change(w, d, m, b):
        b.drift = 3 * b.sT / (2 * PI * 12.3 / (.5 * m.speed))
        w.hidden = {"torque_drift": {"rate": b.drift}}
    return usual(r, [(a, g, .5 * np.sign(s), q) for a, g, s, q in TWELVE], change=change)


# What no catalogue has. Fair is that something is not known.

def outside(name, doc, plan=EIGHT, **k):
    def deco(change):
        def f(r):
            return usual(r, plan, change=lambda w, d, m, b: change(r, w, d, m, b), outside=True, bound=False, **k)
        f.__name__, f.__doc__ = name, doc
        kind(f)
        return change
    return deco


@outside("out_backlash", "The encoder sits behind a coupling with play: its angle jumps with the sign of the torque.")
def _(r, w, d, m, b):
    b.backlash = .06


@outside("out_compressed_currents", "Current sensors that compress: 6 % less at the rated current.", also={"current_gain"})
def _(r, w, d, m, b):
    b.cubic = .06 / m.amps ** 2


@outside("out_bent_torque_sensor", "A torque sensor that is not linear: 5 % of the square.")
def _(r, w, d, m, b):
    b.bend = .05 / m.rated


@outside("out_zero_each_run", "The torque sensor was zeroed anew, with something on the shaft, before each run.", vary=lambda m, j: dict(
    zero=m.rated * [.03, -.02, .04, -.05, .01, -.03, .05, .02][j]))
def _(r, w, d, m, b):
    pass


@outside("out_unlogged_heat", "The magnets get warm and nobody logs it: 0 to 9 % less torque, run by run.", vary=lambda m, j: dict(
    temp=20 + [0, 10, 75, 30, 5, 60, 40, 85][j]), also={"magnet_temperature", "back_emf"})
def _(r, w, d, m, b):
    m.alpha = -.0011


@outside("out_rub", "The rotor rubs at one place of the turn, against the motion.", TWELVE, also={"friction"})
def _(r, w, d, m, b):
    m.drag.append(lambda s: .06 * m.rated * np.sign(s.w) * np.exp(-(np.sin((s.thm - 1) / 2) / .08) ** 2))


@outside("out_belt", "A belt of its own frequency, in no ratio to the turn.", slip="turn|swing|Hz|repeat")
def _(r, w, d, m, b):
    b.belt = (3 * b.sT, .3717)


@outside("out_rub_and_offset", "The same with an error of a current sensor, which can be known.", TWELVE, hidden=("offset",), also={"friction"})
def _(r, w, d, m, b):
    m.drag.append(lambda s: .06 * m.rated * np.sign(s.w) * np.exp(-(np.sin((s.thm - 1) / 2) / .08) ** 2))
