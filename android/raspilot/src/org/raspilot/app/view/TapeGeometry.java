package org.raspilot.app.view;

/**
 * A scale that moves past a pointer in the middle: which marks are drawn, and where.
 *
 * <p>A vertical scale has greater values above, a horizontal one to the right. Only {@link
 * #firstMark()} determines the labels, and it changes only when the value has moved by a whole
 * step. Lengths are pixels.
 */
public final class TapeGeometry {
    private final float step;
    private float pixelsPerStep = 1;
    private int count = 1;
    private long middle;
    private float shift;

    /** Takes the distance between two marks, in the unit of the value; above 0. */
    public TapeGeometry(float step) {
        this.step = step;
    }

    /** Takes the length of the scale and the distance between two marks, pixels. */
    public void resize(float length, float newPixelsPerStep) {
        pixelsPerStep = Math.max(1, newPixelsPerStep);
        int half = (int) Math.ceil(length / 2 / pixelsPerStep) + 1;
        count = 2 * half + 1;
    }

    /** Takes the value at the pointer. */
    public void show(float value) {
        float steps = value / step;
        middle = Math.round((double) steps);
        shift = (steps - middle) * pixelsPerStep;
    }

    /** Returns how many marks are drawn. */
    public int count() {
        return count;
    }

    /** Returns the lowest mark drawn, in steps. */
    public long firstMark() {
        return middle - (count - 1) / 2;
    }

    /** Returns the value of a mark, counted from the lowest one drawn. */
    public float value(int place) {
        return (firstMark() + place) * step;
    }

    /** Returns how far below the pointer a mark of an upright scale is. */
    public float y(int place) {
        return ((count - 1) / 2 - place) * pixelsPerStep + shift;
    }

    /** Returns how far right of the pointer a mark of a lying scale is. */
    public float x(int place) {
        return -y(place);
    }

    /** Returns how far from the pointer a value is along the scale, greater ones positive. */
    public float distance(float value, float atPointer) {
        return (value - atPointer) / step * pixelsPerStep;
    }

    /** Returns whether the index of this mark, counted from zero, is a multiple of {@code each}. */
    public boolean isEach(int place, int each) {
        return (firstMark() + place) % each == 0;
    }
}
