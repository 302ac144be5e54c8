"""The ground station's page: from Raspilot's telemetry to the pixel, in a headless Chromium.

`make run`'s own processes fly the virtual aircraft. The flight's log gives the time at which a
frame was sent, the page's own clock the time on the screen, at the animation frame after the
change.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bench.processes import environment
from bench.table import LeftOutError, Row
from bench.timing import percentile
from up_flightlog.read.flight_log import FlightLog

ROOT = Path(__file__).parents[1]
TESTS = ROOT / "tests" / "browser"
NEEDED = {"node": "nodejs", "npm": "npm", "chromium-headless-shell": "chromium-headless-shell"}
SECONDS, QUICK_SECONDS = 20.0, 4.0
PERIOD_MS = 50
LIMIT_S = 300.0
LOOPBACK_TARGET_MS, IN_PAGE_TARGET_MS, LINK_TARGET_MS = 50.0, 25.0, 150.0
SMOOTH_TARGET_HZ = 50.0
LINK = "delay=100"


@dataclass(frozen=True, slots=True)
class Paints:
    """The measurements of a page during one flight; times are milliseconds, sorted.

    ``to_pixel``: from the sending of a frame; ``attitude``: from the measurement of the attitude
    in it; ``in_page``: from its arrival in the browser.
    """

    to_pixel: list[float]
    attitude: list[float]
    in_page: list[float]
    frames_hz: float
    animation_hz: float
    long_tasks: list[float]


def set_up() -> None:
    for program, package in NEEDED.items():
        if shutil.which(program) is None:
            raise LeftOutError(f"{program} is not installed (Debian package {package})")
    for command in ((ROOT / "tools" / "npm_modules", TESTS), (ROOT / "tools" / "web_assets",)):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise LeftOutError(done.stderr.strip())


def measure(seconds: float, *options: str) -> Paints:
    with tempfile.TemporaryDirectory(prefix="upb-") as folder:
        command: list[str | Path] = [
            "node",
            TESTS / "measure.mjs",
            folder,
            str(seconds),
            str(PERIOD_MS),
            *options,
        ]
        done = subprocess.run(
            command,
            cwd=ROOT,
            capture_output=True,
            text=True,
            timeout=LIMIT_S,
            env={**environment(), "UP_PYTHON": sys.executable},
        )
        if done.returncode != 0:
            raise RuntimeError(f"the page was not measured: {done.stderr.strip()}")
        return _paints(json.loads(done.stdout), sent_frames(Path(folder, "flights")))


def sent_frames(flights: Path) -> dict[int, tuple[float, float]]:
    """Return by beacon when a frame was sent, and the age of its attitude then (both ms)."""
    log = FlightLog.read(sorted(flights.glob("*.mcap")))
    found = {}
    for message in log.messages("up.telemetry.update"):
        age_ms = message.data.get("age_ms", {}).get("orientation") or 0.0
        sent_ms = (log.start_unix_s + message.time_s) * 1000
        found[message.data["_beacon"]] = (sent_ms, age_ms)
    return found


def _paints(measured: dict[str, Any], sent: dict[int, tuple[float, float]]) -> Paints:
    painted = [each for each in measured["painted"] if each["beacon"] in sent]
    if not painted:
        raise RuntimeError("the page painted no frame that is in the log")
    delays = []
    for each in painted:
        sent_ms, age_ms = sent[each["beacon"]]
        delays.append((each["unix_ms"] - sent_ms, age_ms))
    return Paints(
        sorted(delay_ms for delay_ms, _ in delays),
        sorted(delay_ms + age_ms for delay_ms, age_ms in delays),
        sorted(each["inPage_ms"] for each in painted),
        len(painted) / measured["seconds"],
        measured["animationFrames"] / measured["seconds"],
        measured["longTasks_ms"],
    )


def _row(what: str, times_ms: list[float], target_ms: float) -> Row:
    p95_ms = percentile(times_ms, 0.95)
    middle = f"{percentile(times_ms, 0.5):.0f} ms"
    ours = f"{p95_ms:.0f} ms"
    return Row(what, ours, "p50", middle, "", f"<= {target_ms:g} ms", p95_ms <= target_ms)


def rows(quick: bool = False) -> Iterable[Row]:
    """Yield the delay of the screen, locally and over a link of 100 ms, and its smoothness."""
    set_up()
    seconds = QUICK_SECONDS if quick else SECONDS
    near = measure(seconds)
    yield _row(
        f"page: update to pixel, loopback, {near.frames_hz:.0f} frames/s, p95",
        near.to_pixel,
        LOOPBACK_TARGET_MS,
    )
    yield _row("page: of that in the browser, p95", near.in_page, IN_PAGE_TARGET_MS)
    yield Row(
        "page: animation frames a second",
        f"{near.animation_hz:.0f}",
        target=f">= {SMOOTH_TARGET_HZ:g}",
        met=near.animation_hz >= SMOOTH_TARGET_HZ,
    )
    longest_ms = max(near.long_tasks, default=0.0)
    yield Row(
        f"page: tasks beyond 50 ms in {seconds:g} s",
        str(len(near.long_tasks)),
        "longest",
        f"{longest_ms:.0f} ms",
    )
    far = measure(seconds, "--link", LINK)
    yield _row(
        f"page: update to pixel, link of 100 ms, {far.frames_hz:.0f} frames/s, p95",
        far.to_pixel,
        LINK_TARGET_MS,
    )
    yield _row("page: attitude to pixel, link of 100 ms, p95", far.attitude, LINK_TARGET_MS)
