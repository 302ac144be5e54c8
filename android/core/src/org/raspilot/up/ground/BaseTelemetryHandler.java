package org.raspilot.up.ground;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.BaseCommandHandler;

/**
 * The Command Handler of telemetry (thesis 4.5.3): the type parameter is the type of the wanted
 * telemetry, {@link #read} extracts it from a frame, {@link #onTelemetry} processes it.
 *
 * <p>Register it in the Command Executor for {@link Telemetry#NAME}. It runs on the loop.
 *
 * @param <T> the value read from a frame
 */
public abstract class BaseTelemetryHandler<T> extends BaseCommandHandler {
    private final TelemetrySource source;

    /** Creates a handler of that {@link GroundSide}'s frames. */
    protected BaseTelemetryHandler(TelemetrySource source) {
        this.source = source;
    }

    /** Returns the wanted value of a frame; null skips {@link #onTelemetry}. */
    protected abstract T read(Telemetry telemetry);

    /** Processes the value; {@code age} gives its age, now and later. */
    protected abstract void onTelemetry(T value, Age age);

    @Override
    public final void runAction(BaseCommand command) {
        final Telemetry telemetry = source.telemetry();
        final T value = read(telemetry);
        if (value != null) {
            onTelemetry(value, telemetry.age);
        }
    }
}
