"""The modules included in Up; an application replaces one by extending it."""

from up.base_module import BaseModule
from up.mode_monitor import ModeMonitor
from up.providers.base_rx_provider import UpRXProvider
from up.providers.up_altitude_provider import UpAltitudeProvider
from up.providers.up_heading_provider import UpHeadingProvider
from up.providers.up_location_provider import UpLocationProvider
from up.providers.up_orientation_provider import UpOrientationProvider
from up.telemetry_controller import TelemetryController

BUILTIN_MODULES: tuple[type[BaseModule], ...] = (
    UpAltitudeProvider,
    UpHeadingProvider,
    UpLocationProvider,
    UpOrientationProvider,
    UpRXProvider,
    ModeMonitor,
    TelemetryController,
)
