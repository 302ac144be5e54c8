"""Lines waiting for a slow peer."""

from hypothesis import given
from hypothesis import strategies as st

from up_proxy.send_buffer import SendBuffer


def drain(queue, step=7):
    out = b""
    while queue:
        piece = queue.head()[:step]
        queue.sent(len(piece))
        out += piece
    return out


def test_the_oldest_whole_lines_are_dropped():
    queue = SendBuffer(12)
    for line in (b"one\n", b"two\n", b"three\n", b"four\n"):
        queue.put(line)
    assert queue.dropped_lines == 2
    assert drain(queue) == b"three\nfour\n"


def test_without_a_limit_nothing_is_dropped():
    queue = SendBuffer(0)
    for _ in range(1000):
        queue.put(b"x" * 999 + b"\n")
    assert len(queue) == 1_000_000
    assert queue.dropped_lines == 0


LINE = st.binary(max_size=12).map(lambda text: text.replace(b"\n", b"") + b"\n")
ACTION = st.one_of(
    st.tuples(st.just("put"), st.lists(LINE, min_size=1, max_size=4)),
    st.tuples(st.just("control"), st.just([b"UP1 control\n"])),
    st.tuples(st.just("sent"), st.integers(1, 40)),
)


@given(st.integers(1, 60), st.lists(ACTION, max_size=40))
def test_any_sequence_sends_whole_lines_in_order(limit, actions):
    """Lines are numbered, so that any glued, torn, doubled or reordered one shows."""
    queue = SendBuffer(limit)
    out, put, control = b"", [], 0
    for what, value in actions:
        if what == "put":
            lines = [b"%d:" % (len(put) + n) + line for n, line in enumerate(value)]
            put += lines
            queue.put(b"".join(lines))
            assert len(queue) <= queue.kept_bytes + limit
        elif what == "control":
            queue.put_control(value[0])
            control += 1
        else:
            piece = queue.head()[:value]
            queue.sent(len(piece))
            out += piece
    out += drain(queue)
    left = [line + b"\n" for line in out.split(b"\n")[:-1]]
    assert out == b"".join(left)
    assert left.count(b"UP1 control\n") == control
    relayed = [line for line in left if line != b"UP1 control\n"]
    numbers = [put.index(line) for line in relayed]
    assert numbers == sorted(set(numbers))
    assert queue.dropped_lines == len(put) - len(relayed)
