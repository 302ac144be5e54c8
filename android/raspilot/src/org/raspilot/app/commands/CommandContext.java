package org.raspilot.app.commands;

import android.content.Context;
import java.util.Map;
import org.raspilot.app.commands.Permission.DisabledReason;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.ground.GainsService;

/** The services that a Command's page needs from its screen. Main thread only. */
interface CommandContext {
    /** Returns the source of views and texts. */
    Context context();

    GroundSnapshot picture();

    /** Returns the gains that are known now; null: none. */
    GainsService.Snapshot gains();

    /** Returns what remembers texts, history and gains. */
    CommandsState memory();

    /** Returns why a Command is not offered now. */
    DisabledReason objection(CommandForm form, Map<String, ?> data);

    /** Returns the same as a sentence; empty: it is offered. */
    String objectionText(CommandForm form, Map<String, ?> data);

    /** Sends a Command immediately, with the beacon of the frame that was drawn last. */
    void send(BaseCommand command, String words);

    /** Requests the active gains from the aircraft. */
    void requestGains();

    void setGains(GainSet set);

    /** Sends the set of gains before. */
    void undoGains();

    /** Shows a confirmation; does nothing when the user declines or the screen is closed. */
    void confirm(String title, String text, String yes, Runnable then);
}
