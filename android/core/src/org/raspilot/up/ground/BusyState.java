package org.raspilot.up.ground;

import java.util.Locale;

/** States in words that the Raspberry Pi is busy; all are equal, so that it is one event. */
public final class BusyState {
    private final String words;

    private BusyState(String words) {
        this.words = words;
    }

    /** Returns a Busy, false while it is not busy, null if unknown. */
    static Object of(Telemetry telemetry) {
        final Boolean isBusy = telemetry.flag("load.panic");
        return Boolean.TRUE.equals(isBusy) ? new BusyState(words(telemetry)) : isBusy;
    }

    /** Returns the load and the period of telemetry while the Raspberry Pi is busy. */
    public static String words(Telemetry telemetry) {
        final Double percent = telemetry.number("load.cpu");
        final Double periodMs = telemetry.number("system.period_ms");
        final Double delayMs = periodMs == null ? telemetry.number("load.delay_ms") : periodMs;
        return "Raspberry Pi busy"
                + (percent == null ? "" : String.format(Locale.ROOT, " (%.0f %%)", percent))
                + (delayMs == null ? ""
                        : String.format(Locale.ROOT, ": telemetry every %.0f ms", delayMs));
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof BusyState;
    }

    @Override
    public int hashCode() {
        return 1;
    }

    @Override
    public String toString() {
        return words;
    }
}
