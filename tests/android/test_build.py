"""The phone is built from source: the Up Library's tests pass, the app becomes a signed APK."""

from __future__ import annotations

import re
import struct
import sys
import zlib

from tests.support.android import ANDROID, BUILD, make, need_android, need_jars
from tests.support.tools import need_tool

sys.path.insert(0, str(ANDROID / "tools"))
import icons


def test_the_up_library_passes_its_tests():
    need_jars("junit")
    make("build/core-tests.jar")
    counted = re.search(r"^OK \((\d+) tests\)$", make("test", is_built=True), re.MULTILINE)
    assert counted and int(counted[1]) > 100


def test_the_app_is_built_signed_and_verified():
    need_android()
    said = make()
    for scheme in (1, 2, 3):
        assert re.search(rf"^Verified using v{scheme} scheme .*: true$", said, re.MULTILINE)
    size = re.search(r"^raspilot\.apk (\d+) bytes of 400000 ", said, re.MULTILINE)
    assert size and int(size[1]) == (BUILD / "raspilot.apk").stat().st_size <= 400000


def test_the_help_names_every_target():
    need_tool("make")
    said = make("help")
    for target in ("core", "virtual", "test", "check", "fetch", "icons", "clean"):
        assert f"make -C android {target} " in said


def pixels(png):
    """Return width and the bytes of a PNG of ours (RGBA, filters 0 to 2)."""
    width, height = struct.unpack(">II", png[16:24])
    at, packed = 8, b""
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        if png[at + 4 : at + 8] == b"IDAT":
            packed += png[at + 8 : at + 8 + length]
        at += length + 12
    raw, rows, upper = zlib.decompress(packed), [], bytes(4 * width)
    for row in range(height):
        kind, line = raw[row * (4 * width + 1)], raw[row * (4 * width + 1) + 1 :][: 4 * width]
        plain = bytearray(line)
        for each in range(4 * width):
            left = plain[each - 4] if each >= 4 else 0
            plain[each] = (line[each] + (0, left, upper[each])[kind]) & 255
        rows.append(bytes(plain))
        upper = plain
    return width, b"".join(rows)


def test_the_icons_are_what_their_generator_draws(tmp_path):
    icons.write(tmp_path)
    drawn = sorted(each.relative_to(tmp_path) for each in tmp_path.rglob("*.png"))
    assert len(drawn) == 10
    for each in drawn:
        width, new = pixels((tmp_path / each).read_bytes())
        committed_width, old = pixels((ANDROID / "raspilot" / "res" / each).read_bytes())
        assert width == committed_width
        assert max(abs(a - b) for a, b in zip(new, old, strict=True)) <= 1


def test_the_notification_is_white_alone():
    for each in (ANDROID / "raspilot" / "res").glob("drawable-*/ic_notification.png"):
        _, content = pixels(each.read_bytes())
        shown = [content[at : at + 3] for at in range(0, len(content), 4) if content[at + 3]]
        assert set(shown) == {b"\xff\xff\xff"}
