"""The arming vetoes, by name."""

from collections.abc import Callable

from up.cleanup import add_cleanup


class Vetoes:
    """The reasons against arming: those of this program, and those that others report.

    Only this program's own go to the board; the ground sees both.
    """

    def __init__(self) -> None:
        self._own: dict[str, str] = {}
        self._reported: dict[str, tuple[str, ...]] = {}
        self._on_changed: Callable[[], object] = lambda: None

    @property
    def on_changed(self) -> Callable[[], object]:
        """The callback for changes of this program's vetoes; set by the listener."""
        return self._on_changed

    @on_changed.setter
    def on_changed(self, call: Callable[[], object]) -> None:
        before = self._on_changed
        self._on_changed = call

        def remove_callback() -> None:
            if self._on_changed == call:
                self._on_changed = before

        add_cleanup(remove_callback)

    def set(self, name: str, reason: str) -> None:
        """Forbid arming under a name until it is cleared."""
        if self._own.get(name) != reason:
            self._own[name] = reason
            self.on_changed()

    def clear(self, name: str) -> None:
        if self._own.pop(name, None) is not None:
            self.on_changed()

    def report(self, who: str, reasons: tuple[str, ...]) -> None:
        """Note the reasons against arming of another part, such as the board."""
        self._reported[who] = reasons

    @property
    def own(self) -> dict[str, str]:
        return dict(self._own)

    @property
    def all(self) -> list[str]:
        own = [f"{name}: {reason}" for name, reason in self._own.items()]
        others = [f"{who}: {each}" for who, some in self._reported.items() for each in some]
        return own + others
