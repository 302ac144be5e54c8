package org.raspilot.up.ground;

import java.util.Random;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.loop.Loop;

/**
 * The ground's end of the link: telemetry in, Commands out, the seat, and what a screen shows.
 *
 * <p>Only on the loop; what it hands out is immutable and may go to any thread. Source: thesis
 * 4.5.2, docs/protocols.md 4, 6 and 9.
 */
public final class GroundSide implements TelemetrySource {
    /**
     * Makes a ground that is not started.
     *
     * @param tokens keeps the resume token
     * @param executor runs the handlers of what the aircraft says, telemetry's too
     * @param random makes ids and varies the waits
     */
    public GroundSide(Loop loop, GroundSettings settings, TokenStore tokens,
            CommandExecutor executor, GroundListener listener, Random random) {
    }

    /** Begins to connect, and connects again after each loss; started already, without effect. */
    public void start() {
    }

    /** Gives the link up; Commands that wait for their answer hear that it is lost. */
    public void stop() {
    }

    /** Tries at once, as when the phone's network came back. */
    public void reconnectNow() {
    }

    /** Returns the status of now. */
    public GroundStatus status() {
        return new GroundStatus(new GroundStatus.Draft());
    }

    @Override
    public Telemetry telemetry() {
        return Telemetry.NOTHING;
    }

    /** Returns the way that the aircraft has come. */
    public Track track() {
        return null;
    }

    /** Returns what happened. */
    public EventLog events() {
        return null;
    }

    /** Returns what is wrong. */
    public Alarms alarms() {
        return null;
    }

    /** Returns the gains. */
    public GainsDesk gains() {
        return null;
    }

    /** Hears that the screen has drawn the frame with that beacon; null: one without. */
    public void seen(Long beacon) {
    }

    /** Sends a Command with the newest beacon that was {@link #seen}. */
    public void send(BaseCommand command, AnswerListener listener) {
        send(command, null, listener);
    }

    /**
     * Sends a Command once, never again by itself, or refuses it with a sentence.
     *
     * @param shownBeacon the beacon of the frame that the screen shows; null: none is shown
     * @param listener hears what became of it, once
     */
    public void send(BaseCommand command, Long shownBeacon, AnswerListener listener) {
        listener.onAnswer(Answer.refused(command.name(), "no_link", "there is no link"));
    }

    /** Asks for the seat; a free one is given at once. False: there is nobody to ask. */
    public boolean requestSeat() {
        return false;
    }

    /** Hands the seat to the listener with that number. False: it is not ours. */
    public boolean giveSeat(int to) {
        return false;
    }

    /** Leaves the seat free. False: it is not ours. */
    public boolean releaseSeat() {
        return false;
    }
}
