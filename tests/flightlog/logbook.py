"""Recorded flights in a folder, made of real Commands and named as the black box names them."""

from __future__ import annotations

import functools
from pathlib import Path

from tests.flightlog.flights import GROUND, AndroidBatteryCommand, FlightMaker
from up.commands.altitude_command import AltitudeCommand
from up.commands.gains import gain_set_from_data
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.flight_log.flight_file import FlightFile

SECOND_NS = 1_000_000_000
START_UNIX_S = 1_777_000_000
CONFIG = b"# by hand\nlog level: info\n"
EVIL = '<img src="http://evil.example/x" onerror=alert(1)></title><script>alert(2)</script>'


def gains(p):
    axis = {"p": p, "i": 0.0, "d": 0.1}
    axes = {"ailerons": axis, "elevator": axis, "rudder": axis}
    return PIDTuningsValuesCommand.of(gain_set_from_data({"ratePIDs": axes, "stabPIDs": axes}))


def quiet(maker):
    """20 s in which nothing goes wrong, 10 of them armed."""
    maker.quiet_flight()
    maker.every(0, 20, 0.5, lambda time_s: AltitudeCommand(300.0 + time_s))
    maker.put(1.0, gains(2.0))


def eventful(maker):
    """Gains change, marks are set, there is a truth, and texts are malicious."""
    quiet(maker)
    maker.put(2.0, AndroidBatteryCommand(80))
    maker.put(5.9, PIDTuningsCommand(pids=gains(3.0).data), GROUND)
    maker.put(6.0, gains(3.0))
    maker.add(9.0, "black_box.mark", text=f"look {EVIL}")
    maker.line(9.5, 4, EVIL, f"trouble {EVIL}")
    truth = {"latitude_deg": 50.0, "longitude_deg": 14.0, "altitude_m": 301.0}
    for number in range(200):
        time_s = number / 10
        angles = {"roll_deg": 2.0, "pitch_deg": 2.0, "yaw_deg": 3.0}
        wind = {"wind_north_m_s": 0.0, "wind_east_m_s": 4.0}
        maker.add(time_s, "simulator.truth", **truth, **angles, **wind)
    maker.writer.add_attachment(f"config/{EVIL}.yml", "text/yaml", EVIL.encode(), maker.start_ns)


def write_flight(
    folder: Path,
    number: int = 1,
    fill=quiet,
    *,
    aircraft: str = "kite",
    start_unix_s: float = START_UNIX_S,
    is_finished: bool = True,
    part: int = 1,
) -> Path:
    path = FlightFile.first(folder, number, start_unix_s, aircraft).at_part(part).path
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(_content(fill, aircraft, start_unix_s, is_finished))
    return path


@functools.lru_cache(maxsize=16)
def _content(fill, aircraft: str, start_unix_s: float, is_finished: bool) -> bytes:
    maker = FlightMaker(start_ns=round(start_unix_s * SECOND_NS))
    maker.writer.add_metadata("flight", {"aircraft": aircraft, "version": "0.1.0", "host": "pi"})
    maker.writer.add_metadata("versions", {"up": "0.1.0", "serial_cog": "1.0.0"})
    maker.writer.add_attachment("config/config.yml", "text/yaml", CONFIG, maker.start_ns)
    fill(maker)
    return maker.finished() if is_finished else bytes(maker.out)
