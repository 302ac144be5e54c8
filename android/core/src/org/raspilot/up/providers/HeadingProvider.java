package org.raspilot.up.providers;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;

/** Sends the heading of the aircraft's nose by the compass: {@code up.heading.change}. */
public final class HeadingProvider extends SensorProvider<Rotation> {
    public static final String NAME = "heading";

    private static final long SILENCE_MS = 2000;

    private Mounting mounting;
    private double declinationDeg;

    /** Takes the rotation sensor, how it is mounted, and how often a heading leaves at most, ms. */
    public HeadingProvider(SensorSource<Rotation> source, Mounting mounting, int periodMs) {
        super(NAME, source, RatePolicy.stream(periodMs, SILENCE_MS));
        this.mounting = mounting;
    }

    /** Takes another mounting, as after a calibration. */
    public void setMounting(Mounting other) {
        mounting = other;
    }

    /** Takes the angle from magnetic to true north, degrees, east positive. */
    public void setDeclinationDeg(double deg) {
        declinationDeg = deg;
    }

    @Override
    protected BaseCommand read(Rotation rotation) {
        Attitude attitude = mounting.attitude(rotation, declinationDeg);
        return Commands.of(Commands.HEADING,
                "heading", Rounded.direction(attitude.yawDeg), "mode", "actual");
    }
}
