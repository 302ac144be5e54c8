package org.raspilot.up.net;

import java.util.List;

/** Tells whom to ask for the Raspberry Pi, anew for each question: a phone's networks change. */
public interface BroadcastAddresses {
    /** Returns numeric IPv4 addresses, broadcast or of one host; empty: there is no network. */
    List<String> current();
}
