package org.raspilot.up.net;

import java.util.List;

/** The targets of Discovery, read for each request because a phone's networks change. */
public interface BroadcastAddresses {
    /** Returns numeric IPv4 addresses, broadcast or of one host; empty without a network. */
    List<String> current();
}
