package org.raspilot.up;

import org.raspilot.up.commands.CommandExecutor.HandlerFaultListener;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.CommandReceiver;
import org.raspilot.up.commands.CommandRegistry;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.ProvidersController;

/**
 * The Up Library as an application sees it: Commands, their handlers and the providers (thesis
 * 4.5.2).
 *
 * <p>An Up is an ordinary object; {@link #getInstance} is the one that the process set up.
 */
public final class Up {
    private static Up instance;

    private final Loop loop;
    private final CommandRegistry registry;
    private final CommandExecutor executor;
    private final CommandReceiver receiver;
    private final ProvidersController providers;

    /** Creates an Up on a loop; exceptions from handlers are reported to the listener. */
    public Up(Loop loop, HandlerFaultListener faults) {
        this.loop = loop;
        providers = new ProvidersController(loop);
        registry = CommandRegistry.builtin();
        executor = new CommandExecutor(registry, faults);
        receiver = new CommandReceiver(registry, executor, loop);
    }

    /**
     * Returns the Up of this process.
     *
     * @throws IllegalStateException before {@link #setInstance}
     */
    public static synchronized Up getInstance() {
        if (instance == null) {
            throw new IllegalStateException("no Up was set up in this process");
        }
        return instance;
    }

    /**
     * Sets the Up of this process; null removes it.
     *
     * @throws IllegalStateException when another one is set
     */
    public static synchronized void setInstance(Up up) {
        if (up != null && instance != null && instance != up) {
            throw new IllegalStateException("this process has an Up already");
        }
        instance = up;
    }

    /** Returns the loop on which all of it lives. */
    public Loop loop() {
        return loop;
    }

    public CommandRegistry commandRegistry() {
        return registry;
    }

    public CommandExecutor commandExecutor() {
        return executor;
    }

    public CommandReceiver commandReceiver() {
        return receiver;
    }

    public ProvidersController providersController() {
        return providers;
    }
}
