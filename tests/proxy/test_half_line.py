"""Only whole lines go on."""

from hypothesis import given
from hypothesis import strategies as st

from up_proxy.half_line import HalfLine

CHUNKS = st.lists(st.sampled_from([b"\n", b"a", b"bc\n", b"d\ne", b"\n\n"]) | st.binary(min_size=1))


@given(CHUNKS)
def test_lines_come_out_as_they_went_in_and_whole(chunks):
    half = HalfLine()
    whole = []
    for chunk in chunks:
        lines = half.take(chunk)
        assert not lines or lines.endswith(b"\n")
        whole.append(lines)
    text = b"".join(chunks)
    cut = text.rfind(b"\n") + 1
    assert b"".join(whole) == text[:cut]
    assert len(half) == len(text) - cut
    assert half.starts_with(text[cut:])
