"""The base of every module (thesis 3.2.2)."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Coroutine, Iterable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from twisted.logger import Logger

from up.config import ConfigFile
from up.context import Context
from up.mode import IN_EVERY_MODE, Mode
from up.system.reactor_monitor import BUDGET_S

if TYPE_CHECKING:
    from up.up import Up


class BaseModule:
    """A part of the system with one function; built without arguments by the loader.

    Override ``on_init`` to take references and subscribe, ``load`` to decide
    whether to be loaded, ``telemetry_content`` to contribute to telemetry. Declare used modules
    with ``needs`` and ``wants``, configuration with ``CONFIG``, and with ``MODES`` the modes in
    which the loader instantiates the class. ``LOAD_ORDER`` breaks ties, lower first.
    """

    LOAD_ORDER: ClassVar[int] = 0
    CONFIG: ClassVar[ConfigFile[Any] | None] = None
    WRITTEN_FILES: ClassVar[tuple[ConfigFile[Any], ...]] = ()
    """Files of the configuration folder that the module itself writes."""
    IS_SET_BY_GROUND: ClassVar[bool] = False
    """Whether a ground with the role pilot may set the keys of ``CONFIG``, for the next start."""
    SHED_ORDER: ClassVar[int | None] = None
    """When an overloaded program stops this module for good, lower first; None: never."""
    TIME_BUDGET_S: ClassVar[float] = BUDGET_S
    """How long one call may hold the event loop: longer ones are counted, logged with the module's
    name, and end a flight mode. At least 0.020."""
    MODES: ClassVar[frozenset[Mode]] = IN_EVERY_MODE
    FLIGHT_CONTROLLERS: ClassVar[frozenset[str] | None] = None
    """The values of ``flight controller`` (config.yml) for which it, and what needs it, is loaded;
    None: every one."""

    up: Up
    context: Context

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        _alias_hooks(cls)

    def bind(self, context: Context) -> None:
        """Set the module's context; the loader calls this before ``load``."""
        self.context = context

    def load(self) -> bool:
        """Return whether to load the module; may read mode and configuration."""
        return True

    def plain_links(self) -> Iterable[tuple[str, str]]:
        """Yield each unprotected link that may leave this machine: its key, and one sentence.

        ``up check`` warns of them.
        """
        return ()

    def initialize(self, up: Up) -> None:
        """Enter the initialization phase; the framework calls this once.

        Raises TypeError when the hook is ``async def``: the framework does not await it.
        """
        self.up = up
        hook: Callable[[], Any] = self.on_init
        outcome = hook()
        if isinstance(outcome, Awaitable):
            if isinstance(outcome, Coroutine):
                outcome.close()
            raise TypeError(
                f"{self.class_name}.on_init must be done when it returns: what"
                " takes time belongs into on_start, which may be async"
            )

    def on_init(self) -> None:
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
    def log(self) -> Logger:
        return Logger(namespace=self.class_name)

    def is_a(self, name: str) -> bool:
        """Return whether this module's class or one of its base classes has that name."""
        return any(base.__name__ == name for base in type(self).__mro__)

    # Deprecated: the thesis's names of `log` and its methods.

    @property
    def logger(self) -> Logger:
        return self.log

    def _log_debug(self, text: str) -> None:
        self.log.debug("{text}", text=text)

    def _log_info(self, text: str) -> None:
        self.log.info("{text}", text=text)

    def _log_warning(self, text: str) -> None:
        self.log.warn("{text}", text=text)

    def _log_error(self, text: str) -> None:
        self.log.error("{text}", text=text)

    def _log_critical(self, text: str) -> None:
        self.log.critical("{text}", text=text)


_DEPRECATED_HOOKS = {
    "_execute_initialization": "on_init",
    "_execute_start": "on_start",
    "_execute_stop": "on_stop",
}


def _alias_hooks(cls: type[Any]) -> None:
    """Give every hook of a class and its mixins both names, the thesis's and today's.

    Both names in every class of the hierarchy: ``super()`` then works with either of them.
    """
    for each in cls.__mro__[:-1]:
        own = vars(each)
        for old, new in _DEPRECATED_HOOKS.items():
            if old in own and new not in own:
                setattr(each, new, own[old])
            elif new in own and old not in own:
                setattr(each, old, own[new])
