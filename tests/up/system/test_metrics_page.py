from twisted.internet import reactor
from twisted.internet.task import Clock

from up.system.metrics_page import MetricsFactory


def test_a_factory_leaves_nothing_in_a_reactor_that_it_was_not_given():
    before = reactor.getDelayedCalls()
    factory = MetricsFactory(Clock(), lambda: "")
    factory.doStart()
    assert reactor.getDelayedCalls() == before and factory.clock.getDelayedCalls()
    factory.doStop()
