package org.raspilot.up.providers;

/** Which side of the device points to the aircraft's nose. */
public enum Nose {
    /** The top edge. */
    TOP,
    /** The right edge, seen by someone who looks at the screen. */
    RIGHT,
    /** The bottom edge. */
    BOTTOM,
    /** The left edge. */
    LEFT,
    /** The screen: the device stands and looks ahead. */
    SCREEN,
    /** The back: the device stands and looks back. */
    BACK
}
