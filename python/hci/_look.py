"""The look of the pictures: the colours of the reports (src/host/draw/svg_style.c)."""
from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any, Optional, Sequence

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TEXT, QUIET, AXIS, GRID = "#1c1f23", "#5a6068", "#8b9099", "#e4e6ea"
BEFORE, WANTED, AFTER, ALARM = "#767c86", "#b87a00", "#0072b2", "#c04a00"
PHASES = ("#0072b2", "#b87a00", "#009e73")


def figure_of(figure: Optional["Figure"], width: float, height: float, title: str, facts: str = "") -> "Figure":
    """The figure that is drawn into, with its heading."""
    if figure is None:
        from matplotlib import pyplot

        figure = pyplot.figure()
    figure.set_size_inches(width, height)
    figure.set_layout_engine("constrained")
    heading = figure.suptitle("\n".join(textwrap.wrap(title, int(7.5 * width))), x=0.01, ha="left", fontsize=13, fontweight="bold", color=TEXT)
    if facts:
        letters = int(9.5 * width)
        heading.set_text("\n".join(textwrap.wrap(title, letters) + textwrap.wrap(facts, letters)))
        heading.set_fontsize(10)
    return figure


def axes_of(axes: "Axes", title: str, x: str, y: str) -> "Axes":
    """Axes in this look."""
    axes.set_title(title, loc="left", fontsize=10, fontweight="bold", color=TEXT)
    axes.set_xlabel(x, fontsize=9, color=QUIET)
    axes.set_ylabel(y, fontsize=9, color=QUIET)
    axes.tick_params(labelsize=8, color=AXIS, labelcolor=QUIET)
    axes.grid(True, color=GRID, linewidth=0.8)
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(AXIS)
    return axes


def calm(axes: "Axes", share: float = 1e-6) -> None:
    """No axis over rounding alone: at least this share of the values is shown."""
    low, high = axes.get_ylim()
    least = share * max(abs(low), abs(high), 1e-9)
    if high - low < least:
        axes.set_ylim((low + high - least) / 2, (low + high + least) / 2)


def logarithmic(axes: "Axes", name: str) -> None:
    """A logarithmic axis, x or y, with at least half a decade and with labels that have room."""
    from matplotlib.ticker import FormatStrFormatter, LogFormatterMathtext, LogLocator, NullFormatter

    axis = getattr(axes, name + "axis")
    axes.set(**{name + "scale": "log"})
    low, high = axis.get_view_interval()
    wider = max(1.0, 10.0 ** (0.5 - math.log10(high / low)))
    axes.set(**{name + "lim": (low / math.sqrt(wider), high * math.sqrt(wider))})
    is_short = math.log10(wider * high / low) < 2.0
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if is_short else (1.0,)))
    axis.set_major_formatter(FormatStrFormatter("%g") if is_short else LogFormatterMathtext())
    axis.set_minor_formatter(NullFormatter())


def some_labels(axes: "Axes", labels: Sequence[str], most: int) -> None:
    """Labels of places 0, 1, … along x: all, or every so many."""
    every = -(-len(labels) // most) if labels else 1
    axes.set_xticks(range(0, len(labels), every), labels[::every])


def legend_of(axes: "Axes", **more: Any) -> None:
    """A legend over the axes, to the right."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, frameon=False, fontsize=8,
                labelcolor=QUIET, borderaxespad=0.2, handlelength=1.4, columnspacing=1.2, **more)
