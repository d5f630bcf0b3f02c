"""Machines of several kinds, drawn by seed, and what a bench records of them. Equations written for this page alone: a co-energy, its torque by
complex steps, and nothing of the library. Angles are those of the program: e = e_1 sin(theta), i_d against the magnets' axis."""
import csv, os, subprocess
import numpy as np

H = 1e-20


def park(i, theta):
    s = [theta - 2 * np.pi * k / 3 for k in range(3)]
    return -2 / 3 * sum(i[k] * np.cos(s[k]) for k in range(3)), 2 / 3 * sum(i[k] * np.sin(s[k]) for k in range(3))


def phases(d, q, theta):
    return [-d * np.cos(theta - 2 * np.pi * k / 3) + q * np.sin(theta - 2 * np.pi * k / 3) for k in range(3)]


class Plant:
    """One machine of a kind. e: orders of the back-EMF, N·m/A and phase; c: of the cogging torque, N·m and phase; L: (d, q) in H; saturation: None or
    the law's two currents; ripple: of the inductances, (part, order, H, phase); declared: which of all that the sheet says."""

    def __init__(self, kind, seed):
        r = self.random = np.random.default_rng([seed, sum(map(ord, kind))])
        self.kind, self.p = kind, int(r.integers(2, 6))
        self.rated_A, self.K = 8.0, 0.3 * np.exp(r.uniform(-0.5, 0.5))
        mirror = kind in ('mirror', 'iron')
        phase = (lambda: np.pi * r.integers(0, 2)) if mirror else (lambda: r.uniform(-np.pi, np.pi))
        self.e = {n: (self.K * a * np.exp(r.uniform(-0.7, 0.7)), phase()) for n, a in ((5, 0.02), (7, 0.012), (11, 0.006), (13, 0.004))}
        rated = 1.5 * self.K * self.rated_A
        self.c = {n: (rated * a * np.exp(r.uniform(-0.7, 0.7)), phase()) for n, a in ((6, 0.02), (12, 0.007), (18, 0.002))}
        self.psi = self.K / self.p       # V·s: T = 3/2 p psi i_q
        self.L, self.ripple, self.saturation = (5.8e-3, 5.8e-3), [], None
        scale = self.psi / 0.105
        if kind in ('salient', 'ipm', 'iron'):
            self.L = (5.8e-3 * scale, 9.6e-3 * scale)
            q = 0.0 if mirror else None
            angle = lambda usual: usual if mirror else r.uniform(-np.pi, np.pi)
            size = lambda x: x * scale * np.exp(r.uniform(-0.7, 0.7))
            self.ripple = [('qq', 6, size(0.11e-3), angle(0.0)), ('dd', 6, size(0.07e-3), angle(np.pi)), ('dq', 6, size(0.05e-3), angle(-np.pi / 2)),
                           ('qq', 12, size(0.02e-3), angle(0.0))]
        if kind in ('ipm', 'iron'):
            self.saturation = (26.0 * np.exp(r.uniform(-0.3, 0.3)), 14.0, 0.035 * np.exp(r.uniform(-0.7, 0.7)))
        self.friction = (0.01 * rated, 2e-4 * rated)
        self.magnets = 1 + 0.01 * r.uniform(-1, 1)   # beside the sheet

    def coenergy(self, d, q, theta):
        """W'/(3/2), by electrical angle."""
        w = 0.5 * self.L[0] * d ** 2
        if self.saturation:
            i0, i1, share = self.saturation
            w = w + 0.5 * self.L[1] * i0 ** 2 * np.log(1 + (q / i0) ** 2) + self.psi * d * (1 - share * (q / 8) ** 2 / (1 + (q / i1) ** 2))
        else:
            w = w + 0.5 * self.L[1] * q ** 2 + self.psi * d
        fades = 1 / (1 + (q / 18) ** 2) if self.saturation else 1.0
        for part, n, x, a in self.ripple:
            i = {'dd': 0.5 * d * d, 'dq': d * q, 'qq': 0.5 * q * q * fades}[part]
            w = w + x * i * np.cos(n * theta + a)
        return w

    def torque(self, d, q, theta):
        by = lambda a, b, t: np.imag(self.coenergy(a, b, t)) / H
        turn = by(d, q + 1j * H, theta) * -d + by(d + 1j * H, q, theta) * q
        sum_Nm = 1.5 * self.p * (turn * self.magnets + by(d, q, theta + 1j * H))
        i = phases(d, q, theta)
        for n, (a, ph) in self.e.items():
            for k in range(3):
                sum_Nm = sum_Nm + i[k] * a * np.sin(n * (theta - 2 * np.pi * k / 3) + ph)
        return sum_Nm + sum(a * np.sin(n * theta + ph) for n, (a, ph) in self.c.items())

    # ---- what the engineer has ----

    def points(self):
        """(i_q, i_d, rpm, role) of each recording."""
        if self.kind in ('servo', 'mirror'):
            return [(0, 0, 60, 'fit'), (2.7, 0, 60, 'fit'), (5.3, 0, -60, 'fit'), (8, 0, 60, 'fit'), (4, 0, 300, 'holdout')]
        no = [(0, 0, s, 'fit') for s in (60, -60, 300, -300)]
        load = [(2.5, 0), (5, -2.5), (8, 0), (7, -4)]
        return no + [(q, d, s, 'holdout' if (k, s) == (1, 300) else 'fit') for k, (q, d) in enumerate(load) for s in ((-60 if k == 1 else 60), (-300 if k == 3 else 300))]

    def record(self, program, folder, noise):
        os.makedirs(f'{folder}/runs', exist_ok=True)
        rated = 1.5 * self.K * self.rated_A
        ld, lq = (f'{x:.6g}' for x in self.L)
        subprocess.run([program, 'init', f'{folder}/machine', '--pole-pairs', str(self.p), '--flux', f'{self.psi:.9g}', '--resistance', '0.95', '--rated-current', str(self.rated_A),
                        '--rated-torque', f'{rated:.6g}', '--inductance-d', ld, '--inductance-q', lq, '--quiet'], check=True)
        lists = ['file,role']
        for at, (q, d, rpm, role) in enumerate(self.points()):
            n = 1200
            t = np.arange(n) * 3 * 60 / abs(rpm) / n
            theta_m = 1.234 + rpm * 2 * np.pi / 60 * t
            theta, r = self.p * theta_m, self.random
            e = 0.0 if q == 0 and d == 0 else 0.02
            a, b = d + e * np.sin(6 * theta + 0.4), q + e * np.cos(6 * theta + 1)
            torque = self.torque(a, b, theta) - self.friction[0] * np.sign(rpm) - self.friction[1] * rpm * 2 * np.pi / 60 + r.normal(0, noise * rated, n)
            i = [x + r.normal(0, 0.01, n) for x in phases(a, b, theta)]
            np.savetxt(f'{folder}/runs/{at}.csv', np.column_stack([t, theta_m, *i, torque]), delimiter=',', fmt='%.8g', comments='',
                       header='time_s,theta_m_rad,ia_A,ib_A,ic_A,torque_Nm')
            lists.append(f'runs/{at}.csv,{role}')
        with open(f'{folder}/runs.csv', 'w') as f: f.write('\n'.join(lists) + '\n')
        for name, share in (('half', 0.5), ('most', 0.9)):
            with open(f'{folder}/{name}.csv', 'w') as f: f.write(f'order,amplitude_Nm,phase_rad\n0,{share * rated:.6g},{np.pi / 2:.9g}\n')

    def made_by(self, waveform):
        """Peak to peak and mean of the true torque with the currents of a solution."""
        with open(waveform) as f: rows = list(csv.DictReader(f))
        theta = np.array([float(r['theta_e_rad']) for r in rows])
        d, q = park([np.array([float(r[f'i{x}_A']) for r in rows]) for x in 'abc'], theta)
        torque = self.torque(d, q, theta)
        return np.ptp(torque), torque.mean()
