import tracemalloc

from hypothesis import given
from hypothesis import strategies as st

from tests.up.protocols.golden import cut, places
from up.protocols.line_decoder import LineBuffer, LineDecoder


def test_lines_end_at_lf_and_lose_a_cr():
    assert LineDecoder().feed(b"one\ntwo\r\n three \nfo") == [b"one", b"two", b" three "]


def test_empty_lines_are_left_out():
    assert LineDecoder().feed(b"\n\r\n\nx\n\n") == [b"x"]


def test_a_line_may_be_16_kib_with_its_lf_and_no_more():
    lines = LineDecoder()
    longest = b"x" * 16383
    assert lines.feed(longest + b"\n") == [longest]
    assert lines.feed(longest + b"x\nnext\n") == [b"next"]
    assert lines.dropped_too_long == 1


def test_a_line_without_end_takes_no_memory():
    lines = LineDecoder(1024)
    piece = b"x" * 60_000
    tracemalloc.start()
    try:
        for _ in range(1000):
            assert lines.feed(piece) == []
        held, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert held < 10_000
    assert peak < 200_000
    assert lines.feed(b"end\nnext\n") == [b"next"]
    assert lines.dropped_too_long == 1


def test_many_small_pieces_are_bounded_too():
    lines = LineDecoder(1024)
    for _ in range(5000):
        assert lines.feed(b"x") == []
        assert len(lines._buffer) <= 1023
    assert lines.feed(b"\nnext\n") == [b"next"]


def test_reset_forgets_half_a_line():
    lines = LineDecoder()
    lines.feed(b"half")
    lines.reset()
    assert lines.feed(b"whole\n") == [b"whole"]


@given(st.lists(st.binary(max_size=30)), places, st.integers(2, 40))
def test_any_chunking_gives_the_same_lines(contents, cuts, max_length):
    data = b"\n".join(contents)
    whole, pieces = LineDecoder(max_length), LineDecoder(max_length)
    expected = whole.feed(data)
    assert [line for piece in cut(data, cuts) for line in pieces.feed(piece)] == expected
    assert pieces.dropped_too_long == whole.dropped_too_long
    complete = data.split(b"\n")[:-1]
    short = [line.removesuffix(b"\r") for line in complete if len(line) < max_length]
    assert expected == [line for line in short if line]


CHUNKS = st.lists(st.sampled_from([b"\n", b"a", b"bc\n", b"d\ne", b"\n\n"]) | st.binary(min_size=1))


@given(CHUNKS)
def test_only_whole_lines_pass_and_unchanged(chunks):
    buffer = LineBuffer()
    whole = []
    for chunk in chunks:
        lines = buffer.feed(chunk)
        assert not lines or lines.endswith(b"\n")
        whole.append(lines)
    text = b"".join(chunks)
    cut = text.rfind(b"\n") + 1
    assert b"".join(whole) == text[:cut]
    assert len(buffer) == len(text) - cut
    assert buffer.starts_with(text[cut:])
