package org.raspilot.up.ground;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.loop.Loop;

/** Sends what may be sent now or returns why not: nothing is queued, nothing is sent twice. */
final class CommandService {
    private final Loop loop;
    private final GroundLink link;
    private final GroundSettings settings;
    private final PendingCommands answers;
    private final ShownBeacons beacons;

    CommandService(Loop loop, GroundLink link, GroundSettings settings, PendingCommands answers,
            ShownBeacons beacons) {
        this.loop = loop;
        this.link = link;
        this.settings = settings;
        this.answers = answers;
        this.beacons = beacons;
    }

    /**
     * Sends a Command once; {@code seen}: the beacon of the frame that the pilot has seen, or null.
     */
    void send(BaseCommand command, Long seen, AnswerListener listener) {
        final boolean isProtectedRequest = link.facts().isKeyed()
                && PendingCommands.isRequest(command);
        // A protected request needs a beacon, too, though no pilot has to have seen its frame.
        final Long shown = isProtectedRequest && seen == null ? beacons.newest() : seen;
        final Answer refused = refusal(command, shown);
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

    /** Returns why a Command is not sent now; null: it is. */
    private Answer refusal(BaseCommand command, Long shown) {
        final Answer refused = ofLink(command);
        if (refused != null) {
            return refused;
        }
        if (answers.waiting() >= PendingCommands.MAX_WAITING) {
            return Answer.refused(command.name(), "busy",
                    "too many Commands wait for their answer");
        }
        final LinkStatus facts = link.facts();
        if (!facts.keyFault().isEmpty()) {
            return Answer.refused(command.name(), facts.keyFault(),
                    KeyTexts.fault(facts.keyFault()));
        }
        return PendingCommands.isRequest(command) && !facts.isKeyed() ? null
                : beaconFault(command, shown);
    }

    private Answer ofLink(BaseCommand command) {
        final LinkStatus facts = link.facts();
        switch (CommandGate.ofLink(link.isOpen(), facts.isAircraftOnline,
                ControlStatus.of(facts, settings.isDirect))) {
            case NONE:
                return null;
            case NO_LINK:
                return Answer.refused(command.name(), "no_link",
                        facts.reason.isEmpty() ? "not connected"
                                : "not connected: " + facts.reason);
            case NO_AIRCRAFT:
                return Answer.refused(command.name(), "no_aircraft", "the aircraft "
                        + settings.aircraft + " is not connected to the proxy");
            default:
                return Answer.refused(command.name(), "no_control",
                        "this ground only listens: request control first");
        }
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
