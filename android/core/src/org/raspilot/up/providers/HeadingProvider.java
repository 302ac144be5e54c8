package org.raspilot.up.providers;

/** Sends what the Heading sensor reads. */
public final class HeadingProvider extends UpProvider {
    /** The name under which it is registered. */
    public static final String NAME = "heading";

    /** Takes the sensor. */
    public HeadingProvider(SensorSource<Rotation> source) {
        super(NAME);
    }
}
