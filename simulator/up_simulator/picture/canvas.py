"""The drawing surface: the only module that imports and uses matplotlib."""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from up.errors import UserError
from up_simulator.picture.palette import GRID, INK, MUTED, PAPER

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DOTS_PER_IN = 110
SUFFIXES = (".png", ".svg")
_STYLE: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.edgecolor": MUTED,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "text.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.3,
    "hatch.linewidth": 0.6,
    "figure.facecolor": PAPER,
    "savefig.facecolor": PAPER,
    "svg.hashsalt": "up_simulator",
    "path.simplify": True,
}


class PictureError(UserError):
    """A picture cannot be drawn."""


class Sheet:
    """A figure on which everything is placed in inches from its upper left corner."""

    def __init__(self, figure: Figure) -> None:
        self._figure = figure

    def axes(self, left: float, top: float, width: float, height: float, **options: Any) -> Axes:
        paper_width, paper_height = self._figure.get_size_inches()
        place = (
            left / paper_width,
            1 - (top + height) / paper_height,
            width / paper_width,
            height / paper_height,
        )
        return self._figure.add_axes(place, **options)

    def text(self, left: float, top: float, words: str, **options: Any) -> None:
        paper_width, paper_height = self._figure.get_size_inches()
        options = {"va": "top", "ha": "left", **options}
        self._figure.text(left / paper_width, 1 - top / paper_height, words, **options)

    def resize(self, width: float, height: float) -> None:
        """Make it another size; call before anything is placed."""
        self._figure.set_size_inches(width, height)

    def text_width(self, words: str, **options: Any) -> float:
        """Return how many inches wide words are."""
        text = self._figure.text(0, 0, words, **options)
        extent = text.get_window_extent(renderer=self._figure.canvas.get_renderer())  # type: ignore[attr-defined]
        text.remove()
        return float(extent.width) / self._figure.dpi


@contextlib.contextmanager
def sheet_for(path: Path) -> Iterator[Sheet]:
    """Give a sheet to draw on and save it to ``path`` afterwards: .png or .svg, without a date.

    The same drawing gives the same bytes. The user's own style and matplotlib's global state stay
    out of it. Raises ``PictureError`` where matplotlib is missing or the file cannot be written.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise PictureError(f"{path}: a picture ends in .png or .svg", "unknown_format")
    try:
        matplotlib = importlib.import_module("matplotlib")
        figures = importlib.import_module("matplotlib.figure")
        agg = importlib.import_module("matplotlib.backends.backend_agg")
    except ImportError as error:
        raise PictureError(
            "no picture: matplotlib is not installed; pip install -e '.[sim]' brings it",
            "no_matplotlib",
        ) from error
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_STYLE)
        figure = figures.Figure(dpi=DOTS_PER_IN)
        agg.FigureCanvasAgg(figure)
        yield Sheet(figure)
        metadata = {"Software": None} if suffix == ".png" else {"Date": None, "Creator": None}
        try:
            figure.savefig(path, format=suffix[1:], metadata=metadata)
        except OSError as error:
            # Remove the incomplete picture.
            with contextlib.suppress(OSError):
                path.unlink()
            reason = error.strerror or error
            text = f"{path}: the picture cannot be written: {reason}"
            raise PictureError(text, "not_writable") from error
