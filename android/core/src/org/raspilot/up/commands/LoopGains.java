package org.raspilot.up.commands;

/** The gains of one loop on every axis; without a rudder the set is the two-axis form. */
public final class LoopGains {
    public final Gains ailerons;
    public final Gains elevator;
    /** The gains of the rudder, or null. */
    public final Gains rudder;

    /** Creates the gains of a loop; {@code rudder} null: unchanged. */
    public LoopGains(Gains ailerons, Gains elevator, Gains rudder) {
        this.ailerons = ailerons;
        this.elevator = elevator;
        this.rudder = rudder;
    }
}
