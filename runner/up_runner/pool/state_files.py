"""What an instance leaves behind, in the object store: its learned files, its flight logs."""

from __future__ import annotations

import hashlib
import json
import secrets
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

from up.config.atomic_writer import write_atomically
from up.log import UpLogger
from up_cluster.errors import RefusedError, UnavailableError, WrongRevisionError
from up_cluster.object_store import ObjectDamagedError
from up_runner.instance_config import FOLDER, PROFILE_NOTE
from up_runner.instance_host import InstanceHost

MAX_STATE_BYTES = 2**20
NOTE = "saved.json"
"""In an instance's folder: revision and digest of what the store and this host had in common."""
STATE_HOME = "state"
"""XDG_STATE_HOME of an instance, in its folder: the black box writes below it."""
FLIGHTS = Path(STATE_HOME, "raspilot", "flights")
_log = UpLogger.get_logger("runner.pool")


class Store(Protocol):
    """What `ObjectStore` and `S3Store` have in common; an object has `size` and `revision`."""

    async def info(self, name: str, /) -> Any:
        """Return what describes an object; None without it."""

    async def get_bytes(self, info: Any, /) -> bytes:
        """Return an object. Raises ObjectDamagedError."""

    async def put_bytes(self, name: str, data: bytes, expected: Any, /) -> Any:
        """Write an object if its revision is `expected`, 0: none. Raises WrongRevisionError."""

    async def put_file(self, name: str, path: Path, /) -> None:
        """Write an object from a file. Raises OSError, too."""


class StateFiles:
    """The files of one aircraft: from the store before a start, into it afterwards.

    `prefix` begins the names of its objects. A note in the instance's folder says what this host
    and the store last had in common. `restore` and `save` raise UnavailableError and RefusedError;
    `restore` OSError.
    """

    def __init__(
        self, store: Store, host: InstanceHost, name: str, prefix: str, learned: Iterable[str]
    ) -> None:
        self._store = store
        self._host = host
        self._folder = host.folder / name
        self._object = f"{prefix}/state"
        self._prefix = prefix
        self._names = {each for name in learned for each in (name, f"{name}.good")}
        self._revision: int | str = 0
        self._digests: set[str] = set()
        """Of what this runner wrote, or tried to."""
        self._stamp: object = None

    async def restore(self) -> None:
        """Write the files of the store into the folder, in place of those that are there.

        Those of this host remain if the store has none, or if they alone have changed since this
        host and the store had the same. They go if the store's are damaged.
        """
        found: dict[str, Any] = {}
        try:
            info = await self._store.info(self._object)
            if info is None:
                return
            self._revision = info.revision
            if await self._host.on_disk(self._is_newer_here):
                text = "{name}: this host has a newer state, which was not saved"
                _log.warn(text, code="state_kept", name=self._object)
                return
            if info.size > MAX_STATE_BYTES:
                raise ObjectDamagedError(self._object, "too_large", info.revision)
            found = _files_in(await self._store.get_bytes(info), self._object, info.revision)
        except ObjectDamagedError as error:
            self._revision = error.revision
            text = "{name} is not restored: {reason}"
            _log.error(text, code="state_damaged", name=self._object, reason=error.code)
        await self._host.on_disk(self._replace, found)

    async def follow(self) -> None:
        """Go on from the revision in the store, for an instance that runs already."""
        info = await self._store.info(self._object)
        self._revision = 0 if info is None else info.revision

    async def save(self, is_holder: Callable[[], bool]) -> None:
        """Write the learned files if they have changed.

        What another host has written meanwhile is replaced only if this one still holds the lease:
        then it came late. Raises WrongRevisionError otherwise.
        """
        stamp, document = await self._host.on_disk(self._collect)
        if document is None:
            self._stamp = stamp
            return
        try:
            revision, digest = await self._put(document)
        except WrongRevisionError:
            # An earlier write without an answer, or that of another host.
            stored = await self._store.info(self._object)
            if stored is None or await self._digest_of(stored) not in self._digests:
                if not is_holder():
                    raise
                text = "{name}: another host has written it without the lease; it is replaced"
                _log.warn(text, code="state_replaced", name=self._object)
            self._revision = 0 if stored is None else stored.revision
            revision, digest = await self._put(document)
        self._revision, self._digests, self._stamp = revision, {digest}, stamp
        await self._host.on_disk(self._write_note, document)
        text = "{name} is saved: {files} files"
        _log.info(text, code="state_saved", name=self._object, files=len(stamp))

    async def save_flights(self) -> None:
        """Move the flight logs into the store; those that cannot be saved stay."""
        folder = self._folder / FLIGHTS
        for path in await self._host.in_thread(lambda: sorted(folder.glob("*.mcap"))):
            name = f"{self._prefix}/flights/{path.name}"
            try:
                await self._store.put_file(name, path)
                await self._host.in_thread(path.unlink)
            except (UnavailableError, RefusedError, OSError) as error:
                text = "{name} is not saved, and stays on this host: {reason}"
                _log.error(text, code="flight_not_saved", name=name, reason=str(error))
                if isinstance(error, OSError):
                    continue  # Of this file alone.
                return
            _log.info("{name} is saved", code="flight_saved", name=name)
        await self._host.in_thread(self._remove_empty)

    async def _put(self, document: dict[str, Any]) -> tuple[int | str, str]:
        """Write a document; return its revision and its digest.

        Its number gives each write another revision where that comes from the content, as in S3.
        """
        data = json.dumps({**document, "write": secrets.token_hex(8)}, indent=1).encode()
        digest = hashlib.sha256(data).hexdigest()
        self._digests.add(digest)
        written = await self._store.put_bytes(self._object, data, self._revision)
        return written.revision, digest

    async def _digest_of(self, info: Any) -> str:
        try:
            return hashlib.sha256(await self._store.get_bytes(info)).hexdigest()
        except ObjectDamagedError:
            return ""

    def _collect(self) -> tuple[list[tuple[str, int, int]], dict[str, Any] | None]:
        """Return what changes with the files, and the document; None: unchanged, or too large."""
        config = self._folder / FOLDER
        stamp, files = [], {}
        for name in sorted(self._names):
            with suppress(FileNotFoundError):
                status = (config / name).stat()
                stamp.append((name, status.st_mtime_ns, status.st_size))
        if stamp == self._stamp:
            return stamp, None
        for name, _, _ in stamp:
            text = _text_of(config / name)
            if text is not None:
                files[name] = text
        profile = _text_of(self._folder / PROFILE_NOTE)
        document = {"profile": "\n" if profile is None else profile, "files": files}
        if len(json.dumps(document, indent=1)) > MAX_STATE_BYTES:
            text = "{name} is not saved: more than {size} bytes"
            _log.error(text, code="state_not_saved", name=self._object, size=MAX_STATE_BYTES)
            return stamp, None
        return stamp, document

    def _is_newer_here(self) -> bool:
        """Return whether only the files of this host differ from what it last had of the store."""
        try:
            note = json.loads((self._folder / NOTE).read_text(encoding="utf-8"))
            revision, digest = note["revision"], note["digest"]
        except (OSError, ValueError, KeyError, TypeError):
            return False
        _, document = self._collect()
        return document is not None and revision == self._revision and digest != _digest(document)

    def _write_note(self, document: dict[str, Any]) -> None:
        note = {"revision": self._revision, "digest": _digest(document)}
        write_atomically(self._folder / NOTE, json.dumps(note).encode())

    def _replace(self, found: dict[str, Any]) -> None:
        config = self._folder / FOLDER
        config.mkdir(mode=0o700, parents=True, exist_ok=True)
        files = found.get("files", {})
        for name in self._names:
            if name in files:
                write_atomically(config / name, files[name].encode())
            else:
                (config / name).unlink(missing_ok=True)
        if found:
            write_atomically(self._folder / PROFILE_NOTE, found["profile"].encode())
            self._write_note(found)

    def _remove_empty(self) -> None:
        for folder in (FLIGHTS, *list(FLIGHTS.parents)[:-1]):
            with suppress(OSError):
                (self._folder / folder).rmdir()


def _text_of(path: Path) -> str | None:
    """Return what is in a file; None without it, or if it is not UTF-8: the log names it then."""
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    except UnicodeDecodeError as error:
        text = "{path} is not saved: {reason}"
        _log.error(text, code="state_file_damaged", path=str(path), reason=str(error))
        return None


def _digest(document: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(document, sort_keys=True).encode()).hexdigest()


def _files_in(data: bytes, name: str, revision: int | str) -> dict[str, Any]:
    """Return a stored document. Raises ObjectDamagedError."""
    try:
        found = json.loads(data)
        files = {str(key): str(text) for key, text in found["files"].items()}
        profile = str(found["profile"])
        for text in (profile, *files.values()):
            text.encode()  # Raises for a text that no file can have.
        return {"profile": profile, "files": files}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise ObjectDamagedError(name, "content", revision) from None
