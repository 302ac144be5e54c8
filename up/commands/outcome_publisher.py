"""Publishes the outcome of each external Command on the bus, for the flight log."""

from collections import Counter

from up.commands.answer_commands import MAX_DETAIL, MAX_REASON, CommandAnsweredCommand
from up.commands.command_executor import CommandExecutor
from up.commands.origin import Origin
from up.system.clock import Clock

ANSWERS_HZ = 20
"""Outcomes reported per link and second; of the others only their number is reported."""
_LINKS_LIMIT = 64
_NAME_LIMIT = 64


class OutcomePublisher:
    """Publishes answers at a bounded rate: constant refusals on a link cost almost nothing."""

    def __init__(self, executor: CommandExecutor, clock: Clock) -> None:
        self._executor = executor
        self._clock = clock
        self._published: Counter[tuple[str, str]] = Counter()
        self._unreported: Counter[tuple[str, str]] = Counter()
        self._second = 0

    def report(
        self,
        origin: Origin,
        name: str,
        command_id: str | None,
        code: str = "",
        reason: str = "",
        detail: str = "",
        *,
        age_ms: int | None = None,
    ) -> None:
        """Report the outcome of a Command; an empty ``code`` means that it was carried out.

        ``age_ms`` is the age of its beacon. A flood on a plain link hides no report of a key.
        """
        link = (origin.link, origin.key)
        second = int(self._clock.seconds())
        if second != self._second:
            self._second = second
            self._published.clear()
        if link not in self._published and len(self._published) >= _LINKS_LIMIT:
            return
        if self._published[link] >= ANSWERS_HZ:
            self._unreported[link] += 1
            return
        self._published[link] += 1
        self._executor.execute_command(
            CommandAnsweredCommand(
                link=origin.link,
                name=name[:_NAME_LIMIT],
                command_id=command_id,
                outcome="nack" if code else "ack",
                code=code,
                reason=reason[:MAX_REASON],
                detail=detail[:MAX_DETAIL],
                untold=self._unreported.pop(link, 0),
                key=origin.key,
                role=origin.role.value,
                age_ms=age_ms,
            )
        )
