"""What all results have in common."""
from __future__ import annotations

import base64
import html
import io
import json
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, Union

from ._binding import ffi, lib
from ._call import raw_text
from .errors import OutOfMemoryError

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


def json_of(pointer: Any) -> Dict[str, Any]:
    """A summary of the library, which is freed."""
    if pointer == ffi.NULL:
        raise OutOfMemoryError("out of memory for the summary")
    try:
        found: Dict[str, Any] = json.loads(raw_text(pointer))
        return found
    finally:
        lib.hci_text_free(pointer)


class Result:
    """A result: figures in `summary`, a verdict in words, arrays, a table and a picture."""

    #: All figures by name, as `--json` of the program prints them.
    summary: Dict[str, Any]

    def __reduce__(self) -> Union[str, Tuple[Any, ...]]:
        raise TypeError(f"{type(self).__name__}: memory of the library cannot be pickled or copied; hand on its `summary`, and "
                        "copies of its arrays")

    @property
    def verdict(self) -> str:
        """What came of it, in a sentence or a few."""
        raise NotImplementedError

    @property
    def remark(self) -> str:
        """What a reader should know of it, or ""."""
        return ""

    def to_pandas(self) -> "pandas.DataFrame":
        """The main table of the result; columns have their units in their names."""
        raise NotImplementedError

    def plot(self, figure: Optional["Figure"] = None) -> "Figure":
        """Draws the result into a figure of matplotlib, or into a new one."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.verdict.splitlines()[0]}>"

    def _repr_html_(self) -> str:
        """Verdict and picture, for a notebook."""
        first, *more = self.verdict.splitlines()
        page = [f'<p style="font-size:1.2em;font-weight:600">{html.escape(first)}</p>']
        page += [f"<p>{html.escape(line)}</p>" for line in more if line]
        if self.remark:
            page.append(f'<p style="color:#5a6068">{html.escape(self.remark)}</p>')
        picture = self._picture()
        if picture:
            page.append(f'<img alt="{html.escape(first, True)}" src="data:image/png;base64,{picture}"/>')
        return "\n".join(page)

    def _picture(self) -> str:
        """The picture in base64, without a title, since the verdict stands above it, or "" without matplotlib."""
        try:
            from matplotlib.figure import Figure
        except ImportError:
            return ""
        figure, out = Figure(), io.BytesIO()
        self.plot(figure)
        figure.suptitle("")
        figure.savefig(out, format="png", dpi=90)
        return base64.b64encode(out.getvalue()).decode()
