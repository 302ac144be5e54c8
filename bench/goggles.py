"""The goggles' OSD in a changing flight: CPU of a drawn frame, and bytes on the line.

The flight's telemetry is drawn again from its recorded frames, with the changed characters alone
and with all cells each time.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from msp_cog.osd_config import OsdConfig
from msp_cog.osd_screen import OsdScreen
from msp_cog.osd_texts import OsdTexts

from bench.codecs import QUICK_ROUNDS, ROUNDS, cpu_us
from bench.table import Row, compared, figure
from bench.timing import Limit
from up.telemetry_frame import Frame
from up_simulator.scenario.build import build_flight
from up_simulator.scenario.file import parse_scenario

SECONDS, QUICK_SECONDS = 60, 10
DRAWN_HZ = 10
CPU_TARGET, MAX_SHARE = Limit(0.8), 0.1
PEER = "all cells each time"
FLIGHT = """
title: A climb and a circle in turbulence
board: host
duration_s: {seconds}
weather: {{wind_m_s: 4, turbulence: moderate}}
raspilot: {{runs: in process}}
phone: {{}}
goggles: 50x18
ground: {{role: operator, period_ms: 100}}
sticks:
  - {{at_s: 0, mode: AUTO, arm: true, throttle: 0.7}}
events:
  - {{at_s: 3, command: {{name: up.flight_mode.set, data: {{mode: LOITER}}}}}}
expect: [{{name: It flies, signal: truth.height_m, above: 0}}]
"""
Frames = list[Mapping[str, Any]]


def flown(seconds: int) -> tuple[Frames, float]:
    """Return the telemetry of a flight, and the bytes that its goggles got in a second."""
    flight = build_flight(parse_scenario(FLIGHT.format(seconds=seconds)))
    goggles, ground = flight.participants.goggles, flight.participants.ground
    assert goggles is not None and ground is not None
    frames: Frames = []
    received = [0]

    def on_row(time_s: float) -> None:
        if not time_s:
            received[0] = goggles.received
        elif not frames or ground.telemetry is not frames[-1]:
            frames.append(ground.telemetry)

    record = flight.fly(on_row)
    if record.failure is not None or goggles.errors:
        raise RuntimeError(f"the flight failed: {record.failure}, errors: {goggles.errors}")
    return frames, (goggles.received - received[0]) / seconds


def drawing(frames: Frames, is_whole: bool) -> tuple[Callable[[], int], list[int]]:
    """Return the work, and where it leaves the bytes of its last round."""
    config = OsdConfig()
    count = [0]

    def work() -> int:
        texts, screen, count[0] = OsdTexts(), OsdScreen(*config.size), 0
        for number, frame in enumerate(frames):
            now_s = number / DRAWN_HZ
            texts.update(Frame(frame), now_s)
            screen.put_all(config.places, lambda name, now_s=now_s: texts.text(name, now_s))
            if is_whole:
                screen.forget()
            count[0] += len(screen.changes(config.bytes_per_s))
        return len(frames)

    return work, count


def rows(quick: bool = False) -> Iterable[Row]:
    frames, bytes_per_s = flown(QUICK_SECONDS if quick else SECONDS)
    (ours, _), (whole, count) = drawing(frames, False), drawing(frames, True)
    changed_us, whole_us = cpu_us(ours, whole, rounds=QUICK_ROUNDS if quick else ROUNDS)
    what = "goggles, CPU of a drawn frame, 50x18"
    yield compared(what, "us", changed_us, PEER, whole_us, CPU_TARGET)
    whole_per_s = count[0] / len(frames) * DRAWN_HZ
    share = bytes_per_s / whole_per_s
    yield Row(
        "goggles, bytes a second in turbulence",
        figure(bytes_per_s, "B/s"),
        PEER,
        figure(whole_per_s, "B/s"),
        f"{figure(share)}x",
        f"<= {MAX_SHARE:g}x",
        share <= MAX_SHARE,
    )
