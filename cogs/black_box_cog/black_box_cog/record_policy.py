"""Decides which objects get a topic in the log, and how many marks it takes."""

from black_box_cog.commands.black_box_commands import RecordCommand
from black_box_cog.encoders import json_of
from black_box_cog.ingest_queue import Recorded
from up.commands.command_registry import CommandRegistry
from up.commands.refusal import CommandRefusedError
from up.flight_log.origin_text import KEY
from up.system.clock import Clock
from up.system.token_bucket import TokenBucket

TOPICS_LIMIT = 64
MAX_BYTES = 4096
MAX_A_SECOND = 200
MAX_MARKS = 20
_RESERVED = "up."


class RecordPolicy:
    """Bounds number, size and rate of a companion's records, and protects others' topics."""

    def __init__(self, registry: CommandRegistry, clock: Clock) -> None:
        self._registry = registry
        self._topics: set[str] = set()
        self._records = TokenBucket(clock, MAX_A_SECOND, MAX_A_SECOND)
        # Each mark is a line of the program's log, too.
        self._marks = TokenBucket(clock, 1, MAX_MARKS)

    def checked(self, command: RecordCommand) -> Recorded:
        """Return the record; raises CommandRefusedError with the reason."""
        self._check_topic(command.topic)
        if not self._records.take():
            raise CommandRefusedError(f"at most {MAX_A_SECOND} records a second")
        if KEY in command.content:
            raise CommandRefusedError(f"content may not have the key {KEY}")
        try:
            text = json_of(command.content)
        except (ValueError, TypeError, RecursionError):
            raise CommandRefusedError("content cannot be written as JSON") from None
        if len(text) > MAX_BYTES:
            raise CommandRefusedError(
                f"content of {len(text)} bytes as JSON, at most {MAX_BYTES} are recorded"
            )
        self._topics.add(command.topic)
        return Recorded(command.topic, text)

    def check_mark(self) -> None:
        """Raise CommandRefusedError for more marks than a person sets."""
        if not self._marks.take():
            raise CommandRefusedError(f"at most {MAX_MARKS} marks at once and one a second")

    def _check_topic(self, topic: str) -> None:
        if topic.startswith(_RESERVED) or self._registry.get(topic) is not None:
            raise CommandRefusedError(f"the topic {topic} is a Command's")
        if topic not in self._topics and len(self._topics) >= TOPICS_LIMIT:
            raise CommandRefusedError(f"at most {TOPICS_LIMIT} topics are recorded")
