import json
from dataclasses import dataclass
from typing import ClassVar

import pytest
from twisted.internet.task import Clock

from tests.ground.web.hub import Link
from up.commands.builtin import BUILTIN_COMMANDS
from up.commands.command import BaseCommand, value
from up.commands.roles import Role
from up_ground.catalogue import BYTES_LIMIT, Catalogue, catalogue_message
from up_ground.web.access import Access
from up_ground.web.client_hub import ClientHub


@dataclass(frozen=True, slots=True)
class BannerCommand(BaseCommand):
    """Drops
    it.

    In a gust it tears.
    """

    NAME: ClassVar[str] = "tow.banner"
    ALIASES: ClassVar[tuple[str, ...]] = ("tow.rag",)
    ROLES: ClassVar[frozenset[Role]] = frozenset({Role.PILOT})
    NEEDS_BEACON: ClassVar[bool] = True
    length_m: float = value(key="length", unit="m", minimum=0, maximum=40)
    side: str = value("left", choices=("left", "right"))
    lamps: int | None = value(None, maximum=9)
    words: tuple[str, ...] = value((), max_length=3)


@dataclass(frozen=True, slots=True)
class InsideCommand(BaseCommand):
    """No ground may send it."""

    NAME: ClassVar[str] = "tow.inside"


def test_a_command_is_told_with_all_that_a_form_needs():
    (told,) = catalogue_message(Catalogue([BannerCommand, InsideCommand]))["commands"]
    fields = told.pop("fields")
    assert told == {
        "name": "tow.banner",
        "aliases": ["tow.rag"],
        "title": "tow.banner",
        "role": "pilot",
        "role_where": [],
        "text": "Drops it.",
        "needs_beacon": True,
    }
    length, side, lamps, words = fields
    assert length == {
        "name": "length",
        "type": "number",
        "unit": "m",
        "minimum": 0,
        "maximum": 40,
        "choices": None,
        "max_length": None,
        "nullable": False,
        "required": True,
        "text": "a number between 0 and 40 m",
    }
    assert (side["type"], side["choices"], side["required"]) == ("text", ["left", "right"], False)
    assert (lamps["type"], lamps["nullable"], lamps["maximum"]) == ("integer", True, 9)
    assert (words["type"], words["max_length"]) == ("list", 3)


def test_whatever_is_installed_here_is_told_and_fits_into_a_message():
    catalogue = Catalogue.installed()
    message = catalogue_message(catalogue)
    names = [each["name"] for each in message["commands"]]
    assert names == [cls.NAME for cls in catalogue.sendable()]
    assert {"up.flight_mode.set", "arduino.calibrate", "black_box.mark"} <= set(names)
    assert not {"up.ack", "up.nack", "up.telemetry.update"} & set(names)
    assert json.loads(json.dumps(message, allow_nan=False)) == message


def test_a_catalogue_without_end_has_one():
    def command(number):
        return type(
            f"Command{number}",
            (BaseCommand,),
            {"NAME": f"tow.n{number}", "ROLES": frozenset({Role.PILOT}), "__doc__": "x" * 9000},
        )

    message = catalogue_message(Catalogue(map(command, range(2000))))
    # What waits for a page is bounded: this may not fill it.
    assert 0 < len(json.dumps(message)) - BYTES_LIMIT // 2 < BYTES_LIMIT


@pytest.mark.parametrize("offered", [True, False])
def test_a_page_hears_of_it_after_its_welcome_once(offered):
    catalogue = catalogue_message(Catalogue(BUILTIN_COMMANDS)) if offered else None
    pages = ClientHub(Clock(), Access(), catalogue=catalogue)
    for _ in range(2):
        link = Link()
        pages.on_opened(link)
        pages.on_message(link, b'{"type": "hello"}')
        assert link.kinds() == ["welcome", "catalogue"][: 1 + offered]
    if offered:
        assert link.told[1] == catalogue
