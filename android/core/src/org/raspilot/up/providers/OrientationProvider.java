package org.raspilot.up.providers;

import java.util.Locale;
import org.raspilot.up.wire.OrientationFrame;

/**
 * Sends the aircraft's attitude and rates as Orientation Forward frames (protocols 3).
 *
 * <p>The rates are the gyroscope's; without one, or while it is silent, they are those by which the
 * attitude changes.
 */
public final class OrientationProvider extends UpProvider {
    public static final String NAME = "orientation";
    /** The lowest rate, Hz. */
    public static final int MIN_HZ = 50;
    /** The highest rate, Hz. */
    public static final int MAX_HZ = 200;

    private static final long SILENCE_MS = 500;
    private static final long MAX_RATE_AGE_MS = 100;
    /** Times are in ms: over shorter intervals the differences would be noise. */
    private static final long MIN_DIFFERENCE_MS = 20;

    private final SensorSource<Rotation> rotations;
    private final SensorSource<RotationRate> gyroscope;
    private Mounting mounting;
    private double declinationDeg;
    private Rotation newest;
    private Rotation earlier;
    private RotationRate difference = new RotationRate(0, 0, 0, 0);
    private RotationRate measured;
    private OrientationFrame last;

    /** Takes both sensors, the mounting, and how often a frame leaves, 50 to 200 Hz. */
    public OrientationProvider(SensorSource<Rotation> rotations,
            SensorSource<RotationRate> gyroscope, Mounting mounting, int rateHz) {
        super(NAME, RatePolicy.stream(1000.0 / rateHz, SILENCE_MS));
        this.rotations = rotations;
        this.gyroscope = gyroscope;
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
    protected boolean isPresent() {
        return rotations.isPresent();
    }

    @Override
    protected String sensorName() {
        return rotations.name() + " and "
                + (gyroscope.isPresent() ? gyroscope.name() : "no gyroscope");
    }

    @Override
    protected boolean isOpen(MessageSink to) {
        return to.isOrientationOpen();
    }

    @Override
    protected void subscribe(long periodMs) {
        newest = null;
        earlier = null;
        measured = null;
        if (gyroscope.isPresent()) {
            gyroscope.subscribe(periodMs, reading -> measured = reading);
        }
        rotations.subscribe(periodMs, reading -> update(reading));
    }

    @Override
    protected void unsubscribe() {
        rotations.unsubscribe();
        if (gyroscope.isPresent()) {
            gyroscope.unsubscribe();
        }
    }

    @Override
    protected boolean transmit(MessageSink to) {
        Attitude attitude = mounting.attitude(newest, declinationDeg);
        double[] rates = mounting.ratesDegS(isMeasured() ? measured : difference);
        OrientationFrame frame = new OrientationFrame(
                (float) attitude.rollDeg, (float) attitude.pitchDeg, (float) attitude.yawDeg,
                (float) rates[0], (float) rates[1], (float) rates[2]);
        if (!frame.isInRange()) {
            reject("its reading cannot be used: a rate is not a number, or above 4000 deg/s");
            return false;
        }
        boolean isTaken = to.sendOrientation(frame);
        if (isTaken) {
            last = frame;
        }
        return isTaken;
    }

    @Override
    protected String lastText() {
        return last == null ? "" : String.format(Locale.ROOT, "roll %.1f, pitch %.1f, yaw %.1f",
                last.rollDeg, last.pitchDeg, last.yawDeg);
    }

    private void update(Rotation reading) {
        newest = reading;
        if (earlier == null) {
            earlier = reading;
        } else if (reading.timeMs - earlier.timeMs >= MIN_DIFFERENCE_MS) {
            difference = RotationRate.between(earlier, reading);
            earlier = reading;
        }
        offer(true);
    }

    /** Both times are the sensors' own: a gyroscope that fell behind is not believed. */
    private boolean isMeasured() {
        return measured != null && newest.timeMs - measured.timeMs <= MAX_RATE_AGE_MS;
    }
}
