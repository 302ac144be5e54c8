"""The errors of the rig: the text is one sentence for the user, ``code`` names its kind."""

from __future__ import annotations


class RigError(Exception):
    """The rig cannot carry out a request."""

    def __init__(self, text: str, code: str) -> None:
        super().__init__(text)
        self.code = code


class RigUnavailableError(RigError):
    """The rig or the firmware cannot be built or loaded here."""

    def __init__(self, text: str, code: str = "unavailable") -> None:
        super().__init__(text, code)


class FirmwareError(RigError):
    """A file is not a program for the chip, or lacks a symbol."""


class CrashError(RigError):
    """The program used a feature that the chip lacks or the rig does not model."""
