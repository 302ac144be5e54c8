package org.raspilot.up.airborne;

import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.Nose;
import org.raspilot.up.providers.ProvidersController;
import org.raspilot.up.providers.Sensors;

/** The airborne phone: finds the Raspberry Pi, sends its sensors, answers its Commands. */
public final class Airborne {
    /** Takes its surroundings; nothing begins before {@link #start}. */
    public Airborne(
            Loop loop,
            AirborneSettings settings,
            Sensors sensors,
            Speaker speaker,
            AirborneListener listener) {}

    /** Begins; on the loop. */
    public void start() {}

    /** Ends everything; on the loop. */
    public void stop() {}

    /** Returns what the screen shows; on the loop. */
    public AirborneStatus status() {
        return null;
    }

    /** Returns the providers: register yours here. */
    public ProvidersController providers() {
        return null;
    }

    /** Takes another mounting at once, as after a calibration. */
    public void setMounting(Mounting mounting) {}

    /**
     * Returns the mounting by which the phone lies level now, and keeps to it.
     *
     * @throws IllegalStateException without a rotation sensor or a reading of it (a sentence)
     * @throws IllegalArgumentException when that side points up or down (a sentence)
     */
    public Mounting calibrate(Nose nose) {
        return null;
    }

    /** Takes the angle from magnetic to true north, degrees, east positive. */
    public void setDeclinationDeg(double declinationDeg) {}

    /** Takes the pressure at altitude zero, hPa (QNH). */
    public void setReferencePressureHPa(double hPa) {}

    /** Lets the altitude be zero where the phone is now; returns the reference pressure, hPa. */
    public double zeroAltitudeHere() {
        return 0;
    }

    /** Tries at once instead of after the wait, as when the phone's network came back. */
    public void networkChanged() {}
}
