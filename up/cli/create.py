"""``up create``: writes a working application, module, flight mode, handler or cog."""

import argparse
import sys
from collections.abc import Mapping
from importlib.resources import files as resource_files
from pathlib import Path
from string import Template

from up.builtin_modules import BUILTIN_MODULES
from up.cli.cli_error import CliError
from up.cli.explore import package_at
from up.cli.names import Name, check_identifier
from up.cogs.manifest import MANIFEST_FILE, write_manifest
from up.config import write_template
from up.flight_modes.declarations import MAX_NAME
from up.loading.application import Application
from up.loading.checking import config_files
from up.loading.external_modules import ModuleEntry
from up.output import echo

_APPLICATION = {
    "__init__.py": "application_init",
    "UpFile": "application_upfile",
    "Cogfile.yml": "application_cogfile",
    "main.py": "application_main",
    "README.md": "application_readme",
    "pyproject.toml": "application_pyproject",
    ".gitignore": "gitignore",
    "modules/__init__.py": "application_modules",
    "modules/heartbeat_module.py": "module_started",
    "commands/__init__.py": "application_commands",
    "flight_controller/__init__.py": "application_flight_controller",
    "tests/conftest.py": "application_conftest",
    "tests/test_application.py": "application_test",
    "tests/test_heartbeat_module.py": "module_started_test",
}
_COG = {
    "setup.py": "cog_setup",
    "pyproject.toml": "cog_pyproject",
    "README.md": "cog_readme",
    ".gitignore": "gitignore",
    "$package/__init__.py": "cog_init",
    "$package/registrar.py": "cog_registrar",
    "$package/config.py": "cog_config",
    "$package/modules/__init__.py": "cog_modules",
    "$package/modules/${snake}_module.py": "cog_module",
    "$package/commands/__init__.py": "cog_commands",
    "tests/test_$package.py": "cog_test",
}
_PARTS = {
    "module": ("module", "modules"),
    "flight-mode": ("mode", "flight_modes"),
    "handler": ("command", "commands"),
}
"""The ending of its name, and its folder."""


def may_overwrite(path: Path, yes: bool) -> bool:
    """Prompt the user, as the prototype did: y(es), n(o) or c(ancel).

    Raises CliError without an interactive terminal.
    """
    if yes:
        return True
    if not sys.stdin.isatty():
        raise CliError(
            f"{path} exists already: use --yes to overwrite it", code="exists", path=path
        )
    while True:
        try:
            answer = input(f"{path} exists already. Overwrite it? (y)es, (n)o, (c)ancel: ")
        except EOFError:
            return False
        answer = answer.strip().lower()
        if answer in ("y", "yes"):
            return True
        if answer in ("n", "no", "c", "cancel"):
            return False


def run(values: argparse.Namespace) -> int:
    """Write the requested files; return the exit status."""
    if values.kind == "new":
        return _create_application(values)
    if values.kind == "cog":
        return _create_cog(values)
    return _create_part(values)


def _create_application(values: argparse.Namespace) -> int:
    name = Name.of(values.name)
    name.check_free()
    root = Path.cwd() / name.snake
    if root.exists() and not may_overwrite(root, values.yes):
        return 1
    words = _words(name, package=name.snake)
    # The example module needs a different name.
    example = {**words, **_words(Name(("heartbeat",)), package=name.snake)}
    for target, template in _APPLICATION.items():
        _write(root / target, template, example if "heartbeat" in target else words)
    for file in config_files(BUILTIN_MODULES):
        write_template(file, root / "config")
    echo(f"created {root}", "created", path=root)
    echo(f"next: cd {name.snake}; up check; up start (Ctrl-C stops it)")
    return 0


def _create_cog(values: argparse.Namespace) -> int:
    name = Name.of(values.name, ending="cog")
    package = f"{name.snake}_cog"
    root = Path.cwd() / package
    if root.exists():
        raise CliError(
            f"{root} exists already: choose another name or remove it", code="exists", path=root
        )
    words = _words(name, package=package)
    for target, template in _COG.items():
        _write(root / Template(target).substitute(words), template, words)
    inner = root / package
    (inner / "py.typed").write_text("")
    module = ModuleEntry(f"{name.camel}Module", f"{package}.modules.{name.snake}_module")
    write_manifest(inner / MANIFEST_FILE, [module])
    echo(f"created {root}", "created", path=root)
    echo(f"next: list it in an application's Cogfile.yml ({package}: {{path: ...}}); up gather")
    return 0


def _create_part(values: argparse.Namespace) -> int:
    """Write a module, flight mode or handler, and its test where there is a folder of tests."""
    is_handler = values.kind == "handler"
    ending, folder = _PARTS[values.kind]
    name = Name.of(values.name, ending=ending)
    place = None if values.file else package_at(Path.cwd())
    words = _words(name, package=place.package if place else "")
    template = "flight_mode"
    if is_handler:
        template = "handler"
        words["identifier"] = check_identifier(values.identifier)
    elif values.kind == "module":
        template = f"module_{values.type}"
    file_name = f"{name.snake}_{ending}.py"
    if place is None:
        path = Path(values.file)
    else:
        path = place.root / folder / file_name
        if values.kind == "flight-mode" and not (path.parent / "__init__.py").exists():
            _write(path.parent / "__init__.py", "flight_modes", words)
    if (path.exists() or path.is_symlink()) and not may_overwrite(path, values.yes):
        return 0
    _write(path, template, words)
    echo(f"created {path}", "created", path=path)
    if place is not None:
        _write_test(place, file_name, f"{template}_test", words)
        if not is_handler and (place.root / MANIFEST_FILE).is_file():
            echo(f"next: 'up explore -w' lists it in {MANIFEST_FILE}")
    return 0


def _write_test(
    place: Application, file_name: str, template: str, words: Mapping[str, str]
) -> None:
    for folder in (place.root / "tests", place.root.parent / "tests"):
        path = folder / f"test_{file_name}"
        if folder.is_dir() and not path.exists():
            _write(path, template, words)
            echo(f"created {path}", "created", path=path)
            return


def _write(path: Path, template: str, words: Mapping[str, str]) -> None:
    source = resource_files("up.cli.templates").joinpath(f"{template}.tmpl")
    text = Template(source.read_text(encoding="utf-8")).substitute(words)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _words(name: Name, package: str) -> dict[str, str]:
    return {
        "snake": name.snake,
        "camel": name.camel,
        "constant": name.snake.upper(),
        "mode_name": name.snake.upper()[:MAX_NAME].rstrip("_"),
        "words": name.text,
        "package": package,
        "distribution": f"raspilot-{'-'.join(name.words)}-cog",
        "module_doc": f"The module {name.text[0].lower()}{name.text[1:]}.",
    }
