package org.raspilot.up.airborne;

import java.util.Random;
import org.raspilot.up.Up;
import org.raspilot.up.airborne.AirborneStatus.AirborneCounters;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.ProvidersController;
import org.raspilot.up.providers.Sensors;

/**
 * The airborne phone: finds the Raspberry Pi, sends what its sensors read, carries Commands out.
 *
 * <p>Your own provider is one class and one {@code providers().register(...)}, your own Command
 * Handler one {@code up().commandExecutor().registerCommand(...)}. Only on the loop. Source:
 * thesis 4.5.2, "Base Up Service".
 */
public final class Airborne {
    private final Up up;
    private final BasicProviders basics;
    private final AirborneHandlers handlers;
    private final AirborneLink link;
    private final SensorSilenceMonitor silence;
    private boolean isRunning;

    /**
     * Creates a phone that is not started; {@code random}, seeded, varies the retry waits and makes
     * the identity by which the Raspberry Pi distinguishes this phone from others.
     */
    public Airborne(Loop loop, AirborneSettings settings, Sensors sensors, Speaker speaker,
            AirborneListener listener, Random random) {
        up = new Up(loop, (handler, command, fault) -> listener.onEvent("handler_failed",
                "the handler of " + command.name() + " failed: " + fault));
        link = new AirborneLink(loop, settings, random, up, listener);
        handlers = new AirborneHandlers(providers().panic(), speaker, link, listener);
        handlers.register(up.commandExecutor());
        basics = new BasicProviders(settings, sensors);
        basics.register(providers());
        silence = new SensorSilenceMonitor(loop, providers(), listener);
        providers().setListener((name, sentence) ->
                listener.onEvent("provider_problem", name + ": " + sentence));
        providers().panic().addListener(panic -> listener.onPanic(panic.delayMs()));
    }

    public void start() {
        if (!isRunning) {
            isRunning = true;
            providers().start(link);
            link.start();
            silence.start();
        }
    }

    /** Stops everything; it may be started again. */
    public void stop() {
        if (isRunning) {
            isRunning = false;
            silence.stop();
            link.stop();
            providers().stop();
        }
    }

    /** Returns the Up of this side: its Command Executor takes your handlers. */
    public Up up() {
        return up;
    }

    /** Returns the providers: register yours here, before or after the start. */
    public ProvidersController providers() {
        return up.providersController();
    }

    public AirborneStatus status() {
        return new AirborneStatus(link.status(), providers().panic().delayMs(),
                providers().statuses(), new AirborneCounters(up.commandReceiver(),
                        link.connections(), handlers.telemetry(), handlers.answers()));
    }

    public void setMounting(Mounting mounting) {
        basics.setMounting(mounting);
    }

    /** Takes the angle from magnetic to true north, degrees, east positive. */
    public void setDeclinationDeg(double declinationDeg) {
        basics.setDeclinationDeg(declinationDeg);
    }

    /**
     * Takes the pressure at altitude zero, hPa (QNH).
     *
     * @throws IllegalArgumentException when it is not within 300 to 1100 (a sentence)
     */
    public void setReferencePressureHPa(double hPa) {
        basics.altitude.setReferenceHPa(hPa);
    }

    /**
     * Sets the altitude at the phone's position to zero; returns the reference pressure, hPa.
     *
     * @throws IllegalStateException without a reading of the barometer (a sentence)
     */
    public double zeroAltitudeHere() {
        return basics.altitude.zeroHere();
    }

    /** Retries immediately instead of after the wait, as when the phone's network is back. */
    public void networkChanged() {
        if (isRunning) {
            link.reconnectNow();
        }
    }
}
