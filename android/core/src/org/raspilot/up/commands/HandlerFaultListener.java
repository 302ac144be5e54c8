package org.raspilot.up.commands;

/** Told of a handler that failed; the other handlers and the link go on. */
public interface HandlerFaultListener {
    /** Hears what a handler threw that is no refusal, on the loop thread. */
    void onHandlerFailed(BaseCommandHandler handler, BaseCommand command, Throwable fault);
}
