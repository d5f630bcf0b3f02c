"""Currents for a wanted torque."""
from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _look
from ._arrays import view
from ._binding import ffi, lib
from ._call import Note, Path, path, strings, text, whole, writing
from ._result import Result, json_of
from ._tables import Tables
from .errors import ArgumentError

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .machine import Machine

Array = npt.NDArray[Any]
_FORMATS = {"f32": lib.HCI_EMIT_F32, "i16": lib.HCI_EMIT_I16, "q15": lib.HCI_EMIT_Q15, "i8": lib.HCI_EMIT_I8, "csv": lib.HCI_EMIT_CSV,
            "json": lib.HCI_EMIT_JSON}
_SHAPES = {"auto": lib.HCI_EMIT_AUTO, "linear": lib.HCI_EMIT_LINEAR, "quadratic": lib.HCI_EMIT_QUADRATIC,
           "cubic": lib.HCI_EMIT_CUBIC}
_WAVES = {"sine": lib.HCI_FOREIGN_SINE, "cosine": lib.HCI_FOREIGN_COSINE, "sine-lag": lib.HCI_FOREIGN_SINE_LAG,
          "cosine-lag": lib.HCI_FOREIGN_COSINE_LAG}
_FRAMES = {"abc": lib.HCI_TABLE_ABC, "dq": lib.HCI_TABLE_DQ}


class Emitted(NamedTuple):
    """What `Solution.emit` has written."""

    files: List[str]
    summary: Dict[str, Any]


def amplitude(waves: Array) -> Array:
    """Peak amplitudes of harmonics or waves with the fields sine and cosine."""
    found: Array = np.hypot(waves["sine"], waves["cosine"])
    return found


class Samples:
    """Rows of numbers of the library, by the names of their columns."""

    def __init__(self, c: Any) -> None:
        self.names: List[str] = text(c.columns).split(",")
        #: All rows, [rows, columns].
        self.values: Array = view(c, c.value, c.rows * c.width).reshape(-1, c.width)

    def __getitem__(self, name: str) -> Array:
        column: Array = self.values[:, self.names.index(name)]
        return column

    def __len__(self) -> int:
        return len(self.values)

    def to_pandas(self) -> "pandas.DataFrame":
        """The rows as a table that shares their memory."""
        import pandas

        return pandas.DataFrame(self.values, columns=self.names, copy=False)


class Solution(Result):
    """The currents that `Machine.solve` has found, what they do and what they cost.

    Attributes:
        machine: that they are for.
        reached: whether every order of the torque is within its tolerance, within all limits.
        summary: all figures, as summary.json has them.
    """

    def __init__(self, machine: "Machine", c: Any, status: int, remark: str = "") -> None:
        self.machine, self._c, self._status, self._remark = machine, c, status, remark
        self.reached: bool = status == lib.HCI_OK
        self.summary = json_of(lib.hci_solution_json(c, status))

    @property
    def verdict(self) -> str:
        """Whether the torque is as wanted, its figures, and what they are compared with."""
        words = ffi.new("char[1536]")
        lib.hci_solution_words(self._c, words, len(words))
        return text(words)

    @property
    def remark(self) -> str:
        return "; ".join(part for part in (self._remark, text(self._c.remark.text)) if part)

    @property
    def currents(self) -> Array:
        """The waves that flow: fields order, sequence, sine and cosine in A. A view."""
        return view(self._c, self._c.current.wave, self._c.current.count, "hci_wave")

    @property
    def currents_per_Nm(self) -> Optional[Array]:
        """What each N·m of mean torque adds, in A/(N·m); None where torque is not linear in the currents."""
        return self._part(self._c.per_Nm)

    @property
    def currents_constant(self) -> Optional[Array]:
        """What flows without a mean torque, in A; None as above."""
        return self._part(self._c.constant)

    def _part(self, pointer: Any) -> Optional[Array]:
        return None if pointer == ffi.NULL else view(self._c, pointer, self._c.current.count, "hci_wave")

    @property
    def orders(self) -> Array:
        """Each order of the torque: target_Nm, torque_Nm, before_Nm (order, sine, cosine), error_Nm. A view."""
        return view(self._c, self._c.order, self._c.order_count, "hci_solved_order")

    @cached_property
    def waveform(self) -> Samples:
        """Currents and torque over the electrical angle; before and wanted beside them."""
        c, note = ffi.gc(ffi.new("hci_samples *"), lib.hci_samples_release), Note()
        note.check(lib.hci_solution_samples(self.machine.c, self._c, c, note.c))
        return Samples(c)

    @property
    def mean_torque_Nm(self) -> float:
        """What the currents make."""
        orders = self.orders
        return float(orders["torque_Nm"]["cosine"][0]) if len(orders) else 0.0

    @property
    def worst_error_Nm(self) -> float:
        """The largest error of an order that is cared for."""
        return float(self._c.worst_error_Nm)

    @property
    def peak_current_A(self) -> float:
        """Largest |phase current|."""
        return float(self._c.peak_phase_current_A)

    @property
    def loss_to_plain(self) -> float:
        """Copper loss over that of the plain sine with the same mean torque."""
        return float(self._c.loss_to_plain)

    def to_pandas(self) -> "pandas.DataFrame":
        """The waveform over the angle."""
        return self.waveform.to_pandas()

    def spectrum(self) -> "pandas.DataFrame":
        """Wanted and made torque by order, as spectrum.csv has it."""
        import pandas

        orders = self.orders
        table: Dict[str, Any] = {"order": orders["torque_Nm"]["order"]}
        for name, field in (("target_Nm", "target_Nm"), ("torque_Nm", "torque_Nm"), ("before_Nm", "before_Nm")):
            table[name] = amplitude(orders[field])
        table["error_Nm"] = orders["error_Nm"]
        table["verdict"] = [text(lib.hci_order_verdict_name(int(k))) for k in orders["verdict"]]
        return pandas.DataFrame(table)

    def write(self, folder: Path) -> None:
        """Writes the files that `hci-solve solve -o` writes."""
        note = Note()
        with writing:
            note.check(lib.hci_solution_write(self.machine.c, self._c, self._status, path(folder), note.c))

    def emit(self, folder: Path, name: str, *, format: str = "f32", shape: str = "auto", frame: str = "abc",
             points: int = 0, max_error_A: float = 0.0, max_bytes: int = 0, max_instructions: int = 0,
             per_torque: bool = False, reference_torque_Nm: Optional[float] = None, blob: bool = False) -> Emitted:
        """Writes the currents as a table for a microcontroller: the bytes that `hci-solve emit` writes.

        Args:
            folder: where the files go.
            name: of the table, a C identifier.
            format: f32, i16, q15 or i8 for C; csv or json for other programs.
            shape: auto, linear, quadratic or cubic.
            frame: abc (phase currents) or dq (rotor frame).
            points: rows, 0: as many as the error asks for.
            max_error_A: the fewest points that keep every current within it.
            max_bytes: of rows or knots.
            max_instructions: of one call on a Cortex-M4F.
            per_torque: two parts, i = T·A(θ) + B(θ), for every mean torque T.
            reference_torque_Nm: the largest T of that; otherwise the one solved for.
            blob: NAME.bin too, for hci/blob.h.
        """
        request = ffi.new("hci_emit_request *", {
            "format": _word(_FORMATS, format, "format"), "shape": _word(_SHAPES, shape, "shape"),
            "frame": _word(_FRAMES, frame, "frame"), "points": whole(points, "points"), "max_error_A": max_error_A,
            "max_bytes": whole(max_bytes, "max_bytes"), "max_instructions": whole(max_instructions, "max_instructions"),
            "blob": blob})
        with Tables() as tables:
            return self._emit(folder, name, request, per_torque, reference_torque_Nm, tables)

    def _parts(self, request: Any, per_torque: bool, reference_torque_Nm: Optional[float], tables: Tables) -> Tuple[Any, Any]:
        """Puts all currents into a request, or those without and those by torque: as the program reads them from files, so
        that the bytes of tables are the same."""
        if per_torque and self.currents_per_Nm is None:
            raise ArgumentError("per_torque: these currents are not linear in the mean torque (a held fundamental, or reluctance "
                                "torque); leave it out")
        self.write(tables.folder)
        source = path(tables.folder)
        read = _currents(source, lib.HCI_SOLUTION_CURRENTS_CONSTANT if per_torque else lib.HCI_SOLUTION_CURRENTS, tables)
        parts = _currents(source, lib.HCI_SOLUTION_CURRENTS_PER_NM, tables) if per_torque else ffi.new("hci_currents *")
        if per_torque:
            mean, note = ffi.new("double *", reference_torque_Nm or 0.0), Note()
            if reference_torque_Nm is None:
                note.check(lib.hci_solution_read_mean_torque(source, mean, note.c), hide=tables.hide)
            request.reference_torque_Nm = abs(mean[0])
        request.per_Nm, request.per_Nm_count = parts.wave, parts.count
        request.currents, request.current_count = read.wave, read.count
        request.input_hash = (read.hash ^ (parts.hash * 31)) & 0xFFFFFFFFFFFFFFFF
        return read, parts

    def _emit(self, folder: Path, name: str, request: Any, per_torque: bool, reference_torque_Nm: Optional[float],
              tables: Tables) -> Emitted:
        note, result = Note(), ffi.new("hci_emit_result *")
        read, parts = self._parts(request, per_torque, reference_torque_Nm, tables)
        words = ffi.new("char[240]")
        lib.hci_solution_verdict_words(path(tables.folder), words, ffi.sizeof(words))
        verdict = text(words)
        lines, kept = strings([f"{read.count} current components, solved by hci-solve".encode(), verdict.encode()])
        identifier, facts = ffi.new("char[]", name.encode()), ffi.addressof(request, "facts")
        request.name = identifier
        request.has_neutral = any(part.wave[k].sequence == 0 for part in (read, parts) for k in range(part.count))
        request.provenance, request.provenance_count = lines, 2 if verdict else 1
        note.check(lib.hci_emit_facts_read(path(self.machine.path), self.machine.c, facts, note.c))
        request.facts.mean_torque_Nm = float(self._c.wanted_mean_Nm)
        machine_folder = ffi.new("char[]", path(self.machine.path))
        request.machine, request.machine_folder = self.machine.c, machine_folder
        request.expected_ripple_Nm = lib.hci_solution_read_expected_ripple(path(tables.folder))
        with writing:
            note.check(lib.hci_emit(path(folder), request, result, note.c))
        summary = json_of(lib.hci_emit_json(request, result))
        del kept
        data = request.format in (lib.HCI_EMIT_CSV, lib.HCI_EMIT_JSON)
        ends = [text(lib.hci_emit_format_name(request.format))] if data else ["h", "c"] + ["bin"] * bool(request.blob)
        return Emitted([f"{name}.{end}" for end in ends], summary)

    def emit_for_drive(self, folder: Path, name: str, drive: Path, *, levels: Sequence[Union["Solution", Path]] = (),
                       per_torque: bool = False, max_error_A: float = 0.0, up_to_rpm: float = 0.0, blob: bool = False) -> Emitted:
        """Writes orders of current and voltage that a current loop can follow: `hci-solve emit --drive`, docs/drive.md.

        Args:
            folder: where the files go.
            name: of the table, a C identifier.
            drive: drive.csv.
            levels: more solutions, or their folders, at other mean torques.
            per_torque: both parts of this solution, for every torque up to its own, in place of levels.
            max_error_A: of a table over the angle; 0: 2e-4 of the largest current.
            up_to_rpm: up to which orders are used; 0: as far as voltage and sampling do.
            blob: NAME.bin too, for hci/loop_blob.h.
        """
        from .machine import drive_of

        note, result, loop = Note(), ffi.new("hci_emit_loop_result *"), drive_of(drive)
        read = ffi.gc(ffi.new("hci_loop_levels *"), lib.hci_loop_levels_release)
        with Tables() as tables:
            folders, kept = strings([path(tables.solution(one, k)) for k, one in enumerate([self, *levels])])
            note.check(lib.hci_loop_levels_read(folders, len(kept), per_torque, read, note.c), hide=tables.hide)
        identifier = ffi.new("char[]", name.encode())
        request = ffi.new("hci_emit_loop_request *", {
            "name": identifier, "machine": self.machine.c, "drive": loop, "levels": read.level, "level_count": read.count,
            "max_error_A": max_error_A, "speed_rad_per_s": up_to_rpm * np.pi / 30.0, "blob": blob, "input_hash": read.hash})
        note.check(lib.hci_emit_facts_read(path(self.machine.path), self.machine.c, ffi.addressof(request, "facts"), note.c))
        with writing:
            note.check(lib.hci_emit_loop(path(folder), request, result, note.c))
        return Emitted([f"{name}.{end}" for end in ["h", "c"] + ["bin"] * blob], json_of(lib.hci_emit_loop_json(request, result)))

    def emit_for(self, target: str, folder: Path, name: str, *, per_torque: bool = False,
                 reference_torque_Nm: Optional[float] = None, points: int = 0, torque_constant_Nm_per_A: float = 0.0,
                 wave: str = "sine", counts_per_A: float = 0.0, encoder_offset_deg: float = 0.0,
                 encoder_direction: int = 1) -> Emitted:
        """Writes the compensation map of another maker's drive: `hci-solve emit --for`, docs/drives.

        Args:
            target: simplefoc, st-mcsdk, moteus, novanta, beckhoff, openffboard or csv.
            folder: where the files go.
            name: of the files, a C identifier.
            per_torque: two parts, where the map depends on the torque.
            reference_torque_Nm: for which the ripple is told then; otherwise the one solved for.
            points: for targets that take any number; 0: theirs.
            torque_constant_Nm_per_A: by which the drive makes i_q of a torque; 0: that of the machine.
            wave: what the drive means by amplitude and phase: sine, cosine, sine-lag or cosine-lag.
            counts_per_A: for targets with counts; 0: not known.
            encoder_offset_deg: the drive's angle where the machine's is 0, in its own turns.
            encoder_direction: 1, or -1 where its angle falls when the machine turns in its positive direction.
        """
        words = [text(lib.hci_foreign_word(k)) for k in range(lib.HCI_FOREIGN_TARGET_COUNT)]
        note, result = Note(), ffi.new("hci_emit_foreign_result *")
        identifier, own = ffi.new("char[]", name.encode()), ffi.new("char[]", path(self.machine.path))
        request = ffi.new("hci_emit_foreign_request *", {
            "name": identifier, "target": _word({word: k for k, word in enumerate(words)}, target, "target"), "machine_folder": own,
            "machine": self.machine.c, "points": whole(points, "points"), "torque_constant_Nm_per_A": torque_constant_Nm_per_A,
            "wave": _word(_WAVES, wave, "wave"), "counts_per_A": counts_per_A, "encoder_offset_deg": encoder_offset_deg,
            "encoder_direction": encoder_direction})
        with Tables() as tables:
            kept = self._parts(request, per_torque, reference_torque_Nm, tables)
        with writing:
            note.check(lib.hci_emit_foreign(path(folder), request, result, note.c))
        del kept
        return Emitted(text(result.files).split(", "), json_of(lib.hci_emit_foreign_json(request, result)))

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Torque, its spectrum, phase currents and current vector, as solution.svg shows them."""
        first, facts = self.verdict.splitlines()[:2]
        figure = _look.figure_of(figure, 10.0, 6.6, first, facts)
        axes = figure.subplots(2, 2)
        self._draw_torque(axes[0][0])
        self._draw_spectrum(axes[0][1])
        self._draw_currents(axes[1][0])
        self._draw_vector(axes[1][1])
        return figure

    def _draw_torque(self, axes: "Axes") -> None:
        wave, angle = self.waveform, np.degrees(self.waveform["theta_e_rad"])
        _look.axes_of(axes, "Torque", "electrical angle, degrees", "N·m")
        axes.plot(angle, wave["torque_before_Nm"], color=_look.BEFORE, lw=1.1, label="before")
        axes.plot(angle, wave["torque_wanted_Nm"], color=_look.WANTED, lw=2.4, ls=(0, (3, 2)), label="wanted")
        axes.plot(angle, wave["torque_Nm"], color=_look.AFTER, lw=1.6, label="after")
        axes.margins(x=0)
        _look.legend_of(axes)

    def _draw_spectrum(self, axes: "Axes") -> None:
        orders = self.orders[self.orders["torque_Nm"]["order"] > 0.0]
        sizes = [amplitude(orders[name]) for name in ("before_Nm", "target_Nm", "torque_Nm")]
        shown = np.max(sizes, axis=0) > 2e-3 * np.max(sizes, initial=1e-300) if len(orders) else np.zeros(0, bool)
        place = np.arange(np.count_nonzero(shown))
        _look.axes_of(axes, "Torque ripple by order", "electrical order", "N·m, peak")
        axes.bar(place - 0.2, sizes[0][shown], 0.4, color=_look.AXIS, label="before")
        axes.bar(place + 0.2, sizes[2][shown], 0.4, color=_look.AFTER, label="after")
        axes.bar(place, sizes[1][shown], 0.8, fill=False, edgecolor=_look.WANTED, lw=1.2, label="wanted")
        _look.some_labels(axes, [f"{order:.4g}" for order in orders["torque_Nm"]["order"][shown]], 16)
        _look.legend_of(axes)

    def _draw_currents(self, axes: "Axes") -> None:
        wave, angle = self.waveform, np.degrees(self.waveform["theta_e_rad"])
        _look.axes_of(axes, "Phase currents", "electrical angle, degrees", "A")
        axes.plot(angle, wave["ia_plain_A"], color=_look.BEFORE, lw=1.1, label="a before")
        for phase, colour in zip("abc", _look.PHASES):
            axes.plot(angle, wave[f"i{phase}_A"], color=colour, lw=1.6, label=phase)
        axes.margins(x=0)
        _look.legend_of(axes)

    def _draw_vector(self, axes: "Axes") -> None:
        _look.axes_of(axes, "Current vector in the rotor frame", "i_d, A", "i_q, A")
        axes.plot(self.waveform["id_A"], self.waveform["iq_A"], color=_look.AFTER, lw=1.2)
        axes.set_aspect("equal", "datalim")


def _word(words: Dict[str, int], word: str, what: str) -> int:
    if word not in words:
        raise ArgumentError(f"{what}: found {word!r}, expected one of {', '.join(words)}; give one of these")
    return words[word]


def _currents(folder: bytes, part: int, tables: Tables) -> Any:
    read, note = ffi.gc(ffi.new("hci_currents *"), lib.hci_currents_release), Note()
    note.check(lib.hci_solution_read_currents(folder, part, read, note.c), hide=tables.hide)
    return read
