package org.raspilot.up.providers;

/** A side of the device, seen by a viewer of its screen held upright. */
public enum Side {
    TOP(0, 1, 0),
    RIGHT(1, 0, 0),
    BOTTOM(0, -1, 0),
    LEFT(-1, 0, 0),
    SCREEN(0, 0, 1),
    BACK(0, 0, -1);

    private final int x;
    private final int y;
    private final int z;

    Side(int x, int y, int z) {
        this.x = x;
        this.y = y;
        this.z = z;
    }

    /** Returns the part of its direction along the device's axis to the right edge. */
    int x() {
        return x;
    }

    /** Returns the part of its direction along the device's axis to the top edge. */
    int y() {
        return y;
    }

    /** Returns the part of its direction along the device's axis out of the screen. */
    int z() {
        return z;
    }
}
