"""The characters on the goggles: those that were sent, and those that differ."""

from collections.abc import Callable, Iterator, Mapping

from msp_cog.displayport import MAX_TEXT, write
from msp_cog.osd_config import WIDTHS

MAX_GAP = 10
"""A frame costs as many bytes more than its text: a shorter gap is sent with it."""
_UNKNOWN = ""


class OsdScreen:
    """A grid of characters; ``changes`` gives the frames that bring the goggles up to date."""

    def __init__(self, columns: int, rows: int) -> None:
        self.grid = columns, rows
        self._shown = [[" "] * columns for _ in range(rows)]
        self.forget()

    def put(self, row: int, column: int, text: str) -> None:
        self._shown[row][column : column + len(text)] = text

    def put_all(self, places: Mapping[str, tuple[int, int]], text: Callable[[str], str]) -> None:
        """Write the text of every element at its column and row, as wide as the element is."""
        for name, (column, row) in places.items():
            width = WIDTHS[name]
            self.put(row, column, f"{text(name):<{width}.{width}}")

    def forget(self, row: int | None = None) -> None:
        """Count a row, or all of them, as not sent."""
        columns, rows = self.grid
        if row is None:
            self._sent = [[_UNKNOWN] * columns for _ in range(rows)]
        else:
            self._sent[row] = [_UNKNOWN] * columns

    def clear(self) -> None:
        """Count the goggles as blank."""
        columns, rows = self.grid
        self._sent = [[" "] * columns for _ in range(rows)]

    def changes(self, max_bytes: int) -> bytes:
        """Return frames of what differs, as many as fit; they count as sent."""
        frames = b""
        for row, (shown, sent) in enumerate(zip(self._shown, self._sent, strict=True)):
            for begin, end in _runs(shown, sent):
                frame = write(row, begin, "".join(shown[begin:end]))
                if len(frames) + len(frame) > max_bytes:
                    return frames
                frames += frame
                sent[begin:end] = shown[begin:end]
        return frames


def _runs(shown: list[str], sent: list[str]) -> Iterator[tuple[int, int]]:
    """Yield the columns of each text to send: from, and to before."""
    begin = end = -1
    for column, (new, old) in enumerate(zip(shown, list(sent), strict=True)):
        if new == old:
            continue
        if begin >= 0 and (column - end > MAX_GAP or column - begin >= MAX_TEXT):
            yield begin, end
            begin = -1
        begin, end = (column if begin < 0 else begin), column + 1
    if begin >= 0:
        yield begin, end
