package org.raspilot.up.airborne;

import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandFields;
import org.raspilot.up.commands.CommandRefusedException;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.NackCode;
import org.raspilot.up.providers.Panic;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.SafeText;

/** What the airborne phone does with the Commands that the Raspberry Pi sends. */
final class AirborneHandlers {
    private static final int MAX_REASON_LENGTH = 300;

    private final Panic panic;
    private final Speaker speaker;
    private final AirborneLink link;
    private final AirborneListener listener;
    private long telemetry;
    private long answers;

    AirborneHandlers(Panic panic, Speaker speaker, AirborneLink link,
            AirborneListener listener) {
        this.panic = panic;
        this.speaker = speaker;
        this.link = link;
        this.listener = listener;
    }

    void register(CommandExecutor executor) {
        executor.registerCommand(Commands.SPEAK, command ->
                speaker.speak((String) command.data().get("text")));
        executor.registerCommand(Commands.PANIC, command ->
                follow(new CommandFields(command.data())));
        executor.registerCommand(Commands.TELEMETRY, command -> telemetry++);
        executor.registerCommand(Commands.ACK, command ->
                onAnswer((String) command.data().get("id")));
        executor.registerCommand(Commands.NACK, command -> {
            CommandFields fields = new CommandFields(command.data());
            onAnswer(fields.text("id", GeneralMessage.MAX_ID_LENGTH));
            listener.onEvent("nack_received", "the Raspberry Pi refused a message: "
                    + SafeText.of(fields.text("reason", 500, ""), MAX_REASON_LENGTH));
        });
    }

    /** Returns how many telemetry messages came. */
    long telemetry() {
        return telemetry;
    }

    /** Returns how many answers to messages sent with an id came. */
    long answers() {
        return answers;
    }

    private void onAnswer(String id) {
        answers++;
        link.onAnswer(id);
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
