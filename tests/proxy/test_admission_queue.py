"""Waiting connections take turns by source, and a flood displaces only itself."""

from hypothesis import given
from hypothesis import strategies as st

from up_proxy.admission_queue import AdmissionQueue

SIZE = 6


@given(st.lists(st.sampled_from(["a", "b", "c", "pop"]), max_size=60))
def test_no_source_loses_to_one_with_more_and_each_has_its_turn(steps):
    queue = AdmissionQueue(SIZE)
    waiting = {}

    def pop():
        item = queue.pop()
        assert waiting[item[0]].pop(0) == item
        return item[0]

    for number, step in enumerate(steps):
        if step != "pop":
            waiting.setdefault(step, []).append((step, number))
            lost = queue.put(step, (step, number))
            if lost is not None:
                assert len(waiting[lost[0]]) == max(map(len, waiting.values()))
                assert waiting[lost[0]].pop() == lost
        elif queue:
            pop()
        assert len(queue) == sum(map(len, waiting.values())) <= SIZE
    while queue:
        sources = {source for source, items in waiting.items() if items}
        assert {pop() for _ in sources} == sources
