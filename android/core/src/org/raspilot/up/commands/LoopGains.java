package org.raspilot.up.commands;

/** The gains of one loop on every axis; without a rudder the set is the two-axis form. */
public final class LoopGains {
    private final Gains ailerons;
    private final Gains elevator;
    private final Gains rudder;

    /** Creates the gains of a loop; {@code rudder} null: unchanged. */
    public LoopGains(Gains ailerons, Gains elevator, Gains rudder) {
        this.ailerons = ailerons;
        this.elevator = elevator;
        this.rudder = rudder;
    }

    /** Returns the gains of the ailerons. */
    public Gains ailerons() {
        return ailerons;
    }

    /** Returns the gains of the elevator. */
    public Gains elevator() {
        return elevator;
    }

    /** Returns the gains of the rudder, or null. */
    public Gains rudder() {
        return rudder;
    }
}
