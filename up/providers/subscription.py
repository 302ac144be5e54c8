"""A module's subscription to the reading of a provider."""

from __future__ import annotations

from collections.abc import Callable
from functools import update_wrapper
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from up.cleanup import add_cleanup
from up.system.clock import Timer, cancel

if TYPE_CHECKING:
    from up.providers.base_provider import BaseProvider, Reading

_T = TypeVar("_T")
_RESOLUTION_S = 0.001


class Subscription(Generic[_T]):
    """Reports each new fresh reading of a provider, and once that the newest became stale.

    It is one more handler of the provider's Command, called after the provider: a fault of the
    module is logged with its name and does not affect others.
    """

    def __init__(
        self,
        provider: BaseProvider[_T],
        on_changed: Callable[[Reading[_T]], Any],
        on_stale: Callable[[], object] | None,
        max_age_s: float,
    ) -> None:
        self._provider = provider
        self._on_stale = on_stale
        self._max_age_s = max_age_s
        self._reactor = provider.context.reactor
        self._last: Reading[_T] | None = None
        self._is_fresh = False
        self._timer: Timer | None = None
        fresh = provider.fresh

        def on_command(_command: object) -> Any:
            reading = fresh(max_age_s)
            if reading is None:
                self._note_stale()
            elif reading is not self._last:
                self._last = reading
                self._is_fresh = True
                if on_stale is not None and self._timer is None:
                    self._watch()
                return on_changed(reading)
            return None

        # The bus names the module whose method this is.
        handler = update_wrapper(on_command, on_changed)
        provider.up.command_executor.register_command(provider.COMMAND, handler)
        add_cleanup(lambda: cancel(self._timer))

    def _watch(self) -> None:
        """Look again when the newest reading will be too old."""
        self._timer = None
        reading = self._provider.fresh(self._max_age_s)
        if reading is None:
            self._note_stale()
        else:
            left_s = self._max_age_s - reading.age_s(self._reactor.seconds())
            self._timer = self._reactor.callLater(max(left_s, _RESOLUTION_S), self._watch)

    def _note_stale(self) -> None:
        if self._is_fresh:
            self._is_fresh = False
            if self._on_stale is not None:
                self._on_stale()
