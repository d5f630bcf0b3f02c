"""FMUs of hci-solve in FMPy, against hci-solve simulate.

    imported.py HCI_SOLVE DATA     in a folder that may be written
"""
import csv
import json
import os
import shutil
import subprocess
import sys

import fmpy
import fmpy.fmi2
import fmpy.fmi3
import fmpy.validation
import numpy

PROGRAM, DATA = sys.argv[1:3]
TOLERANCE = 1e-9


def hci_solve(*words):
    subprocess.run([PROGRAM, *words, "-q"], check=True)


def export(machine, name, *words):
    """An FMU, validated."""
    hci_solve("export-fmu", machine, "-o", name, *words)
    problems = fmpy.validation.validate_fmu(name)
    assert not problems, problems
    return name


class Slave:
    """An instance, with values by their names."""

    def __init__(self, name, instance="one"):
        self.description = fmpy.read_model_description(name)
        self.folder = fmpy.extract(name)
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.is_3 = self.description.fmiVersion.startswith("3")
        make = fmpy.fmi3.FMU3Slave if self.is_3 else fmpy.fmi2.FMU2Slave
        self.fmu = make(guid=self.description.guid, modelIdentifier=self.description.coSimulation.modelIdentifier,
                        unzipDirectory=self.folder, instanceName=instance)
        self.fmu.instantiate()

    def begin(self, **values):
        """Into the initialization."""
        if self.is_3:
            self.fmu.enterInitializationMode(startTime=0.0)
        else:
            self.fmu.setupExperiment(startTime=0.0)
            self.fmu.enterInitializationMode()
        self.set(**values)
        self.time_s = 0.0

    def start(self, **values):
        self.begin(**values)
        self.fmu.exitInitializationMode()

    def set(self, **values):
        for name, value in values.items():
            variable = self.variables[name]
            kind = {"Float64": "Float64", "Real": "Real", "Boolean": "Boolean",
                    "Int32": "Int32", "Integer": "Integer"}[variable.type]
            getattr(self.fmu, "set" + kind)([variable.valueReference], [value])

    def get(self, *names):
        references = [self.variables[name].valueReference for name in names]
        return numpy.array(self.fmu.getFloat64(references) if self.is_3 else self.fmu.getReal(references))

    def step(self, duration_s):
        self.fmu.doStep(self.time_s, duration_s)
        self.time_s += duration_s

    def restored(self, kept):
        """A state from its bytes."""
        return (self.fmu.deserializeFMUState if self.is_3 else self.fmu.deSerializeFMUstate)(kept)

    def end(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


# ---- trajectories

def write_scenario(name, **values):
    with open(name, "w") as file:
        file.write("name,value\n" + "".join(f"{key},{value}\n" for key, value in values.items()))
    return name


def simulated(machine, **values):
    """Every step of a simulation, by column."""
    scenario = write_scenario("scenario.csv", **values, trajectory_every=1)
    hci_solve("simulate", machine, scenario, "-o", "simulated")
    with open("simulated/trajectory.csv") as file:
        rows = list(csv.reader(file))
    return dict(zip(rows[0], numpy.array(rows[1:], dtype=float).T))


def differences(slave, trajectory, inputs, columns, step_s, every=1):
    """Largest differences over a trajectory whose inputs are played, as a share of the largest value."""
    most = dict.fromkeys(columns, 0.0)
    count = len(trajectory["time_s"]) - 1
    for k in range(0, count + 1, every):
        slave.set(**{name: trajectory[column][k] for name, column in inputs.items()})
        for (name, column), value in zip(columns.items(), slave.get(*columns)):
            difference = value - trajectory[column][k]
            if name == "angle":  # wrapped in the file
                difference = (difference + numpy.pi) % (2 * numpy.pi) - numpy.pi
            most[name] = max(most[name], abs(difference))
        if k < count:
            slave.step(every * step_s)
    return {name: most[name] / max(abs(trajectory[column]).max(), 1e-12) for name, column in columns.items()}


VOLTAGES = {"va": "va_V", "vb": "vb_V", "vc": "vc_V", "load_torque": "load_torque_Nm"}
CURRENTS = {"ia_imposed": "ia_A", "ib_imposed": "ib_A", "ic_imposed": "ic_A"}
TRUE = {"torque": "torque_Nm", "speed": "speed_rad_per_s", "angle": "theta_m_rad", "ia": "ia_A", "ib": "ib_A", "ic": "ic_A",
        "id": "id_A", "iq": "iq_A"}


def with_sensors(trajectory):
    """Names of the true and of the measured columns, where sensors stand between."""
    columns = {name: column.replace("_Nm", "_true_Nm").replace("_A", "_true_A").replace("_rad", "_true_rad", 1)
               for name, column in TRUE.items()}
    return {name: column for name, column in columns.items() if column in trajectory}


def check(what, share):
    worst = max(share, key=share.get)
    print(f"{what}: largest difference {share[worst]:.2g} of the largest value ({worst})")
    assert share[worst] <= TOLERANCE, share


STEP_s = 1e-5


def check_voltages(version):
    """A loaded start of machine C under current control, its voltages played to the FMU."""
    name = export(f"{DATA}/machine_c", f"voltages_{version}.fmu", "--fmi", version)
    trajectory = simulated(f"{DATA}/machine_c", duration=0.03, torque_reference=6, load_torque=2, current_control="pi")
    slave = Slave(name)
    slave.start()
    check(f"FMI {version}, voltages", differences(slave, trajectory, VOLTAGES, TRUE, STEP_s))
    slave.end()
    return name, trajectory


def check_currents(version):
    name = export(f"{DATA}/machine_a", f"currents_{version}.fmu", "--fmi", version, "--inputs", "currents")
    shutil.copy(f"{DATA}/drive/machine_a_currents.csv", ".")
    step_s = 2e-5
    trajectory = simulated(f"{DATA}/machine_a", duration=0.02, step=step_s, prescribed_speed=157.07963267948966,
                           current_control="ideal", currents="machine_a_currents.csv")
    slave = Slave(name)
    slave.start(speed_is_prescribed=True, speed_prescribed=157.07963267948966, step=step_s)
    check(f"FMI {version}, currents", differences(slave, trajectory, CURRENTS, TRUE, step_s))
    slave.end()


EFFECTS = """effect,parameter,value,unit,std_error
cogging,sine_18,0.05,Nm,
saturation,d1q2_cosine_0,-0.4,Nm,
saturation,reference_current,8,A,
phase_imbalance,a,0.02,1,
magnet_temperature,emf_per_kelvin,-0.001,1/K,
friction,coulomb,0.2,Nm,
friction,viscous,0.001,Nms_per_rad,
current_gain,b,0.03,1,
current_offset,c,0.05,A,
position_offset,angle,0.02,rad,
channel_delay,current,0.000025,s,
"""


def check_effects(version):
    """Effects on machine and sensors: with a delay, the readings have a memory."""
    shutil.copytree(f"{DATA}/machine_c", "effects", dirs_exist_ok=True)
    with open("effects/effects.csv", "w") as file:
        file.write(EFFECTS)
    name = export("effects", f"effects_{version}.fmu", "--fmi", version)
    trajectory = simulated("effects", duration=0.03, torque_reference=6, load_torque=2, current_control="pi",
                           magnet_temperature=80)
    slave = Slave(name)
    slave.start(magnet_temperature=80.0)
    measured = {"ia_measured": "ia_A", "ib_measured": "ib_A", "ic_measured": "ic_A", "speed_measured": "speed_rad_per_s"}
    check(f"FMI {version}, effects, true", differences(slave, trajectory, VOLTAGES, with_sensors(trajectory), STEP_s))
    slave.fmu.reset()
    slave.start(magnet_temperature=80.0)
    check(f"FMI {version}, effects, measured, after a reset", differences(slave, trajectory, VOLTAGES, measured, STEP_s))
    slave.end()
    return name


# ---- instances and states

def play(slave, trajectory, first, last):
    for k in range(first, last):
        slave.set(**{name: trajectory[column][k] for name, column in VOLTAGES.items()})
        slave.step(STEP_s)
    return slave.get(*TRUE, "ia_measured", "torque_measured")


def check_states(name, trajectory):
    """Two instances at once, a state taken and given back, as bytes into the other one too; twice the same."""
    one, two = Slave(name), Slave(name, "two")
    one.start()
    two.start(angle_start=0.3)
    at_100 = play(one, trajectory, 0, 100)
    other = play(two, trajectory, 0, 100)
    assert (at_100 != other).any()
    state = one.fmu.getFMUState()
    at_200 = play(one, trajectory, 100, 200)
    one.fmu.setFMUState(state)
    assert (one.get(*TRUE, "ia_measured", "torque_measured") == at_100).all()
    assert (play(one, trajectory, 100, 200) == at_200).all()
    kept = one.fmu.serializeFMUState(state)
    two.fmu.setFMUState(two.restored(kept))
    assert (play(two, trajectory, 100, 200) == at_200).all()
    one.end()
    two.end()
    again = Slave(name)
    again.start()
    assert (play(again, trajectory, 0, 100) == at_100).all()
    again.end()
    print(f"{name}: two instances, states, and instantiated again: the same to the bit")


def check_refusals(name):
    slave = Slave(name)
    slave.start()
    for wrong in (lambda: slave.set(inertia=1.0), lambda: slave.set(torque=1.0), lambda: slave.step(-1.0),
                  lambda: slave.step(0.0), lambda: slave.step(float("inf")), lambda: slave.step(float("nan")), lambda: slave.step(1e9),
                  lambda: slave.set(va=float("nan"))):
        try:
            wrong()
        except Exception:
            continue
        raise AssertionError("not refused")
    slave.end()
    try:
        slave = Slave(name)
        slave.start(step=0.0)
    except Exception:
        pass
    else:
        raise AssertionError("a step of 0 is not refused")
    slave.fmu.freeInstance()


# ---- machine and controller wired together

WIRES = {"ia": "ia_measured", "ib": "ib_measured", "ic": "ic_measured", "angle": "angle_measured", "speed": "speed_measured"}
PHASES = ("va", "vb", "vc")


def wired(machine, controller, duration_s, step_s):
    """Torque, angle and the largest line voltage at each step. Outputs of both are taken at the same instant, then both
    step: no order between the two."""
    torque, angle, voltage = [], [], []
    for _ in range(round(duration_s / step_s) + 1):
        read = machine.get(*WIRES.values())
        volts = controller.get(*PHASES)
        controller.set(**dict(zip(WIRES, read)))
        machine.set(**dict(zip(PHASES, volts)))
        values = machine.get("torque", "angle_electrical")
        torque.append(values[0])
        angle.append(values[1])
        voltage.append(max(volts) - min(volts))
        machine.step(step_s)
        controller.step(step_s)
    return numpy.array(torque), numpy.unwrap(angle), numpy.array(voltage)


def figures(torque, angle, voltage, settle_s, step_s):
    """As `simulate` has them: over whole electrical turns after settle_s, means by trapezoids in time."""
    first = int(numpy.ceil(settle_s / step_s - 0.5))
    torque, angle, volts = torque[first:], angle[first:] - angle[first], voltage[first:]
    turns = numpy.floor(angle[-1] / (2 * numpy.pi) + 1e-9)
    last = numpy.searchsorted(angle, turns * 2 * numpy.pi * (1 - 1e-12) - 1e-9) - 1
    share = (turns * 2 * numpy.pi - angle[last]) / (angle[last + 1] - angle[last])
    late = 0.5 * share * share

    def mean(x):
        whole = (x[:last] + x[1:last + 1]).sum() / 2 + (share - late) * x[last] + late * x[last + 1]
        return whole / (last + share)

    mean_Nm, swing = mean(torque), torque[:last + 1].max() - torque[:last + 1].min()
    deviation = numpy.sqrt(mean((torque - mean_Nm) ** 2))
    return {"mean_Nm": mean_Nm, "T_ripple": 100 * swing / mean_Nm, "F_ripple": 100 * deviation / mean_Nm, "peak_line_V": volts.max()}


def check_pair(pair, drive, remedy, compared=("mean_Nm", "T_ripple", "F_ripple", "peak_line_V"), of_machine={}, **of_controller):
    """A drive of machine A at 300 rpm: what `simulate --table` says of the same tables in the same loop."""
    speed = 300 * numpy.pi / 30
    said = json.loads(subprocess.run([PROGRAM, "simulate", f"{DATA}/machine_a", "--table", "solved", "--drive", drive, "--speeds", "300",
                                      "--json", "-q"], check=True, capture_output=True).stdout)
    known = next(entry for entry in said["speeds"][0]["remedies"] if entry["remedy"] == remedy)
    settle_s, step_s = 12 * 0.5e-3 / 0.1 + 200e-4, 1e-5
    machine, controller = Slave(pair[0]), Slave(pair[1])
    machine.begin(speed_is_prescribed=True, speed_prescribed=speed, **of_machine)
    controller.begin(remedy=["table", "lead", "compensation", "feedforward"].index(remedy) + 1, torque_reference=said["torque_Nm"],
                     **of_controller)
    controller.set(**dict(zip(WIRES, machine.get(*WIRES.values()))))
    machine.fmu.exitInitializationMode()
    controller.fmu.exitInitializationMode()
    got = figures(*wired(machine, controller, settle_s + max(0.2, 2.02 * 2 * numpy.pi / speed), step_s), settle_s, step_s)
    check(f"{pair[0]}, {pair[1]}, {os.path.basename(drive)}, {remedy}, T_ripple {got['T_ripple']:.6g} %",
          {name: abs(got[name] - known[name]) / abs(known[name]) for name in compared})
    machine.end()
    controller.end()


def check_pairs():
    hci_solve("solve", f"{DATA}/machine_a", "--target", f"{DATA}/scenarios/02/target.csv", "--auto", "-o", "solved")
    drive = f"{DATA}/drive/machine_a_10kHz.csv"
    machine = export(f"{DATA}/machine_a", "machine.fmu", "--drive", drive)
    controller = {version: export(f"{DATA}/machine_a", f"controller_{version}.fmu", "--table", "solved", "--drive", drive, "--fmi", version)
                  for version in ("2", "3")}
    check_pair((machine, controller["2"]), drive, "table")
    check_pair((machine, controller["3"]), drive, "feedforward")
    with open(drive) as file, open("worse.csv", "w") as worse:  # dead time, an encoder, coarse currents
        worse.write(file.read() + "dead_time,2,us,\ndead_time_crossing,0.2,A,\ndead_time_compensation,1,,\n"
                    "current_quantum,20,mA,\nencoder_counts,4096,,\n")
    dead_time = {"dead_time_voltage": 100 * 2e-6 / 1e-4, "dead_time_crossing": 0.2}
    # The voltage is compared in front of the dead time alone.
    check_pair((machine, controller["2"]), "worse.csv", "compensation", ("mean_Nm", "T_ripple", "F_ripple"), dead_time,
               current_quantum=0.02, encoder_counts=4096.0, **dead_time)


check_pairs()
for version in ["2", "3"]:
    voltages, played = check_voltages(version)
    check_states(voltages, played)
    check_refusals(voltages)
check_currents("2")
effects = check_effects("2")
check_states(effects, played)
