import os

import pytest

from tests.up.commands.samples import Log
from up.system import scheduling
from up.system.scheduling import use_realtime_priority


def test_zero_leaves_everything_as_it_is(monkeypatch):
    monkeypatch.delattr(os, "sched_setscheduler")
    assert use_realtime_priority(0) is False


@pytest.mark.parametrize(
    ("fault", "code"),
    [(PermissionError(), "realtime_denied"), (OSError(22, "Invalid argument"), "realtime_failed")],
)
def test_a_refusal_is_said_and_the_program_goes_on(monkeypatch, fault, code):
    def refuse(*_):
        raise fault

    monkeypatch.setattr(scheduling.os, "sched_setscheduler", refuse)
    with Log() as log:
        assert use_realtime_priority(20) is False
    assert log.of(code)
    assert not log.failures


def test_what_the_system_really_does():
    before = os.sched_getscheduler(0)
    parameters = os.sched_getparam(0)
    try:
        permitted = use_realtime_priority(1)
        assert (os.sched_getscheduler(0) == os.SCHED_FIFO) is (permitted or before == 1)
    finally:
        os.sched_setscheduler(0, before, parameters)
