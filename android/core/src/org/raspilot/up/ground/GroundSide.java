package org.raspilot.up.ground;

import java.util.Random;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandExecutor;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.GeneralMessage;

/**
 * The ground's end of the link: telemetry in, Commands out, the seat, and what a screen shows.
 *
 * <p>Only on the loop; what it hands out is immutable and may go to any thread. Source: thesis
 * 4.5.2, docs/protocols.md 4, 6 and 9.
 */
public final class GroundSide implements TelemetrySource {
    /** Period of the checks for changes due to time alone, ms. */
    private static final long TICK_MS = 250;

    private final Loop loop;
    private final GroundSettings settings;
    private final CommandExecutor executor;
    private final GroundListener listener;
    private final GroundLink link;
    private final TelemetryStream stream = new TelemetryStream();
    private final SeenBeacons beacons = new SeenBeacons();
    private final Answers answers;
    private final CommandDesk desk;
    private final GainsDesk gains;
    private final HomeSearch home = new HomeSearch();
    private final Track track = new Track();
    private final EventLog events = new EventLog();
    private final Alarms alarms = new Alarms();
    private final Judge judge = new Judge(events, alarms);
    private final Bulletin bulletin;
    private final SilenceTimer silence;
    private Cancellable tick;

    /**
     * Creates a ground that is not started.
     *
     * @param tokens stores the resume token
     * @param executor runs the handlers of the aircraft's Commands, telemetry included
     * @param random makes ids and varies the waits
     */
    public GroundSide(Loop loop, GroundSettings settings, TokenStore tokens,
            CommandExecutor executor, GroundListener listener, Random random) {
        this.loop = loop;
        this.settings = settings;
        this.executor = executor;
        this.listener = listener;
        bulletin = new Bulletin(listener);
        silence = new SilenceTimer(loop, () -> look(true));
        link = new GroundLink(loop, settings, tokens, new Links(), random);
        answers = new Answers(loop, random);
        desk = new CommandDesk(loop, settings, link, answers, beacons);
        gains = new GainsDesk(loop, (command, shownBeacon, answered) ->
                transmit(command, shownBeacon, answered));
    }

    /** Starts to connect, and reconnects after each loss; no effect when started already. */
    public void start() {
        if (tick == null) {
            judge.forget();
            stream.forget();
            tick();
            link.start();
        }
    }

    /** Closes the link; waiting Commands end with a lost link. */
    public void stop() {
        if (tick != null) {
            tick.cancel();
            tick = null;
            silence.cancel();
            link.stop();
            judge.forget();
            tellChanged();
        }
    }

    /** Retries immediately, for example when the phone's network is back. */
    public void reconnectNow() {
        link.reconnectNow();
    }

    public GroundStatus status() {
        final long nowMs = loop.nowMs();
        final Telemetry newest = stream.newest();
        final GroundStatus.Draft draft = new GroundStatus.Draft();
        draft.link = link.facts();
        draft.isDirect = settings.isDirect;
        draft.rateHz = stream.rateHz(nowMs);
        draft.isSilent = newest.isSilent(nowMs);
        draft.isLate = newest.age.isLate(nowMs);
        draft.role = newest.text("ground.role");
        draft.tuneInFlight = newest.flag("ground.tune_in_flight");
        draft.home = home.home();
        draft.counters = new GroundCounters(draft.link.connections, stream.frames(),
                stream.lost(), draft.link.malformed, link.tooLong(), draft.link.strangeControl,
                answers.strange());
        return new GroundStatus(draft);
    }

    @Override
    public Telemetry telemetry() {
        return stream.newest();
    }

    /** Returns the track of the aircraft. */
    public Track track() {
        return track;
    }

    public EventLog events() {
        return events;
    }

    public Alarms alarms() {
        return alarms;
    }

    public GainsDesk gains() {
        return gains;
    }

    /** Called when the screen has drawn the frame with that beacon; null: without one. */
    public void seen(Long beacon) {
        beacons.seen(beacon);
    }

    /** Sends a Command with the newest beacon that was {@link #seen}. */
    public void send(BaseCommand command, AnswerListener answered) {
        send(command, beacons.newestSeen(), answered);
    }

    /**
     * Sends a Command once, without automatic repetition, or refuses it with a sentence.
     *
     * @param shownBeacon the beacon of the frame that the screen shows, or null
     * @param answered receives the outcome, once
     */
    public void send(BaseCommand command, Long shownBeacon, AnswerListener answered) {
        final GainSet set;
        try {
            set = GainsDesk.gainsOf(command);
        } catch (InvalidCommandException fault) {
            answered.onAnswer(Answer.refused(command.name(), "invalid", fault.getMessage()));
            return;
        }
        if (set == null) {
            transmit(command, shownBeacon, answered);
        } else {
            gains.set(set, shownBeacon, answered);
        }
        tellChanged();
    }

    /** Requests the seat; a free one is granted immediately. Returns false without a link. */
    public boolean requestSeat() {
        return link.requestSeat();
    }

    /** Hands the seat to the listener with that number. False: it is not ours. */
    public boolean giveSeat(int to) {
        return link.giveSeat(to);
    }

    /** Leaves the seat free. False: it is not ours. */
    public boolean releaseSeat() {
        return link.releaseSeat();
    }

    /** Discards the request for the seat: the pilot keeps it. */
    public void dismissSeatAsk() {
        link.dismissAsk();
    }

    private void transmit(final BaseCommand command, Long shownBeacon,
            final AnswerListener answered) {
        final GainSet set = command.data().containsKey("pids")
                ? GainsDesk.gainsOf(command) : null;
        final String words = set == null ? CommandWords.of(command) : CommandWords.ofGains(
                GainsDesk.difference(gains.snapshot().flying, set));
        final boolean isQuiet = Answers.isRequest(command);
        desk.send(command, shownBeacon, answer -> {
            if (answer.outcome != Answer.Outcome.REFUSED && !(isQuiet && answer.isAck())) {
                events.note(loop.nowMs(),
                        answer.isAck() ? EventLevel.INFO : EventLevel.WARNING,
                        set == null ? "command" : "gains",
                        CommandWords.outcome(words, answer));
            }
            answered.onAnswer(answer);
            tellChanged();
        });
    }

    private void onFrame(GeneralMessage message) {
        final long nowMs = loop.nowMs();
        final Telemetry frame = stream.take(message, nowMs);
        beacons.onFrame(frame);
        home.take(frame);
        track.take(frame, home.home(), nowMs);
        silence.watch(frame, nowMs);
        judge.onFrame(frame, status(), nowMs);
        executor.executeCommand(new BaseCommand(message));
        listener.onTelemetry(frame);
        if (bulletin.isNews(frame, nowMs)) {
            tellStatus();
        }
        if (desk.standing() == SeatStanding.OURS && !frame.isSilent(nowMs)) {
            gains.onMoment();
        }
        tellChanged();
    }

    private void tick() {
        tick = loop.schedule(TICK_MS, () -> {
            tick();
            look(bulletin.isDue(loop.nowMs()));
        });
    }

    /** Updates the alarms and events and reports the changes. */
    private void look(boolean isStatusDue) {
        judge.onMoment(stream.newest(), status(), loop.nowMs());
        if (isStatusDue) {
            tellStatus();
        }
        tellChanged();
    }

    private void tellStatus() {
        bulletin.tell(status(), loop.nowMs());
    }

    private void tellChanged() {
        bulletin.tellChanged(track.version() + events.version() + alarms.snapshot().version
                + gains.version());
    }

    private final class Links implements LinkListener {
        @Override
        public void onMessage(GeneralMessage message) {
            if (message.name.equals(Telemetry.NAME)) {
                onFrame(message);
                return;
            }
            if (message.name.equals(GainsDesk.VALUES) && !gains.told(message.data)) {
                events.note(loop.nowMs(), EventLevel.WARNING, "gains",
                        "the aircraft told gains that are no whole set");
            }
            answers.take(message);
            executor.executeCommand(new BaseCommand(message));
            tellChanged();
        }

        @Override
        public void onOpened() {
            stream.onRoundTrip(link.facts().roundTripMs);
            gains.want();
        }

        @Override
        public void onLost(String reason) {
            beacons.onLost();
            silence.cancel();
            if (stream.newest() != Telemetry.NOTHING) {
                listener.onTelemetry(stream.onLost());
            }
            answers.lost();
        }

        @Override
        public void onLink() {
            judge.onLink(status(), loop.nowMs());
            look(true);
        }
    }
}
