"""States of aircraft, in batches to the nodes."""

from collections import deque
from types import SimpleNamespace

from up_proxy.cluster.node_messages import parse_batch
from up_proxy.cluster.state_batches import SIZE, StateBatches


class Aircraft(SimpleNamespace):
    def state_for(self, node):
        return self.fence, f'"{node}"'.encode()


def test_each_state_is_sent_once_to_each_of_its_nodes_as_it_is_then():
    steps, sent = deque(), []
    batches = StateBatches(
        SimpleNamespace(do_later=steps.append), lambda node, body: sent.append((node, body))
    )
    aircraft = [Aircraft(name=f"a{number}", fence=0) for number in range(2 * SIZE + 3)]
    for round_ in (1, 2):
        for each in aircraft:
            batches.add("one", each)
        batches.add("two", aircraft[0])
        for each in aircraft:
            each.fence = round_
        while steps:
            assert len(steps) == 1
            steps.popleft()()
        heard = [(node, *state) for node, body in sent for state in parse_batch(body)]
        expected = [("one", each.name, round_, b'"one"') for each in aircraft]
        assert sorted(heard) == sorted([*expected, ("two", "a0", round_, b'"two"')])
        assert len(sent) == 4
        sent.clear()
