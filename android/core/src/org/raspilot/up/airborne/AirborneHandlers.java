package org.raspilot.up.airborne;

import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandFields;
import org.raspilot.up.commands.CommandRefusedException;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.NackCode;
import org.raspilot.up.providers.Panic;
import org.raspilot.up.wire.GeneralMessage;

/** What the airborne phone does with the Commands that the Raspberry Pi sends. */
final class AirborneHandlers {
    private final Panic panic;
    private final Speaker speaker;
    private final Answers answers;
    private long telemetry;

    /** Handles the answers to messages sent with an id. */
    interface Answers {
        void onAck(String id);

        /** Takes a nack with its reason. */
        void onNack(String id, String reason);
    }

    AirborneHandlers(Panic panic, Speaker speaker, Answers answers) {
        this.panic = panic;
        this.speaker = speaker;
        this.answers = answers;
    }

    void register(CommandExecutor executor) {
        executor.registerCommand(Commands.SPEAK, command ->
                speaker.speak((String) command.data().get("text")));
        executor.registerCommand(Commands.PANIC, command ->
                follow(new CommandFields(command.data())));
        executor.registerCommand(Commands.TELEMETRY, command -> telemetry++);
        executor.registerCommand(Commands.ACK, command ->
                answers.onAck((String) command.data().get("id")));
        executor.registerCommand(Commands.NACK, command -> {
            CommandFields fields = new CommandFields(command.data());
            answers.onNack(fields.text("id", GeneralMessage.MAX_ID_LENGTH),
                    fields.text("reason", 500, ""));
        });
    }

    /** Returns how many telemetry messages came. */
    long telemetry() {
        return telemetry;
    }

    private void follow(CommandFields command) throws CommandRefusedException {
        if (!command.flag("panic")) {
            panic.clear();
            return;
        }
        try {
            panic.apply(command.number("delay_ms"));
        } catch (IllegalArgumentException error) {
            throw new CommandRefusedException(NackCode.INVALID, error.getMessage());
        }
    }
}
