"""The base of every module (thesis 3.2.2)."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Coroutine, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from twisted.logger import Logger

from up.config import ConfigFile
from up.context import Context
from up.mode import IN_EVERY_MODE, Mode

if TYPE_CHECKING:
    from up.up import Up


class BaseModule:
    """A part of the system with one function; built without arguments by the loader.

    Override ``_execute_initialization`` to take references and subscribe, ``load`` to decide
    whether to be loaded, ``telemetry_content`` to contribute to telemetry. Declare used modules
    with ``needs`` and ``wants``, configuration with ``CONFIG``, and with ``MODES`` the modes in
    which the loader instantiates the class. ``LOAD_ORDER`` breaks ties, lower first.
    """

    LOAD_ORDER: ClassVar[int] = 0
    CONFIG: ClassVar[ConfigFile[Any] | None] = None
    MODES: ClassVar[frozenset[Mode]] = IN_EVERY_MODE

    up: Up
    context: Context

    def bind(self, context: Context) -> None:
        """Set the module's context; the loader calls this before ``load``."""
        self.context = context

    def load(self) -> bool:
        """Return whether to load the module; may read mode and configuration."""
        return True

    def initialize(self, up: Up) -> None:
        """Enter the initialization phase; the framework calls this once.

        Raises TypeError when the hook is ``async def``: the framework does not await it.
        """
        self.up = up
        hook: Callable[[], Any] = self._execute_initialization
        outcome = hook()
        if isinstance(outcome, Awaitable):
            if isinstance(outcome, Coroutine):
                outcome.close()
            raise TypeError(
                f"{self.class_name}._execute_initialization must be done when it returns: what"
                " takes time belongs into _execute_start, which may be async"
            )

    def _execute_initialization(self) -> None:
        """Take references, subscribe to Commands, read configuration. No sockets, no ports."""

    @property
    def telemetry_content(self) -> Mapping[str, Any] | None:
        """Return what this module contributes to telemetry, under its module key; or None."""
        return None

    @property
    def config(self) -> Any:
        """Return the values of the module's configuration file, an instance of its dataclass."""
        if self.CONFIG is None:
            raise AttributeError(f"{self.class_name} declares no CONFIG")
        return self.context.config(self.CONFIG)

    @property
    def class_name(self) -> str:
        """Return the class name, which messages use as the module's name."""
        return type(self).__name__

    @property
    def path(self) -> str:
        """Return the fully qualified name, as written in ``disabled_modules.yml``."""
        return f"{type(self).__module__}.{type(self).__qualname__}"

    @property
    def logger(self) -> Logger:
        """Return a logger with this module's name."""
        return Logger(namespace=self.class_name)

    def is_a(self, name: str) -> bool:
        """Return whether this module's class or one of its base classes has that name."""
        return any(base.__name__ == name for base in type(self).__mro__)

    def _log_debug(self, text: str) -> None:
        self.logger.debug("{text}", text=text)

    def _log_info(self, text: str) -> None:
        self.logger.info("{text}", text=text)

    def _log_warning(self, text: str) -> None:
        self.logger.warn("{text}", text=text)

    def _log_error(self, text: str) -> None:
        self.logger.error("{text}", text=text)

    def _log_critical(self, text: str) -> None:
        self.logger.critical("{text}", text=text)
