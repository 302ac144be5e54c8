"""States of aircraft, in batches to the nodes."""

from types import SimpleNamespace

from twisted.internet.task import Clock

from up_proxy.cluster.node_messages import parse_batch
from up_proxy.cluster.state_batches import SIZE, StateBatches


class Aircraft(SimpleNamespace):
    def state_for(self, node):
        return self.fence, f'"{node}"'.encode()


def test_each_state_is_sent_once_to_each_of_its_nodes():
    clock, sent = Clock(), []
    batches = StateBatches(clock, lambda node, body: sent.append((node, body)))
    for fence in (1, 2):
        aircraft = [Aircraft(name=f"a{number}", fence=fence) for number in range(2 * SIZE + 3)]
        for each in aircraft:
            batches.add("one", each)
        batches.add("two", aircraft[0])
        assert len(sent) == 2 and len(clock.getDelayedCalls()) == 1
        clock.advance(0)
        heard = [(node, *state) for node, body in sent for state in parse_batch(body)]
        expected = [("one", each.name, fence, b'"one"') for each in aircraft]
        assert heard == [*expected, ("two", "a0", fence, b'"two"')]
        assert len(sent) == 4
        sent.clear()


def test_one_that_ends_sends_no_state():
    clock, sent = Clock(), []
    batches = StateBatches(clock, lambda node, body: sent.append(body))
    gone, here = Aircraft(name="gone", fence=1), Aircraft(name="here", fence=1)
    for each in (gone, here):
        batches.add("one", each)
    batches.add("two", gone)
    batches.discard(gone)
    batches.add("one", here)
    clock.advance(0)
    assert sent == [b'here 1 "one"\n' * 2]


def test_a_state_is_that_of_its_sending():
    clock, sent = Clock(), []
    batches = StateBatches(clock, lambda node, body: sent.append(body))
    aircraft = Aircraft(name="a", fence=1)
    batches.add("one", aircraft)
    aircraft.fence = 2
    clock.advance(0)
    assert sent == [b'a 2 "one"\n']
