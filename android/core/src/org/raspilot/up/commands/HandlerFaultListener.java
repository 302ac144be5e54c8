package org.raspilot.up.commands;

/** Told of a handler that failed; the other handlers and the link go on. */
public interface HandlerFaultListener {
    /** Called on the loop thread with an exception of a handler that is not a refusal. */
    void onHandlerFailed(BaseCommandHandler handler, BaseCommand command, Throwable fault);
}
