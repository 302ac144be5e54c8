"""Up: a modular framework for autopilots that can be changed.

The public names, for applications and cogs; ``docs/api.md`` describes them. They are imported on
first use, because programs such as the proxy use only parts of the package.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from up.base_module import BaseModule as Module
    from up.base_started_module import BaseStartedModule as StartedModule
    from up.base_started_module import StartFailedError, StartResult
    from up.base_thread_module import BaseThreadModule as ThreadModule
    from up.commands.base_command_handler import BaseCommandHandler as CommandHandler
    from up.commands.command import BaseCommand as Command
    from up.commands.command import value
    from up.commands.refusal import Code, CommandRefusedError
    from up.commands.roles import Role
    from up.config import ConfigErrors, ConfigFile, items, key, mapping, section
    from up.failures import FailureSource
    from up.flight_controller.base_flight_controller import BaseFlightController as FlightController
    from up.flight_modes.demand import (
        AttitudeDemand,
        Bank,
        Circle,
        Course,
        Demand,
        Line,
        PathDemand,
        SurfacesDemand,
    )
    from up.flight_modes.flight_mode import FlightMode, FlightSituation, Home, ModeRefusal, Target
    from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point
    from up.mode import Mode
    from up.needs import needs, wants
    from up.providers.base_provider import BaseProvider as Provider
    from up.providers.base_provider import Reading

_PLACES = {
    "AttitudeDemand": "flight_modes.demand",
    "Bank": "flight_modes.demand",
    "Circle": "flight_modes.demand",
    "Code": "commands.refusal",
    "Command": "commands.command:BaseCommand",
    "CommandHandler": "commands.base_command_handler:BaseCommandHandler",
    "CommandRefusedError": "commands.refusal",
    "ConfigErrors": "config",
    "ConfigFile": "config",
    "Course": "flight_modes.demand",
    "Demand": "flight_modes.demand",
    "FailureSource": "failures",
    "FlightController": "flight_controller.base_flight_controller:BaseFlightController",
    "FlightMode": "flight_modes.flight_mode",
    "FlightSituation": "flight_modes.flight_mode",
    "Home": "flight_modes.flight_mode",
    "Line": "flight_modes.demand",
    "LocalFrame": "flight_modes.navigation_state",
    "Mode": "mode",
    "ModeRefusal": "flight_modes.flight_mode",
    "Module": "base_module:BaseModule",
    "NavigationState": "flight_modes.navigation_state",
    "PathDemand": "flight_modes.demand",
    "Point": "flight_modes.navigation_state",
    "Provider": "providers.base_provider:BaseProvider",
    "Reading": "providers.base_provider",
    "Role": "commands.roles",
    "StartFailedError": "base_started_module",
    "StartResult": "base_started_module",
    "StartedModule": "base_started_module:BaseStartedModule",
    "SurfacesDemand": "flight_modes.demand",
    "Target": "flight_modes.flight_mode",
    "ThreadModule": "base_thread_module:BaseThreadModule",
    "items": "config",
    "key": "config",
    "mapping": "config",
    "needs": "needs",
    "section": "config",
    "value": "commands.command",
    "wants": "needs",
}

__all__ = [
    "AttitudeDemand",
    "Bank",
    "Circle",
    "Code",
    "Command",
    "CommandHandler",
    "CommandRefusedError",
    "ConfigErrors",
    "ConfigFile",
    "Course",
    "Demand",
    "FailureSource",
    "FlightController",
    "FlightMode",
    "FlightSituation",
    "Home",
    "Line",
    "LocalFrame",
    "Mode",
    "ModeRefusal",
    "Module",
    "NavigationState",
    "PathDemand",
    "Point",
    "Provider",
    "Reading",
    "Role",
    "StartFailedError",
    "StartResult",
    "StartedModule",
    "SurfacesDemand",
    "Target",
    "ThreadModule",
    "items",
    "key",
    "mapping",
    "needs",
    "section",
    "value",
    "wants",
]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module 'up' has no attribute {name!r}")
    module, _, attribute = _PLACES[name].partition(":")
    found = globals()[name] = getattr(import_module(f"up.{module}"), attribute or name)
    return found


class _Package(ModuleType):
    def __setattr__(self, name: str, value: Any) -> None:
        # The import of the module `up.needs` must not replace the public function.
        if not (name in _PLACES and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
