package org.raspilot.app.view;

/** Positions of servo and stick pulses, from microseconds (docs/protocols.md, 6). */
public final class BarsGeometry {
    private static final float MIDDLE_US = 1500;
    private static final float HALF_US = 500;
    private static final float MAX_SHARE = 1.1f;

    private BarsGeometry() {
    }

    /** Returns -1 at 1000 us, 0 at 1500 us, 1 at 2000 us, and never beyond 1.1. */
    public static float share(double pulseUs) {
        return Math.max(-MAX_SHARE, Math.min(MAX_SHARE, (float) (pulseUs - MIDDLE_US) / HALF_US));
    }

    /** Returns whether a pulse lies outside the scale of 1000 to 2000 us. */
    public static boolean isBeyond(double pulseUs) {
        return Math.abs(pulseUs - MIDDLE_US) > HALF_US;
    }
}
