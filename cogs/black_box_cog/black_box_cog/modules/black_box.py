"""Records the flight: all Commands on the bus, and the program's log."""

from __future__ import annotations

import gc
import importlib
import sys
import time
from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from black_box_cog.commands.black_box_commands import MarkCommand, RecordCommand
from black_box_cog.config import BLACK_BOX
from black_box_cog.ingest_queue import IngestQueue, LogForwarder, RecorderStatus
from black_box_cog.record_policy import RecordPolicy
from up.base_thread_module import BaseThreadModule
from up.cleanup import add_cleanup
from up.commands.refusal import CommandRefusedError
from up.commands.telemetry_commands import TelemetryCommand

if TYPE_CHECKING:
    from black_box_cog.recorder import Recorder

SOURCE_S = 10.0
"""The recorder wants telemetry for this long after data of the Arduino or the phone."""
INITIAL_DELAY_S = 1.0
PAUSE_S = 0.005
DEFERRED_IMPORTS = (
    "up.flight_log.flight_file",
    "black_box_cog.flight_folder",
    "black_box_cog.flight_metadata",
    "up.commands.telemetry_schema",
    "up.flight_log.command_schema",
    "up.flight_log.mcap_format",
    "up.flight_log.compression",
    "up.flight_log.mcap_writer",
    "black_box_cog.timeline",
    "black_box_cog.log_segment",
    "black_box_cog.segment_factory",
    "black_box_cog.disk_error_state",
    "black_box_cog.recorder",
    "black_box_cog.recorder_maker",
)
"""Imports for the recorder's thread only, in order: the start does not wait for them."""


class BlackBox(BaseThreadModule):
    """Observes the bus; its thread writes. The reactor's thread only appends to a queue."""

    CONFIG = BLACK_BOX
    # First to start and last to stop, to record the other modules' start and stop.
    LOAD_ORDER = -sys.maxsize
    SHED_ORDER = 20

    recorder: Recorder | None = None

    def load(self) -> bool:
        enabled: bool = self.config.enabled
        return enabled

    @property
    def status(self) -> RecorderStatus:
        return RecorderStatus() if self.recorder is None else self.recorder.status

    @property
    def wants_telemetry(self) -> bool:
        """Return whether a flight is recorded and the Arduino or the phone sent data recently."""
        return (
            self.config.telemetry
            and self.recorder is not None
            and self.recorder.status.recording
            and time.perf_counter() - self.recorder.last_source_s < SOURCE_S
        )

    @property
    def telemetry_content(self) -> Mapping[str, Any]:
        return {"black_box": asdict(self.status)}

    def on_init(self) -> None:
        self.queue = IngestQueue(self.config.waiting_messages)
        self._log_forwarder = LogForwarder(self.queue.put)
        executor = self.up.command_executor
        self._policy = RecordPolicy(executor.registry, self.context.reactor)
        executor.register_command(TelemetryCommand, self._on_telemetry)
        executor.register_command(MarkCommand, self._on_mark)
        executor.register_command(RecordCommand, self._on_record)

    def on_start(self) -> bool:
        self.up.command_executor.add_observer(self.queue.observe)
        self._log_forwarder.start()
        add_cleanup(self._log_forwarder.stop)
        return True

    def on_stop(self) -> None:
        self._log_forwarder.stop()

    def _loop(self) -> None:
        assert self.recorder is not None
        self.recorder.work()
        self.stop_event.wait(self.recorder.round_s)

    def _run(self) -> None:
        self.stop_event.wait(INITIAL_DELAY_S)
        try:
            self.recorder = self._make_recorder()
            super()._run()
            self.recorder.finish()
        except Exception:  # noqa: BLE001 - without this the thread would end silently
            self.faults += 1
            self.log.failure(
                "{name} stopped recording", name=self.class_name, code="recorder_failed"
            )

    def _make_recorder(self) -> Recorder:
        """Return the recorder, importing its code in pieces: all in one would delay control."""
        for name in DEFERRED_IMPORTS:
            importlib.import_module(name)
            self.stop_event.wait(PAUSE_S)
        if not gc.isenabled():
            # As for objects of the start: no collection needs to visit it again.
            gc.freeze()
        from black_box_cog.recorder_maker import make_recorder

        up, context = self.up, self.context
        return make_recorder(self.queue, self.config, up, context, self.stop_event.is_set)

    def _on_telemetry(self, command: TelemetryCommand) -> None:
        """Do nothing: the observer records it; a subscriber can say whether frames are wanted."""

    def _on_mark(self, command: MarkCommand) -> None:
        self._refuse_without_file()
        self._policy.check_mark()
        self.log.info("mark: {text}", text=command.text, code="mark")

    def _on_record(self, command: RecordCommand) -> None:
        self._refuse_without_file()
        self.queue.put(self._policy.checked(command), self.up.command_executor.origin)

    def _refuse_without_file(self) -> None:
        problem = self.status.problem
        if problem is not None:
            raise CommandRefusedError(f"the flight is not recorded: {problem}")
