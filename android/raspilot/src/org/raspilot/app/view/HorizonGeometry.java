package org.raspilot.app.view;

/**
 * Positions of the parts of an artificial horizon, in pixels around the middle of the picture.
 *
 * <p>Right wing down turns the ball to the left, nose up moves it down (thesis 4.5.3; angles as in
 * docs/protocols.md: degrees, roll positive right wing down, pitch positive nose up). Nothing is
 * allocated after construction.
 */
public final class HorizonGeometry {
    /** Pitch of each rung of the ladder, degrees; the horizon itself is not a rung. */
    private static final float[] RUNGS_DEG = rungs();
    private static final float[] ROLL_MARKS_DEG = {
        -60, -45, -30, -20, -10, 10, 20, 30, 45, 60
    };
    /** How many degrees of pitch fit between the middle and the upper edge. */
    private static final float VISIBLE_DEG = 28f;
    private static final float MAX_PITCH_DEG = 90f;

    private float radius;
    private float unitsPerDeg;
    private float rollDeg;
    private float pitchDeg;

    /** Takes the size of the picture, pixels. */
    public void resize(float width, float height) {
        radius = Math.min(width, height) * 0.42f;
        unitsPerDeg = Math.min(width, height) / 2f / VISIBLE_DEG;
    }

    /** Takes an attitude, degrees: right wing down and nose up are positive. */
    public void turn(float roll, float pitch) {
        rollDeg = roll;
        pitchDeg = Math.max(-MAX_PITCH_DEG, Math.min(MAX_PITCH_DEG, pitch));
    }

    /** Returns by how many degrees the ball is turned, clockwise. */
    public float ballRotationDeg() {
        return -rollDeg;
    }

    /** Returns how far down the ball is moved before it is turned, pixels. */
    public float ballShift() {
        return pitchDeg * unitsPerDeg;
    }

    /** Returns the radius of the roll scale, pixels. */
    public float radius() {
        return radius;
    }

    public int rungCount() {
        return RUNGS_DEG.length;
    }

    /** Returns the pitch of a rung, degrees. */
    public float rungDeg(int rung) {
        return RUNGS_DEG[rung];
    }

    /** Returns the position of a rung on the ball, pixels below the horizon. */
    public float rungY(int rung) {
        return -RUNGS_DEG[rung] * unitsPerDeg;
    }

    /** Returns half of a rung's width, pixels: long each 10 degrees, short each 5 and 2.5. */
    public float rungHalfWidth(int rung) {
        if (isLabelled(rung)) {
            return radius * 0.34f;
        }
        return RUNGS_DEG[rung] % 5 == 0 ? radius * 0.18f : radius * 0.09f;
    }

    public boolean isLabelled(int rung) {
        return RUNGS_DEG[rung] % 10 == 0;
    }

    /** Returns whether a rung is drawn now: near the middle, within the roll scale. */
    public boolean isRungVisible(int rung) {
        return Math.abs(rungY(rung) + ballShift()) < radius * 0.86f;
    }

    /** Returns how many marks the roll scale has, the one in the middle not counted. */
    public int rollMarkCount() {
        return ROLL_MARKS_DEG.length;
    }

    /** Returns the bank of a mark of the roll scale, degrees. */
    public float rollMarkDeg(int mark) {
        return ROLL_MARKS_DEG[mark];
    }

    /** Returns how long a mark of the roll scale is, pixels. */
    public float rollMarkLength(int mark) {
        return ROLL_MARKS_DEG[mark] % 30 == 0 ? radius * 0.12f : radius * 0.06f;
    }

    /** Returns how far right of the middle an angle on a circle is; from above, clockwise. */
    public static float circleX(float angleDeg, float circleRadius) {
        return circleRadius * (float) Math.sin(Math.toRadians(angleDeg));
    }

    /** Returns how far below the middle an angle on a circle is; from above, clockwise. */
    public static float circleY(float angleDeg, float circleRadius) {
        return -circleRadius * (float) Math.cos(Math.toRadians(angleDeg));
    }

    private static float[] rungs() {
        float[] found = new float[2 * (8 + 14)];
        int count = 0;
        for (int step = -36; step <= 36; step++) {
            float pitch = step * 2.5f;
            boolean isFine = pitch % 5 != 0;
            if (pitch != 0 && !(isFine && Math.abs(pitch) >= 20)) {
                found[count++] = pitch;
            }
        }
        float[] exact = new float[count];
        System.arraycopy(found, 0, exact, 0, count);
        return exact;
    }
}
