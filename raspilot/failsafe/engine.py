"""Decides which failsafe acts: delays, priority, and what ends one. No Twisted.

A new trigger is a key of ``config.py`` and a condition in ``raspilot/modules/failsafes.py``.
"""

from collections.abc import Collection, Mapping

from raspilot.failsafe.config import WARN, Trigger
from up.quick_dataclass import dataclass


@dataclass(slots=True)
class _Failure:
    since_s: float | None = None
    is_overridden: bool = False


class FailsafeEngine:
    """Follows the conditions of the triggers, which are in the order of their priority.

    A trigger is active while its condition has held for its delay. Its action is wanted unless
    the pilot has overridden it since its condition began.
    """

    def __init__(self, triggers: Mapping[str, Trigger]) -> None:
        self._triggers = triggers
        self._failures = {code: _Failure() for code in triggers}
        self.active: list[str] = []

    def update(self, now_s: float, conditions: Mapping[str, bool]) -> None:
        """Take the conditions of this moment; ``now_s`` is monotonic, and a missing one is over."""
        self.active = []
        for code, failure in self._failures.items():
            if not conditions.get(code, False):
                failure.since_s, failure.is_overridden = None, False
                continue
            if failure.since_s is None:
                failure.since_s = now_s
            if now_s - failure.since_s >= self._triggers[code].delay_s:
                self.active.append(code)

    def wanted(self, acting: str | None, exempt: Collection[str]) -> str | None:
        """Return the trigger whose action is to be carried out now instead of that of ``acting``.

        None: none. An action lasts until the pilot ends it, so only a trigger above ``acting``
        replaces it: two of them never take turns. Those ``exempt`` do not act now.
        """
        for code in self._triggers:
            if code == acting:
                return None
            is_free = not self._failures[code].is_overridden and code not in exempt
            if code in self.active and is_free and self._triggers[code].action != WARN:
                return code
        return None

    def override(self) -> None:
        """End the actions of the triggers that are active: the pilot has decided otherwise."""
        for code in self.active:
            self._failures[code].is_overridden = True
