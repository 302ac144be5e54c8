package org.raspilot.up.commands;

/** A {@link CommandHandler} as a class to extend (thesis 4.1.4). */
public abstract class BaseCommandHandler implements CommandHandler {
}
