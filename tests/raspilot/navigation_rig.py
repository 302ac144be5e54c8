"""A flight mode manager with a position and modes of its own, for its tests."""

from dataclasses import replace

from twisted.internet.defer import Deferred

from raspilot.flight_modes.circle import CircleMode
from raspilot.flight_modes.glide import Glide
from raspilot.flight_modes.guided import Guided
from raspilot.flight_modes.loiter import Loiter
from raspilot.flight_modes.return_home import Return
from tests.raspilot.flight_controller_rig import BOARD, Rig
from up.base_module import BaseModule
from up.commands.flight_state_command import FlightModeCommand, FlightStateCommand
from up.flight_modes.demand import AttitudeDemand, SurfacesDemand
from up.flight_modes.flight_mode import FlightMode
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point
from up.providers.base_provider import BaseProvider, Reading

FRAME = LocalFrame(48.0, 17.0)
NAVIGATION = NavigationState(
    0.0, FRAME, Point(100.0, 50.0), Point(14.0, 0.0), 250.0, 0.0, Point(0.0, 0.0), 14.0, 0.0, 0.0,
    0.0, 2.0, 3.0, 0.5, 0.5, 2.0, 0.5,
)  # fmt: skip
STANDING = replace(NAVIGATION, velocity_m_s=Point(0.0, 0.0))
ARDUINO = "flight controller: arduino\n"


class Navigation(BaseProvider):
    """A position that the test sets."""

    READING = "navigation"
    state = NAVIGATION

    def on_init(self):
        self._seconds = self.context.reactor.seconds

    def set(self, state=NAVIGATION):
        self.state = state
        self._reading = Reading(state, "test", self.context.reactor.seconds())


class Bank(FlightMode):
    """Banks by 20 degrees with half throttle, by position."""

    NAME = "BANK"
    NEEDS = {"navigation": 3.0, "orientation": 0.1}
    FALLBACK = "LEVEL"
    REQUESTS = frozenset({"course"})
    seen = None

    def step(self, situation, dt_s):
        self.seen = situation
        return AttitudeDemand(20.0, 5.0, 0.5)


class Level(FlightMode):
    NAME = "LEVEL"
    FALLBACK = ""

    def step(self, situation, dt_s):
        return AttitudeDemand(0.0, 0.0)


class Servos(FlightMode):
    NAME = "SERVOS"
    FALLBACK = "LEVEL"

    def step(self, situation, dt_s):
        return SurfacesDemand(1500, 1500, 1500)


class Board(BaseModule):
    """Confirms a flight mode when the test says so."""

    def on_init(self):
        self.asked = []
        self.answer = None
        self.up.command_executor.register_command(FlightModeCommand, self.on_mode)

    def on_mode(self, command):
        if command.mode == "AUTO":
            self.asked.append(command.mode)
            self.answer = Deferred()
            return self.answer
        return None


class NavigationRig(Rig):
    def __init__(self, folder, config=ARDUINO, modes=(), modules=(), **more):
        super().__init__(
            folder, modes=(Bank, Level, Servos, Guided, Loiter, CircleMode, Glide, *modes),
            modules=(Navigation, Board, *modules),
            **{"config": config, "navigation": "home_accuracy_m: 5\n", **more},
        )  # fmt: skip
        self.navigation = self.up.get_module(Navigation)
        self.board = self.up.get_module(Board)
        self.bank = self.up.get_module(Bank)

    def state(self, mode="SETPOINT", *, armed=True, auto=True, in_flight=True):
        self.bus.execute_command(FlightStateCommand(mode, armed, auto, False, in_flight), BOARD)

    def setpoint(self):
        """Let a frame come; return the set-point that it made, or None."""
        count = len(self.setpoints)
        self.navigation.set(self.navigation.state)
        self.frame()
        return self.setpoints[-1] if len(self.setpoints) > count else None

    def shown(self):
        return self.manager.telemetry_content["flight_control"]


def refusal(got):
    return got[0].value.detail


def flying_rig(tmp_path):
    """Return an aircraft in FBW, armed and in flight, that has the flight mode RETURN."""
    made = NavigationRig(tmp_path, modes=(Return,))
    made.state("FBW", armed=False, in_flight=False)
    made.setpoint()
    made.state("FBW")
    made.setpoint()
    return made
