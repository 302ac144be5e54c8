"""docs/firmware.md agrees with the firmware's sources."""

from __future__ import annotations

import re

from tests.support.virtual_environment import REPOSITORY

PAGE = (REPOSITORY / "docs" / "firmware.md").read_text(encoding="utf-8")
SOURCES = REPOSITORY / "arduino" / "raspilot" / "src"
NUMBER = r"-?\d+(?:\.\d+)?"


def source(name):
    return (SOURCES / name).read_text(encoding="utf-8")


def first_number_of(name, constant):
    """The first number in the value of a constant: 885 in ``us_to_ticks(885)``."""
    (value,) = re.findall(rf"\bconstexpr \w+ {constant} = ([^;]*);", source(name))
    return float(re.search(NUMBER, value.replace("static_cast<int32_t>", ""))[0])


def test_its_numbers_are_those_of_the_sources():
    stated = re.findall(rf"`(\w+)` ({NUMBER})[^|`]*: `([\w/.]+)` \|$", PAGE, re.MULTILINE)
    rows = PAGE.count("<!-- numbers -->")
    assert rows == 3 and len(stated) > 40
    for constant, number, name in stated:
        assert first_number_of(name, constant) == float(number), f"{name}: {constant}"


def test_every_row_of_numbers_names_its_constant():
    for table in re.findall(r"<!-- numbers -->\n\|.*\n\|.*\n((?:\|.*\n)+)", PAGE):
        for row in table.splitlines():
            assert re.search(rf"\| `\w+` {NUMBER}[^|]*: `[\w/.]+` \|$", row), row


def test_the_files_and_functions_that_it_names_exist():
    for name in re.findall(r"`((?:core|pilot|control|protocol|store|chip)/[\w/.]*)`", PAGE):
        assert (SOURCES / name).exists(), name
    for name, function in re.findall(r"`([a-z]+/[\w/]+\.cpp)` `(\w+)`", PAGE):
        assert re.search(rf"\b{function}\(", source(name)), f"{name} {function}"
    everything = "".join(path.read_text() for path in sorted(SOURCES.rglob("*.[ch]*")))
    for owner, function in re.findall(r"`([A-Z]\w+)::(\w+)`", PAGE):
        assert re.search(rf"\bclass {owner}\b", everything), owner
        is_defined = re.search(rf"\b{owner}::{function}\(", everything)
        assert is_defined or re.search(rf"\b{function}\(.*\) (?:const )?{{", everything), function


def test_its_interrupts_are_those_of_the_chip():
    vectors = set(re.findall(r"`(\w+_vect)`", PAGE))
    handled = set(re.findall(r"ISR\((\w+_vect)", "".join(map(source, CHIP))))
    assert vectors and vectors <= handled


def test_the_layout_of_eeprom_is_that_of_the_sources():
    slots = source("store/eeprom_slot.h")
    first, room, slots_a_kind = (
        int(re.search(rf"{name} = (\d+);", slots)[1])
        for name in ("FIRST_SLOT_ADDRESS", "SLOT_ROOM", "SLOTS_A_KIND")
    )
    order = re.search(r"enum \w+ : uint8_t {([^}]*?)\bKINDS\b", source("store/settings.h"))[1]
    expected = []
    for place, kind in enumerate(name.lower() for name in re.findall(r"\w+", order)):
        home = "settings" if kind == "battery" else kind
        size = re.search(rf"{kind.upper()}_SIZE = (\d+);", source(f"store/{home}.h"))[1]
        addresses = [first + (place * slots_a_kind + slot) * room for slot in range(slots_a_kind)]
        expected.append((kind, *addresses, int(size)))
    rows = re.findall(r"^\| (\w+) \| (\d+) \| (\d+) \| (\d+) \|", PAGE, re.MULTILINE)
    assert [(kind, *map(int, numbers)) for kind, *numbers in rows] == expected


def test_the_folders_are_all_there():
    listed = re.findall(r"^\| `(\w+)/` \|", PAGE, re.MULTILINE)
    assert set(listed) == {path.name for path in SOURCES.iterdir() if path.is_dir()}


CHIP = sorted(str(path.relative_to(SOURCES)) for path in (SOURCES / "chip").glob("*.cpp"))
