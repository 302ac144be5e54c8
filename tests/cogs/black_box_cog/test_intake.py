from black_box_cog.commands.record_command import RecordCommand
from black_box_cog.intake import LIMIT_BYTES, Intake, LogLine, Recorded

from up.commands.orientation_command import OrientationCommand
from up.commands.origin import INTERNAL
from up.commands.telemetry_commands import TelemetryCommand

PLACE = OrientationCommand(1.0, 2.0, 3.0)


def test_what_waits_is_bounded_by_what_it_takes_too():
    intake = Intake(1_000_000)
    for _ in range(LIMIT_BYTES // 4000):
        intake.note(Recorded("companion.air", "x" * 4000))
    assert intake.dropped > 0 and 3000 < len(intake) < LIMIT_BYTES // 4000
    dropped = intake.dropped
    intake.note(LogLine(2, "Anybody", "x" * 4000))
    intake.observe(TelemetryCommand({}, 1), INTERNAL)
    assert intake.dropped == dropped + 2


def test_what_was_taken_makes_room_again():
    intake = Intake(1_000_000)
    for _ in range(3):
        for _ in range(LIMIT_BYTES // 12_000):
            intake.observe(TelemetryCommand({}, 1), INTERNAL)
            intake.observe(PLACE, INTERNAL)
            intake.note(LogLine(2, "Anybody", "words"))
            assert len(intake.take(3)) == 3
    assert intake.dropped == 0


def test_a_content_waits_once_and_not_as_the_command_that_brought_it_too():
    intake = Intake(10)
    intake.observe(RecordCommand("companion.air", {"speed": 1}), INTERNAL)
    assert len(intake) == 0
