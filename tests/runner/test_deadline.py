"""A deadline that is moved again and again."""

from twisted.internet.task import Clock

from up_runner.deadline import Deadline


def test_it_is_missed_once_after_the_last_touch():
    clock, missed = Clock(), []
    deadline = Deadline(clock, 2.0, lambda: missed.append(clock.seconds()))
    clock.advance(100)
    assert missed == []
    for _ in range(30):
        deadline.touch()
        clock.advance(0.1)
    assert missed == [] and len(clock.getDelayedCalls()) == 1
    clock.pump([0.5] * 10)
    assert len(missed) == 1 and 104.8 < missed[0] < 105.5
    assert not deadline.running and clock.getDelayedCalls() == []


def test_a_stopped_one_is_not_missed():
    clock, missed = Clock(), []
    deadline = Deadline(clock, 2.0, lambda: missed.append(1))
    deadline.touch()
    deadline.stop()
    deadline.stop()
    clock.advance(10)
    assert missed == []
    deadline.touch()
    clock.advance(2)
    assert missed == [1]


def test_touched_while_it_is_missed_it_begins_anew():
    clock = Clock()
    missed = []

    def on_missed():
        missed.append(clock.seconds())
        deadline.touch()

    deadline = Deadline(clock, 1.0, on_missed)
    deadline.touch()
    clock.pump([0.5] * 8)
    assert missed == [1.0, 2.0, 3.0, 4.0]
    deadline.stop()
