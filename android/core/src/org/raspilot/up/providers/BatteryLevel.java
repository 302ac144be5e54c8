package org.raspilot.up.providers;

/** How full the device's battery is. */
public final class BatteryLevel {
    /** Percent, 0 to 100. */
    public final double percent;

    /** Stores the value unchanged; {@link BatteryProvider} validates it. */
    public BatteryLevel(double percent) {
        this.percent = percent;
    }
}
