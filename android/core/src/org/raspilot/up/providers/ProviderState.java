package org.raspilot.up.providers;

/** What a provider does now. */
public enum ProviderState {
    /** This device has no such sensor. */
    ABSENT,
    /** It was not started, or it was stopped. */
    STOPPED,
    /** No reading yet, or no link to send it on. */
    WAITING,
    /** Its readings leave. */
    SENDING,
    /** The sensor is present and has been silent for longer than allowed. */
    SILENT
}
