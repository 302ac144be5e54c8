import queue
import threading

import pytest

from up.base_module import BaseModule
from up.base_started_module import BaseStartedModule
from up.base_thread_module import BaseThreadModule
from up.loading.plan import BootError
from up.needs import needs
from up.testing import Bench, StillClock


class Line(BaseStartedModule):
    async def on_start(self):
        return True


class User(BaseStartedModule):
    line = needs(Line)

    def on_start(self):
        assert self.line.started
        return True


class Worker(BaseThreadModule):
    def _loop(self):
        self.call_in_reactor(setattr, self, "heard", threading.current_thread().name)
        self.stop_event.wait(60)


def test_modules_are_ordered_started_and_stopped(tmp_path):
    bench = Bench(User, Line, config_folder=tmp_path)
    assert [module.class_name for module in bench.up.modules] == ["Line", "User"]
    bench.start()
    assert bench.module(User).started
    bench.stop()
    assert not bench.module(Line).started


def test_a_missing_need_is_an_error_as_in_a_boot(tmp_path):
    with pytest.raises(BootError) as error:
        Bench(User, config_folder=tmp_path)
    assert error.value.code == "need_missing"


def test_a_module_that_is_not_there(tmp_path):
    with pytest.raises(LookupError, match="Line"):
        Bench(BaseModule, config_folder=tmp_path).module(Line)


def test_a_thread_is_heard_and_ended(tmp_path):
    bench = Bench(Worker, config_folder=tmp_path)
    bench.start()
    bench.clock.take_call()
    worker = bench.module(Worker)
    assert worker.heard == "Thread-Worker"
    bench.stop()
    assert not any(thread.name == "Thread-Worker" for thread in threading.enumerate())


def test_nothing_from_a_thread_is_an_error():
    with pytest.raises(queue.Empty):
        StillClock().take_call(timeout_s=0.01)
