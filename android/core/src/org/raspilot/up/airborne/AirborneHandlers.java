package org.raspilot.up.airborne;

import org.raspilot.up.commands.AckCommand;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.BaseCommandHandler;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandRefusedException;
import org.raspilot.up.commands.NackCode;
import org.raspilot.up.commands.NackCommand;
import org.raspilot.up.commands.PanicCommand;
import org.raspilot.up.commands.SpeakCommand;
import org.raspilot.up.commands.TelemetryCommand;
import org.raspilot.up.providers.Panic;

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
        executor.registerCommand(SpeakCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                speaker.speak(((SpeakCommand) command).text);
            }
        });
        executor.registerCommand(PanicCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) throws CommandRefusedException {
                follow((PanicCommand) command);
            }
        });
        executor.registerCommand(TelemetryCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                telemetry++;
            }
        });
        executor.registerCommand(AckCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                answers.onAck(((AckCommand) command).commandId);
            }
        });
        executor.registerCommand(NackCommand.NAME, new BaseCommandHandler() {
            @Override
            public void runAction(BaseCommand command) {
                NackCommand nack = (NackCommand) command;
                answers.onNack(nack.commandId, nack.reason);
            }
        });
    }

    /** Returns how many telemetry messages came. */
    long telemetry() {
        return telemetry;
    }

    private void follow(PanicCommand command) throws CommandRefusedException {
        if (!command.panic) {
            panic.forget();
            return;
        }
        try {
            panic.follow(command.delayMs);
        } catch (IllegalArgumentException error) {
            throw new CommandRefusedException(NackCode.INVALID, error.getMessage());
        }
    }
}
