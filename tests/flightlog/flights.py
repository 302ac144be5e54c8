"""Flights for the tests, made of real Commands, logged as the black box logs them."""

from __future__ import annotations

import json

from android_cog.commands.android_commands import (
    AndroidBatteryCommand,
    AndroidBatteryLowCommand,
)
from arduino_cog.commands.arduino_status_command import ArduinoStatusCommand

from tests.flightlog.logs import LogMaker
from up.commands.altitude_command import AltitudeCommand
from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import OrientationCommand
from up.commands.origin import INTERNAL, Origin
from up.commands.panic_command import PanicCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.roles import Role
from up.commands.rx_command import ALL_VALID, RXCommand
from up.commands.servo_command import ServoCommand
from up.commands.system_commands import LinkStateCommand, SystemStateCommand
from up.commands.telemetry_commands import TelemetryCommand
from up.flight_log.command_schema import schema_of
from up.flight_log.origin_text import KEY, origin_text

BOARD = Origin("arduino", Role.BOARD, 10)
PHONE = Origin("android", Role.SENSOR)
GROUND = Origin("mission_control", Role.PILOT)

ARMED, AT_AUTO, RECEIVER, IMU, FAILSAFE, BIAS_STORED, GAINS_STORED, HEARD = (
    1 << bit for bit in range(8)
)
GOOD = RECEIVER | IMU | GAINS_STORED | HEARD
WATCHDOG, RESTORED = 1 << 3, 1 << 7

__all__ = [
    "ALL_VALID",
    "AltitudeCommand",
    "AndroidBatteryCommand",
    "AndroidBatteryLowCommand",
    "FlightStateCommand",
    "HeadingCommand",
    "LinkStateCommand",
    "LocationCommand",
    "OrientationCommand",
    "PIDTuningsCommand",
    "PIDTuningsValuesCommand",
    "PanicCommand",
    "RXCommand",
    "ServoCommand",
    "SystemStateCommand",
    "TelemetryCommand",
]


def status(**fields) -> ArduinoStatusCommand:
    plain = {
        "version": 1,
        "mode": ord("f"),
        "switch": 1,
        "flags": GOOD,
        "vetoes": 0,
        "reset_cause": 1,
        "loop_us": 2000,
        "late_us": 12,
        "frame_errors": 0,
        "frames_lost": 0,
        "uptime_s": 60,
        "rx_age_ms": 10,
        "imu_age_ms": 2,
        "battery_mv": 0,
        "acceleration": 0,
    }
    return ArduinoStatusCommand(**{**plain, **fields})


class FlightMaker(LogMaker):
    def put(self, time_s: float, command: BaseCommand, origin: Origin = INTERNAL) -> None:
        self.channel(command.NAME, schema_of(type(command)))
        data = command.data
        if isinstance(command, TelemetryCommand):
            data = {**data, "_beacon": command.beacon}
        data = {**data, KEY: origin_text(origin)}
        self.raw(time_s, command.NAME, json.dumps(data).encode())

    def line(
        self, time_s: float, level: int, name: str, text: str, /, code: str = "", **fields
    ) -> None:
        coded = {"code": code, "fields": fields} if code else {}
        self.add(time_s, "log", level=level, name=name, message=text, **coded)

    def every(self, begin_s: float, end_s: float, period_s: float, command, origin=BOARD) -> None:
        for number in range(round((end_s - begin_s) / period_s)):
            time_s = begin_s + number * period_s
            made = command(time_s) if callable(command) else command
            self.put(time_s, made, origin)

    def quiet_flight(self, length_s: float = 20.0, armed=(5.0, 15.0)) -> None:
        """Add the data of a flight without faults; armed between these times."""

        def state(time_s: float) -> FlightStateCommand:
            return FlightStateCommand("FBW", armed[0] <= time_s < armed[1], False, False)

        self.put(0, LinkStateCommand("arduino", True))
        self.put(0, LinkStateCommand("android", True))
        self.put(0, LinkStateCommand("mission_control", True))
        self.every(0, length_s, 0.1, OrientationCommand(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7))
        self.every(0, length_s, 0.1, RXCommand(1500, 1500, 1000, 1500, 1000, 2000, ALL_VALID))
        self.every(0, length_s, 0.2, state)
        self.every(0, length_s, 0.2, lambda time_s: status(uptime_s=round(time_s) + 3))
        self.every(
            0, length_s, 1.0, lambda time_s: LocationCommand(50 + time_s / 1e4, 14.0, 300.0), PHONE
        )
