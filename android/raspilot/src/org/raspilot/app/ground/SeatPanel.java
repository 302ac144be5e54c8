package org.raspilot.app.ground;

import android.view.View;
import android.widget.Button;
import android.widget.TextView;

import org.raspilot.app.R;
import org.raspilot.app.view.Texts;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.SeatStanding;

/** Who commands and the state of the link, with the button that requests or leaves the seat. */
public final class SeatPanel implements View.OnClickListener {
    private final TextView link;
    private final TextView seat;
    private final Button take;
    private final Button give;
    private TelemetryService.Ground ground;
    private Integer asker;
    private boolean isOurs;

    public SeatPanel(View root) {
        link = (TextView) root.findViewById(R.id.seat_link);
        seat = (TextView) root.findViewById(R.id.seat_line);
        take = (Button) root.findViewById(R.id.seat_take);
        give = (Button) root.findViewById(R.id.seat_give);
        take.setOnClickListener(this);
        give.setOnClickListener(this);
    }

    /** Sets the ground; null: none. */
    public void setGround(TelemetryService.Ground newGround) {
        ground = newGround;
    }

    public void update(Picture picture) {
        GroundStatus status = picture.status;
        if (status == null) {
            Texts.show(link, link.getResources().getString(R.string.seat_no_service));
            Texts.show(seat, "");
            take.setEnabled(false);
            give.setVisibility(View.GONE);
            return;
        }
        Texts.show(link, linkText(status));
        Texts.show(seat, sentence(status.seatSentence()));
        SeatStanding standing = status.standing;
        isOurs = standing == SeatStanding.OURS;
        asker = isOurs ? status.askedBy : null;
        take.setEnabled(standing != SeatStanding.UNKNOWN && ground != null);
        take.setVisibility(status.isDirect ? View.GONE : View.VISIBLE);
        String text = take.getResources().getString(
                isOurs ? R.string.seat_release : R.string.seat_request);
        Texts.show(take, text);
        give.setVisibility(asker == null ? View.GONE : View.VISIBLE);
        if (asker != null) {
            Texts.show(give, give.getResources().getString(R.string.seat_give, asker));
        }
    }

    @Override
    public void onClick(View button) {
        if (ground == null) {
            return;
        }
        if (button.getId() == R.id.seat_give) {
            if (asker != null) {
                ground.giveSeat(asker);
            }
        } else if (isOurs) {
            ground.releaseSeat();
        } else {
            ground.requestSeat();
        }
    }

    private String linkText(GroundStatus status) {
        String text = sentence(status.linkSentence());
        if (!status.isOpen() || status.isSilent || status.rateHz == null) {
            return text;
        }
        Double wayMs = status.roundTripMs;
        String rate = link.getResources().getString(R.string.seat_rate, status.rateHz,
                status.counters.lostFrames);
        return text + " " + (wayMs == null ? rate : rate + " "
                + link.getResources().getString(R.string.seat_way, Math.round(wayMs)));
    }

    /** Converts a text to a sentence: with a capital and a full stop. */
    public static String sentence(String words) {
        if (words == null || words.isEmpty()) {
            return "";
        }
        String text = words.substring(0, 1).toUpperCase(java.util.Locale.ROOT)
                + words.substring(1);
        return text.endsWith(".") ? text : text + ".";
    }
}
