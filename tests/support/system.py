"""Builds a system from a few modules, as the loader would, for tests."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from up.base_module import BaseModule
from up.builtin_modules import BUILTIN_MODULES
from up.context import Context
from up.life_cycle import LifeCycle
from up.loading.discovery import Discovered
from up.loading.order import order
from up.loading.plan import Plan
from up.loading.selection import select
from up.mode import Mode
from up.up import Up


def build_up(
    modules: Sequence[type[BaseModule]],
    reactor: Any,
    folder: Path,
    *,
    mode: Mode = Mode.AUTO,
    config: Mapping[str, str] | None = None,
    builtins: bool = True,
    instance: str = "",
) -> Up:
    """Return an initialized Up of these classes and, by default, the built-in ones."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in (config or {}).items():
        (folder / name).write_text(text, encoding="utf-8")
    if not hasattr(reactor, "callFromThread"):
        reactor.callFromThread = lambda call, *args: reactor.callLater(0, call, *args)
        # A Clock is not thread-safe: work with the disk is done immediately.
        reactor.start_thread = lambda work: work()
    context = Context(reactor, mode, folder, instance=instance)
    found = Discovered()
    for cls in modules:
        found.add(cls, "test")
    chosen = select(found, BUILTIN_MODULES if builtins else (), context, ())
    assert not chosen.problems, chosen.problems
    up = Up(Plan(modules=order(chosen.modules)), context)
    up.initialize()
    return up


async def started(up: Up) -> LifeCycle:
    """Start a system and return what stops it."""
    life = LifeCycle(up)
    await life.start()
    return life
