"""The configuration folder of one instance: a base, then a profile, then a request."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import Any

import yaml

from up.config.atomic_writer import write_atomically
from up.config.keys_file import KEYS
from up.config.loader import read_text
from up.quick_dataclass import dataclass
from up_runner.request import Request, Scalar
from up_runner.response import Problem

FOLDER = "config"
PROFILE_NOTE = "profile"
_NOT_FOR_INSTANCES = frozenset(("runner.yml", "proxy.yml", KEYS.filename))
_HEAD = "# Put together by the runner; edit the base configuration or the profile instead.\n"

Settings = dict[str, Any]


class ConfigurationRefused(ValueError):  # noqa: N818 - it names the outcome
    """A request or a file that is refused."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.problem = Problem(code, text)


@dataclass(frozen=True, slots=True)
class InstanceConfig:
    """The rules for building configuration folders.

    `settable` and `dynamic_ports` map a file to keys: those that a request may set, and those that
    are 0 unless base or profile set a port. `persisted` files are kept while the profile is the
    same. `imposed` maps a file to values of the runner itself, over base and profile. `keys` is the
    runner's keys.yml, which serves instances without one of their own.
    """

    base: Path
    profiles: Path
    settable: Mapping[str, Sequence[str]] = field(default_factory=dict)
    dynamic_ports: Mapping[str, Sequence[str]] = field(default_factory=dict)
    persisted: Sequence[str] = ()
    imposed: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    keys: Path | None = None

    def check(self, request: Request) -> None:
        """Raise ConfigurationRefused for a forbidden key or an unknown profile."""
        for file, settings in request.configuration.items():
            allowed = self.settable.get(file)
            if allowed is None:
                raise ConfigurationRefused(
                    "not_settable", f"a request may not set anything of {file!a}"
                )
            for key in settings:
                if key not in allowed:
                    raise ConfigurationRefused(
                        "not_settable", f"a request may not set {key!a} of {file}"
                    )
        if request.profile is not None and not (self.profiles / request.profile).is_dir():
            raise ConfigurationRefused(
                "unknown_profile", f"this host has no profile {request.profile}"
            )

    def build(self, request: Request, folder: Path) -> Path:
        """Write the configuration for a request into the instance's folder and return its path.

        Raises ConfigurationRefused, and OSError for a failed write.
        """
        self.check(request)
        sources = [self.base]
        if request.profile is not None:
            sources.append(self.profiles / request.profile)
        target = folder / FOLDER
        target.mkdir(mode=0o700, parents=True, exist_ok=True)
        persisted = set(self.persisted) if self._same_profile(request, folder) else set()
        names = {name for source in sources for name in _files(source)}
        names |= set(request.configuration) | set(self.dynamic_ports) | set(self.imposed)
        for name in sorted(names - _NOT_FOR_INSTANCES):
            if name in persisted and (target / name).is_file():
                continue
            write_atomically(target / name, self._content(name, sources, request))
        self._remove_others(target, names, persisted)
        self._link_keys(target, sources)
        write_atomically(folder / PROFILE_NOTE, f"{request.profile or ''}\n".encode())
        return target

    def _content(self, name: str, sources: Sequence[Path], request: Request) -> bytes:
        paths = [source / name for source in sources]
        texts = [(path, text) for path in paths if (text := _read(path)) is not None]
        requested = request.configuration.get(name, {})
        ports = self.dynamic_ports.get(name, ())
        imposed = self.imposed.get(name, {})
        if len(texts) == 1 and not requested and not ports and not imposed:
            return texts[0][1].encode()
        settings: Settings = {}
        for path, text in texts:
            _merge(settings, _parsed(text, path))
        for port in ports:
            if settings.get(port) is None:
                settings[port] = 0
        _merge(settings, imposed)
        for key, value in requested.items():
            settings[key] = _like(settings.get(key), value, f"{key!a} of {name}")
        return (_HEAD + yaml.safe_dump(settings, sort_keys=False)).encode()

    def _link_keys(self, target: Path, sources: Sequence[Path]) -> None:
        """Let the instance read the keys where they are: a revoked key ends there, too."""
        places = [self.keys, *(each / KEYS.filename for each in sources)]
        found = [each.absolute() for each in places if each is not None and each.is_file()]
        link = target / KEYS.filename
        link.unlink(missing_ok=True)
        if found:
            link.symlink_to(found[-1])

    def _same_profile(self, request: Request, folder: Path) -> bool:
        try:
            note = (folder / PROFILE_NOTE).read_text("utf-8")
        except (OSError, UnicodeDecodeError):
            return False
        return note == f"{request.profile or ''}\n"

    def _remove_others(self, target: Path, names: set[str], persisted: set[str]) -> None:
        good = {f"{name}.good" for name in persisted}
        for path in target.iterdir():
            if path.name in names | persisted | good:
                continue
            if path.is_file() or path.is_symlink():
                path.unlink()


def _files(folder: Path) -> list[str]:
    if not folder.is_dir():
        return []
    return [path.name for path in folder.iterdir() if path.suffix == ".yml" and path.is_file()]


def _read(path: Path) -> str | None:
    problems: list[str] = []
    text = read_text(path, lambda line, column, what, *more: problems.append(what))
    if problems:
        raise ConfigurationRefused("bad_file", f"the configuration file {path} {problems[0]}")
    return text


def _parsed(text: str, path: Path) -> Settings:
    try:
        found = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        line = f" in line {mark.line + 1}" if mark else ""
        raise ConfigurationRefused(
            "bad_file", f"the configuration file {path} is not valid YAML{line}"
        ) from None
    if found is None:
        return {}
    if not isinstance(found, dict):
        raise ConfigurationRefused(
            "bad_file", f"the configuration file {path} is not a map of keys"
        )
    return found


def _merge(settings: Settings, over: Mapping[str, Any]) -> None:
    """Merge one file over another, map by map, key by key."""
    for key, value in over.items():
        below = settings.get(key)
        if isinstance(below, dict) and isinstance(value, dict):
            _merge(below, value)
        else:
            settings[key] = value


def _like(present: object, value: Scalar, what: str) -> Scalar:
    """Return the value if it has the same type as the one that it replaces."""
    for kind, noun in ((bool, "true or false"), (int | float, "a number"), (str, "a text")):
        if isinstance(present, kind):
            # Python counts bool as a number; a configuration file does not.
            fits = isinstance(value, kind) and (kind is bool or not isinstance(value, bool))
            if not fits:
                raise ConfigurationRefused("wrong_type", f"{what} must be {noun}")
            return value
    if isinstance(present, dict | list):
        raise ConfigurationRefused("wrong_type", f"{what} cannot be set by a request")
    return value
