"""Reads the sensors at the I2C bus and publishes their measurements."""

from collections.abc import Callable, Mapping
from functools import partial
from importlib import import_module
from typing import Any

from smbus2 import SMBus

from sensors_cog.config import CHIPS, SENSORS, SensorConfig
from sensors_cog.sensor import Aircraft, I2cSensor
from sensors_cog.slot import WORKING, SensorSlot
from up.base_started_module import StartFailedError
from up.base_thread_module import BaseThreadModule
from up.commands.command import InvalidCommandError
from up.commands.origin import Origin
from up.commands.roles import Role
from up.mode import WITH_BOARD
from up.needs import needs
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_orientation_provider import UpOrientationProvider

MAX_WAIT_S = 0.1
MAX_AGE_S = 0.5


class I2cSensors(BaseThreadModule):
    """Publishes what each sensor of sensors.yml measures, with the sensor's name as source.

    A transfer of the bus blocks, so all sensors are read on this module's thread, each in its
    period. An absent sensor, or another chip at its address, is logged once and tried again.
    """

    CONFIG = SENSORS
    MODES = WITH_BOARD

    orientation = needs(UpOrientationProvider)
    altitude = needs(UpAltitudeProvider)

    open_bus: Callable[[int], Any] = SMBus

    def on_init(self) -> None:
        self._buses: dict[int, Any] = {}
        self._slots: dict[str, tuple[SensorSlot, Origin]] = {}

    def load(self) -> bool:
        return bool(self.config.sensors)

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        slots = {name: slot for name, (slot, _) in self._slots.items()}
        return {
            "sensors": {
                name: {"state": slot.state, **({} if slot.newest is None else slot.newest.data)}
                for name, slot in slots.items()
            },
            "counters": {f"sensor_{name}": dict(slot.counters) for name, slot in slots.items()},
        }

    def on_start(self) -> bool:
        for name, config in self.config.sensors.items():
            make = partial(self._make, class_of(config.chip), config)
            slot = SensorSlot(make, partial(self.call_in_reactor, self._on_state, name))
            self._slots[name] = slot, Origin(name, Role.SENSOR, config.priority)
        return True

    def on_stop(self) -> None:
        buses, self._buses = self._buses, {}
        for bus in buses.values():
            bus.close()

    def poll(self) -> float:
        """Read every sensor that is due; return the time until the next, s."""
        seconds: Callable[[], float] = self.context.reactor.seconds
        for slot, origin in self._slots.values():
            measured = slot.poll(seconds(), self._aircraft())
            if measured is not None:
                try:
                    # The ranges of the Command are those of a possible measurement.
                    measured = type(measured).from_data(measured.data)
                except InvalidCommandError:
                    slot.counters["invalid"] += 1
                else:
                    self.up.command_executor.execute_command(measured, origin)
        due_s = min(slot.due_s for slot, _ in self._slots.values())
        return max(0.0, min(MAX_WAIT_S, due_s - seconds()))

    def _loop(self) -> None:
        self.stop_event.wait(self.poll())

    def _make(self, cls: type[I2cSensor], config: SensorConfig) -> I2cSensor:
        bus = self._buses.get(config.bus)
        if bus is None:
            bus = self._buses[config.bus] = self.open_bus(config.bus)
        return cls(bus, config)

    def _aircraft(self) -> Aircraft:
        attitude, altitude = self.orientation.fresh(MAX_AGE_S), self.altitude.value or 0.0
        if attitude is None:
            return Aircraft(altitude_m=altitude)
        return Aircraft(attitude.value.roll_deg, attitude.value.pitch_deg, altitude)

    def _on_state(self, name: str, state: str, reason: str) -> None:
        if state == WORKING:
            self.log.info("the sensor {name} works", name=name, code="sensor_works")
        else:
            text = "the sensor {name}: {reason}; trying again"
            self.log.warn(text, name=name, reason=reason, code=f"sensor_{state}")


def class_of(chip: str) -> type[I2cSensor]:
    """Return the class of a chip, of this cog or of the user; raises StartFailedError."""
    module, _, name = CHIPS.get(chip, chip).rpartition(".")
    try:
        found = getattr(import_module(module), name)
    except (ImportError, AttributeError) as error:
        text = f"sensors.yml: chip {chip} cannot be imported: {error}"
        raise StartFailedError(text, "chip_unknown") from error
    if not (isinstance(found, type) and issubclass(found, I2cSensor)):
        raise StartFailedError(f"sensors.yml: {chip} does not extend I2cSensor", "chip_unknown")
    return found
