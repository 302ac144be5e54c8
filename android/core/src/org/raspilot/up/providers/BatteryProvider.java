package org.raspilot.up.providers;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;

/** Sends the device's battery level: {@code android.battery}, on change and each ten seconds. */
public final class BatteryProvider extends SensorProvider<BatteryProvider.BatteryLevel> {
    public static final String NAME = "battery";

    private static final long MIN_MS = 1000;
    private static final long REPEAT_MS = 10000;
    private static final long SILENCE_MS = 10000;

    public BatteryProvider(SensorSource<BatteryLevel> source) {
        super(NAME, source, RatePolicy.level(MIN_MS, REPEAT_MS, SILENCE_MS));
    }

    @Override
    protected BaseCommand read(BatteryLevel level) {
        if (!(level.percent >= 0 && level.percent <= 100)) {
            throw new IllegalArgumentException("a level of " + level.percent + " percent");
        }
        return Commands.of(Commands.BATTERY, "level", Math.round(level.percent));
    }

    /** How full the device's battery is. */
    public static final class BatteryLevel {
        /** Percent, 0 to 100. */
        public final double percent;

        /** Stores the value unchanged; {@link BatteryProvider} validates it. */
        public BatteryLevel(double percent) {
            this.percent = percent;
        }
    }
}
