"""Creates the recorder on its own thread, and prepares its data in advance."""

import contextlib
from collections.abc import Callable, Iterator
from typing import Any

from black_box_cog.config import MEGABYTE, BlackBoxConfig
from black_box_cog.disk import Disk
from black_box_cog.flight_folder import FlightFolder
from black_box_cog.flight_metadata import FlightMetadata
from black_box_cog.ingest_queue import IngestQueue
from black_box_cog.log_segment import form_of
from black_box_cog.recorder import Recorder
from up.commands.command_registry import CommandRegistry
from up.flight_log.flights_folder import folder_of


def make_recorder(
    queue: IngestQueue,
    config: BlackBoxConfig,
    up: Any,
    context: Any,
    is_over: Callable[[], bool],
) -> Recorder:
    """Return a prepared recorder, unless the program ends in the meantime."""
    disk = Disk()
    total, keep_free = config.total_size_mb * MEGABYTE, config.keep_free_mb * MEGABYTE
    folder = FlightFolder(disk, folder_of(config.folder), total, keep_free)
    metadata = _metadata(up, context)
    recorder = Recorder(queue, config, folder, metadata, disk)
    recorder.prepare(_preparations(metadata, up.command_executor.registry, is_over))
    return recorder


def _preparations(
    metadata: FlightMetadata, registry: CommandRegistry, is_over: Callable[[], bool]
) -> Iterator[None]:
    """Yield after each piece of the preparation that a flight's start would need."""
    yield from metadata.prepare()
    for cls in registry:
        if is_over():
            return
        # An invalid class is left out when its first Command arrives, and reported then.
        with contextlib.suppress(Exception):
            form_of(cls)
        yield


def _metadata(up: Any, context: Any) -> FlightMetadata:
    modules = {type(module).__module__.partition(".")[0] for module in up.modules}
    return FlightMetadata(
        _aircraft(up, context),
        {
            "instance": context.instance,
            "mode": context.mode.value,
            "flight_controller": context.application.flight_controller,
        },
        tuple(sorted(modules)),
        context.config_folder,
    )


def _aircraft(up: Any, context: Any) -> str:
    provider = up.mission_control_provider
    config = None if provider is None or provider.CONFIG is None else provider.config
    return getattr(config, "aircraft", "") or context.instance or "default"
