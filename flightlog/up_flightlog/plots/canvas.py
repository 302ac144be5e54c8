"""The drawing surface: the only module that imports matplotlib and saves its figures."""

from __future__ import annotations

import importlib
import importlib.util
import io
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from up.errors import UserError
from up_flightlog.plots.theme import Theme

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MISSING = "matplotlib is not installed: pip install 'raspilot[log]'"
_COLOURS = 128
"""A line drawing has few colours; a palette makes its file a third as large."""


class PictureError(UserError):
    """A picture cannot be drawn; the text is one sentence for the user."""


class Sheet:
    """A figure on which positions are in inches from the upper left corner."""

    def __init__(
        self, figure: Figure, theme: Theme, place: tuple[float, float, float, float] | None = None
    ) -> None:
        self.theme = theme
        self._figure = figure
        self._paper = tuple(map(float, figure.get_size_inches()))
        self._left, self._top, self.width, self.height = place or (0.0, 0.0, *self._paper)

    def part(self, left: float, top: float, width: float, height: float) -> Sheet:
        """Return a part of this sheet as a separate sheet."""
        place = (self._left + left, self._top + top, width, height)
        return Sheet(self._figure, self.theme, place)

    def axes(self, left: float, top: float, width: float, height: float) -> Axes:
        paper_width, paper_height = self._paper
        return self._figure.add_axes(
            (
                (self._left + left) / paper_width,
                1 - (self._top + top + height) / paper_height,
                width / paper_width,
                height / paper_height,
            )
        )

    def size_of(self, axes: Axes) -> tuple[float, float]:
        """Return the width and height of axes, inches."""
        box = axes.get_position()
        return box.width * self._paper[0], box.height * self._paper[1]

    def resize(self, width: float, height: float) -> None:
        """Change the size of the whole paper, inches; call it before anything is placed."""
        self._figure.set_size_inches(width, height)
        self._paper = (width, height)
        self.width, self.height = width, height

    def text(self, left: float, top: float, words: str, **options: Any) -> None:
        """Write text with its upper left corner at a position."""
        x, y = (self._left + left) / self._paper[0], 1 - (self._top + top) / self._paper[1]
        self._figure.text(x, y, words, va="top", ha="left", **options)

    def text_width(self, words: str, size: float) -> float:
        text = self._figure.text(0, 0, words, size=size)
        extent = text.get_window_extent(renderer=self._figure.canvas.get_renderer())  # type: ignore[attr-defined]
        text.remove()
        return float(extent.width) / float(self._figure.dpi)


def has_matplotlib() -> bool:
    """Return whether matplotlib is available, without the cost of importing it."""
    return importlib.util.find_spec("matplotlib") is not None


def load_matplotlib() -> tuple[Any, Any, Any, Any]:
    """Import what draws: matplotlib, its figures and canvas, and PIL's images.

    Raises PictureError without them.
    """
    names = ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg", "PIL.Image")
    try:
        matplotlib, figures, agg, images = map(importlib.import_module, names)
    except ImportError as error:
        raise PictureError(MISSING, "no_matplotlib") from error
    return matplotlib, figures, agg, images


def png_of(
    paint: Callable[[Sheet], None], width_in: float, height_in: float, dpi: int, theme: Theme
) -> bytes:
    """Return the drawing of ``paint`` as a PNG without a date: equal drawings are equal bytes.

    Ignores the user's style and matplotlib's global state. Raises PictureError without matplotlib.
    """
    matplotlib, figures, agg, images = load_matplotlib()
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_style(theme))
        figure = figures.Figure(figsize=(width_in, height_in), dpi=dpi)
        canvas = agg.FigureCanvasAgg(figure)
        paint(Sheet(figure, theme))
        canvas.draw()
        width, height = canvas.get_width_height()
        image = images.frombuffer(
            "RGBA", (width, height), canvas.buffer_rgba(), "raw", "RGBA", 0, 1
        )
        data = io.BytesIO()
        # The octree takes a seventh of the time of the median cut, and as many bytes.
        image.convert("RGB").quantize(_COLOURS, images.Quantize.FASTOCTREE, dither=0).save(
            data, "PNG", compress_level=6
        )
    return data.getvalue()


def _style(theme: Theme) -> dict[str, Any]:
    return {
        "font.family": "DejaVu Sans",
        "font.size": 9.0,
        "axes.facecolor": theme.paper,
        "axes.edgecolor": theme.muted,
        "axes.labelcolor": theme.muted,
        "axes.linewidth": 0.7,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.axisbelow": True,
        "axes.grid": True,
        "grid.color": theme.grid,
        "grid.linewidth": 0.6,
        "xtick.color": theme.muted,
        "ytick.color": theme.muted,
        "xtick.labelcolor": theme.muted,
        "ytick.labelcolor": theme.muted,
        "text.color": theme.ink,
        # A dollar sign from a log must not begin a formula.
        "text.parse_math": False,
        "legend.frameon": False,
        "legend.fontsize": 8.5,
        "lines.linewidth": 1.3,
        "hatch.linewidth": 0.6,
        "figure.facecolor": theme.paper,
    }
