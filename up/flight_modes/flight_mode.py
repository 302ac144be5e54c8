"""The base of every flight mode."""

from collections.abc import Mapping
from typing import ClassVar, NamedTuple

from up.base_module import BaseModule
from up.commands.orientation_command import OrientationCommand
from up.commands.rx_command import RXCommand
from up.flight_modes.demand import Demand
from up.flight_modes.navigation_state import NavigationState, Point
from up.quick_dataclass import dataclass
from up.quick_init import quick_init


@dataclass(frozen=True, slots=True)
class Home:
    """Where RETURN flies to: a point in the estimator's frame, and its altitude."""

    point: Point
    altitude_m: float


@dataclass(frozen=True, slots=True)
class Target:
    """Where a mode flies to: requested from the ground, or resumed after a restart."""

    point: Point
    altitude_m: float
    radius_m: float | None = None


@quick_init
@dataclass(frozen=True, slots=True)
class FlightSituation:
    """What a mode sees in one step.

    A reading is None unless it is valid and as fresh as the mode's ``NEEDS`` require; those that
    are needed are never None. For a mode that does not need it ``navigation`` may be dead
    reckoning, without a fix for up to 120 s: look at its deviations. ``required_course_deg`` and
    ``required_altitude_m`` are the ground's requests since the mode was entered.
    """

    time_s: float
    orientation: OrientationCommand
    navigation: NavigationState | None = None
    rx: RXCommand | None = None
    home: Home | None = None
    target: Target | None = None
    required_course_deg: float | None = None
    required_altitude_m: float | None = None


class ModeRefusal(NamedTuple):
    """Why a mode cannot be entered now: a code for telemetry and programs, and a sentence."""

    code: str
    text: str


class FlightMode(BaseModule):
    """What the aircraft does while it is active; a new file in ``flight_modes/`` is a new mode.

    ``NAME`` is the mode's name everywhere. ``NEEDS`` gives the readings without which it is not
    offered, and their maximum ages in seconds; ``FALLBACK`` the mode that replaces it when one
    becomes too old, or a step fails, blocks, or demands what is not possible; "": none.
    ``REQUESTS`` are the ground's requests that it follows: ``course``, ``altitude``, ``target``. A
    mode that is not ``SELECTABLE`` only serves as a fallback or as ``auto_mode``.
    """

    NAME: ClassVar[str] = ""
    NEEDS: ClassVar[Mapping[str, float]] = {"orientation": 1.0}
    FALLBACK: ClassVar[str] = "GLIDE"
    REQUESTS: ClassVar[frozenset[str]] = frozenset()
    SELECTABLE: ClassVar[bool] = True
    IS_SET_BY_GROUND = True

    successor = ""
    """The mode that replaces this one, once it has set the name, unless that one refuses."""
    continues = False
    """Whether this mode acts again instead of the successor's own successor."""

    @property
    def is_uninterrupted(self) -> bool:
        """Return whether no failsafe may select another mode now: in the hand, or landing."""
        return False

    @property
    def goal(self) -> Target | None:
        """Return the successor's target, which a restart of the program resumes too.

        None: it resumes the circle that is flown.
        """
        return None

    def refusal(self, situation: FlightSituation) -> ModeRefusal | str | None:
        """Return why the mode cannot be entered now, apart from its readings; None: it can.

        The code of a sentence alone is ``mode_refused``.
        """
        return None

    def enter(self, situation: FlightSituation) -> None:
        """Called before the first step: discard what belongs to an earlier part of the flight."""

    def step(self, situation: FlightSituation, dt_s: float) -> Demand:
        """Return the present demand; called for every orientation frame, within 2 ms."""
        raise NotImplementedError
