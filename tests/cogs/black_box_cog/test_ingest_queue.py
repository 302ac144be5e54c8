from black_box_cog.commands.black_box_commands import RecordCommand
from black_box_cog.ingest_queue import LIMIT_BYTES, IngestQueue, LogLine, Recorded

from up.commands.orientation_command import OrientationCommand
from up.commands.origin import INTERNAL
from up.commands.telemetry_commands import TelemetryCommand

PLACE = OrientationCommand(1.0, 2.0, 3.0)


def test_waiting_entries_are_bounded_by_their_memory():
    queue = IngestQueue(1_000_000)
    for _ in range(LIMIT_BYTES // 4000):
        queue.put(Recorded("companion.air", "x" * 4000))
    assert queue.dropped > 0 and 3000 < len(queue) < LIMIT_BYTES // 4000
    dropped = queue.dropped
    queue.put(LogLine(2, "Anybody", "x" * 4000))
    queue.observe(TelemetryCommand({}, 1), INTERNAL)
    assert queue.dropped == dropped + 2


def test_what_was_taken_makes_room_again():
    queue = IngestQueue(1_000_000)
    for _ in range(3):
        for _ in range(LIMIT_BYTES // 12_000):
            queue.observe(TelemetryCommand({}, 1), INTERNAL)
            queue.observe(PLACE, INTERNAL)
            queue.put(LogLine(2, "Anybody", "words"))
            assert len(queue.pop(3)) == 3
    assert queue.dropped == 0


def test_a_content_waits_once_and_not_as_the_command_that_brought_it_too():
    queue = IngestQueue(10)
    queue.observe(RecordCommand("companion.air", {"speed": 1}), INTERNAL)
    assert len(queue) == 0
