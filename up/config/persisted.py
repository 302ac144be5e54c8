"""Values that the program itself learns and saves, such as gains tuned in flight."""

import contextlib
from pathlib import Path
from typing import Generic, TypeVar, cast

from up.config.atomic_writer import write_atomically
from up.config.file import ConfigFile
from up.config.loader import read_text
from up.config.problems import ConfigErrors, Problems
from up.errors import UserError

T = TypeVar("T")
_HEAD = "# Written by the program; a file that lacks its last line, '# end', is not used.\n\n"
_END = "# end"


class PersistedFile(Generic[T]):
    """A file of learned values; the first save also writes a good copy, `<name>.good`.

    A set is valid only as a whole: a map with a missing value, or a missing end mark, makes the
    file corrupt. People may edit the file; a file from elsewhere needs no end mark.
    """

    def __init__(self, path: Path, config_file: ConfigFile[T]) -> None:
        self.path = Path(path)
        self.good_path = self.path.with_name(self.path.name + ".good")
        self._file = config_file

    def load(self) -> tuple[T, UserError | None]:
        """Return the values and None, or the best available values and the reason.

        For a corrupt or lost file this is the last good copy, otherwise the defaults: the field
        ``used`` of the reason is ``good_copy`` or ``defaults``. Never raises. If neither file
        exists, nothing was ever learned: returns the defaults and no reason.
        """
        values, problem = self._read(self.path)
        if values is not None:
            self._keep_good(values)
            return values, None
        good, good_problem = self._read(self.good_path)
        if good is not None:
            reason = problem or UserError(f"{self.path}: is gone", "file_missing")
            used = f"the last good copy {self.good_path.name} is used"
            return good, _instead(reason, used, "good_copy")
        if problem is None and good_problem is None:
            return self._file.cls(), None
        reason = cast(UserError, problem or good_problem)
        return self._file.cls(), _instead(reason, "the defaults are used", "defaults")

    def save(self, values: T) -> None:
        """Write the values and their good copy, each atomically.

        Raises ValueError, before any file is changed, for values that could not be read back, and
        OSError for a failed write; the previously saved values then remain.
        """
        data = self._render(values)
        try:
            self._file.parse(data, self.path, whole=True)
        except ConfigErrors as errors:
            raise ValueError(str(errors)) from None
        self.path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(self.path, data)
        write_atomically(self.good_path, data)

    def _read(self, path: Path) -> tuple[T | None, UserError | None]:
        problems = Problems(path)
        try:
            text = read_text(path, problems.report)
            problems.raise_if_any()
            if text is None:
                return None, None
            if text.startswith(_HEAD) and not text.rstrip().endswith(_END):
                problems.report(text.count("\n") + 1, 1, "is cut short", "cut_short")
                problems.raise_if_any()
            return self._file.parse(text, path, whole=True), None
        except ConfigErrors as errors:
            first, *more = errors.problems
            rest = f" (and {len(more)} more)" if more else ""
            return None, UserError(f"{first}{rest}", first.code, **first.fields)

    def _keep_good(self, values: T) -> None:
        """Update the good copy of a saved set with later edits by people."""
        if self.good_path.exists() and self._read(self.good_path)[0] != values:
            with contextlib.suppress(OSError):
                write_atomically(self.good_path, self._render(values))

    def _render(self, values: T) -> bytes:
        return f"{_HEAD}{self._file.render(values)}\n{_END}\n".encode()


def _instead(reason: UserError, text: str, used: str) -> UserError:
    return UserError(f"{reason}; {text}", reason.code, **{**reason.fields, "used": used})
