package org.raspilot.up.providers;

/** How full the device's battery is. */
public final class BatteryLevel {
    private final double percent;

    /** Stores the value unchanged; {@link BatteryProvider} validates it. */
    public BatteryLevel(double percent) {
        this.percent = percent;
    }

    /** Returns percent, 0 to 100. */
    public double percent() {
        return percent;
    }
}
