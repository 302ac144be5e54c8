package org.raspilot.up.ground;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.loop.Loop;

/** Sends what may be sent now or returns why not: nothing is queued, nothing is sent twice. */
final class CommandService {
    private final Loop loop;
    private final GroundLink link;
    private final CommandGate gate;
    private final PendingCommands answers;
    private final ShownBeacons beacons;

    CommandService(Loop loop, GroundLink link, CommandGate gate, PendingCommands answers,
            ShownBeacons beacons) {
        this.loop = loop;
        this.link = link;
        this.gate = gate;
        this.answers = answers;
        this.beacons = beacons;
    }

    /**
     * Sends a Command once.
     *
     * @param seen the beacon of the frame that the pilot has seen; null: none
     */
    void send(BaseCommand command, Long seen, AnswerListener listener) {
        final boolean isProtectedRequest = link.facts().isKeyed()
                && PendingCommands.isRequest(command);
        // A protected request needs a beacon, too, though no pilot has to have seen its frame.
        final Long shown = isProtectedRequest && seen == null ? beacons.newest() : seen;
        final Answer refused = gate.refusal(command, shown);
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
}
