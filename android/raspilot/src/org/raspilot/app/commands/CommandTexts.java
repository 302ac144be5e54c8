package org.raspilot.app.commands;

import android.content.res.Resources;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.ground.ControlPanel;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.CommandGate.DisabledReason;
import org.raspilot.up.ground.FlightModes;
import org.raspilot.up.ground.Freshness;

/** The texts of the Commands: groups, objections, and requests. */
public final class CommandTexts {
    private CommandTexts() {
    }

    /** Returns the displayed title of a Command; its name if it has no title. */
    static String title(String name) {
        return org.raspilot.up.ground.CommandTexts.title(name);
    }

    static int group(CommandGroup group) {
        switch (group) {
            case FLIGHT:
                return R.string.commands_flight;
            case BOARD:
                return R.string.commands_board;
            case DATA:
                return R.string.commands_data;
            case PHONE:
                return R.string.commands_phone;
            default:
                return R.string.commands_other;
        }
    }

    /** Returns a Command with its data, as a question and as a line of the history has it. */
    static String asked(String name, Map<String, ?> data) {
        StringBuilder all = new StringBuilder(title(name));
        for (Map.Entry<String, ?> field : data.entrySet()) {
            all.append(all.indexOf(":") < 0 ? ": " : ", ");
            all.append(field.getKey()).append(' ').append(field.getValue());
        }
        return all.toString();
    }

    /** Returns an objection as a sentence, or an empty text. */
    public static String objection(Resources words, DisabledReason objection, GroundSnapshot picture) {
        switch (objection) {
            case NONE:
                return "";
            case NO_LINK:
                return words.getString(R.string.why_no_link);
            case NO_AIRCRAFT:
                return words.getString(R.string.why_no_aircraft);
            case NO_SESSION:
                return picture.status == null ? ""
                        : ControlPanel.sentence(picture.status.securityText());
            case CONTROL_FREE:
                return words.getString(R.string.why_control_free);
            case CONTROL_TAKEN:
                return words.getString(R.string.why_control_held);
            case LISTENING:
                return words.getString(R.string.why_listening);
            case ROLE:
                String role = picture.status == null ? "" : picture.status.commandRole;
                return words.getString(R.string.why_role, role);
            case SILENT:
                return words.getString(R.string.why_silent);
            case ARMED:
                return words.getString(R.string.why_armed);
            case ARMED_ALREADY:
                return words.getString(R.string.why_armed_already);
            default:
                return words.getString(R.string.why_disarmed_already);
        }
    }

    /** Returns the current notes for the form of a Command, or an empty text. */
    static String now(Resources words, String name, GroundSnapshot picture) {
        if (name.equals("up.flight_mode.set")) {
            return words.getString(R.string.commands_now, mode(words, picture));
        }
        if (name.equals("up.telemetry.frequency") && picture.status != null
                && picture.status.rateHz != null) {
            double rateHz = picture.status.rateHz;
            return words.getString(R.string.commands_period_now, Math.round(1000 / rateHz),
                    rateHz);
        }
        if (name.equals("android.speak")) {
            Boolean isThere = picture.telemetry.flag("android.connected");
            return Boolean.FALSE.equals(isThere)
                    ? words.getString(R.string.commands_no_phone) : "";
        }
        return "";
    }

    /** Returns a flight mode as its button shows it; {@code code}: why it is not offered, or null. */
    public static String mode(Resources words, String mode, String code) {
        return code == null ? mode
                : words.getString(R.string.mode_why, mode, FlightModes.reason(code));
    }

    private static String mode(Resources words, GroundSnapshot picture) {
        String mode = FlightModes.acting(picture.telemetry);
        boolean isLive = picture.telemetry.freshness("flight_mode", picture.nowMs)
                == Freshness.LIVE;
        return isLive && mode != null ? mode : words.getString(R.string.commands_not_known);
    }
}
