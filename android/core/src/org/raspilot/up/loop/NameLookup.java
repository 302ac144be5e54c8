package org.raspilot.up.loop;

import java.net.Inet4Address;
import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;

/**
 * Resolves names on its own threads, so that a slow name server delays only its caller.
 *
 * <p>Concurrent requests for the same name share one lookup. IPv4 addresses need no thread. Idle
 * threads end after 5 s.
 */
final class NameLookup {
    private static final int MAX_THREADS = 4;

    private final Loop loop;
    private final Resolver resolver;
    private final ThreadPoolExecutor threads;
    private final Map<String, List<Asker>> waitingListeners = new HashMap<>();

    /** Creates a look-up that answers on {@code loop}. */
    NameLookup(Loop loop, Resolver resolver, final String threadName) {
        this.loop = loop;
        this.resolver = resolver;
        threads = new ThreadPoolExecutor(MAX_THREADS, MAX_THREADS, 5, TimeUnit.SECONDS,
                new LinkedBlockingQueue<>(), call -> {
                    final Thread thread = new Thread(call, threadName);
                    thread.setDaemon(true);
                    return thread;
                });
        threads.allowCoreThreadTimeOut(true);
    }

    /** Looks up a name or an address; the caller is answered after this call has returned. */
    void resolve(final String host, final Asker asker) {
        if (host == null || host.isEmpty()) {
            notifyListener(asker, unknown("the host is empty"));
            return;
        }
        final InetAddress numeric = numeric(host);
        if (numeric != null) {
            notifyListener(asker, known(numeric));
        } else if (waitingListeners.containsKey(host)) {
            waitingListeners.get(host).add(asker);
        } else {
            final List<Asker> waiting = new ArrayList<>();
            waiting.add(asker);
            waitingListeners.put(host, waiting);
            resolveOnThread(host);
        }
    }

    /**
     * Parses an IPv4 address of four decimal numbers, without a query; null otherwise. The system's
     * own parser queries the name server for what it cannot parse.
     */
    static InetAddress numeric(String host) {
        if (!host.matches("[0-9]{1,3}(\\.[0-9]{1,3}){3}")) {
            return null;
        }
        final String[] words = host.split("\\.");
        final byte[] bytes = new byte[words.length];
        for (int i = 0; i < words.length; i++) {
            final int number = Integer.parseInt(words[i]);
            if (number > 255) {
                return null;
            }
            bytes[i] = (byte) number;
        }
        try {
            return InetAddress.getByAddress(bytes);
        } catch (UnknownHostException impossible) {
            throw new IllegalStateException(impossible);
        }
    }

    /** Ends the threads; one that waits for a name server ends with the process at the latest. */
    void stop() {
        threads.shutdownNow();
    }

    private void resolveOnThread(final String host) {
        try {
            threads.execute(() -> {
                final Answer answer = query(host);
                loop.post(() -> notifyAllListeners(host, answer));
            });
        } catch (RejectedExecutionException stopped) {
            notifyAllListeners(host, unknown("the loop was stopped"));
        }
    }

    /** Posted separately, so that an exception in one caller does not affect the others. */
    private void notifyAllListeners(String host, Answer answer) {
        for (Asker asker : waitingListeners.remove(host)) {
            notifyListener(asker, answer);
        }
    }

    private void notifyListener(final Asker asker, final Answer answer) {
        loop.post(() -> answer.giveTo(asker));
    }

    private Answer query(String host) {
        try {
            return known(resolver.resolve(host));
        } catch (UnknownHostException error) {
            return unknown("the name " + host + " is not known");
        } catch (RuntimeException error) {
            // Android throws SecurityException without the permission to use the network.
            return unknown("the name " + host + " cannot be looked up: " + error);
        }
    }

    private static Answer known(InetAddress... addresses) {
        return asker -> asker.onAddresses(addresses);
    }

    private static Answer unknown(String reason) {
        return asker -> asker.onUnknown(reason);
    }

    /** Looks up, on the calling thread. */
    interface Resolver {
        InetAddress[] resolve(String host) throws UnknownHostException;
    }

    /** Receives the outcome, on the loop, once. */
    interface Asker {
        void onAddresses(InetAddress[] addresses);

        /** Called when the lookup fails, with the reason. */
        void onUnknown(String reason);
    }

    private interface Answer {
        void giveTo(Asker asker);
    }

    /** Queries the system for a name's addresses: IPv4 first, on which the peers listen. */
    static final class SystemResolver implements NameLookup.Resolver {
        @Override
        public InetAddress[] resolve(String host) throws UnknownHostException {
            final List<InetAddress> others = new ArrayList<>();
            final List<InetAddress> sorted = new ArrayList<>();
            for (InetAddress address : InetAddress.getAllByName(host)) {
                (address instanceof Inet4Address ? sorted : others).add(address);
            }
            sorted.addAll(others);
            return sorted.toArray(new InetAddress[sorted.size()]);
        }
    }
}
