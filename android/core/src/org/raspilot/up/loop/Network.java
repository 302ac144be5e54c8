package org.raspilot.up.loop;

import java.io.IOException;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.loop.UdpPort.UdpListener;

/** Opens connections whose listeners are called on the loop. Only on the loop. */
public interface Network {
    /**
     * Starts to connect to {@code host}, a name or an address; the listener receives the outcome
     * after this call has returned.
     *
     * @param port 1 to 65535; any other port is reported by {@link TcpListener#onClosed}
     * @param timeoutMs timeout of name lookup and connecting together
     */
    TcpConnection connectTcp(String host, int port, int timeoutMs, TcpListener listener);

    /**
     * Opens an UDP socket on any port, allowed to broadcast.
     *
     * @throws IOException when the system gives no socket
     */
    UdpPort openUdp(UdpListener listener) throws IOException;
}
