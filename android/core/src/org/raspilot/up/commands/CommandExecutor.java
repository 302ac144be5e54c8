package org.raspilot.up.commands;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * The bus: delivers every Command to those who subscribed to it (thesis 4.1.4).
 *
 * <p>Used on the loop thread only. A Command executed from inside a handler waits until the
 * current Command's handlers are done.
 */
public final class CommandExecutor {
    private static final CommandOutcome NOBODY_ASKS = (handlers, fault) -> {
        // A fault was reported and counted where it happened.
    };

    private final CommandRegistry registry;
    private final HandlerFaultListener faults;
    /** Handlers by name; a list is replaced and never changed, so that a delivery can go on. */
    private final Map<String, List<CommandHandler>> handlers = new HashMap<>();
    private final ArrayDeque<Runnable> waiting = new ArrayDeque<>();
    private boolean isDelivering;

    /** Creates a bus; exceptions from handlers are reported to the listener. */
    public CommandExecutor(CommandRegistry registry, HandlerFaultListener faults) {
        this.registry = registry;
        this.faults = faults;
    }

    /**
     * Subscribes a handler to a Command by its name or alias; one handler may be registered several
     * times.
     */
    public void registerCommand(String name, CommandHandler handler) {
        if (handler == null) {
            throw new IllegalArgumentException("no handler for " + name);
        }
        List<CommandHandler> now = new ArrayList<>(handlersOf(name));
        now.add(handler);
        handlers.put(registry.primaryName(name), now);
    }

    public boolean hasHandlers(String name) {
        return !handlersOf(name).isEmpty();
    }

    /**
     * Delivers a Command to its handlers in the order of their registration; no handler's fault or
     * refusal reaches the caller or the other handlers.
     */
    public void executeCommand(BaseCommand command) {
        execute(command, NOBODY_ASKS);
    }

    /** Delivers a Command, immediately or after the current delivery, and reports the outcome. */
    void execute(final BaseCommand command, final CommandOutcome outcome) {
        waiting.add(() -> deliver(command, outcome));
        if (isDelivering) {
            return;
        }
        isDelivering = true;
        try {
            for (Runnable next = waiting.poll(); next != null; next = waiting.poll()) {
                next.run();
            }
        } finally {
            isDelivering = false;
        }
    }

    private void deliver(BaseCommand command, CommandOutcome outcome) {
        List<CommandHandler> subscribed = handlersOf(command.name());
        Throwable first = null;
        for (CommandHandler handler : subscribed) {
            Throwable fault = run(handler, command);
            first = first == null ? fault : first;
        }
        outcome.onDone(subscribed.size(), first);
    }

    /** Returns what the handler threw, or null; whatever it was, the others have their turn. */
    private Throwable run(CommandHandler handler, BaseCommand command) {
        try {
            handler.runAction(command);
            return null;
        } catch (CommandRefusedException refusal) {
            return refusal;
        } catch (RuntimeException | LinkageError | StackOverflowError fault) {
            faults.onHandlerFailed(handler, command, fault);
            return fault;
        }
    }

    private List<CommandHandler> handlersOf(String name) {
        List<CommandHandler> now = handlers.get(registry.primaryName(name));
        return now == null ? Collections.emptyList() : now;
    }

    /** Receives the failures of handlers; the other handlers and the link continue. */
    public interface HandlerFaultListener {
        /** Called on the loop thread with an exception of a handler that is not a refusal. */
        void onHandlerFailed(CommandHandler handler, BaseCommand command, Throwable fault);
    }

    interface CommandOutcome {
        /** Takes the number of handlers, and the first exception that one threw, or null. */
        void onDone(int handlers, Throwable fault);
    }
}
