"""The Up Library as the phone aboard, in real time: a JVM with its own sockets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from up_simulator.aircraft.flight import Clock, FlightSource, FlightState
from up_simulator.harness.user_log import Log
from up_simulator.phone.handset import Record
from up_simulator.phone.java_process import JavaPhoneProcess
from up_simulator.phone.java_program import JavaProgram
from up_simulator.phone.sensors import MOUNTING, PhoneSensors

LOST = "the phone is lost, the flight continues"
_TINY_S = 1e-6


@dataclass(slots=True)
class _Stream:
    """One requested sensor."""

    period_s: float
    due_s: float


class SensorFeed:
    """Provides each sensor's readings in the requested period, starting immediately.

    The sensors have the names of the virtual phone's lines. ``now_s`` is of any one clock.
    """

    def __init__(
        self, flight: FlightSource, *, seed: int = 1, record: Record | None = None
    ) -> None:
        self._flight = flight
        self.sensors = sensors = PhoneSensors(seed)
        self._measure: dict[str, Callable[[FlightState], Any]] = {
            "fix": sensors.location,
            "pressure": sensors.pressure_hpa,
            "rate": sensors.rate_rad_s,
            "rotation": sensors.rotation,
            "battery": lambda state: sensors.battery(state)["level"],
        }
        if record is not None:
            self._measure["record"] = record
        self._requested: dict[str, _Stream] = {}

    def request(self, sensor: str, period_s: float, now_s: float) -> None:
        """Provide a sensor's readings with this period from now on; 0 cancels."""
        if period_s > 0 and sensor in self._measure:
            self._requested[sensor] = _Stream(period_s, now_s)
        else:
            self._requested.pop(sensor, None)

    def readings(self, now_s: float) -> dict[str, Any]:
        """Return the due readings by sensor; in the same order every time."""
        found: dict[str, Any] = {}
        for sensor, measure in self._measure.items():
            stream = self._requested.get(sensor)
            if stream is not None and now_s >= stream.due_s - _TINY_S:
                # A late reading does not delay the following ones.
                due_s = stream.due_s + stream.period_s
                stream.due_s = due_s if due_s > now_s else now_s + stream.period_s
                reading = measure(self._flight.state)
                if reading is not None:
                    found[sensor] = reading
        return found

    def clear(self) -> None:
        self._requested.clear()


class JavaHandset:
    """A phone on a JVM, whose sensors are fed by ``tick``; it keeps its links without help.

    ``address_options`` returns the virtual phone's options with Raspilot's addresses. A JVM that
    ends unexpectedly is reported in one sentence, and costs the flight only its phone.
    """

    def __init__(
        self,
        program: JavaProgram,
        clock: Clock,
        flight: FlightSource,
        address_options: Callable[[], Sequence[str]],
        orientation: str,
        log: Log,
        *,
        seed: int = 1,
        record: Record | None = None,
    ) -> None:
        self._feed = SensorFeed(flight, seed=seed, record=record)
        self.sensors = self._feed.sensors
        self._clock = clock
        self._log = log
        self._process: JavaPhoneProcess | None = None
        self._program = program
        self._address_options = address_options
        mounting = " ".join(map(str, MOUNTING))
        self._options = ["--orientation", orientation, "--mounting", mounting]
        if record is not None:
            self._options.append("--record")

    @property
    def pid(self) -> int | None:
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        if self._process is None:
            options = [*self._options, *self._address_options()]
            self._process = JavaPhoneProcess(self._program, *options)

    def tick(self) -> None:
        process = self._process
        if process is None:
            return
        for event in process.receive():
            self._on_event(event)
        if not process.is_running:
            self._on_exit(process)
            return
        readings = self._feed.readings(self._clock.seconds())
        if readings:
            process.send(readings)

    async def stop(self) -> None:
        process, self._process = self._process, None
        if process is not None:
            process.end()

    def _on_event(self, event: dict[str, Any]) -> None:
        match event.get("event"):
            case "wants":
                period_s = event["period_ms"] / 1000
                self._feed.request(str(event["sensor"]), period_s, self._clock.seconds())
            case "connected":
                host, port = event.get("host"), event.get("general")
                text = f"connected to {host}:{port}"
                self._log(text, code="phone_connected", host=host, port=port)
            case "lost":
                self._log(str(event.get("reason")), code="phone_disconnected")
            case "says":
                speech = event.get("text")
                self._log(f"says: {speech!r}", code="phone_speech", speech=speech)
            case "panic":
                ms = event.get("delay_ms")
                text = f"panic mode: periods of at least {ms} ms" if ms else "panic mode is over"
                self._log(text, code="phone_panic", panic=bool(ms), delay_ms=ms)
            case "notice":
                self._log(str(event.get("text")), code="phone_notice")

    def _on_exit(self, process: JavaPhoneProcess) -> None:
        self._process = None
        self._feed.clear()
        process.end()
        text = " ".join(f"{process.exit_reason}; {LOST}".split())
        self._log(text, code="phone_lost", reason=process.exit_reason)
