"""``up gather``: installs and registers the cogs of the Cogfile (thesis 4.3.2)."""

import subprocess
import sys
from collections.abc import Sequence

from up.cogs import pip
from up.cogs.cog import CogError
from up.cogs.cogfile import COGFILE, WantedCog, load_cogfile
from up.cogs.installed import is_installed
from up.cogs.registration import register, unregister
from up.cogs.registry import Registry
from up.errors import UserError
from up.loading.application import Application
from up.output import echo


def gather(application: Application, *, may_install: bool = True) -> None:
    """Install missing cogs, register all, unregister those that left the Cogfile.

    Raises UserError with one sentence per problem, ConfigErrors for errors in the Cogfile or the
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
        echo(f"{cog}: has left {COGFILE}", "cog_removed", cog=cog)
        unregister(cog, application)
    missing = [each for each in wanted if not is_installed(each)]
    if missing and may_install:
        _install(missing, wanted)
        _register_anew(application)
        return
    if missing:
        names = [each.cog for each in missing]
        text = f"not installed, but listed in {COGFILE}: {', '.join(names)}"
        raise CogError(text, "not_installed", cogs=names)
    _register_all(wanted, application)


def _install(missing: Sequence[WantedCog], wanted: Sequence[WantedCog]) -> None:
    for each in missing:
        origin = _origin(each)
        echo(
            f"{each.cog}: to be installed from {origin}", "installing", cog=each.cog, origin=origin
        )
    pip.install(missing, [each for each in wanted if each.folder is not None])
    count = len(missing)
    echo(f"installed {count} {'cog' if count == 1 else 'cogs'}", "installed", count=count)


def _register_anew(application: Application) -> None:
    """Register in a new interpreter: this one does not see newly installed packages."""
    # -P: a cog's outer folder in the current directory would hide the package inside it.
    command = [sys.executable, "-P", "-m", "up.cli", "--file", str(application.root)]
    done = subprocess.run([*command, "gather", "--no-install"], check=False)
    if done.returncode != 0:
        raise CogError(
            "the cogs are installed but not all of them are registered", code="registration_failed"
        )


def _register_all(wanted: Sequence[WantedCog], application: Application) -> None:
    failed: list[UserError] = []
    for each in wanted:
        try:
            register(each.cog, application, "cogfile")
        except UserError as error:
            failed.append(error)
    if failed:
        raise UserError.group(failed)
    count = len(wanted)
    text = f"{count} {'cog' if count == 1 else 'cogs'} of {COGFILE} installed and registered"
    echo(text, "gathered", count=count)


def _origin(wanted: WantedCog) -> str:
    if wanted.folder is not None:
        return str(wanted.folder)
    if wanted.spec.url:
        return wanted.spec.url
    return f"the package index ({wanted.spec.pypi} {wanted.spec.version or 'newest'})"
