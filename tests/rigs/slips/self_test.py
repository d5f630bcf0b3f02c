"""Does the bench keep the laws of physics? Nothing of the program is used. Usage: self_test.py [MOTORS]

Voltage and torque are compared with derivatives of flux linkage and co-energy, taken numerically from the tables that are written;
the power balance with the stored energy; the recordings, after their sensors, with the power balance over a run. Motors with a
broken equation have to fail (the controls), each slip has to show, and in the files that it names alone.
"""

import math
import random
import sys

import bench
import relations
import score
import slips
from motor import PHASE, TURN, Motor, dot, draw

STEP = 1e-5  # of the mechanical angle and of time by the turn


def flux_Wb(motor, theta_m, i):
    """lambda_s of magnets and currents; e = d(lambda)/d(theta_m), so that a harmonic is -E / (mu p) cos."""
    p = motor.pole_pairs
    magnets = [-motor.magnet_scale * sum(E / (mu * p) * math.cos(mu * (p * theta_m - s) + g) for mu, E, g in motor.emf) for s in PHASE]
    L = inductances(motor, p * theta_m)
    return [magnets[k] + dot(L[k], i) for k in range(3)]


def inductances(motor, theta):
    """3 x 3 from (L_d + L_q)/2 and (L_d - L_q)/2: another form than that of motor.py."""
    c6 = motor.inductance_6 * math.cos(6 * theta)
    mean, half = (motor.L_d + motor.L_q) / 2, (motor.L_d - motor.L_q) / 2 + c6
    return [[2 / 3 * (mean * math.cos(a - b) + half * math.cos(2 * theta - a - b)) + motor.inductance_0 / 3 for b in PHASE] for a in PHASE]


def stored_J(motor, theta_m, i):
    """Of the currents; what the magnets and teeth store comes back over a period, as cogging."""
    L = inductances(motor, motor.pole_pairs * theta_m)
    return 0.5 * dot(i, [dot(row, i) for row in L])


def slope(f, x, step):
    """Fourth-order difference of a list or a number."""
    pairs = zip(f(x + 2 * step), f(x + step), f(x - step), f(x - 2 * step))
    return [(-a + 8 * b - 8 * c + d) / (12 * step) for a, b, c, d in pairs]


def law_errors(motor, shaft, currents, t):
    """Relative errors of voltage, torque and power at a time."""
    p, R = motor.pole_pairs, motor.resistance * motor.resistance_scale
    step = STEP * TURN / abs(shaft.omega_m)
    theta_m, omega_m, i, v, torque = bench.truth_at(motor, shaft, currents, t)

    def flux_at(time):
        angle = shaft.at(time)[0]
        return flux_Wb(motor, angle, currents.at(p * angle)[0])

    def energy_at(time):
        angle = shaft.at(time)[0]
        return [stored_J(motor, angle, currents.at(p * angle)[0])]

    def coenergy_at(angle):
        return [dot(i, flux_Wb(motor, angle, [0, 0, 0])) + stored_J(motor, angle, i)]

    electric = [v[k] - R * i[k] - x for k, x in enumerate(slope(flux_at, t, step))]
    air_gap = slope(coenergy_at, theta_m, STEP)[0] + motor.cogging_Nm(p * theta_m)
    shaft_W = omega_m * (torque + motor.friction_Nm(omega_m) - motor.cogging_Nm(p * theta_m))
    power = dot(v, i) - R * dot(i, i) - shaft_W - slope(energy_at, t, step)[0]
    scale_V, scale_Nm = motor.k_e * abs(omega_m) + R * motor.rated_current_A, motor.ideal_torque_Nm
    return {"voltage": max(map(abs, electric)) / scale_V, "torque": abs(air_gap - torque - motor.friction_Nm(omega_m)) / scale_Nm,
            "power": abs(power) / (scale_Nm * abs(omega_m))}


def worst_errors(motor, rng):
    worst = {"voltage": 0.0, "torque": 0.0, "power": 0.0}
    for kind in ("back", "load", "brake", "reverse", "crawl"):
        share, i_d, i_q = bench.conditions(motor, rng, kind)
        omega_m = share * motor.rated_speed_rpm * TURN / 60
        shaft, currents = bench.Shaft(rng, omega_m, rng.uniform(-0.1, 0.1) * abs(omega_m)), bench.Currents(rng, i_d, i_q)
        for _ in range(10):
            errors = law_errors(motor, shaft, currents, rng.uniform(0, TURN / abs(shaft.omega_m)))
            worst = {law: max(worst[law], errors[law]) for law in worst}
    return worst


TOLERANCE = 1e-6  # differences of fourth order of orders up to 13 x 21 with this step are good to some 1e-8


# Controls: each breaks one equation, and the laws that have to notice.
class NoHalf(Motor):
    def torque_Nm(self, theta, i):
        return dot(self.emf_Nm_per_A(theta), i) + dot(i, self.times_inductance_slope(theta, i)) + self.cogging_Nm(theta)


class ElectricalSlope(Motor):
    def times_inductance_slope(self, theta, x):
        return [y / self.pole_pairs for y in super().times_inductance_slope(theta, x)]


class ReluctanceSign(Motor):
    def inductances_dq(self, theta):
        L_d, L_q, slope_d, slope_q = super().inductances_dq(theta)
        return L_q, L_d, slope_d, slope_q


class EmfSign(Motor):
    def emf_Nm_per_A(self, theta):
        return [-x for x in super().emf_Nm_per_A(theta)]


class PowerInvariant(Motor):
    def times_inductance(self, theta, x):
        return [math.sqrt(1.5) * y for y in super().times_inductance(theta, x)]


def check_controls():
    failures = []
    for control in (NoHalf, ElectricalSlope, ReluctanceSign, EmfSign, PowerInvariant):
        rng = random.Random(1)
        motor = draw(rng, {"saliency": "high"})
        motor.inductance_6 = 0.02 * motor.L_d
        motor.__class__ = control
        errors = worst_errors(motor, rng)
        if max(errors.values()) < 100 * TOLERANCE:
            failures.append("control %s was not noticed: %s" % (control.__name__, errors))
    return failures


def check_laws(count):
    failures = []
    for seed in range(count):
        rng = random.Random("laws %d" % seed)
        errors = worst_errors(draw(rng, {}), rng)
        failures += ["motor %d: %s off by %.1e" % (seed, law, error) for law, error in errors.items() if error > TOLERANCE]
    return failures


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def check_recordings(count):
    """Over a run: v.i - R i^2 = (T + friction) omega. Gains of 2 % each, and the stored energy of an unfinished period, may be seen."""
    failures = []
    for seed in range(count):
        case = slips.Case("", random.Random("power %d" % seed), {}, ["load", "brake", "reverse"], dict(slips.ABC, theta="m"))
        motor = case.motor
        for path in [path for path in case.files if path.startswith("runs/")]:
            run = case.files[path]
            v, i = list(zip(*[run[n] for n in bench.VOLTAGES])), list(zip(*[run[n] for n in bench.CURRENTS]))
            electric = mean(dot(a, b) for a, b in zip(v, i))
            copper = motor.resistance * motor.resistance_scale * mean(dot(b, b) for b in i)
            omega_m = mean(run["speed_rad_per_s"])
            shaft = mean(run["torque_Nm"]) * omega_m + motor.friction_Nm(omega_m) * omega_m
            if abs(electric - copper - shaft) > 0.08 * (abs(shaft) + abs(copper)):
                failures.append("recording %d %s: %g W in, %g W of heat, %g W out" % (seed, path, electric, copper, shaft))
    return failures


def check_slips(seed):
    """Each changes the files that it names and no other, and shows in files that are in order without it."""
    failures = []
    for make, arguments in slips.seeded(seed):
        case = make(*arguments)
        correct = case.before
        failures += ["%s without its slip: %s" % (case.name, x) for x in relations.off(correct)]
        changed = {path.split("/")[1] for path in correct if case.files[path].text() != correct[path].text()}
        named = [set(truth.files) for truth in case.truths.values()]
        if not changed <= set().union(*named) or not all(changed & files for files in named):
            failures.append("%s changed %s" % (case.name, sorted(changed)))
        if not relations.off(case.files):
            failures.append("%s does not show" % case.name)
    return failures


def check_correct(count):
    return ["correct.%d: %s" % (seed, x) for seed in range(1, count + 1) for x in relations.off(slips.correct(seed).files)]


def check_comparison():
    """The comparison of answers made by hand with the truth: truths with what looks the same, (slip, probability, alternatives) found, outcome."""
    failures = []
    for truths, found, outcome in [
        ({"emf_rms": []}, [("emf_rms", 0.9, [])], "named"),
        ({"emf_rms": []}, [("emf_rms", 0.4, ["emf_line"])], "ambiguous"),
        ({"emf_rms": []}, [("emf_line", 0.4, ["emf_rms"])], "ambiguous"),
        ({"emf_rms": []}, [("emf_line", 0.6, ["emf_rms"])], "wrong"),
        ({"emf_rms": []}, [("emf_rms", 0.9, []), ("emf_line", 0.5, [])], "wrong"),
        ({"emf_rms": []}, [], "missed"),
        ({"emf_sign": ["angle_zero_d_axis"]}, [("angle_zero_d_axis", 0.5, ["emf_sign"])], "named"),
        ({"emf_sign": ["angle_zero_d_axis"]}, [("angle_zero_d_axis", 0.9, [])], "missed"),
        ({"emf_rms": [], "torque_sign": []}, [("emf_rms", 0.9, [])], "missed"),
        ({"emf_rms": [], "torque_sign": []}, [("emf_rms", 0.9, []), ("torque_sign", 0.9, [])], "named"),
    ]:
        case = slips.Case.__new__(slips.Case)
        case.truths = {name: slips.Truth([], None, alike) for name, alike in truths.items()}
        findings = [{"slip": name, "probability": p, "alternatives": alike} for name, p, alike in found]
        said = score.compare(case, score.Answer(1, {"findings": findings}, ""))
        if said != outcome:
            failures.append("compare says %s, not %s, of %s for %s" % (said, outcome, found, truths))
    return failures


def check_repeats(count):
    """The same seed gives the same bytes."""
    texts = [[table.text() for table in slips.correct(seed).files.values()] for seed in list(range(count)) * 2]
    return [] if texts[:count] == texts[count:] else ["a seed did not give the same files twice"]


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    failures = check_laws(count) + check_controls() + check_recordings(count) + check_slips(1) + check_correct(5 * count)
    failures += check_comparison() + check_repeats(5)
    for line in failures:
        print("FAILED: " + line)
    print("%d motors, 5 controls, %d slips and pairs: %d failures" % (count, len(slips.seeded(1)), len(failures)))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
