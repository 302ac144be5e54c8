"""Every language of the app has all its texts, with the same values in them."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from typing import NamedTuple

import pytest

from tests.support.android import ANDROID

RES = ANDROID / "raspilot" / "res"
LANGUAGES = ["values-de"]
# The field's words that German has, too.
ALIKE = {"Failsafe", "Log", "Motor", "Proxy", "Roll", "Runner", "Servos, us"}
VALUE = re.compile(r"%(?:(\d+)\$)?([-+.\d]*[a-z])|%%|\\n")
SHOWN = re.compile(
    r"\b(?:set(?:Text|Title|Message|Hint|Summary|ContentDescription)|TextViews\.show|makeText"
    r"|set(?:Positive|Neutral|Negative)Button)\([^;]*;"
)
CALL = re.compile(r"\bgetString\(\s*R\.string\.(\w+)([,)])")


class Text(NamedTuple):
    """One text resource: a string, or an array."""

    kind: str
    items: tuple[str, ...]
    is_translatable: bool


def texts(folder):
    """Return the text resources of a folder by their names; each name exists once."""
    found = {}
    for file in sorted((RES / folder).glob("*.xml")):
        for each in ElementTree.parse(file).getroot():
            if each.tag in ("string", "string-array", "plurals"):
                assert each.get("name") not in found, each.get("name")
                items = tuple(item.text or "" for item in each.iter() if item is not each)
                found[each.get("name")] = Text(
                    each.tag, items or (each.text or "",), each.get("translatable") != "false"
                )
    return found


DEFAULT = texts("values")


def values(text):
    """Return the values and line breaks of a text, in the order of the arguments."""
    return sorted(each[0] for each in VALUE.finditer(text))


def arguments(source, start):
    """Return how many arguments follow a comma at ``start`` until the bracket that closes."""
    depth, count = 1, 0
    for character in source[start:]:
        depth += (character in "({") - (character in ")}")
        count += character == "," and depth == 1
        if depth == 0:
            return count
    raise AssertionError(source[start:])


@pytest.mark.parametrize("folder", LANGUAGES)
def test_a_language_has_every_text_with_its_values(folder):
    language = texts(folder)
    assert set(language) == {name for name, text in DEFAULT.items() if text.is_translatable}
    for name, text in language.items():
        wanted = DEFAULT[name]
        assert (text.kind, len(text.items)) == (wanted.kind, len(wanted.items)), name
        assert list(map(values, text.items)) == list(map(values, wanted.items)), name
        assert all(item.strip() for item in text.items), name
        assert text.items != wanted.items or set(text.items) <= ALIKE, name


def test_a_text_gets_as_many_arguments_as_it_has_values():
    checked = 0
    for file in (ANDROID / "raspilot" / "src").rglob("*.java"):
        source = file.read_text(encoding="utf-8")
        for call in CALL.finditer(source):
            (text,) = DEFAULT[call[1]].items
            wanted = max((int(each[1] or 0) for each in VALUE.finditer(text)), default=0)
            assert arguments(source, call.start(2)) == wanted, f"{file.name}: {call[1]}"
            checked += wanted > 0
    assert checked > 20


def test_no_displayed_text_is_written_in_the_code():
    for file in (ANDROID / "raspilot" / "src").rglob("*.java"):
        for shown in SHOWN.finditer(file.read_text(encoding="utf-8")):
            written = re.findall(r'"((?:[^"\\]|\\.)*)"', shown[0])
            assert not re.search(r"[A-Za-z]{2}", "".join(written)), f"{file.name}: {shown[0]}"
