package org.raspilot.up.commands;

/** The three gains of one PID controller, each 0 to 50 (docs/protocols.md 5). */
public final class Gains {
    public static final double MAX = 50;

    public final double p;
    public final double i;
    public final double d;

    /** Creates the gains of one controller; {@link PidTuningsCommand} checks them. */
    public Gains(double p, double i, double d) {
        this.p = p;
        this.i = i;
        this.d = d;
    }
}
