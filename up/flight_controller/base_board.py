"""The board that flies the aircraft, as every board shows itself (thesis 3.2.2)."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar

from up.base_started_module import BaseStartedModule
from up.commands.command import BaseCommand
from up.commands.flight_state_command import FlightStateCommand
from up.commands.origin import Origin
from up.commands.roles import Role
from up.commands.servo_command import ServoCommand
from up.commands.system_commands import LinkStateCommand
from up.mode import WITH_BOARD

PRIORITY = 10
"""The board's readings come before those of other sources."""
_AXES = ("ailerons", "elevator", "throttle", "rudder")
NO_STATE = FlightStateCommand(None, False, False, False)


class BaseBoard(BaseStartedModule):
    """Publishes what a board reports, with the role ``board``; extend it in a cog's ``modules/``.

    A board publishes ``OrientationCommand`` with a sequence, ``RXCommand`` and
    ``FlightStateCommand``, and whatever else it measures, by ``publish``; it calls ``report_heard``
    when the board answers and ``report_silent`` when it no longer does: its state is then unknown
    and nothing arms. A second module handles ``SetpointCommand`` or ``OutputCommand``. The board's
    own switch decides whether they act: ``FlightStateCommand.flight_mode`` is ``SETPOINT`` or
    ``OUTPUT`` only while they do.
    """

    MODES = WITH_BOARD
    LINK: ClassVar[str] = ""
    """The name of the link: the source of readings, and the prefix of telemetry and vetoes."""
    TITLE: ClassVar[str] = ""
    """How sentences name the board."""
    GROUND_MODES: ClassVar[tuple[str, ...]] = ("FBW",)
    """The modes of its own that a ground may select, FBW among them."""

    def __init__(self, config: Any = None, silent: bool = False) -> None:
        super().__init__(config, silent)
        self.origin = Origin(self.LINK, Role.BOARD, PRIORITY)
        self.state = NO_STATE
        self.servo: ServoCommand | None = None
        self._is_state_known = False
        self._state_s = self._servo_s = 0.0
        self._board_listeners: list[Callable[[], object]] = []

    @property
    def connected(self) -> bool:
        """Return whether the board answers."""
        raise NotImplementedError

    @property
    def absent(self) -> str:
        """Return the sentence that keeps the motor from being armed without the board."""
        return f"{self.TITLE} is not connected"

    @property
    def is_armed(self) -> bool | None:
        return self.state.is_armed if self._is_state_known else None

    @property
    def is_in_flight(self) -> bool | None:
        """Return whether the aircraft may be in flight; None while unknown."""
        return self.state.is_in_flight

    def on_init(self) -> None:
        self._execute = self.up.command_executor.execute_command
        self._seconds = self.context.reactor.seconds
        self.up.vetoes.report(self.LINK, (self.absent,))

    def add_board_listener(self, listener: Callable[[], object]) -> None:
        """Call ``listener`` whenever a board answers that may be new or reset."""
        self._board_listeners.append(listener)

    def publish(self, command: BaseCommand) -> None:
        """Publish a reading of the board."""
        self._execute(command, self.origin)

    def publish_servo(self, servo: ServoCommand) -> None:
        self.servo = servo
        self._servo_s = self._seconds()
        self.publish(servo)

    def publish_state(self, state: FlightStateCommand) -> None:
        self.state, self._is_state_known = state, True
        self._state_s = self._seconds()
        self.publish(state)

    def report_heard(self) -> None:
        """Report that the board answers."""
        self.log.info("{board} answers", board=self.TITLE, code="board_connected")
        self.up.vetoes.report(self.LINK, ())
        self.publish(LinkStateCommand(self.LINK, True))
        self.notify_board_started()

    def report_silent(self) -> None:
        """Report that the board is gone; its last values are unknown from now on."""
        self.state, self._is_state_known = NO_STATE, False
        self.up.vetoes.report(self.LINK, (self.absent,))
        self.publish(NO_STATE)
        self.publish(LinkStateCommand(self.LINK, False))

    def notify_board_started(self) -> None:
        for listener in self._board_listeners:
            listener()

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        """Return the flight's state and the servo outputs."""
        now_s = self._seconds()
        servo, is_known = self.servo, self._is_state_known
        return {
            "armed": self.is_armed,
            "in_flight": self.is_in_flight,
            "flight_mode": self.state.flight_mode,
            "servo": {axis: servo and getattr(servo, f"{axis}_us") for axis in _AXES},
            "age_ms": {
                "servo": servo and round((now_s - self._servo_s) * 1000),
                "flight": round((now_s - self._state_s) * 1000) if is_known else None,
            },
            "source": {"servo": servo and self.LINK, "flight": self.LINK if is_known else None},
        }


def ground_modes(modules: Iterable[object]) -> tuple[str, ...]:
    """Return the modes of the board among the modules that a ground may select."""
    boards = [each for each in modules if isinstance(each, BaseBoard)]
    return boards[0].GROUND_MODES if boards else BaseBoard.GROUND_MODES
