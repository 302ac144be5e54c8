package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.commands.CommandExecutor.HandlerFaultListener;

/** Records exceptions of handlers. */
final class HandlerFaults implements HandlerFaultListener {
    final List<Throwable> faults = new ArrayList<>();

    @Override
    public void onHandlerFailed(CommandHandler handler, BaseCommand command, Throwable fault) {
        faults.add(fault);
    }
}
