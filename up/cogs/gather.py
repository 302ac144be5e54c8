"""``up gather``: installs and registers the cogs of the Cogfile (thesis 4.3.2)."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence

from up.cogs import pip
from up.cogs.cog import CogError, Echo, echo
from up.cogs.cogfile import COGFILE, WantedCog, load_cogfile
from up.cogs.installed import is_installed
from up.cogs.registration import register, unregister
from up.cogs.registry import Registry
from up.config import ConfigErrors
from up.loading.application import Application


def gather(application: Application, *, may_install: bool = True, echo: Echo = echo) -> None:
    """Install missing cogs, register all, unregister those that left the Cogfile.

    Raises CogError with one sentence per problem, ConfigErrors for errors in the Cogfile or the
    generated list.
    """
    wanted = load_cogfile(application.root)
    registry = Registry(application.root)
    left = [
        cog
        for cog, entry in registry.entries().items()
        if entry.source == "cogfile" and cog not in {each.cog for each in wanted}
    ]
    for cog in sorted(left):
        echo(f"{cog}: has left {COGFILE}")
        unregister(cog, application, echo)
    missing = [each for each in wanted if not is_installed(each)]
    if missing and may_install:
        _install(missing, wanted, echo)
        _register_anew(application)
        return
    if missing:
        names = ", ".join(each.cog for each in missing)
        raise CogError(f"not installed, but listed in {COGFILE}: {names}", code="not_installed")
    _register_all(wanted, application, echo)


def _install(missing: Sequence[WantedCog], wanted: Sequence[WantedCog], echo: Echo) -> None:
    for each in missing:
        echo(f"{each.cog}: to be installed from {_origin(each)}")
    pip.install(missing, [each for each in wanted if each.folder is not None], echo)
    echo(f"installed {len(missing)} {'cog' if len(missing) == 1 else 'cogs'}")


def _register_anew(application: Application) -> None:
    """Register in a new interpreter: this one does not see newly installed packages."""
    # -P: a cog's outer folder in the current directory would hide the package inside it.
    command = [sys.executable, "-P", "-m", "up.cli", "--file", str(application.root)]
    done = subprocess.run([*command, "gather", "--no-install"], check=False)
    if done.returncode != 0:
        raise CogError(
            "the cogs are installed but not all of them are registered", code="registration_failed"
        )


def _register_all(wanted: Sequence[WantedCog], application: Application, echo: Echo) -> None:
    failed: list[str] = []
    for each in wanted:
        try:
            register(each.cog, application, "cogfile", echo)
        except (CogError, ConfigErrors) as error:
            failed.append(str(error))
    if failed:
        raise CogError("\n".join(failed), code="registration_failed")
    count = len(wanted)
    echo(f"{count} {'cog' if count == 1 else 'cogs'} of {COGFILE} installed and registered")


def _origin(wanted: WantedCog) -> str:
    if wanted.folder is not None:
        return str(wanted.folder)
    if wanted.spec.url:
        return wanted.spec.url
    return f"the package index ({wanted.spec.pypi} {wanted.spec.version or 'newest'})"
