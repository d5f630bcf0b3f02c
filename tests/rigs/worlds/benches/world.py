"""Worlds of recorded permanent-magnet motors with something hidden in them.

Each kind is a bench that people really have: a thesis with two current clamps, a repair shop, a generator behind a
gearbox, a gimbal, a joint behind a harmonic drive, a coast-down with a flywheel, a wrench on a blocked rotor, an
oscilloscope, a field solver's export. `make(kind, seed)` returns a `World`: the declared machine, the recordings, what is
hidden, and the plant that made them. All equations are this file's own; `python world.py` checks them (energy, periodicity).

Conventions: theta = p theta_m; e_s = sum S sin n(theta - s 2pi/3) + C cos n(theta - s 2pi/3); i_a = i_q sin theta - i_d cos theta.
"""
import sys
import numpy as np
from plant import KINDS, LAG, NS, PI, inductance, motor, park, phases, salient, iron, through
from benches import coasting, free
import more  # noqa: F401 (fills the registry)

def make(name, seed):
    """The world of a kind and a seed."""
    return KINDS[name](np.random.default_rng([seed, sum(ord(c) * (j + 7) for j, c in enumerate(name))]))


def self_check():
    """Energy and periodicity of the plant; raises where they fail."""
    r = np.random.default_rng(5)
    m = iron(r, salient(r, motor(r, 4)))
    th, h = np.linspace(0, 2 * PI, 97)[:-1], 1e-4
    i = phases(-.3 * m.amps, .8 * m.amps, th) + .1 * m.amps * np.sin(5 * th + LAG)
    st = lambda x, c: NS(th=x, thm=x / m.p, i=c, id=park(c, x)[0], iq=park(c, x)[1], temp=20 + 0 * x, w=0 * x)

    def co_energy(x):
        """Flux of the magnets, inductances, iron and cogging; torque is its slope at constant phase currents."""
        lam = sum(-s / n * np.cos(n * (x - LAG)) + c / n * np.sin(n * (x - LAG)) for n, (s, c) in m.emf.items()) / m.p
        cog = sum(-s / n * np.cos(n * x) + c / n * np.sin(n * x) for n, (s, c) in m.cog.items()) / m.p
        d, q = park(i, x)
        return (lam * i).sum(0) + .5 * np.einsum("an,nab,bn->n", i, inductance(m, x), i) + m.co_energy(d, q, x) + cog
    slope = m.p * (co_energy(th + h) - co_energy(th - h)) / (2 * h)
    assert np.abs(slope - m.torque(st(th, i))).max() < 1e-5 * m.rated, "torque is not the slope of the co-energy"
    assert np.abs(m.torque(st(th + 2 * PI * m.p, i)) - m.torque(st(th, i))).max() < 1e-9 * m.rated, "not periodic"
    d, m, _ = coasting(r, .3, "linear")
    x, w, work = free(m, m.inertia, m.speed, 1.0, 1000)
    pot = -sum(-s / n * np.cos(n * m.p * x) + c / n * np.sin(n * m.p * x) for n, (s, c) in m.cog.items()) / m.p
    e = .5 * m.inertia * w ** 2 + pot + work
    assert np.ptp(e) < 1e-5 * e[0], "energy of the coast-down is not kept"
    f = lambda t: np.sin(40 * t)[None]
    t = np.arange(4000) * 1e-3
    y = through(f, t, lambda p: 1 / (1 + .02 * p), .5)[0]
    assert np.abs(y - (np.sin(40 * t) - .8 * np.cos(40 * t)) / 1.64).max() < 2e-3, "filter"
    print("self check: torque is the slope of the co-energy, periodic; energy is kept; filters are right;", len(KINDS), "kinds")


if __name__ == "__main__":
    self_check()
    for k in sys.argv[1:]:
        name, _, seed = k.partition(":")
        w = make(name, int(seed or 1))
        w.write(f"{name}_{seed or 1}")
        print(name, w.hidden)
