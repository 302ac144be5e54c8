package org.raspilot.up.net;

import java.io.DataInputStream;
import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.Charset;
import org.junit.rules.ExternalResource;

/** The other end of a real socket, on loopback; listens on one port for the whole test. */
final class Peer extends ExternalResource {
    private static final int LONG_MS = 20000;
    private static final int SMALL_BUFFER = 4096;

    private ServerSocket server;
    private Socket connection;

    @Override
    protected void before() throws IOException {
        server = new ServerSocket();
        server.setReceiveBufferSize(SMALL_BUFFER);
        server.setReuseAddress(true);
        server.bind(new InetSocketAddress(InetAddress.getByName("127.0.0.1"), 0), 50);
        server.setSoTimeout(LONG_MS);
    }

    @Override
    protected void after() {
        try {
            server.close();
            if (connection != null) {
                connection.close();
            }
        } catch (IOException error) {
            throw new AssertionError(error);
        }
    }

    Endpoint place() {
        return new Endpoint("127.0.0.1", server.getLocalPort(), server.getLocalPort());
    }

    void accept() throws IOException {
        connection = server.accept();
        connection.setSoTimeout(LONG_MS);
    }

    void say(String text) throws IOException {
        connection.getOutputStream().write(text.getBytes(Charset.forName("UTF-8")));
    }

    /** Reads up to a line's end. */
    String readLine() throws IOException {
        final StringBuilder line = new StringBuilder();
        for (int next = read(); next != '\n'; next = read()) {
            if (next < 0) {
                return line + "<end>";
            }
            line.append((char) next);
        }
        return line.toString();
    }

    /** Reads one byte; -1 at the end. */
    int read() throws IOException {
        return connection.getInputStream().read();
    }

    DataInputStream in() throws IOException {
        return new DataInputStream(connection.getInputStream());
    }

    /** Ends the connection in an orderly way. */
    void hangUp() throws IOException {
        connection.close();
    }

    void cut() throws IOException {
        connection.setSoLinger(true, 0);
        connection.close();
    }

    /** Listens no more: further attempts are refused. */
    void refuse() throws IOException {
        server.close();
    }
}
