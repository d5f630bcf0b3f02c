"""A machine, and everything that is asked of it."""
from __future__ import annotations

import json
import math
import os
import re
import tempfile
from pathlib import Path as FilePath
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy.typing as npt

from . import _program
from ._arrays import view
from ._binding import ffi, lib
from ._call import Note, Path, Progress, Watch, number, path, strings, text, whole, writing
from ._tables import Harmonics, Scenario, Tables, Target, harmonics_path, scenario_path, target_path
from .check import Check
from .diagnosis import Diagnosis
from .errors import ArgumentError
from .fit import Fit
from .prediction import Prediction
from .recording import Reading, Recordable, listed, recordings_of
from .simulation import Follow, Simulation
from .solution import Solution, _word
from .waveform import Waveform
from .written import Sweep

_METHODS = {"auto": lib.HCI_METHOD_AUTO, "lu": lib.HCI_METHOD_LU, "umfpack": lib.HCI_METHOD_UMFPACK,
            "qr": lib.HCI_METHOD_QR, "pointwise": lib.HCI_METHOD_POINTWISE}
_STRATEGIES = {"mtpa": lib.HCI_STRATEGY_MTPA, "id0": lib.HCI_STRATEGY_ID0, "cancel": lib.HCI_STRATEGY_CANCEL}
_COMPARES = {"all": lib.HCI_COMPARE_ALL, "square": lib.HCI_COMPARE_SQUARE}
_MINIMISE = {"auto": lib.HCI_MINIMISE_AUTO, "worst": lib.HCI_MINIMISE_WORST,
             "peak-to-peak": lib.HCI_MINIMISE_PEAK_TO_PEAK, "rms": lib.HCI_MINIMISE_RMS}
_READINGS = {
    "kv_line_peak": lib.HCI_SHEET_KV_LINE_PEAK, "kv_line_rms": lib.HCI_SHEET_KV_LINE_RMS,
    "kv_phase_peak": lib.HCI_SHEET_KV_PHASE_PEAK, "volt_line_rms": lib.HCI_SHEET_VOLT_LINE_RMS,
    "volt_line_peak": lib.HCI_SHEET_VOLT_LINE_PEAK, "volt_phase_peak": lib.HCI_SHEET_VOLT_PHASE_PEAK,
    "volt_phase_rms": lib.HCI_SHEET_VOLT_PHASE_RMS, "torque_peak": lib.HCI_SHEET_TORQUE_PEAK,
    "torque_rms": lib.HCI_SHEET_TORQUE_RMS, "torque_dc": lib.HCI_SHEET_TORQUE_DC, "flux": lib.HCI_SHEET_FLUX,
}
_QUANTITIES = {"back_emf": lib.HCI_WAVEFORM_BACK_EMF, "cogging": lib.HCI_WAVEFORM_COGGING}
#: One limit for all phases, or one of each phase by its letter; 0 opens a phase.
PhaseLimit = Union[float, Mapping[str, float]]


class Machine:
    """A machine as its folder describes it: `Machine.read` or `Machine.from_datasheet` makes one.

    Attributes:
        path: of the folder.
        name: of the folder, the last part of its path.
    """

    def __init__(self, folder: Path) -> None:
        self.path = os.fspath(folder)
        self.name = FilePath(self.path).name
        self._folder: Optional[tempfile.TemporaryDirectory[str]] = None
        self._of_sheet = ""
        note = Note()
        self.c = ffi.gc(ffi.new("hci_machine_data *"), lib.hci_machine_release)
        self._effects = ffi.gc(ffi.new("hci_effects_data *"), lib.hci_effects_release)
        self._uncertainty = ffi.gc(ffi.new("hci_uncertainty *"), lib.hci_uncertainty_release)
        note.check(lib.hci_machine_read(path(folder), self.c, note.c))
        note.check(lib.hci_effects_read_machine(path(folder), self._effects, note.c))
        note.check(lib.hci_uncertainty_read_machine(path(folder), self._uncertainty, note.c))

    @classmethod
    def read(cls, folder: Path) -> "Machine":
        """Reads the folder of a machine: machine.csv, back_emf.csv and what else docs/files.md names."""
        return cls(folder)

    @classmethod
    def from_datasheet(cls, *, pole_pairs: int, strength: float, reading: str, folder: Optional[Path] = None,
                       name: str = "machine", slots: int = 0, resistance_ohm: float = math.nan,
                       resistance_of_line: bool = False, inductance_H: float = math.nan,
                       inductance_d_H: float = math.nan, inductance_q_H: float = math.nan,
                       inertia_kgm2: float = math.nan, rated_current_A: float = math.nan,
                       rated_current_is_rms: bool = False, rated_torque_Nm: float = math.nan,
                       rated_speed_rpm: float = math.nan, dc_link_voltage_V: float = math.nan) -> "Machine":
        """Makes a first machine folder from the values of a data sheet, as `hci-solve init` does.

        Args:
            pole_pairs: a machine with N magnets has N/2.
            strength: of the magnets, in the unit of the reading.
            reading: how the sheet means it: kv_line_peak, kv_line_rms, kv_phase_peak (rpm/V), volt_line_rms,
                volt_line_peak, volt_phase_peak, volt_phase_rms (V/krpm), torque_peak, torque_rms, torque_dc (N·m/A)
                or flux (Wb).
            folder: where the tables go; a temporary folder of the machine without it.
            name: of the machine, for the first line of the tables.
            slots: of the stator; they give the orders of the cogging torque.
            resistance_ohm: of a phase, or between two terminals with resistance_of_line.
            inductance_H: of a phase; inductance_d_H and inductance_q_H along the magnets and across them instead.
            inertia_kgm2: of the rotor.
            rated_current_A: of a phase, peak, or rms with rated_current_is_rms.
            rated_torque_Nm: on the shaft.
            rated_speed_rpm: mechanical.
            dc_link_voltage_V: of battery or supply.
        """
        label, note = ffi.new("char[]", name.encode()), Note()
        both = not math.isnan(number(inductance_H, "inductance_H"))
        sheet = ffi.new("hci_sheet *", {
            "name": label, "pole_pairs": whole(pole_pairs, "pole_pairs"), "slots": whole(slots, "slots"), "reading": _word(_READINGS, reading, "reading"),
            "resistance_of_line": resistance_of_line, "rated_current_is_rms": rated_current_is_rms,
            **{key: number(value, key) for key, value in {
                "strength": strength, "resistance_ohm": resistance_ohm, "inductance_d_H": inductance_H if both else inductance_d_H,
                "inductance_q_H": inductance_H if both else inductance_q_H, "inertia_kgm2": inertia_kgm2,
                "rated_current_A": rated_current_A, "rated_torque_Nm": rated_torque_Nm, "rated_speed_rpm": rated_speed_rpm,
                "dc_link_voltage_V": dc_link_voltage_V}.items()}})
        own = tempfile.TemporaryDirectory(prefix="hci-machine-") if folder is None else None
        where = os.path.join(own.name, re.sub(r"[^\w.-]", "_", name).lstrip(".") or "machine") if own is not None else os.fspath(folder or "")
        with writing:
            note.check(lib.hci_init_write(path(where), sheet, note.c))
        machine = cls(where)
        machine._folder = own
        lib.hci_sheet_remark(sheet, note.c)
        machine._of_sheet = text(note.c.text)
        return machine

    def __reduce__(self) -> Tuple[Any, ...]:
        """Other processes read the folder, which has to be there as long as they do."""
        return Machine, (os.path.abspath(self.path),)

    def __copy__(self) -> "Machine":
        return self  # nothing of a machine changes

    def __deepcopy__(self, _: Any) -> "Machine":
        return self

    def __repr__(self) -> str:
        return f"<Machine {self.path}: {self.pole_pairs} pole pairs, {len(self.back_emf)} back-EMF orders>"

    # ---- what it is ----

    @property
    def pole_pairs(self) -> int:
        """Electrical turns in a mechanical one."""
        return int(self.c.model.pole_pairs)

    @property
    def values(self) -> Dict[str, float]:
        """Numbers of machine.csv by their names with units; those that are not given are left out."""
        names = [name for name, field in ffi.typeof("hci_machine_data").fields if field.type.cname == "double"]
        found = {name: float(getattr(self.c, name)) for name in names}
        return {name: value for name, value in found.items() if not math.isnan(value)}

    @property
    def back_emf(self) -> npt.NDArray[Any]:
        """Waves of the back-EMF per speed: fields order, sequence, sine, cosine in N·m/A. A view."""
        return view(self.c, self.c.back_emf, self.c.model.back_emf_count, "hci_wave")

    @property
    def cogging(self) -> npt.NDArray[Any]:
        """Cogging torque: fields order, sine, cosine in N·m. A view."""
        return view(self.c, self.c.cogging, self.c.model.cogging_count, "hci_harmonic")

    @property
    def effects(self) -> List[str]:
        """Names of the effects of effects.csv."""
        return [text(self._effects.effect[k].type.name) for k in range(self._effects.list.count)]

    @property
    def remark(self) -> str:
        """What a reader should know, such as names that were not understood, or ratings that do not agree."""
        return "; ".join(words for words in (self._of_sheet, text(self.c.remark.text)) if words)

    # ---- currents ----

    def solve(self, target: Target, *, harmonics: Optional[Harmonics] = None, at_most: int = 0,
              fundamental: Optional[Tuple[float, float]] = None, method: str = "auto", strategy: str = "mtpa",
              compare: str = "all", tolerance: float = 0.0, max_loss: float = 0.0,
              limit_current_A: PhaseLimit = 0.0, limit_rms_A: PhaseLimit = 0.0, limit_copper_W: float = 0.0,
              limit_copper_ratio: float = 0.0, limit_voltage_V: float = 0.0, speed_rpm: Optional[float] = None,
              voltage_reserve: float = 0.0, dead_time_s: float = 0.0, pwm_frequency_Hz: float = 0.0,
              ignore_ratings: bool = False, minimise: str = "auto", temperature_C: Optional[float] = None,
              drive: Optional[Path] = None, progress: Progress = None) -> Solution:
        """Finds the currents that make the machine produce a wanted torque: `hci-solve solve`.

        Args:
            target: a file, a mean torque in N·m, or {order: amplitude_Nm} or {order: (amplitude_Nm, phase_rad)} or
                with a weight as the third: 0 is do not care. Order 0 is the mean; orders not listed are wanted zero.
            harmonics: components to use, a file or [(order, set), …]; without it they are chosen.
            at_most: so many components are chosen; 0: as many as it takes.
            fundamental: peak amplitude in A and phase in rad of a fundamental that is held.
            method: auto, lu, umfpack, qr or pointwise.
            strategy: of the method pointwise: mtpa, id0 or cancel.
            compare: all orders, or square: as many as unknowns.
            tolerance: share of the mean torque within which an order is reached; 0: 1e-6.
            max_loss: with at_most: copper loss over the pointwise limit; 0: 1.10.
            limit_current_A: largest |phase current|, of all phases or {"a": 10}; 0 of a phase opens it.
            limit_rms_A: rms of a phase current, likewise.
            limit_copper_W: copper loss of all phases.
            limit_copper_ratio: copper loss over that of the plain sine.
            limit_voltage_V: dc-link voltage that line voltages stay below at speed_rpm.
            speed_rpm: mechanical.
            voltage_reserve: share of the dc link that is left for the control.
            dead_time_s: with pwm_frequency_Hz: what line voltages lose.
            pwm_frequency_Hz: see dead_time_s.
            ignore_ratings: leave out the limits that machine.csv declares.
            minimise: which ripple is made smallest where the torque cannot be as wanted: auto, worst,
                peak-to-peak or rms.
            temperature_C: of the magnets.
            drive: drive.csv: harmonics that its current loop cannot follow at speed_rpm are left out.
            progress: see docs/python.md.

        Returns:
            The solution; `reached` tells whether the torque is as wanted.
        """
        options = ffi.new("hci_solve_options *", {
            "choose_at_most": whole(at_most, "at_most"), "method": _word(_METHODS, method, "method"),
            "strategy": _word(_STRATEGIES, strategy, "strategy"), "compare": _word(_COMPARES, compare, "compare"),
            "tolerance": tolerance, "loss_allowance": max_loss, "limit_voltage_V": limit_voltage_V,
            "minimise": _word(_MINIMISE, minimise, "minimise"), "at_speed": speed_rpm is not None,
            "speed_rad_per_s": (speed_rpm or 0.0) * math.pi / 30.0, "at_temperature": temperature_C is not None,
            "temperature_C": temperature_C or 0.0,
            "limits": {"voltage_reserve": voltage_reserve, "dead_time_s": dead_time_s, "copper_W": limit_copper_W,
                       "pwm_frequency_Hz": pwm_frequency_Hz, "copper_ratio": limit_copper_ratio,
                       "ignore_ratings": ignore_ratings}})
        if limit_voltage_V and speed_rpm is None:
            raise ArgumentError("limit_voltage_V: the voltage depends on the speed; give speed_rpm too")
        if drive is not None and (not speed_rpm or method == "pointwise"):
            raise ArgumentError("drive: what a current loop follows depends on the speed, and harmonics are left out; give speed_rpm, "
                                "not 0, and another method than pointwise")
        _set_limits(options, limit_current_A, limit_rms_A)
        held = lib.hci_wave_polar(1.0, 1, *_held(fundamental)) if fundamental is not None else None
        kept = ffi.new("hci_wave *", held) if held is not None else ffi.NULL
        options.held = kept
        return self._solve(options, target, harmonics, drive, Watch(progress))

    def _solve(self, options: Any, target: Target, harmonics: Optional[Harmonics], drive: Optional[Path],
               watch: Watch) -> Solution:
        note, remark, solution = Note(), Note(), ffi.new("hci_solution *")
        wanted = ffi.gc(ffi.new("hci_target *"), lib.hci_target_release)
        chosen = ffi.gc(ffi.new("hci_component_set *"), lib.hci_component_set_release)
        with Tables() as tables:
            note.check(lib.hci_target_read(path(target_path(target, tables)), wanted, note.c), hide=tables.hide)
            if harmonics is not None:
                note.check(lib.hci_component_set_read(path(harmonics_path(harmonics, tables)), self.c.has_neutral,
                                                      chosen, note.c), hide=tables.hide)
        options.target, options.set = wanted, chosen if harmonics is not None else ffi.NULL
        options.effects, options.uncertainty = ffi.addressof(self._effects, "list"), self._uncertainty
        machine = self.c
        if drive is not None:
            loop, machine = drive_of(drive), ffi.new("hci_machine_data *", self.c[0])
            note.check(lib.hci_solve_for_drive(loop, machine, options, options.set and chosen or ffi.NULL, remark.c, note.c))
        watch.into(options)
        status = lib.hci_solve(machine, options, solution, note.c)
        found = ffi.gc(solution, lib.hci_solution_release)
        watch.finish()
        return Solution(self, found, note.check(status), text(remark.c.text))

    def pointwise(self, target: Target, strategy: str = "mtpa", **more: Any) -> Solution:
        """The currents angle by angle: mtpa (the shortest), id0 or cancel. more: as of `solve`."""
        return self.solve(target, method="pointwise", strategy=strategy, **more)

    # ---- recordings ----

    def _reading(self, recordings: Sequence[Any], columns: Optional[Mapping[str, str]], holding: bool, strict: bool) -> Reading:
        reading = Reading(recordings, columns=columns, holding=holding, strict=strict)
        reading.c.pole_pairs, reading.c.inertia_kgm2 = self.pole_pairs, self.c.inertia_kgm2
        reading.c.torque_constant_Nm_per_A = lib.hci_machine_torque_constant(self.c)
        return reading

    def predict(self, recording: Recordable, *, columns: Optional[Mapping[str, str]] = None, holding: bool = False,
                strict: bool = False) -> Prediction:
        """The modelled torque of each sample of a recording, and what the recording differs by.

        Args:
            recording: a path, a DataFrame, a mapping of arrays or a `Recording`.
            columns: which column is which quantity, where names do not say it: {"torque_mNm": "Channel 3"}.
            holding: without a torque column the shaft is turned slowly, and its torque is 0.
            strict: a cell without a number is an error.
        """
        (one,) = recordings_of([recording])
        reading, note = self._reading([one], columns, holding, strict), Note()
        samples = ffi.gc(ffi.new("hci_predicted_run *"), lib.hci_predicted_run_release)
        found = ffi.new("hci_prediction *")
        note.check(lib.hci_predict_samples(path(self.path), path(one.name), reading.c, samples, found, note.c))
        return Prediction(samples, found)

    def diagnose(self, runs: Union[Path, Iterable[Recordable]], *, holdout: Iterable[Recordable] = (),
                 columns: Optional[Mapping[str, str]] = None, holding: bool = False, strict: bool = False,
                 resolution_percent: float = 0.0, progress: Progress = None,
                 _last: Optional["_Last"] = None) -> Diagnosis:
        """Finds what the model of the machine lacks to describe recordings: `hci-solve diagnose`.

        Ctrl-C, or a progress function that returns True, ends the search for effects with what it has so far
        (`summary["search"]` tells); the interrupt is not raised then.

        Args:
            runs: a list of runs as a file (runs.csv), or recordings that the model is fitted to.
            holdout: recordings that it is tested on.
            columns: which column is which quantity, where names do not say it.
            holding: without a torque column the shaft is turned slowly, and its torque is 0.
            strict: a cell without a number is an error.
            resolution_percent: what the model is not asked to be better than; 0: 0.05.
            progress: see docs/python.md.
        """
        watch = Watch(progress)
        read = _Runs(self, runs, holdout, (columns, holding, strict), _last)
        options = ffi.new("hci_diagnose_options *", {"resolution": resolution_percent / 100.0})
        slip = _Inquiry(self, read)
        options.slip, options.slip_context = ffi.addressof(lib, "hci_check_slip"), slip.c
        watch.into(options)
        c, note = ffi.new("hci_diagnosis *"), Note()
        diagnose = lib.hci_diagnose if _last is None else lib.hci_diagnose_further
        status = diagnose(self.c, ffi.addressof(self._effects, "list"), read.c, options, c, note.c)
        found = ffi.gc(c, lib.hci_diagnosis_release)
        watch.finish((KeyboardInterrupt,))
        note.check(status)
        if _last is not None:
            note.check(_last.compare(self, read, found, note))
        return Diagnosis(self, found, (read, slip), status)

    def fit(self, runs: Union[Path, Iterable[Recordable]], *, columns: Optional[Mapping[str, str]] = None,
            strict: bool = False, limits: Optional[Path] = None) -> Fit:
        """The few parameters in which motors of one make differ, without a search: `hci-solve fit`.

        Args:
            runs: a list of runs as a file (runs.csv), or recordings.
            columns: which column is which quantity, where names do not say it.
            strict: a cell without a number is an error.
            limits: a table effect,parameter,low,high, such as line.csv of `fleet`: `Fit.passed` tells.
        """
        read, c, note = _Runs(self, runs, [], (columns, False, strict), plain=True), ffi.new("hci_fleet_fit *"), Note()
        note.check(lib.hci_fleet_fit_runs(self.c, ffi.addressof(self._effects, "list"), read.c, c, note.c))
        if limits is not None:
            note.check(lib.hci_fleet_fit_judge(path(limits), c, note.c))
        return Fit(c)

    def check(self, *recordings: Recordable, columns: Optional[Mapping[str, str]] = None, holding: bool = False,
              strict: bool = False) -> Check:
        """Looks for broken conventions: poles for pole pairs, rms for peak, a sign, an angle zero: `hci-solve check`.

        Args:
            recordings: any number, which have the same conventions.
            columns: which column is which quantity, where names do not say it.
            holding: without a torque column the shaft is turned slowly, and its torque is 0.
            strict: a cell without a number is an error.
        """
        all_of = recordings_of(recordings)
        reading, note, found = self._reading(all_of, columns, holding, strict), Note(), ffi.new("hci_check *")
        names, kept = strings([path(recording.name) for recording in all_of])
        folder = ffi.new("char[]", path(self.path))
        status = lib.hci_check_files(folder, names, len(all_of), reading.c, found, note.c)
        return Check(found, (names, kept, folder), note.check(status))

    def harmonics(self, recording: Recordable, quantity: str, *, orders: Optional[Sequence[float]] = None,
                  max_order: float = math.nan, torque_constant_Nm_per_A: float = math.nan,
                  columns: Optional[Mapping[str, str]] = None, holding: bool = False, strict: bool = False) -> Waveform:
        """The orders of a measured waveform with their standard errors: `hci-solve harmonics`.

        Args:
            recording: a path, a DataFrame, a mapping of arrays or a `Recording`.
            quantity: cogging or back_emf.
            orders: electrical, ascending, these and no others; without them what stands out.
            max_order: highest one that is looked for.
            torque_constant_Nm_per_A: of i_q, for cogging from a run with currents.
            columns: which column is which quantity, where names do not say it.
            holding: without a torque column the shaft is turned slowly, and its torque is 0.
            strict: a cell without a number is an error.
        """
        (one,) = recordings_of([recording])
        reading, note = self._reading([one], columns, holding, strict), Note()
        reading.c.inertia_kgm2, reading.c.torque_constant_Nm_per_A = math.nan, 0.0
        given = ffi.new("double[]", [float(order) for order in orders]) if orders is not None else ffi.NULL
        options = ffi.new("hci_waveform_options *", {
            "quantity": _word(_QUANTITIES, quantity, "quantity"), "pole_pairs": self.pole_pairs, "orders": given,
            "order_count": len(orders) if orders is not None else 0, "max_order": max_order,
            "torque_constant_Nm_per_A": torque_constant_Nm_per_A})
        run = ffi.gc(ffi.new("hci_run *"), lib.hci_run_release)
        note.check(lib.hci_run_read(path(one.name), reading.c, run, note.c))
        found = ffi.gc(ffi.new("hci_waveform *"), lib.hci_waveform_release)
        note.check(lib.hci_waveform_find(run, options, found, note.c))
        return Waveform(found)

    # ---- the drive in time ----

    def simulate(self, scenario: Scenario, *, currents: Union[Solution, Path, None] = None,
                 progress: Progress = None) -> Simulation:
        """Runs the drive in time: machine, shaft, current and speed control, sensors: `hci-solve simulate`.

        Args:
            scenario: a file, or names and values as docs/simulate.md has them: {"duration": 0.1, "prescribed_speed":
                (100, "rpm"), "current_control": "ideal"}. A number alone is in the unit of the page.
            currents: what flows, in place of the scenario's: a solution, its folder or currents.csv.
            progress: see docs/python.md.
        """
        watch, note = Watch(progress), Note()
        c, found, samples = ffi.new("hci_scenario *"), ffi.new("hci_simulation *"), ffi.new("hci_samples *")
        options = ffi.new("hci_simulate_options *", {"effects": ffi.addressof(self._effects, "list")})
        watch.into(options)
        with Tables() as tables:
            note.check(lib.hci_scenario_read(path(scenario_path(scenario, tables)), c, note.c), hide=tables.hide)
            if isinstance(currents, Solution):
                currents.write(tables.folder / "solution")
                currents = tables.folder / "solution"
            if currents is not None:
                c.currents = path(currents)
            status = lib.hci_simulate_samples(self.c, c, options, samples, found, note.c)
        watch.finish()
        note.check(status, hide=tables.hide)
        return Simulation(ffi.gc(found, lib.hci_simulation_release), ffi.gc(samples, lib.hci_samples_release))

    def follow(self, solution: Union[Solution, Path, Sequence[Union[Solution, Path]]], drive: Path, speeds_rpm: Sequence[float],
               **options: Any) -> Follow:
        """Takes currents through the current loop of a real drive: `hci-solve simulate --table --drive --speeds`.

        Args:
            solution: a solution or its folder; several are levels of torque.
            drive: drive.csv.
            speeds_rpm: mechanical.
            options: of the program with _ for -: torque=1.5, model_error=10.
        """
        with Tables() as tables:
            folders = [tables.solution(one, k) for k, one in enumerate(_several(solution))]
            words = _program.words_of({"table": folders, "drive": drive, "speeds": [float(x) for x in speeds_rpm], **options})
            return Follow(*_program.run("simulate", self.path, *words, "--json"))

    # ---- whole commands of the program ----

    def sweep(self, folder: Path, **options: Any) -> Sweep:
        """Solves over a grid: `hci-solve sweep`.

        Args:
            folder: where the results go; the same call goes on there.
            options: those of the program with _ for -: trade_off=True, torque=2.4, currents=[12, 16, 20]; or envelope=True,
                speeds="0:3000:100"; or map=True, torques=[1, 2], speeds=[0].
                Other speeds need a dc link.
        """
        return Sweep(folder, *_program.run("sweep", self.path, *_program.words_of(options), "--out", folder))

    def export_fmu(self, file: Path, *, fmi: int = 2, inputs: Optional[str] = None,
                   table: Union[Solution, Path, Sequence[Union[Solution, Path]], None] = None, drive: Optional[Path] = None,
                   sources_only: bool = False) -> Dict[str, Any]:
        """Writes an FMU of the machine with its effects, or of its controller: `hci-solve export-fmu`, docs/fmu.md.

        Args:
            file: the FMU.
            fmi: 2 or 3.
            inputs: voltages or currents; without it voltages.
            table: the controller instead, with the table of this solution; several are levels of torque.
            drive: drive.csv: the loop of a controller; of a machine what machine.csv lacks.
            sources_only: no binary, and no C compiler is needed.

        Returns:
            What was made, by name.
        """
        with Tables() as tables:
            folders = [tables.solution(one, k) for k, one in enumerate(_several(table))] if table is not None else None
            words = _program.words_of({"fmi": str(fmi), "inputs": inputs, "table": folders, "drive": drive,
                                       "sources_only": sources_only, "out": file})
            made: Dict[str, Any] = json.loads(_program.run("export-fmu", self.path, *words, "--json")[1])
            return made


class _Last:
    """The last diagnosis, which a new one goes on from."""

    def __init__(self, folder: Path, before: Optional[Iterable[Recordable]]) -> None:
        self.folder = os.fspath(folder)
        self.list = os.path.join(self.folder, "declared", "runs.csv")
        self.before = None if before is None else list(before)
        self.count = 0
        self.again = ffi.gc(ffi.new("hci_again *"), lib.hci_again_release)
        if before is None and not os.path.exists(self.list):
            raise ArgumentError(f"before: {self.list} is not there, since the recordings of last time were in memory; give them as before")

    def compare(self, machine: Machine, runs: "_Runs", diagnosis: Any, note: Note) -> int:
        """Sets what the new recordings say of it."""
        folder = ffi.new("char[]", path(self.folder))
        question = ffi.new("hci_again_question *", {
            "machine": machine.c, "declared": ffi.addressof(machine._effects, "list"), "runs": runs.c,
            "recordings_before": self.count, "folder": folder})
        runs.last = self
        return int(lib.hci_again_find(question, diagnosis, self.again, note.c))


class _Runs:
    """The recordings of a diagnosis, for as long as this lives: those of the last one first."""

    def __init__(self, machine: Machine, runs: Union[Path, Iterable[Recordable]], holdout: Iterable[Recordable], how: Any,
                 last: Optional[_Last] = None, plain: bool = False) -> None:
        self.c = ffi.gc(ffi.new("hci_runs *"), lib.hci_runs_release)
        self.last: Optional[_Last] = None
        self._machine, self._how, self._plain = machine, how, plain
        self.recordings: List[Any] = []
        if last is not None:
            self._add(last.list if last.before is None else last.before, [])
            last.count = int(self.c.count)
        self._add(runs, holdout)

    def _reading(self, recordings: Sequence[Any]) -> Reading:
        reading = self._machine._reading(recordings, *self._how)
        if self._plain:  # as `fit` reads them: a torque is measured, or there is none
            reading.c.inertia_kgm2, reading.c.torque_constant_Nm_per_A = math.nan, 0.0
        return reading

    def _add(self, runs: Union[Path, Iterable[Recordable]], holdout: Iterable[Recordable]) -> None:
        note, held = Note(), listed(holdout)
        if isinstance(runs, (str, os.PathLike)):
            if held:
                raise ArgumentError("holdout: a list of runs in a file says itself which are held out; leave one of them out")
            reading, more = self._reading([]), ffi.gc(ffi.new("hci_runs *"), lib.hci_runs_release)
            note.check(lib.hci_runs_read(path(runs), ffi.new("hci_runs_options *", {"run": reading.c[0]}), more, note.c))
            note.check(lib.hci_runs_join(self.c, more, note.c))
            return
        fitted = listed(runs)
        all_of = recordings_of(fitted + held)
        reading = self._reading(all_of)
        self.recordings += all_of
        for k, recording in enumerate(all_of):
            role = lib.HCI_ROLE_FIT if k < len(fitted) else lib.HCI_ROLE_HOLDOUT
            note.check(lib.hci_runs_add(self.c, path(recording.name), role, reading.c, note.c))


class _Inquiry:
    """What the library may ask check about in a diagnosis, for as long as this lives."""

    def __init__(self, machine: Machine, runs: _Runs) -> None:
        files = [] if runs.c.origin == ffi.NULL else [ffi.string(runs.c.origin[k].path) for k in range(runs.c.count)]
        names = files or [path(recording.name) for recording in runs.recordings]
        self._reading = runs._reading(runs.recordings)
        self._folder, self._kept = ffi.new("char[]", path(machine.path)), strings(names)
        self.c = ffi.new("hci_check_inquiry *", {"machine": self._folder, "run": self._kept[0], "runs": len(names),
                                                 "reading": self._reading.c[0]})


def diagnose_again(last: Path, runs: Union[Path, Iterable[Recordable]], *, before: Optional[Iterable[Recordable]] = None,
                   **more: Any) -> Diagnosis:
    """Goes on from an earlier diagnosis with further recordings: `hci-solve diagnose --again`.

    Whether the new recordings are as the last one promised is in `verdict` and in `summary["again"]`.

    Args:
        last: the folder that `Diagnosis.write` wrote.
        runs: the new recordings, as of `Machine.diagnose`.
        before: the recordings of last time, where they were in memory.
        more: as of `Machine.diagnose`.
    """
    machine = Machine.read(os.path.join(os.fspath(last), "declared"))
    return machine.diagnose(runs, _last=_Last(last, before), **more)


def drive_of(file: Path) -> Any:
    """drive.csv as the library has it."""
    drive, note = ffi.gc(ffi.new("hci_drive_data *"), lib.hci_drive_release), Note()
    note.check(lib.hci_drive_read(path(file), drive, note.c))
    return drive


def _held(fundamental: Tuple[float, float]) -> List[float]:
    """Amplitude and phase of the fundamental that is held."""
    parts = [number(part, "fundamental") for part in fundamental] if isinstance(fundamental, (tuple, list)) else []
    if len(parts) != 2 or not all(map(math.isfinite, parts)):
        raise ArgumentError(f"fundamental: found {fundamental!r}, expected a peak amplitude in A and a phase in rad; give two finite numbers")
    return parts


def _several(solution: Union[Solution, Path, Sequence[Union[Solution, Path]]]) -> List[Union[Solution, Path]]:
    return list(solution) if isinstance(solution, (list, tuple)) else [solution]  # type: ignore[list-item]


def _set_limits(options: Any, current: PhaseLimit, rms: PhaseLimit) -> None:
    """Limits of all phases or of some."""
    if isinstance(current, Mapping):
        for phase, value in _by_phase(current, "limit_current_A"):
            options.limits.is_open[phase] = value == 0.0
            options.limits.current_A[phase] = value
    else:
        options.limit_current_A = number(current, "limit_current_A")
    for phase, value in _by_phase(rms if isinstance(rms, Mapping) else dict.fromkeys("abc", rms), "limit_rms_A"):
        options.limits.rms_A[phase] = value


def _by_phase(limits: Mapping[str, float], name: str) -> List[Tuple[int, float]]:
    """Phases 0, 1 and 2 with their limits."""
    for phase in limits:
        if phase not in ("a", "b", "c"):
            raise ArgumentError(f"{name}: found phase {phase!r}, expected a, b or c; give one of these")
    return [("abc".index(phase), number(value, name)) for phase, value in limits.items()]
