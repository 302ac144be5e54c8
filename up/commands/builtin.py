"""The Commands included in Up."""

from __future__ import annotations

from up.commands.airspeed_command import AirspeedCommand
from up.commands.altitude_command import AltitudeCommand
from up.commands.answer_commands import AckCommand, CommandAnsweredCommand, NackCommand
from up.commands.arming_commands import ArmCommand, DisarmCommand
from up.commands.command import BaseCommand
from up.commands.flight_state_command import (
    FlightBatteryCommand,
    FlightModeCommand,
    FlightStateCommand,
    FlyByWireLimitsCommand,
)
from up.commands.heading_command import HeadingCommand
from up.commands.location_command import LocationCommand
from up.commands.mission_commands import (
    MissionCommitCommand,
    MissionItemCommand,
    MissionPartCommand,
    MissionProblemsCommand,
    MissionRequestCommand,
)
from up.commands.navigation_commands import HomeCommand, NavigationTargetCommand
from up.commands.orientation_command import AccelerationCommand, OrientationCommand
from up.commands.output_command import OutputCommand, SetpointCommand
from up.commands.panic_command import PanicCommand
from up.commands.parameter_commands import (
    ParameterRequestCommand,
    ParameterSetCommand,
    ParameterValuesCommand,
)
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.rx_command import RXCommand
from up.commands.servo_command import ServoCommand
from up.commands.system_commands import (
    LinkStateCommand,
    SourceSelectedCommand,
    SystemStateCommand,
    SystemStopCommand,
)
from up.commands.telemetry_commands import TelemetryCommand, TelemetryFrequencyCommand

BUILTIN_COMMANDS: tuple[type[BaseCommand], ...] = (
    AckCommand,
    AirspeedCommand,
    AltitudeCommand,
    ArmCommand,
    CommandAnsweredCommand,
    DisarmCommand,
    FlightBatteryCommand,
    FlightModeCommand,
    FlightStateCommand,
    FlyByWireLimitsCommand,
    HeadingCommand,
    HomeCommand,
    LinkStateCommand,
    LocationCommand,
    MissionCommitCommand,
    MissionItemCommand,
    MissionPartCommand,
    MissionProblemsCommand,
    MissionRequestCommand,
    NackCommand,
    NavigationTargetCommand,
    AccelerationCommand,
    OrientationCommand,
    OutputCommand,
    PIDTuningsCommand,
    PIDTuningsValuesCommand,
    PanicCommand,
    ParameterRequestCommand,
    ParameterSetCommand,
    ParameterValuesCommand,
    RXCommand,
    ServoCommand,
    SetpointCommand,
    SourceSelectedCommand,
    SystemStateCommand,
    SystemStopCommand,
    TelemetryCommand,
    TelemetryFrequencyCommand,
)
