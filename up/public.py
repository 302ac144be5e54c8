"""The public names of Up, for ``from up import ...`` (docs/api.md)."""

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
