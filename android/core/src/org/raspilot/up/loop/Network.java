package org.raspilot.up.loop;

import java.io.IOException;

/** Opens connections whose listeners are called on the loop. Only on the loop. */
public interface Network {
    /**
     * Begins to connect to {@code host}, a name or an address; the listener hears of the outcome
     * later, never before this call returned.
     *
     * @param port 1 to 65535; another port is told by {@link TcpListener#onClosed}
     * @param timeoutMs how long looking up the name and connecting may take together
     */
    TcpConnection connectTcp(String host, int port, int timeoutMs, TcpListener listener);

    /**
     * Opens an UDP socket on any port, allowed to broadcast.
     *
     * @throws IOException when the system gives no socket
     */
    UdpPort openUdp(UdpListener listener) throws IOException;
}
