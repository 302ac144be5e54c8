"""One receiver: which of its fixes are published, and as how old."""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Protocol

from gps_cog.config import ReceiverConfig
from gps_cog.fix import GpsFix
from gps_cog.fix_clock import FixClock
from up.commands.location_command import LocationCommand


class Decoder(Protocol):
    """The format of a receiver's bytes."""

    counters: Counter[str]
    PERIOD_S: float
    """After which the receiver's clock begins again; 0: never."""

    def feed(self, data: bytes) -> Iterator[GpsFix]:
        """Yield the fixes that the bytes complete."""

    def reset(self) -> None:
        """Discard a partial message."""


class Receiver:
    """Judges the fixes of a receiver and publishes those that are usable.

    Counted are ``fixes`` and, of those that were dropped, the reasons: ``no_fix``, ``invalid``,
    ``inaccurate``, those of ``FixClock``, and those of the decoder.
    """

    def __init__(
        self,
        config: ReceiverConfig,
        decoder: Decoder,
        seconds: Callable[[], float],
        publish: Callable[[LocationCommand], object],
    ) -> None:
        self.decoder = decoder
        self._max_accuracy_m = config.max_accuracy_m
        self._delay_s = config.delay_ms / 1000
        self._clock = FixClock(self._delay_s, decoder.PERIOD_S)
        self._seconds = seconds
        self._publish = publish
        self._counters: Counter[str] = Counter()
        self._newest: GpsFix | None = None
        self._newest_s = 0.0

    @property
    def counters(self) -> dict[str, int]:
        return dict(self._counters + self.decoder.counters)

    @property
    def telemetry(self) -> Mapping[str, Any]:
        """Return what the receiver reports itself, with or without a fix."""
        newest = self._newest
        if newest is None:
            return {"fix": None, "satellites": None, "age_ms": None}
        age_ms = round((self._seconds() - self._newest_s) * 1000)
        return {
            "fix": newest.kind or "none", "satellites": newest.satellites, "age_ms": age_ms
        }  # fmt: skip

    def on_bytes(self, data: bytes) -> None:
        for fix in self.decoder.feed(data):
            self._newest, self._newest_s = fix, self._seconds()
            self._counters[self._judge(fix)] += 1

    def _judge(self, fix: GpsFix) -> str:
        """Publish a usable fix; return the name under which it is counted."""
        if fix.kind is None:
            return "no_fix"
        if fix.accuracy_m is not None and fix.accuracy_m > self._max_accuracy_m:
            return "inaccurate"
        age_s: float | str = self._delay_s
        command = fix.command(self._delay_s)
        if command is None:
            return "invalid"
        if fix.stamp_s is not None:
            age_s = self._clock.age_s(fix.stamp_s, self._seconds())
            if isinstance(age_s, str):
                return age_s
            command = fix.command(age_s)
        if command is not None:
            self._publish(command)
        return "fixes"
