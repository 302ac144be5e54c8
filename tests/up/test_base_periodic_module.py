"""A periodic module continues after a fault, and logs each kind of fault once."""

from types import SimpleNamespace

from twisted.internet.task import Clock

from up.base_periodic_module import BasePeriodicModule


class Faulty(BasePeriodicModule):
    PERIOD_S = 0.5
    calls = faults = 0
    log = None

    def on_period(self):
        self.calls += 1
        if self.calls in (1, 2):
            raise RuntimeError("broken")

    def on_fault(self):
        self.faults += 1


def test_a_fault_is_logged_once_and_the_next_call_comes():
    module, clock, logged = Faulty(), Clock(), []
    module.context = SimpleNamespace(reactor=clock)
    module.log = SimpleNamespace(failure=lambda *_, code: logged.append(code))
    module.on_start()
    clock.pump([0.5, 0.5, 0.5])
    assert (module.calls, module.faults, logged) == (3, 2, ["period_failed"])
    module.on_stop()
    clock.advance(5.0)
    assert module.calls == 3 and not clock.getDelayedCalls()
