package org.raspilot.up.ground;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.BaseCommandHandler;

/**
 * The Command Handler of telemetry (thesis 4.5.3): the type parameter says which of the telemetry
 * is wanted, {@link #read} takes it out of a frame, {@link #onTelemetry} does something with it.
 *
 * <p>Register it in the Command Executor for {@link Telemetry#NAME}. It runs on the loop.
 *
 * @param <T> what is read from a frame
 */
public abstract class BaseTelemetryHandler<T> extends BaseCommandHandler {
    private final TelemetrySource source;

    /** Makes a handler of that {@link GroundSide}'s frames. */
    protected BaseTelemetryHandler(TelemetrySource source) {
        this.source = source;
    }

    /** Returns what is wanted of a frame; null: it has none of it, and the action is not run. */
    protected abstract T read(Telemetry telemetry);

    /** Does something with what was read; {@code age} says how old it is, now and later. */
    protected abstract void onTelemetry(T value, Age age);

    @Override
    public final void runAction(BaseCommand command) {
        final Telemetry telemetry = source.telemetry();
        final T value = read(telemetry);
        if (value != null) {
            onTelemetry(value, telemetry.age());
        }
    }
}
