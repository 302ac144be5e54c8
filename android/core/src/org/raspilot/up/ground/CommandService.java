package org.raspilot.up.ground;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.loop.Loop;

/** Sends what may be sent now or returns why not: nothing is queued, nothing is sent twice. */
final class CommandService {
    private final Loop loop;
    private final GroundSettings settings;
    private final GroundLink link;
    private final PendingCommands answers;
    private final ShownBeacons beacons;

    CommandService(Loop loop, GroundSettings settings, GroundLink link, PendingCommands answers,
            ShownBeacons beacons) {
        this.loop = loop;
        this.settings = settings;
        this.link = link;
        this.answers = answers;
        this.beacons = beacons;
    }

    /**
     * Sends a Command once.
     *
     * @param shown the beacon of the frame that the pilot has seen; null: none
     */
    void send(BaseCommand command, Long shown, AnswerListener listener) {
        final boolean isRequest = PendingCommands.isRequest(command);
        Answer refused = refusal(command);
        if (refused == null && !isRequest) {
            refused = beaconFault(command, shown);
        }
        if (refused != null) {
            listener.onAnswer(refused);
            return;
        }
        final Long echoed = beacons.isFresh(shown, loop.nowMs()) ? shown : null;
        final String id = answers.add(command, listener);
        final byte[] line;
        try {
            line = command.toMessage(id, echoed).toLine();
        } catch (IllegalArgumentException fault) {
            answers.remove(id);
            listener.onAnswer(Answer.refused(command.name(), "invalid", fault.getMessage()));
            return;
        }
        if (!link.send(line)) {
            answers.remove(id);
            listener.onAnswer(Answer.refused(command.name(), "no_link",
                    "the link takes nothing more now"));
        } else if (command.name().equals(Commands.TELEMETRY_PERIOD)) {
            link.expectAnotherPeriod();
        }
    }

    /** Returns why nothing can be sent now; null: it can. */
    Answer refusal(BaseCommand command) {
        final LinkStatus facts = link.facts();
        if (!link.isOpen()) {
            return Answer.refused(command.name(), "no_link",
                    facts.reason.isEmpty() ? "not connected"
                            : "not connected: " + facts.reason);
        }
        if (Boolean.FALSE.equals(facts.isAircraftOnline)) {
            return Answer.refused(command.name(), "no_aircraft", "the aircraft "
                    + settings.aircraft + " is not connected to the proxy");
        }
        if (standing() != ControlStatus.OURS) {
            return Answer.refused(command.name(), "no_control",
                    "this ground only listens: request control first");
        }
        if (answers.waiting() >= PendingCommands.MAX_WAITING) {
            return Answer.refused(command.name(), "busy",
                    "too many Commands wait for their answer");
        }
        return null;
    }

    /** Returns the state of the seat; a seat we left is not ours, even while unconfirmed. */
    ControlStatus standing() {
        final LinkStatus facts = link.facts();
        return ControlStatus.of(facts, settings.isDirect);
    }

    /** A pilot must see the aircraft's state to command: the screen may hang or show late data. */
    private Answer beaconFault(BaseCommand command, Long shown) {
        if (shown == null) {
            if (beacons.isLegacy() && !command.name().equals(Commands.ARM)
                    && !command.name().equals(Commands.DISARM)) {
                // A thesis aircraft's telemetry has no beacons.
                return null;
            }
            return Answer.refused(command.name(), "no_beacon",
                    "it is only sent with the beacon of telemetry that was seen");
        }
        if (!beacons.isFresh(shown, loop.nowMs())) {
            return Answer.refused(command.name(), "stale", "the telemetry on the screen is older"
                    + " than " + beacons.limitMs() / 1000 + " s");
        }
        return null;
    }
}
