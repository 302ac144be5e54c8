"""DisplayPort byte for byte, and the least that brings a screen up to date."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msp_cog.displayport import (
    CLEAR,
    DRAW,
    HEARTBEAT,
    RELEASE,
    answer,
    answers,
    operation,
    plain,
    write,
)
from msp_cog.osd_config import OSD, WIDTHS
from msp_cog.osd_screen import OsdScreen

from up.config import ConfigErrors
from up_simulator.radio.goggles import Goggles

TEXTS = st.text(alphabet=[chr(each) for each in range(0x20, 0x60)], min_size=1, max_size=40)
PUTS = st.lists(st.tuples(st.integers(0, 3), st.integers(0, 13), TEXTS), max_size=12)


@pytest.mark.parametrize(
    ("frame", "wanted"),
    [
        (operation(HEARTBEAT), "244d3e01b600b7"),
        (operation(RELEASE), "244d3e01b601b6"),
        (operation(CLEAR), "244d3e01b602b5"),
        (operation(DRAW), "244d3e01b604b3"),
        # Row 2, column 5, attribute 0.
        (write(2, 5, "ALT 12M"), "244d3e0bb603020500414c542031324d8e"),
    ],
)
def test_operations_byte_for_byte(frame, wanted):
    assert frame == bytes.fromhex(wanted)


def test_answers_to_goggles():
    known = answers((50, 18), is_armed=True)
    assert answer(2, known) == bytes.fromhex("244d3e04024254464c1a")
    assert answer(189, known) == bytes.fromhex("244d3e02bd32129f")
    # HDZero and DJI read the modes at byte 6, and ARM at the place that the ids give it.
    assert known[101][6:10] == b"\1\0\0\0" and known[119] == b"\0"
    assert answers((50, 18), is_armed=False)[101][6:10] == bytes(4)
    # Other requests are refused, also those that a board would carry out.
    for number in (105, 200, 99, 250, 89):
        assert answer(number, known)[:5] == b"$M!\0" + bytes((number,))


def test_other_characters_become_question_marks():
    assert plain("Lo\u00edter~{\n\0`") == "LO?TER?????"


@given(st.lists(PUTS, max_size=4), st.integers(60, 400))
def test_the_goggles_show_the_screen_in_bounded_pieces_of_what_changed(steps, max_bytes):
    screen, goggles = OsdScreen(53, 4), Goggles(53, 4)
    for puts in [[(0, 0, " ")], *steps]:
        for row, column, text in puts:
            screen.put(row, column, text)
        while frames := screen.changes(max_bytes):
            assert len(frames) <= max_bytes
            goggles.feed(frames)
        goggles.feed(operation(DRAW))
        assert goggles.errors == 0
        assert goggles.shown == ["".join(row) for row in screen._shown]
        assert screen.changes(max_bytes) == b""


def test_one_changed_digit_costs_one_frame_and_a_forgotten_row_only_itself():
    screen = OsdScreen(50, 18)
    screen.put(3, 1, "ALT 123M")
    screen.clear()
    assert screen.changes(999) == write(3, 1, "ALT 123M")
    screen.put(3, 1, "ALT 124M")
    assert screen.changes(999) == write(3, 7, "4")
    screen.forget(5)
    assert screen.changes(999) == write(5, 0, " " * 30) + write(5, 30, " " * 20)


def parse(text, tmp_path):
    return OSD.parse(text, tmp_path / "osd.yml")


@pytest.mark.parametrize("grid", ["30x16", "50x18", "53x20"])
def test_the_default_places_fit_every_grid(grid, tmp_path):
    places = parse(f"grid: {grid}\n", tmp_path).places
    assert places.keys() == WIDTHS.keys()


@pytest.mark.parametrize(
    ("text", "key", "code"),
    [
        ("elements: {altitude: '42,3'}", "elements", "outside_grid"),
        ("elements: {altitude: '1,18'}", "elements", "outside_grid"),
        ("elements: {altitude: '1,-19'}", "elements", "outside_grid"),
        ("elements: {altitude: '-8,3'}", "elements", "outside_grid"),
        ("elements: {altitude: '9,2'}", "elements", "overlap"),
        ("elements: {altitude: '1;3'}", "elements.altitude", "not_a_place"),
        ("{baud_rate: 19200, bytes_per_s: 1921}", "bytes_per_s", "too_fast"),
    ],
    ids=["right", "below", "above", "cut", "overlap", "form", "speed"],
)
def test_a_place_outside_the_grid_or_over_another_is_refused_and_too_many_bytes(
    text, key, code, tmp_path
):
    with pytest.raises(ConfigErrors) as refused:
        parse(text, tmp_path)
    (problem,) = refused.value.problems
    assert (problem.key, problem.code, problem.line) == (key, code, 1)


def test_an_element_without_a_place_is_not_shown(tmp_path):
    assert "home" not in parse("elements: {home: ''}\n", tmp_path).places
