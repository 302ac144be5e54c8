"""Draws the icons: a banked horizon behind the wings of an attitude indicator.

``icons.py RES`` writes ic_launcher.png and ic_notification.png into the drawable folders of every
density. The launcher's icon is in colour; the notification's is white, as Android requires (it uses
only the shape). Shapes are distances: a pixel is covered by the distance of its middle.
"""

from __future__ import annotations

import itertools
import math
import struct
import sys
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

# Pixels for 1 dp.
DENSITIES = {"mdpi": 1.0, "hdpi": 1.5, "xhdpi": 2.0, "xxhdpi": 3.0, "xxxhdpi": 4.0}
LAUNCHER_DP = 48
NOTIFICATION_DP = 24

Colour = tuple[float, float, float]
Pixel = tuple[float, float, float, float]

SKY_HIGH: Colour = (22, 92, 158)
SKY_LOW: Colour = (126, 195, 240)
EARTH_NEAR: Colour = (148, 98, 52)
EARTH_FAR: Colour = (84, 52, 26)
RIM: Colour = (16, 34, 54)
WHITE: Colour = (255, 255, 255)
CLEAR: Pixel = (0, 0, 0, 0)

# The icon is one unit wide; the aeroplane banks to the left, so the horizon falls to the right.
BANK_RAD = math.radians(-14)
WINGS = ((0.17, 0.50), (0.385, 0.50), (0.50, 0.60), (0.615, 0.50), (0.83, 0.50))


def disc(x: float, y: float, radius: float) -> float:
    """Return the distance from a disc in the middle, negative within."""
    return math.hypot(x - 0.5, y - 0.5) - radius


def stroke(x: float, y: float, points: tuple[tuple[float, float], ...], half: float) -> float:
    """Return the distance from a line through ``points`` with round ends, ``half`` its width."""
    nearest = math.inf
    for (ax, ay), (bx, by) in itertools.pairwise(points):
        dx, dy = bx - ax, by - ay
        along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
        along = min(1.0, max(0.0, along))
        nearest = min(nearest, math.hypot(x - ax - along * dx, y - ay - along * dy))
    return nearest - half


def blend(low: Colour, high: Colour, share: float) -> Colour:
    """Return the colour at ``share`` between ``low`` and ``high``."""
    share = min(1.0, max(0.0, share))
    red, green, blue = (a + (b - a) * share for a, b in zip(low, high, strict=True))
    return red, green, blue


def over(below: Pixel, colour: Colour, cover: float) -> Pixel:
    """Return ``below`` with ``colour`` laid over it, ``cover`` of it opaque."""
    alpha = cover + below[3] * (1 - cover)
    if alpha == 0:
        return CLEAR
    kept = below[3] * (1 - cover)
    red, green, blue = (
        (a * cover + b * kept) / alpha for a, b in zip(colour, below[:3], strict=True)
    )
    return red, green, blue, alpha


def launcher(x: float, y: float, pixel: float) -> Pixel:
    """Return the launcher icon's colour at a place; ``pixel`` is one pixel's width."""

    def cover(distance: float) -> float:
        return min(1.0, max(0.0, 0.5 - distance / pixel))

    below = (y - 0.5) * math.cos(BANK_RAD) + (x - 0.5) * math.sin(BANK_RAD)
    sky = blend(SKY_LOW, SKY_HIGH, -below / 0.42)
    earth = blend(EARTH_NEAR, EARTH_FAR, below / 0.42)
    shown = over(CLEAR, RIM, cover(disc(x, y, 0.48)))
    inside = cover(disc(x, y, 0.44))
    shown = over(shown, sky, inside)
    shown = over(shown, earth, min(inside, cover(-below)))
    shown = over(shown, WHITE, min(inside, cover(abs(below) - 0.011)))
    shown = over(shown, RIM, 0.55 * min(inside, cover(stroke(x, y - 0.012, WINGS, 0.052))))
    return over(shown, WHITE, cover(stroke(x, y, WINGS, 0.036)))


def notification(x: float, y: float, pixel: float) -> Pixel:
    """Return the notification icon's colour at a place: white, or nothing."""

    def cover(distance: float) -> float:
        return min(1.0, max(0.0, 0.5 - distance / pixel))

    rim = cover(abs(disc(x, y, 0.405)) - 0.045)
    return over(CLEAR, WHITE, max(rim, cover(stroke(x, y - 0.01, WINGS, 0.05))))


def drawn(shade: Callable[[float, float, float], Pixel], side: int) -> Iterator[bytes]:
    """Yield the rows of a square picture of ``side`` pixels, RGBA."""
    for row in range(side):
        values: list[int] = []
        for column in range(side):
            red, green, blue, alpha = shade((column + 0.5) / side, (row + 0.5) / side, 1 / side)
            values += [round(red), round(green), round(blue), round(alpha * 255)]
        yield bytes(values)


def filtered(rows: list[bytes], kind: int) -> bytes:
    """Return the rows under one of PNG's filters: 0 none, 1 less the left, 2 less the upper."""
    out = bytearray()
    upper = bytes(len(rows[0]))
    for row in rows:
        before = (bytes(len(row)), bytes(4) + row[:-4], upper)[kind]
        out.append(kind)
        out += bytes((a - b) & 255 for a, b in zip(row, before, strict=True))
        upper = row
    return bytes(out)


def png(rows: list[bytes]) -> bytes:
    """Return a PNG (RGBA, 8 bits) of the rows, with the filter that compresses best."""

    def chunk(name: bytes, content: bytes) -> bytes:
        checked = name + content
        return struct.pack(">I", len(content)) + checked + struct.pack(">I", zlib.crc32(checked))

    packed = min((zlib.compress(filtered(rows, kind), 9) for kind in range(3)), key=len)
    header = struct.pack(">IIBBBBB", len(rows[0]) // 4, len(rows), 8, 6, 0, 0, 0)
    start = b"\x89PNG\r\n\x1a\n"
    return start + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b"")


def write(res: Path) -> None:
    """Write both icons in every density below the folder ``res``."""
    for density, scale in DENSITIES.items():
        folder = res / f"drawable-{density}"
        folder.mkdir(parents=True, exist_ok=True)
        for name, shade, size_dp in (
            ("ic_launcher", launcher, LAUNCHER_DP),
            ("ic_notification", notification, NOTIFICATION_DP),
        ):
            rows = list(drawn(shade, round(size_dp * scale)))
            (folder / f"{name}.png").write_bytes(png(rows))


if __name__ == "__main__":
    write(Path(sys.argv[1]))
