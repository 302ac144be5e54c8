package org.raspilot.app;

import java.io.BufferedReader;
import java.io.Closeable;
import java.io.IOException;
import java.io.InputStreamReader;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;

/** The other end of a link of lines, played by a test: it listens and records received lines. */
class Peer implements Closeable {
    private final ServerSocket server;
    private final List<String> heard = new ArrayList<>();
    private Socket connection;
    private boolean isClosed;

    Peer() throws IOException {
        server = new ServerSocket(0, 5, InetAddress.getByName("127.0.0.1"));
        run("accept", this::accept);
    }

    /** A step of a thread that ends with the connection. */
    interface Work {
        void work() throws IOException;
    }

    final int port() {
        return server.getLocalPort();
    }

    /** Called with a line that is not a heartbeat; on a thread of the peer's. */
    void onLine(String line) throws IOException {
    }

    /** Returns all lines received so far except heartbeats. */
    final synchronized List<String> heard() {
        return new ArrayList<>(heard);
    }

    final synchronized boolean isConnected() {
        return connection != null;
    }

    /** Sends a line; no effect without a connection. */
    final void say(String line) {
        Socket now;
        synchronized (this) {
            now = connection;
        }
        if (now != null) {
            try {
                synchronized (now) {
                    now.getOutputStream().write((line + "\n").getBytes(StandardCharsets.UTF_8));
                }
            } catch (IOException gone) {
                drop();
            }
        }
    }

    /** Ends the connection; another one may come. */
    final synchronized void drop() {
        if (connection != null) {
            try {
                connection.close();
            } catch (IOException gone) {
                // It is gone, as expected.
            }
            connection = null;
        }
    }

    @Override
    public void close() throws IOException {
        synchronized (this) {
            isClosed = true;
        }
        server.close();
        drop();
    }

    private void accept() throws IOException {
        while (true) {
            final Socket came = server.accept();
            synchronized (this) {
                connection = came;
            }
            run("read", () -> read(came));
        }
    }

    private void read(Socket from) throws IOException {
        BufferedReader lines = new BufferedReader(
                new InputStreamReader(from.getInputStream(), StandardCharsets.UTF_8));
        for (String line = lines.readLine(); line != null; line = lines.readLine()) {
            if (!line.isEmpty()) {
                synchronized (this) {
                    heard.add(line);
                }
                onLine(line);
            }
        }
    }

    final synchronized boolean isClosed() {
        return isClosed;
    }

    final void run(String name, final Work work) {
        Thread thread = new Thread("peer " + name) {
            @Override
            public void run() {
                try {
                    work.work();
                } catch (IOException gone) {
                    synchronized (Peer.this) {
                        if (!isClosed && connection != null && name.equals("accept")) {
                            throw new IllegalStateException(gone);
                        }
                    }
                }
            }
        };
        thread.setDaemon(true);
        thread.start();
    }
}
