"""The encoding of a Command class, computed once per program."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from black_box_cog.encoders import Encode, encoder_of
from up.commands.command import BaseCommand
from up.flight_log.command_schema import schema_of


@dataclass(frozen=True, slots=True)
class CommandForm:
    """The schema of a class's data, and the function that encodes a Command."""

    schema: dict[str, Any]
    encode: Encode


_forms: dict[type[BaseCommand], CommandForm] = {}


def form_of(cls: type[BaseCommand]) -> CommandForm:
    """Return the form of a class; the first call takes half a millisecond on a PC."""
    form = _forms.get(cls)
    if form is None:
        form = _forms[cls] = CommandForm(schema_of(cls), encoder_of(cls))
    return form
