"""Home: set once, never moved by accident (INAV#5893), kept over a restart."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from twisted.logger import Logger

from raspilot.flight_controller.flight_memory import FlightMemory, Place
from raspilot.navigation.planning import course_to_deg, distance_m, ground_speed_m_s
from up.commands.flight_state_command import FlightStateCommand
from up.commands.navigation_commands import HomeCommand, NavigationTargetCommand
from up.commands.refusal import Code, CommandRefusedError
from up.flight_modes.flight_mode import Home, Target
from up.flight_modes.navigation_state import LocalFrame, NavigationState, Point

MAX_DISTANCE_M = 100_000.0
"""No target is farther away: the plane of the estimator would no longer fit the Earth."""

MAX_HOME_STEP_M = 150.0
"""Enough to correct a home that was taken in flight; a wrong sign or unit is more."""

MIN_PROGRESS_M_S = 0.5
STANDING_M_S = 3.0
"""A faster aircraft that is armed is in the air, for example after a brown-out."""


class HomeKeeper:
    """Home is the first accurate position, then that of the standing aircraft when it is armed.

    In flight only a Command moves it. ``place`` is None until home is set; ``on_changed`` gets
    every new one. ``is_outside`` returns whether a point is outside the fence; its radius counts
    from the given home, and without one not at all.
    """

    log = Logger()

    def __init__(
        self, folder: Path, reactor: Any, accuracy_m: float, on_changed: Callable[[Place], object]
    ) -> None:
        self.memory = FlightMemory(folder, reactor)
        self._on_changed = on_changed
        self.place: Place | None = None
        self._accuracy_m = accuracy_m
        self._was_in_flight: bool | None = None
        self.is_outside: Callable[[Point, Home | None], bool] = lambda *_: False

    def resume(self) -> None:
        """Take the home of the flight that another run of the program began."""
        self.place = self.memory.values.home
        if self.place is not None:
            self._on_changed(self.place)

    def of(self, frame: LocalFrame) -> Home | None:
        """Return home in the estimator's frame."""
        place = self.place
        if place is None:
            return None
        return Home(frame.point(place.latitude_deg, place.longitude_deg), place.altitude_m)

    def update(self, navigation: NavigationState | None, state: FlightStateCommand | None) -> None:
        """Set home, if this is the moment; called for every orientation frame."""
        is_in_flight = None if state is None else state.is_in_flight
        begins = is_in_flight and self._was_in_flight is False
        # Without an accurate position at this moment home stays: a later one would be in the air.
        self._was_in_flight = is_in_flight
        if navigation is None or navigation.position_sd_m > self._accuracy_m:
            return
        if self.place is None:
            if is_in_flight is not None:
                self._set(_place_of(navigation), "first_position")
        elif begins and navigation.ground_speed_m_s <= STANDING_M_S:
            self._set(_place_of(navigation), "flight_begins")

    def set(self, command: HomeCommand, navigation: NavigationState | None) -> None:
        """Set home by a Command; raises CommandRefusedError without a position."""
        place = self.place
        if command.latitude_deg is None or command.longitude_deg is None:
            place = _place_of(require_position(navigation))
            if self.place is not None and self._was_in_flight:
                # The ground is not where it flies.
                place = replace(place, altitude_m=self.place.altitude_m)
        else:
            _check_distance(command.latitude_deg, command.longitude_deg, navigation)
            if place is None and command.altitude_m is None:
                place = _place_of(require_position(navigation))
            place = replace(
                place or Place(),
                latitude_deg=command.latitude_deg,
                longitude_deg=command.longitude_deg,
            )
        if command.altitude_m is not None:
            _check_altitude(command.altitude_m, self.place, navigation)
            place = replace(place, altitude_m=command.altitude_m)
        if navigation is not None and self._was_in_flight:
            # On the ground it is a reason not to arm: a fence for the new home may follow.
            self._check_fence(navigation.frame.point(place.latitude_deg, place.longitude_deg), None)
        self._set(place, "command")

    def target_of(
        self, command: NavigationTargetCommand, navigation: NavigationState | None
    ) -> Target:
        """Return a Command's target in the estimator's frame; raises CommandRefusedError."""
        state = require_position(navigation)
        _check_distance(command.latitude_deg, command.longitude_deg, state)
        altitude_m = state.altitude_m if command.altitude_m is None else command.altitude_m
        if command.height_m is not None:
            if self.place is None:
                text = "home is not set: give the altitude above sea level"
                raise CommandRefusedError(text, detail="no_home")
            altitude_m = self.place.altitude_m + command.height_m
        point = state.frame.point(command.latitude_deg, command.longitude_deg)
        self._check_fence(point, self.of(state.frame))
        return Target(point, altitude_m, command.radius_m)

    def telemetry(
        self, navigation: NavigationState | None, cruise_m_s: float
    ) -> Mapping[str, float | None]:
        """Return the telemetry of home that the location's provider does not send."""
        home = None if navigation is None else self.of(navigation.frame)
        time_s = None
        if navigation is not None and home is not None:
            time_s = time_home_s(navigation, home, cruise_m_s)
        return {**telemetry_of(self.place), "time_s": time_s}

    def _check_fence(self, point: Point, home: Home | None) -> None:
        if self.is_outside(point, home):
            raise CommandRefusedError("that point is outside the fence", detail="outside_fence")

    def _set(self, place: Place, cause: str) -> None:
        if place == self.place:
            return
        self.place = place
        self.memory.update(home=place)
        self._on_changed(place)
        self.log.info(
            "home is {latitude:.6f}, {longitude:.6f}, {altitude:.0f} m above sea level",
            latitude=place.latitude_deg,
            longitude=place.longitude_deg,
            altitude=place.altitude_m,
            cause=cause,
            code="home_set",
        )


def time_home_s(navigation: NavigationState, home: Home, airspeed_m_s: float) -> float | None:
    """Return how long the straight way home takes in this wind; None: it does not arrive."""
    course_deg = course_to_deg(navigation.position, home.point)
    speed_m_s = ground_speed_m_s(airspeed_m_s, course_deg, navigation.wind_m_s)
    # Against a wind of its own speed only the rounding moves it.
    if speed_m_s is None or speed_m_s < MIN_PROGRESS_M_S:
        return None
    return distance_m(navigation.position, home.point) / speed_m_s


def require_position(navigation: NavigationState | None) -> NavigationState:
    """Return the state; raises CommandRefusedError without one."""
    if navigation is None:
        text = "the position of the aircraft is not known"
        raise CommandRefusedError(text, Code.UNAVAILABLE, detail="reading_stale")
    return navigation


def telemetry_of(place: Place | None, *more: str) -> dict[str, float | None]:
    """Return a place as telemetry: its latitude, longitude, altitude, and ``more``."""
    fields = {"latitude": "deg", "longitude": "deg", "altitude": "m", **dict.fromkeys(more, "m")}
    return {
        name: None if place is None else getattr(place, f"{name}_{unit}")
        for name, unit in fields.items()
    }


def place_of_target(target: Target, frame: LocalFrame) -> Place:
    """Return the saved form of a target."""
    latitude_deg, longitude_deg = frame.degrees(target.point)
    return Place(latitude_deg, longitude_deg, target.altitude_m, target.radius_m)


def target_of_place(place: Place, frame: LocalFrame) -> Target:
    """Return a saved target in the estimator's frame."""
    point = frame.point(place.latitude_deg, place.longitude_deg)
    return Target(point, place.altitude_m, place.radius_m)


def _check_distance(
    latitude_deg: float, longitude_deg: float, navigation: NavigationState | None
) -> None:
    if navigation is None:
        return
    point = navigation.frame.point(latitude_deg, longitude_deg)
    away_m = distance_m(point, navigation.position)
    if away_m > MAX_DISTANCE_M:
        raise CommandRefusedError(
            f"that point is {away_m / 1000:.0f} km away: at most"
            f" {MAX_DISTANCE_M / 1000:.0f} km is possible",
            detail="too_far",
        )


def _check_altitude(
    altitude_m: float, home: Place | None, navigation: NavigationState | None
) -> None:
    if home is None:
        reference_m, limit_m, what = require_position(navigation).altitude_m, 500.0, "the aircraft"
    else:
        reference_m, limit_m, what = home.altitude_m, MAX_HOME_STEP_M, "the present home"
    away_m = altitude_m - reference_m
    if abs(away_m) > limit_m:
        side = "above" if away_m > 0 else "below"
        raise CommandRefusedError(
            f"that altitude is {abs(away_m):.0f} m {side} {what}: at most {limit_m:g} m"
            " is possible",
            detail="home_altitude",
        )


def _place_of(navigation: NavigationState) -> Place:
    latitude_deg, longitude_deg = navigation.frame.degrees(navigation.position)
    return Place(latitude_deg, longitude_deg, navigation.altitude_m)
