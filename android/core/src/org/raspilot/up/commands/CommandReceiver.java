package org.raspilot.up.commands;

import java.util.HashMap;
import java.util.Map;
import java.util.WeakHashMap;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.SafeText;

/**
 * The mediator between a link and the bus: reads, validates, executes, answers (thesis 4.1.4).
 *
 * <p>A Command with an id is answered once; the same id with the same content is answered again
 * and not executed again (the newest 256 ids of 60 s of a link). Source: docs/protocols.md 4.
 */
public final class CommandReceiver {
    private static final int MAX_REASON_LENGTH = 500;
    private static final int SHOWN_NAME = 64;
    private static final String FAILED = "carrying it out failed; the log says where";

    private final CommandRegistry registry;
    private final CommandExecutor executor;
    private final Loop loop;
    private final Map<AnswerSink, AnswerCache> memories =
            new WeakHashMap<>();
    private final Map<String, Long> counts = new HashMap<>();

    /** Creates a receiver for the links of one loop. */
    public CommandReceiver(CommandRegistry registry, CommandExecutor executor, Loop loop) {
        this.registry = registry;
        this.executor = executor;
        this.loop = loop;
    }

    /** Takes one line of a link, without its line end. */
    public void receiveLine(byte[] line, int length, AnswerSink answers) {
        GeneralMessage message;
        try {
            message = GeneralMessage.read(line, length);
        } catch (MalformedException malformed) {
            refuse(malformed.id, answers, NackCode.MALFORMED, malformed.reason());
            return;
        }
        receive(message, answers);
    }

    public void receive(final GeneralMessage message, final AnswerSink answers) {
        addOne("received");
        if (isRepeated(message, answers)) {
            addOne("repeated");
            return;
        }
        String name = message.name;
        if (!registry.knows(name) && !executor.hasHandlers(name)) {
            refuse(message.id, answers, NackCode.UNKNOWN,
                    "no Command '" + SafeText.of(name, SHOWN_NAME) + "'");
            return;
        }
        BaseCommand command;
        try {
            command = registry.read(message);
        } catch (InvalidCommandException fault) {
            refuse(message.id, answers, NackCode.INVALID,
                    registry.primaryName(name) + ": " + fault.getMessage());
            return;
        } catch (RuntimeException fault) {
            // A Command of an application costs this message and not the link.
            refuse(message.id, answers, NackCode.FAILED, FAILED);
            reportFault(fault);
            return;
        }
        executor.execute(command, (handlers, fault) -> conclude(message, answers, handlers, fault));
    }

    /**
     * Returns the number of messages with an outcome: {@code received}, {@code repeated} or the
     * word of a {@link NackCode}.
     */
    public long count(String what) {
        Long count = counts.get(what);
        return count == null ? 0 : count;
    }

    /** Throw it where the loop reports it to its listener. */
    private void reportFault(final RuntimeException fault) {
        loop.post(() -> {
            throw fault;
        });
    }

    private boolean isRepeated(GeneralMessage message, AnswerSink answers) {
        if (message.id == null) {
            return false;
        }
        AnswerCache.Entry known = memory(answers).add(message, loop.nowMs());
        if (known != null && known.answer != null) {
            answers.answer(known.answer);
        }
        return known != null;
    }

    private void conclude(GeneralMessage message, AnswerSink answers, int handlers,
            Throwable fault) {
        if (fault instanceof CommandRefusedException) {
            CommandRefusedException refusal = (CommandRefusedException) fault;
            refuse(message.id, answers, refusal.code, refusal.reason());
        } else if (fault != null) {
            refuse(message.id, answers, NackCode.FAILED, FAILED);
        } else if (handlers == 0) {
            refuse(message.id, answers, NackCode.UNAVAILABLE,
                    "no handler for " + message.name);
        } else if (message.id != null) {
            answer(message.id, answers, Commands.ack(message.id));
        }
    }

    private void refuse(String id, AnswerSink answers, NackCode code, String reason) {
        addOne(code.word());
        if (id != null) {
            answer(id, answers, Commands.nack(id, code.word(),
                    SafeText.of(String.valueOf(reason), MAX_REASON_LENGTH)));
        }
    }

    private void answer(String id, AnswerSink answers, BaseCommand answer) {
        memory(answers).setAnswer(id, answer.toMessage());
        answers.answer(answer.toMessage());
    }

    private AnswerCache memory(AnswerSink answers) {
        AnswerCache memory = memories.get(answers);
        if (memory == null) {
            memory = new AnswerCache();
            memories.put(answers, memory);
        }
        return memory;
    }

    private void addOne(String what) {
        counts.put(what, count(what) + 1);
    }

    /**
     * Receives the answers to the Commands of one link; one object for the whole life of the link.
     *
     * <p>The receiver remembers ids by this object, so it outlives the link's connections.
     */
    public interface AnswerSink {
        /** Sends an {@code up.ack} or {@code up.nack} if possible. */
        void answer(GeneralMessage answer);
    }
}
