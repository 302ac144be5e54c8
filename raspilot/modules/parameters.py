"""The keys of flight modes, failsafes and navigation, read and set by a ground."""

import re
from pathlib import Path
from typing import Any

from twisted.internet.defer import Deferred
from twisted.python.failure import Failure

from up.base_module import BaseModule
from up.commands.flight_state_command import FlightStateCommand
from up.commands.parameter_commands import (
    ParameterRequestCommand,
    ParameterSetCommand,
    ParameterValuesCommand,
)
from up.commands.refusal import Code, CommandRefusedError
from up.config import ConfigErrors, ConfigFile
from up.config.atomic_writer import write_atomically
from up.config.edit import leaves, value_of, with_value
from up.config.loader import read_text
from up.config.nodes import ScalarNode
from up.config.problems import Problems
from up.config.scalars import read_scalar
from up.config.schema import plain_value
from up.fields import ConstraintError, suggestion
from up.mode import WITH_BOARD
from up.needs import wants
from up.providers.base_mission_control_provider import BaseMissionControlProvider
from up.system.disk_thread import DiskThread

VETO = "parameters"
_WORD = re.compile(r"[\w.+-]+", re.ASCII)
Keys = dict[str, Any]


class Parameters(BaseModule):
    """Writes a key into its file, as a person would; modules read their files at the next start.

    Only the files of loaded modules with ``IS_SET_BY_GROUND``: permissions, keys and ports are not
    a ground's. The file is checked as a whole, as at a start, before it is replaced, and only this
    key may differ. A flight that a restart of the program resumes must not change its rules:
    nothing is written while the aircraft is armed or may be in flight, and with a value that does
    not act yet nothing arms.
    """

    MODES = WITH_BOARD
    LOAD_ORDER = 300

    mission_control = wants(BaseMissionControlProvider)

    def on_init(self) -> None:
        modules = self.up.get_modules(BaseModule)
        files = {each.CONFIG for each in modules if each.IS_SET_BY_GROUND and each.CONFIG}
        named = {file.filename: file for file in files if not file.is_secret}
        self._files = dict(sorted(named.items()))
        self._keys = {name: leaves(file.schema) for name, file in self._files.items()}
        config = self.context.config
        self._used = {name: self._values(file, config(file)) for name, file in self._files.items()}
        self._disk = DiskThread(self.context.reactor)
        self._pending: dict[str, Keys] = {}
        self._writing = 0
        self._state: FlightStateCommand | None = None
        executor = self.up.command_executor
        executor.register_command(FlightStateCommand, self._on_flight_state)
        executor.register_command(ParameterRequestCommand, self._on_request)
        executor.register_command(ParameterSetCommand, self._on_set)

    def _on_flight_state(self, command: FlightStateCommand) -> None:
        self._state = command

    def _on_request(self, command: ParameterRequestCommand) -> None:
        names = list(self._files) if not command.file else [self._file(command.file).filename]
        for name in names:
            message = ParameterValuesCommand(name, self._used[name], self._pending.get(name, {}))
            if self.mission_control is None or not self.mission_control.send_command(message):
                raise CommandRefusedError("no ground station is connected", Code.UNAVAILABLE)

    def _on_set(self, command: ParameterSetCommand) -> Deferred[None]:
        file = self._file(command.file)
        path = tuple(command.key.split("."))
        if path not in self._keys[file.filename]:
            near = suggestion(command.key, [".".join(each) for each in self._keys[file.filename]])
            text = f"{file.filename} has no key {command.key!r}{near}"
            raise CommandRefusedError(text, Code.INVALID, detail="parameter_unknown")
        if not _WORD.fullmatch(command.setting):
            text = "the value must be a number or a word"
            raise CommandRefusedError(text, Code.INVALID, detail="bad_format")
        state = self._state
        if state is None or state.is_armed or state.is_in_flight is not False:
            text = "no parameter is set while the aircraft is armed or may be in flight"
            if state is None:
                text += ": its board has not reported yet"
            raise CommandRefusedError(text, detail="in_flight")
        constraint = self._keys[file.filename][path]
        try:
            wanted = read_scalar(ScalarNode(1, 1, command.setting, True), constraint)
        except ConstraintError as error:
            text = f"{file.filename}: {command.key} {error}"
            raise CommandRefusedError(text, Code.INVALID, detail=error.code) from None
        # The motor must not be armed in the meantime.
        self._writing += 1
        self.up.vetoes.set(VETO, f"{file.filename} is being written")
        done = self._disk.run(lambda: self._write(file, path, command.setting, wanted))
        return done.addCallbacks(
            lambda values: self._on_written(file, command, values), self._on_failed
        )

    def _file(self, name: str) -> ConfigFile[Any]:
        if name not in self._files:
            text = f"no file {name!r} that a ground may set{suggestion(name, self._files)}"
            raise CommandRefusedError(text, Code.INVALID, detail="parameter_unknown")
        return self._files[name]

    def _values(self, file: ConfigFile[Any], values: Any) -> Keys:
        keys = self._keys[file.filename]
        return {".".join(path): value_of(file.schema, values, path) for path in keys}

    def _write(
        self, file: ConfigFile[Any], path: tuple[str, ...], setting: str, wanted: object
    ) -> Keys:
        """Change the file and return what it says now; on the disk's thread."""
        place = (Path(self.context.config_folder) / file.filename).resolve()
        problems = Problems(place)
        before = read_text(place, problems.report) or ""
        problems.raise_if_any()
        after = with_value(before, path, setting)
        expected = section = plain_value(file.schema, file.parse(before, place))
        for name in path[:-1]:
            section = section[name] or {}
        section[path[-1]] = wanted
        values = file.parse(after, place)
        if plain_value(file.schema, values) != expected:
            text = f"{file.filename}: its form is not one that the program can edit"
            raise CommandRefusedError(text, Code.NOT_SUPPORTED, detail="parameter_not_saved")
        if after != before:
            mode = place.stat().st_mode & 0o777 if place.exists() else 0o666
            write_atomically(place, after.encode(), mode)
        return self._values(file, values)

    def _on_written(
        self, file: ConfigFile[Any], command: ParameterSetCommand, values: Keys
    ) -> None:
        used = self._used[file.filename]
        pending = {key: each for key, each in values.items() if each != used[key]}
        self._pending[file.filename] = pending
        self.log.info(
            "{file}: {key}: {value} acts at the next start", file=file.filename, key=command.key,
            value=command.setting, code="parameter_set",
        )  # fmt: skip
        self._update_veto()

    def _update_veto(self) -> None:
        """After a write, when no other one is waiting: a disk may take a second."""
        self._writing -= 1
        if self._writing:
            return
        names = [f"{name}: {key}" for name, keys in self._pending.items() for key in keys]
        if names:
            self.up.vetoes.set(VETO, f"a restart is needed for {', '.join(names)}")
        else:
            self.up.vetoes.clear(VETO)

    def _on_failed(self, failure: Failure) -> None:
        self._update_veto()
        failure.trap(ConfigErrors, OSError)
        error = failure.value
        if isinstance(error, ConfigErrors):
            first = error.problems[0]
            raise CommandRefusedError(str(first), Code.INVALID, detail=first.code)
        text = f"the file cannot be written: {getattr(error, 'strerror', None) or error}"
        raise CommandRefusedError(text, Code.FAILED, detail="parameter_not_saved")
