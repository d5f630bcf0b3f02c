#!/usr/bin/env python3
"""Inputs for the fuzz targets from data/ and tests/files: folders as text, each file behind a line `@@ NAME`.

seeds.py HCI_SOLVE OUT [--dictionary FILE]; runs in the source folder. OUT/TARGET/NAME is written for each target."""
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

DATA = pathlib.Path("data")
MACHINES = ["machine_a", "machine_b", "machine_c", "machine_c_saturated"]
MOST_BYTES = 6000  # a fuzzer is quick with small inputs


def packed(files):
    """files: {name: bytes or text}."""
    parts = []
    for name, text in files.items():
        parts.append(f"@@ {name}\n".encode() + (text if isinstance(text, bytes) else text.encode()))
    return b"\n".join(parts)


def shortened(path, rows=40):
    """The first rows of a long table."""
    lines = path.read_bytes().split(b"\n")
    return b"\n".join(lines[:rows]) + b"\n"


def folder(path, name):
    return {f"{name}/{p.name}": shortened(p, 60) for p in sorted(path.iterdir()) if p.suffix in (".csv", ".json")}


def small_machine(**more):
    """A machine of few rows, with numbers for a plant."""
    values = {"pole_pairs": "2,1", "emf_frequency": "50,Hz", "resistance": "0.5,ohm", "inductance_d": "2,mH",
              "inductance_q": "2,mH", "inertia": "0.001,kgm2", "rated_current": "10,A", "dc_link_voltage": "100,V"}
    values.update(more)
    return {"machine/machine.csv": "name,value,unit\n" + "".join(f"{k},{v}\n" for k, v in values.items()),
            "machine/back_emf.csv": "order,amplitude_V,phase_rad\n1,21.93,0\n5,-5.02,0\n7,4.8,0.1\n",
            "machine/cogging.csv": "order,amplitude_Nm,phase_rad\n6,0.0021,1.22\n12,0.3102,1.76\n"}


EFFECTS = """effect,parameter,value,unit,std_error
cogging,sine_6,0.01,Nm,0.001
cogging,cosine_6,0.02,Nm,
friction,coulomb,0.05,Nm,
friction,viscous,0.001,Nms/rad,
channel_delay,current,0.0001,s,
"""


def recording(rows, columns=("time_s", "theta_e_rad", "ia_A", "ib_A", "ic_A", "torque_Nm"), twist=0.0):
    """A slow turn of the small machine, of a few rows."""
    text = ",".join(columns) + "\n"
    for k in range(rows):
        angle = 6.2 * k / rows
        values = {"time_s": 0.001 * k, "theta_e_rad": angle, "theta_m_rad": angle / 2, "speed_rad_per_s": 31.0, "id_A": 0.1,
                  "iq_A": 4 + twist * math.sin(6 * angle), "va_V": 20 * math.sin(angle), "vb_V": 20 * math.sin(angle - 2.094),
                  "vc_V": 20 * math.sin(angle + 2.094), "ia_A": 4 * math.cos(angle), "ib_A": 4 * math.cos(angle - 2.094),
                  "ic_A": 4 * math.cos(angle + 2.094), "temperature_C": 25.0,
                  "torque_Nm": 0.84 + 0.3 * math.sin(12 * angle + 1.76) + twist * math.sin(6 * angle)}
        text += ",".join(f"{values[c]:.5g}" for c in columns) + "\n"
    return text


class Seeds:
    def __init__(self, program, out):
        self.program, self.out = program, out

    def add(self, target, name, files):
        path = self.out / target / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(files if isinstance(files, bytes) else packed(files))

    def made(self, *words):
        """A folder that the program writes. Exit code 1: not all of it is reached."""
        done = subprocess.run([str(self.program), *map(str, words), "--quiet"], stdout=subprocess.DEVNULL)
        if done.returncode > 1:
            sys.exit(f"seeds.py: exit code {done.returncode} of {words}")

    # ---- readers ----

    def csv(self):
        for path in sorted(pathlib.Path("tests/files/csv").iterdir()):
            if path.stat().st_size <= MOST_BYTES:
                self.add("fuzz_csv", path.name, path.read_bytes())

    def machine(self):
        for name in MACHINES:
            self.add("fuzz_machine", name, folder(DATA / name, "machine"))
        self.add("fuzz_machine", "effects", {**small_machine(), "machine/effects.csv": EFFECTS})
        self.add("fuzz_machine", "uncertainty", {
            **small_machine(), "machine/effects.csv": EFFECTS,
            "machine/uncertainty.csv": "effect,parameter,unit,value,machine_1,machine_2\ncogging,sine_6,Nm,0.01,0.001,-0.001\n",
            "machine/measured.csv": "file,least_id_A,most_id_A,least_iq_A,most_iq_A\na.csv,0,0,0,4\n"})

    def runs(self):
        columns = [("time_s", "theta_e_rad", "ia_A", "ib_A", "ic_A", "torque_Nm"), ("theta_m_rad", "id_A", "iq_A", "torque_Nm"),
                   ("time_s", "va_V", "vb_V", "vc_V"), ("time_s", "theta_m_rad", "iq_A"), ("time_s", "speed_rad_per_s", "iq_A")]
        for k, names in enumerate(columns):
            self.add("fuzz_runs", f"columns_{k}", {"runs.csv": "file,role\na.csv,fit\nb.csv,holdout\n",
                                                   "a.csv": recording(12, names), "b.csv": recording(8, names, 0.1)})
        self.add("fuzz_runs", "named", {"runs.csv": "file,role,test,columns\na.csv,fit,holding,torque_mNm=AI3\n",
                                        "columns.csv": "name,column\ntheta_e_deg,Angle\n",
                                        "a.csv": "Angle,AI3,iq_A\n0,1,2\n10,1,3\n20,2,3\n30,3,1\n"})

    def wanted(self):
        for path in sorted(DATA.glob("scenarios/*/*.csv")):
            self.add("fuzz_wanted", f"{path.parent.name}_{path.stem}", {path.name: shortened(path)})
        for path in sorted(DATA.glob("example_currents/*.csv")):
            self.add("fuzz_wanted", path.stem, {"currents.csv": path.read_bytes()})
        self.add("fuzz_wanted", "grid", {"grid.csv": "torque_Nm,speed_rpm,dc_link_V\n1,100,48\n2,200,48\n"})

    def drive(self):
        for path in sorted((DATA / "drive").glob("*.csv")):
            for name in ("drive.csv", "scenario.csv"):
                self.add("fuzz_drive", f"{path.stem}_{name}", {name: path.read_bytes()})
        loop = "frequency_Hz,gain_d,phase_d_rad,gain_q,phase_q_rad\n10,1,-0.1,1,-0.1\n50,1,-0.4,1,-0.4\n200,0.9,-1,0.9,-1\n1000,0.5,-2,0.5,-2\n"
        self.add("fuzz_drive", "response", {"drive.csv": "name,value,unit\ncurrent_sample_time,100,us\nresponse,loop.csv,\n", "loop.csv": loop})

    # ---- commands ----

    def results(self, work):
        """Folders of `solve`, tables and blobs of `emit`."""
        small = work / "small"
        for name, text in small_machine().items():
            path = work / "small" / pathlib.Path(name).name
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        target = DATA / "scenarios/02/target.csv"
        self.made("solve", small, "--target", target, "--auto", "2", "-o", work / "solved")
        names = ("currents.csv", "currents_per_Nm.csv", "currents_constant.csv", "spectrum.csv", "summary.json")
        whole = {f"results/{name}": (work / "solved" / name).read_bytes() for name in names}
        results = dict(list(whole.items())[:-1])  # with summary.json every changed table is refused by its checksum
        for k, options in enumerate(["", "--frame dq --points 16", "--format i16", "--format q15 --blob", "--format i8 --max-bytes 200",
                                     "--format csv", "--format json", "--per-torque", "--json", "--for simplefoc --machine machine"]):
            self.add("fuzz_emit", f"options_{k}", {"options": options, **results, **small_machine()})
        self.add("fuzz_emit", "drive", {"options": "--machine machine --drive drive.csv", **results, **small_machine(),
                                        "drive.csv": "name,value,unit\ncurrent_sample_time,100,us\n"})
        self.add("fuzz_folder", "solved", results)
        self.add("fuzz_folder", "summary", whole)
        self.add("fuzz_emit", "summary", whole)
        self.add("fuzz_folder", "journal", {**results, "results/.hci-journal": "rename\t.hci-1\t.hci-2\tcurrents.csv\nremove\t.hci-3\t.hci-4\tspectrum.csv\n",
                                            "results/.hci-1": "order,set,amplitude_A,phase_rad\n1,pos,1,0\n"})
        self.blobs(work, small)

    def blobs(self, work, small):
        for name, options in {"f32": ["--points", "16"], "i16": ["--format", "i16"], "i8": ["--format", "i8"], "torque": ["--per-torque", "--points", "12"],
                              "loop": ["--machine", small, "--drive", work / "drive.csv"]}.items():
            (work / "drive.csv").write_text("name,value,unit\ncurrent_sample_time,100,us\n")
            self.made("emit", work / "solved", "--name", name, "--blob", *options, "-o", work / "blobs")
            self.add("fuzz_blob", name, (work / "blobs" / f"{name}.bin").read_bytes())

    def maps(self, work):
        """Maps of other makers' drives, as recordings."""
        for target in ("simplefoc", "st-mcsdk", "moteus", "novanta", "openffboard", "csv"):
            options = ["--counts-per-ampere", "100"] if target in ("st-mcsdk", "openffboard") else []
            points = ["--points", "64"] if target in ("simplefoc", "csv") else []
            self.made("emit", work / "solved", "--name", "map", "--machine", work / "small", "--for", target, *points, *options, "-o", work / target)
            for path in sorted((work / target).iterdir()):
                if path.stat().st_size < 4 * MOST_BYTES:
                    self.add("fuzz_csv", f"map_{path.name}", path.read_bytes())

    def laws(self):
        """Bytes that machines are drawn from."""
        for k in range(9, 17):
            draws = random.Random(k)
            self.add("fuzz_laws", f"draws_{k}", bytes(draws.randrange(256) for _ in range(20 + 10 * k)))
        for k in range(200):
            draws = random.Random(k)
            self.add("fuzz_core", f"draws_{k}", bytes([0, k % 4]) + bytes(draws.randrange(256) for _ in range(400)))
            if k < 40:
                self.add("fuzz_power", f"draws_{k}", bytes(draws.randrange(256) for _ in range(300)))

    def commands(self):
        run = recording(16)
        self.add("fuzz_check", "machine", small_machine())
        self.add("fuzz_check", "run", {**small_machine(), "run.csv": run})
        self.add("fuzz_check", "verbose", {"options": "--verbose --json", **small_machine(pole_pairs="4,1"), "run.csv": run})
        for k, options in enumerate(["--quantity cogging --pole-pairs 2 --torque-constant 0.2", "--quantity back_emf --pole-pairs 2 --orders 1,5,7",
                                     "--quantity cogging --pole-pairs 2 --holding --max-order 12", "--quantity back_emf --pole-pairs 3 --json"]):
            columns = ("time_s", "theta_e_rad", "va_V", "vb_V", "vc_V") if k % 2 else ("time_s", "theta_m_rad", "iq_A", "torque_Nm")
            self.add("fuzz_harmonics", f"options_{k}", {"options": options, "run.csv": recording(24, columns, 0.2)})
        for k, effects in enumerate(["", EFFECTS]):
            machine = {**small_machine(), **({"machine/effects.csv": effects} if effects else {})}
            self.add("fuzz_predict", f"effects_{k}", {"options": "-o out.csv", **machine, "run.csv": run})
            self.add("fuzz_diagnose", f"effects_{k}", {**machine, "runs.csv": "file,role\na.csv,fit\nb.csv,holdout\n",
                                                       "a.csv": recording(12, twist=0.1), "b.csv": recording(8)})
        self.solved()
        self.simulated()

    def solved(self):
        target = "order,amplitude_Nm,phase_rad\n0,2,1.5707963\n6,0.1,0.5\n"
        for k, options in enumerate(["--auto", "--auto 2", "--harmonics harmonics.csv", "--method pointwise", "--auto 3 --limit-current 8",
                                     "--harmonics harmonics.csv --compare square --json"]):
            self.add("fuzz_solve", f"options_{k}", {"options": options, **small_machine(), "target.csv": target,
                                                    "harmonics.csv": "order,set\n1,pos\n5,sym\n7,asym\n11,neg\n13,pos\n"})

    def simulated(self):
        scenarios = {"ideal": "duration,0.001,s\nprescribed_speed,1500,rpm\ntorque_reference,1,Nm\nstep,10,us\n",
                     "speed": "duration,0.002,s\nspeed_reference,100,rpm\nstep,10,us\nload_torque,0.1,Nm\n",
                     "pi": "duration,0.002,s\nprescribed_speed,1500,rpm\ntorque_reference,1,Nm\ncurrent_control,pi,\nstep,10,us\n",
                     "hysteresis": "duration,0.001,s\nprescribed_speed,1500,rpm\ntorque_reference,1,Nm\ncurrent_control,hysteresis,\nstep,1,us\n",
                     "currents": "duration,0.045,s\nprescribed_speed,1500,rpm\nstep,100,us\ncurrents,currents.csv,\n"}
        for name, rows in scenarios.items():
            self.add("fuzz_simulate", name, {**small_machine(), "scenario.csv": "name,value,unit\n" + rows,
                                             "currents.csv": "order,set,amplitude_A,phase_rad\n1,pos,5,0\n5,neg,0.3,1\n"})


def dictionary(path):
    """Words of formats and options, from the pages that tell of them."""
    words = {"@@ ", "\\x0a@@ ", "machine/", "results/", ".csv", "1e308", "-1e308", "5e-324", "1e-308", "2000", "1/7", "0.5", ",", "\\x0a", "\\x22",
             "nan", "inf", "0x1p3", "--", "\\xef\\xbb\\xbf", ";", "\\x09"}
    for page in [pathlib.Path("docs/files.md"), *sorted(pathlib.Path("docs/reference").glob("*.md"))]:
        for word in re.findall(r"`([^`\n]{1,40})`", page.read_text()):
            words.update(re.findall(r"[\w./=*·-]{2,}", word))
    for text in pathlib.Path("src/core/effects").glob("*.c"):
        words.update(re.findall(r'"([a-z_]{3,30})"', text.read_text()))
    escaped = {w if w.startswith("\\") else "".join(c if 32 <= ord(c) < 127 and c not in '"\\' else "".join(f"\\x{b:02x}" for b in c.encode()) for c in w)
               for w in words if "\\x0a@@" not in w} | {"\\x0a@@ "}
    path.write_text("".join(f'"{word}"\n' for word in sorted(escaped)))


def main():
    program, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    shutil.rmtree(out, ignore_errors=True)
    seeds = Seeds(program, out)
    with tempfile.TemporaryDirectory() as work:
        for make in (seeds.csv, seeds.machine, seeds.runs, seeds.wanted, seeds.drive, seeds.laws, seeds.commands):
            make()
        seeds.results(pathlib.Path(work))
        seeds.maps(pathlib.Path(work))
    dictionary(out / "words.dict")


if __name__ == "__main__":
    main()
