"""The Commands included in Up."""

from importlib import import_module

from up.commands.command import BaseCommand

_MODULES = (
    "airspeed_command",
    "altitude_command",
    "answer_commands",
    "arming_commands",
    "flight_state_command",
    "heading_command",
    "location_command",
    "mission_commands",
    "navigation_commands",
    "orientation_command",
    "output_command",
    "panic_command",
    "parameter_commands",
    "pid_tunings_commands",
    "rx_command",
    "servo_command",
    "system_commands",
    "telemetry_commands",
)

BUILTIN_COMMANDS: tuple[type[BaseCommand], ...] = tuple(
    each
    for module in (import_module(f"up.commands.{name}") for name in _MODULES)
    for each in vars(module).values()
    if isinstance(each, type)
    and issubclass(each, BaseCommand)
    and each.__module__ == module.__name__
)
"""Every Command that one of these modules declares."""
