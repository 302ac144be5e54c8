"""Chooses the phone aboard: the Up Library on a JVM, or the stand-in in Python."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from up_simulator.harness.participants import CrewError
from up_simulator.phone.java_program import JavaProgram, JavaUnavailableError, find_java_program

PhoneKind = Literal["auto", "java", "python"]
KINDS = ("auto", "java", "python")
IN_JAVA = "the app's own Up Library, on a Java virtual machine"
IN_PYTHON = "a stand-in in Python"


@dataclass(frozen=True, slots=True)
class PhoneChoice:
    """The phone aboard; ``title`` names it, and the reason for the choice, to the user."""

    title: str
    java: JavaProgram | None = None


def choose_phone(
    kind: PhoneKind = "auto", say: Callable[[str], None] = lambda _text: None
) -> PhoneChoice:
    """Return the phone of that kind; auto is the Java one if it is available.

    ``say`` reports a Java phone older than its sources. Raises CrewError if Java is required but
    not available.
    """
    if kind == "python":
        return PhoneChoice(IN_PYTHON)
    try:
        return PhoneChoice(IN_JAVA, find_java_program(say))
    except JavaUnavailableError as error:
        if kind == "java":
            raise CrewError(f"the phone cannot be the Java one: {error}") from error
        return PhoneChoice(f"{IN_PYTHON}: {error}")
