"""The reading ``navigation``: where the aircraft is, how it moves, and how sure that is."""

from collections.abc import Mapping
from typing import Any

from raspilot.navigation.airframe_model import AirframeModel
from raspilot.navigation.battery_sag import BatterySag
from raspilot.navigation.estimator import Estimator
from raspilot.navigation.fix_gate import Fix
from raspilot.navigation.fix_sources import FixSources
from up.commands.airspeed_command import AirspeedCommand
from up.commands.flight_state_command import FlightBatteryCommand, FlightStateCommand
from up.commands.location_command import LocationCommand
from up.commands.orientation_command import AccelerationCommand, OrientationCommand
from up.commands.servo_command import ServoCommand
from up.commands.telemetry_schema import READINGS
from up.flight_modes.navigation_file import NAVIGATION
from up.flight_modes.navigation_state import NavigationState
from up.log.limits import Once
from up.needs import needs
from up.providers.base_provider import BaseProvider, Reading
from up.providers.source_arbiter import SourceArbiter
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_heading_provider import UpHeadingProvider
from up.providers.up_location_provider import UpLocationProvider
from up.providers.up_orientation_provider import UpOrientationProvider

ASSUMED_AGE_S = 0.8
"""Age of a fix on arrival where its source does not measure it."""
AIRSPEED_S = 1.0
"""How old the airspeed of a sensor may be before another one is followed."""
BATTERY_S = 2.0
"""The same of the flight battery's voltage."""
MAX_SAID = 4
LOWEST_US, RANGE_US = 1000, 1000
UNKNOWN_HEADING_SD_DEG, UNKNOWN_WIND_SD_M_S, UNKNOWN_ALTITUDE_SD_M = 60.0, 4.0, 100.0
MIN_COURSE_M_S = 1.0


class NavigationEstimator(BaseProvider[NavigationState]):
    """Feeds the estimator with the readings that the providers follow.

    ``state`` is the estimate at the newest orientation. The time of ``reading`` is that at which
    the newest accepted fix was taken: ``fresh(3.0)`` is dead reckoning for at most 3 s.
    ``home_altitude_m`` is set by the module that keeps home.
    """

    READING = "navigation"
    COMMAND = OrientationCommand
    MAX_AGE_S = READINGS[READING].source_s

    orientation = needs(UpOrientationProvider)
    location = needs(UpLocationProvider)
    altitude = needs(UpAltitudeProvider)
    heading = needs(UpHeadingProvider)

    def on_init(self) -> None:
        self.home_altitude_m: float | None = None
        self._state: NavigationState | None = None
        self._is_old = True
        self._motor_stopped = False
        self._throttle = 0.0
        self._sources = FixSources()
        self._doubted = 0
        self._said = Once(MAX_SAID)
        model = AirframeModel(self.context.config(NAVIGATION))
        self.estimator = Estimator(model)
        self._sag = BatterySag(model.level_throttle)
        self._seconds = self.context.reactor.seconds
        self.orientation.subscribe(self._on_orientation)
        self.location.subscribe(self._on_location)
        self.altitude.subscribe(self._on_altitude)
        self.heading.subscribe(self._on_heading)
        self.location.is_doubted = self._is_doubted
        executor = self.up.command_executor
        executor.register_command(LocationCommand, self._on_any_location)
        self._airspeeds = SourceArbiter(AIRSPEED_S, lambda _before, _source: None)
        self._batteries = SourceArbiter(BATTERY_S, lambda _before, _source: None)
        executor.register_command(AirspeedCommand, self._on_airspeed)
        executor.register_command(ServoCommand, self._on_servos)
        executor.register_command(AccelerationCommand, self._on_acceleration)
        executor.register_command(FlightStateCommand, self._on_flight_state)
        executor.register_command(FlightBatteryCommand, self._on_flight_battery)

    @property
    def state(self) -> NavigationState | None:
        """Return the estimate at the newest orientation; None before the first fix."""
        if self._is_old:
            self._renew()
        return self._state

    @property
    def reading(self) -> Reading[NavigationState] | None:
        if self._is_old:
            self._renew()
        return self._reading

    def _renew(self) -> None:
        state, self._reading = self.estimator.state(), None
        if state is not None:
            taken_s, fix = self.estimator.fix_time_s, self.location.reading
            if taken_s is not None and fix is not None:
                self._reading = Reading(state, fix.source, taken_s)
        self._state = state
        self._is_old = False

    def fresh(self, max_age_s: float) -> Reading[NavigationState] | None:
        reading = self.reading
        if reading is None or self._seconds() - reading.time_s > max_age_s:
            return None
        return reading

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        estimator = self.estimator
        return {
            "navigation": self._navigation(),
            "counters": {"navigation": {**estimator.rejected, **self._doubts()}},
            **self._ages(),
        }

    def _doubts(self) -> dict[str, int]:
        return {"doubted": self._doubted} if self._doubted else {}

    def _navigation(self) -> dict[str, Any]:
        state = self.state
        if state is None:
            return {}
        latitude, longitude = state.frame.degrees(state.position)
        has_altitude = state.altitude_sd_m < UNKNOWN_ALTITUDE_SD_M
        altitude_m = state.altitude_m if has_altitude else None
        has_wind = state.wind_sd_m_s < UNKNOWN_WIND_SD_M_S
        has_heading = state.heading_sd_deg < UNKNOWN_HEADING_SD_DEG
        has_course = state.ground_speed_m_s > MIN_COURSE_M_S
        in_flight = self.estimator.is_in_flight
        home_m = self.home_altitude_m
        height_m = None if altitude_m is None or home_m is None else altitude_m - home_m
        return {
            "latitude": latitude,
            "longitude": longitude,
            "altitude": altitude_m,
            "height": height_m,
            "speed": state.ground_speed_m_s,
            "course": state.course_deg if has_course else None,
            "climb": state.climb_m_s if has_altitude else None,
            "airspeed": state.airspeed_m_s if in_flight else None,
            "heading": state.heading_deg if has_heading else None,
            "motor_stopped": state.motor_stopped,
            "wind": {
                "speed": state.wind_speed_m_s if has_wind else None,
                "from": state.wind_from_deg if has_wind else None,
            },
            "sd": {
                "position": state.position_sd_m,
                "altitude": state.altitude_sd_m if has_altitude else None,
                "wind": state.wind_sd_m_s if has_wind else None,
                "airspeed": state.airspeed_sd_m_s if in_flight else None,
                "heading": state.heading_sd_deg if has_heading else None,
            },
        }

    def _on_orientation(self, reading: Reading[OrientationCommand]) -> None:
        value = reading.value
        self._is_old = True
        self.estimator.orientation(reading.time_s, value.roll_deg, value.pitch_deg, value.yaw_deg)

    def _on_location(self, reading: Reading[LocationCommand]) -> None:
        value, now_s = reading.value, reading.time_s
        self._is_old = True
        self.estimator.fix(_fix_of(value, now_s), now_s)

    def _on_any_location(self, command: LocationCommand) -> None:
        """Compare the fix of every source, followed or not, with the estimate."""
        now_s = self._seconds()
        is_far = self.estimator.is_far(_fix_of(command, now_s))
        if is_far is not None:
            self._sources.note(self.up.command_executor.origin.link, is_far, now_s)

    def _is_doubted(self, source: str) -> bool:
        is_doubted = self._sources.is_doubted(source, self._seconds())
        self._doubted += is_doubted
        if is_doubted and self._said.first(source):
            self.log.warn(
                "the fixes of {source} are left out: another source agrees with the estimate",
                source=source,
                code="source_doubted",
            )
        return is_doubted

    def _on_altitude(self, reading: Reading[float]) -> None:
        self._is_old = True
        self.estimator.barometer(reading.time_s, reading.value, reading.source)

    def _on_heading(self, reading: Reading[float]) -> None:
        self._is_old = True
        self.estimator.compass(reading.time_s, reading.value)

    def _on_airspeed(self, command: AirspeedCommand) -> None:
        origin, now_s = self.up.command_executor.origin, self._seconds()
        if self._airspeeds.accepts(origin.link, origin.priority, now_s):
            self._is_old = True
            self.estimator.airspeed(now_s, command.airspeed_m_s)

    def _on_servos(self, command: ServoCommand) -> None:
        self._throttle = (command.throttle_us - LOWEST_US) / RANGE_US
        self.estimator.throttle(self._throttle * self._sag.share)

    def _on_flight_state(self, command: FlightStateCommand) -> None:
        """Hold the altitude from the arming on: home is set then."""
        if command.is_in_flight is not None:
            self.estimator.vertical.hold(command.is_in_flight)

    def _on_flight_battery(self, command: FlightBatteryCommand) -> None:
        origin = self.up.command_executor.origin
        if not self._batteries.accepts(origin.link, origin.priority, self._seconds()):
            return
        if self.estimator.is_in_flight:
            self._sag.measure(command.voltage_v, self._throttle)
        else:
            self._sag.reset()

    def _on_acceleration(self, command: AccelerationCommand) -> None:
        self._is_old = True
        self.estimator.acceleration(self._seconds(), command.forward_m_s2)
        self._report_motor()

    def _report_motor(self) -> None:
        is_stopped = self.estimator.motor.is_stopped
        if is_stopped and not self._motor_stopped:
            self.log.warn("the motor gives no thrust at the present throttle", code="motor_stopped")
        self._motor_stopped = is_stopped


def _fix_of(command: LocationCommand, now_s: float) -> Fix:
    age_s = ASSUMED_AGE_S if command.age_ms is None else command.age_ms / 1000
    return Fix(
        now_s - age_s,
        command.latitude_deg,
        command.longitude_deg,
        command.altitude_m,
        command.accuracy_m,
        command.speed_m_s,
        command.bearing_deg,
    )
