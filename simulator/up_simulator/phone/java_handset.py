"""The Up Library as the phone aboard, in real time: a JVM with its own sockets."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from up_simulator.aircraft.flight import Flight
from up_simulator.harness.clock import Clock
from up_simulator.phone.handset import Record
from up_simulator.phone.java_feed import SensorFeed
from up_simulator.phone.java_process import JavaPhoneProcess
from up_simulator.phone.java_program import JavaProgram
from up_simulator.phone.mounting import MOUNTING

GONE = "the phone is gone, and all else flies on"


def sentence_of(event: Mapping[str, Any]) -> str | None:
    """Return an event of the virtual phone in plain words; None if it is not worth a line."""
    match event.get("event"):
        case "connected":
            return f"connected to {event.get('host')}:{event.get('general')}"
        case "lost":
            return str(event.get("reason"))
        case "says":
            return f"says: {event.get('text')!r}"
        case "panic":
            delay_ms = event.get("delay_ms")
            return f"busy: nothing quicker than {delay_ms} ms" if delay_ms else "not busy any more"
        case "notice":
            return str(event.get("text"))
    return None


def options_of(orientation: str, seed: int) -> list[str]:
    """Return the options of every virtual phone of a flight."""
    mounting = " ".join(map(str, MOUNTING))
    return ["--orientation", orientation, "--seed", str(seed), "--mounting", mounting]


class JvmHandset:
    """Common to every phone on a JVM: its sensors' feed, its output, and an unexpected end.

    A JVM that ends unexpectedly is reported once in a sentence, and costs the flight only its
    phone. ``has_connected`` is whether it was connected at any time.
    """

    def __init__(self, feed: SensorFeed, clock: Clock, say: Callable[[str], None]) -> None:
        self._feed = feed
        self.sensors = feed.sensors
        self._clock = clock
        self._say = say
        self._process: JavaPhoneProcess | None = None
        self.has_connected = False
        self.loss: str | None = None

    @property
    def pid(self) -> int | None:
        """Return the JVM's process number while it runs."""
        return None if self._process is None else self._process.pid

    def set_battery(self, percent: float) -> None:
        """Set the level of its battery."""
        self._feed.set_battery(percent, self._clock.seconds())

    async def stop(self) -> None:
        """End it."""
        process, self._process = self._process, None
        if process is not None:
            process.end()

    def take(self, event: dict[str, Any]) -> None:
        """Take an event of the JVM."""
        if event.get("event") == "wants":
            period_s = event["period_ms"] / 1000
            self._feed.want(str(event["sensor"]), period_s, self._clock.seconds())
            return
        if event.get("event") == "connected":
            self.has_connected = True
        if (sentence := sentence_of(event)) is not None:
            self._say(sentence)

    def lose(self, process: JavaPhoneProcess) -> None:
        """Handle its unexpected end."""
        self._process = None
        self._feed.forget()
        process.end()
        self.loss = " ".join(f"{process.last_words}; {GONE}".split())
        self._say(self.loss)


class JavaHandset(JvmHandset):
    """A phone whose sensors are fed by ``tick``; it finds and keeps its links without help.

    ``place`` are the virtual phone's options with Raspilot's addresses.
    """

    def __init__(
        self,
        program: JavaProgram,
        clock: Clock,
        flight: Flight,
        place: Callable[[], Sequence[str]],
        orientation: str,
        say: Callable[[str], None],
        *,
        seed: int = 1,
        record: Record | None = None,
    ) -> None:
        super().__init__(SensorFeed(flight, seed=seed, record=record), clock, say)
        self._program = program
        self._place = place
        self._options = options_of(orientation, seed)
        if record is not None:
            self._options.append("--record")

    def start(self) -> None:
        """Start the JVM; it connects when it is up."""
        if self._process is None:
            self._process = JavaPhoneProcess(self._program, *self._options, *self._place())

    def tick(self) -> None:
        """Take its events, and send its sensors' readings."""
        process = self._process
        if process is None:
            return
        for event in process.hear():
            self.take(event)
        if not process.is_running:
            self.lose(process)
            return
        readings = self._feed.readings(self._clock.seconds())
        if readings:
            process.say(readings)
