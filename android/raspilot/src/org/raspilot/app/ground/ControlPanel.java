package org.raspilot.app.ground;

import android.content.res.Resources;
import android.view.View;
import android.widget.Button;
import android.widget.TextView;
import org.raspilot.app.R;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.ground.ControlStatus;
import org.raspilot.up.ground.GroundStatus;

/** The owner of control and the state of the link, with the buttons for control. */
public final class ControlPanel {
    private final TextView link;
    private final TextView seat;
    private final Button take;
    private final Button give;
    private TelemetryService.Ground ground;
    private Integer asker;
    private boolean isOurs;

    public ControlPanel(View root) {
        link = (TextView) root.findViewById(R.id.control_link);
        seat = (TextView) root.findViewById(R.id.control_line);
        take = (Button) root.findViewById(R.id.control_take);
        give = (Button) root.findViewById(R.id.control_give);
        take.setOnClickListener(pressed -> take());
        give.setOnClickListener(pressed -> give());
    }

    /** Sets the ground; null: none. */
    public void setGround(TelemetryService.Ground newGround) {
        ground = newGround;
    }

    public void update(GroundSnapshot picture) {
        GroundStatus status = picture.status;
        if (status == null) {
            String fault = ground == null ? "" : sentence(ground.fault());
            TextViews.show(link, fault.isEmpty()
                    ? link.getResources().getString(R.string.control_no_service) : fault);
            TextViews.show(seat, "");
            take.setEnabled(false);
            give.setVisibility(View.GONE);
            return;
        }
        TextViews.show(link, linkText(status));
        TextViews.show(seat, controlText(status));
        ControlStatus standing = status.control;
        isOurs = standing == ControlStatus.OURS;
        asker = isOurs ? status.requestedBy : null;
        take.setEnabled(standing != ControlStatus.UNKNOWN && ground != null);
        take.setVisibility(status.isDirect ? View.GONE : View.VISIBLE);
        String text = take.getResources().getString(
                isOurs ? R.string.control_release : R.string.control_request);
        TextViews.show(take, text);
        give.setVisibility(asker == null ? View.GONE : View.VISIBLE);
        if (asker != null) {
            TextViews.show(give, give.getResources().getString(R.string.control_give, asker));
        }
    }

    private void give() {
        if (ground != null && asker != null) {
            ground.giveControl(asker);
        }
    }

    private void take() {
        if (ground == null) {
            return;
        }
        if (isOurs) {
            ground.releaseControl();
        } else {
            ground.requestControl();
        }
    }

    private String linkText(GroundStatus status) {
        Resources words = link.getResources();
        boolean isCurrent = status.isOpen() && !status.isSilent
                && !Boolean.FALSE.equals(status.isAircraftOnline);
        String text = isCurrent ? words.getString(R.string.control_connected)
                : sentence(status.linkText());
        if (!status.isOpen()) {
            return text;
        }
        if (status.keyFault.isEmpty()) {
            text += " " + (!status.keyName.isEmpty() ? sentence(status.securityText())
                    : words.getString(status.isTls ? R.string.control_tls : R.string.control_plain));
        }
        if (status.isSilent || status.rateHz == null) {
            return text;
        }
        Double wayMs = status.roundTripMs;
        String rate = words.getString(R.string.control_rate, status.rateHz,
                status.lostFrames);
        return text + " " + (wayMs == null ? rate : rate + " "
                + words.getString(R.string.control_way, Math.round(wayMs)));
    }

    private String controlText(GroundStatus status) {
        Resources words = seat.getResources();
        switch (status.control) {
            case OURS:
                return status.isDirect ? words.getString(R.string.control_direct)
                        : status.requestedBy == null ? words.getString(R.string.control_ours)
                        : words.getString(R.string.control_asked, status.requestedBy);
            case FREE:
                return words.getString(R.string.control_free);
            case HELD:
                return words.getString(R.string.control_held, status.owner);
            case LATER:
                return words.getString(R.string.control_listening);
            default:
                return words.getString(R.string.control_unknown);
        }
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
