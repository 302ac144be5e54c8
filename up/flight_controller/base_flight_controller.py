"""The abstract Flight Controller (thesis 3.2.3)."""

from collections.abc import Mapping
from typing import Any, ClassVar

from up.base_started_module import BaseStartedModule
from up.commands.refusal import NO_NAVIGATION, Code, CommandRefusedError
from up.needs import needs
from up.providers.base_provider import BaseProvider
from up.providers.base_rx_provider import BaseRXProvider
from up.providers.up_orientation_provider import UpOrientationProvider


class BaseFlightController(BaseStartedModule):
    """Combines readings into servo outputs; extend it in an application's ``flight_controller/``.

    ``FLIGHT_MODES`` gives for each mode the readings that it needs and their maximum ages in
    seconds: a mode is offered only while all of them are valid.
    """

    SELECTS_MODES: ClassVar[bool] = False
    """Whether it handles the flight modes of ``up.flight_mode.set`` that are not the board's."""
    FLIGHT_MODES: ClassVar[Mapping[str, Mapping[str, float]]] = {}

    rx = needs(BaseRXProvider)
    orientation = needs(UpOrientationProvider)

    def on_init(self) -> None:
        self._providers: dict[str, BaseProvider[Any]] = {
            provider.READING: provider for provider in self.up.get_modules(BaseProvider)
        }

    @property
    def offered_modes(self) -> list[str]:
        return [mode for mode in self.FLIGHT_MODES if self.is_offered(mode)]

    def is_offered(self, mode: str) -> bool:
        """Return whether a mode's readings are valid and fresh; False for an unknown mode."""
        wanted = self.FLIGHT_MODES.get(mode)
        return wanted is not None and all(
            self._is_fresh(reading, max_age_s) for reading, max_age_s in wanted.items()
        )

    def missing_for(self, mode: str) -> list[str]:
        """Return the readings that keep a mode from being offered."""
        wanted = self.FLIGHT_MODES.get(mode, {})
        return [each for each, max_age_s in wanted.items() if not self._is_fresh(each, max_age_s)]

    def require(self, what: str, value: float) -> None:
        """Follow a ``course`` (deg) or ``altitude`` (m) that the ground requests.

        Raises CommandRefusedError when nothing follows it.
        """
        raise CommandRefusedError(NO_NAVIGATION, Code.NOT_SUPPORTED)

    def required(self, what: str) -> float | None:
        """Return the course or altitude that it follows now because the ground requested it."""
        return None

    def _is_fresh(self, reading: str, max_age_s: float) -> bool:
        provider = self._providers.get(reading)
        return provider is not None and provider.fresh(max_age_s) is not None
