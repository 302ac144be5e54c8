package org.raspilot.up.providers;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;

/**
 * Sends the altitude by the barometer: {@code up.altitude.change}.
 *
 * <p>It is relative to the reference pressure: above sea level if that is the QNH, above the field
 * after {@link #zeroHere}. It is not smoothed, to avoid delay.
 */
public final class AltitudeProvider extends SensorProvider<AltitudeProvider.Pressure> {
    public static final String NAME = "altitude";
    /** The lowest reference pressure, hPa: a field at 9 km. */
    public static final double MIN_REFERENCE_HPA = 300;
    /** The highest reference pressure, hPa. */
    public static final double MAX_REFERENCE_HPA = 1100;

    private static final long SILENCE_MS = 3000;

    private double referenceHPa = StandardAtmosphere.SEA_LEVEL_HPA;

    /** Takes the barometer, and how often an altitude leaves at most, ms. */
    public AltitudeProvider(SensorSource<Pressure> source, int periodMs) {
        super(NAME, source, RatePolicy.stream(periodMs, SILENCE_MS));
    }

    /**
     * Takes the pressure at altitude zero, hPa.
     *
     * @throws IllegalArgumentException when it is not within 300 to 1100 (a sentence)
     */
    public void setReferenceHPa(double hPa) {
        if (!isReference(hPa)) {
            throw new IllegalArgumentException("the reference pressure is 300 to 1100 hPa, not "
                    + hPa);
        }
        referenceHPa = hPa;
    }

    /**
     * Sets the altitude at the device's position to zero; returns the reference pressure, hPa.
     *
     * @throws IllegalStateException without a reading of the barometer (a sentence)
     */
    public double zeroHere() {
        if (newest() == null) {
            throw new IllegalStateException("the barometer has said nothing yet");
        }
        setReferenceHPa(newest().hPa);
        return referenceHPa;
    }

    public static boolean isReference(double hPa) {
        return hPa >= MIN_REFERENCE_HPA && hPa <= MAX_REFERENCE_HPA;
    }

    @Override
    protected BaseCommand read(Pressure pressure) {
        if (!(pressure.hPa > 0)) {
            throw new IllegalArgumentException("a pressure of " + pressure.hPa + " hPa");
        }
        double altitudeM = StandardAtmosphere.altitudeM(pressure.hPa, referenceHPa);
        return Commands.of(Commands.ALTITUDE, "altitude", Rounded.to(2, altitudeM));
    }

    /** The air pressure at the device, by its barometer. */
    public static final class Pressure {
        public final double hPa;

        /** Stores the value unchanged; {@link AltitudeProvider} validates it. */
        public Pressure(double hPa) {
            this.hPa = hPa;
        }
    }
}
