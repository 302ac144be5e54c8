package org.raspilot.app.commands;

import android.content.Context;
import android.view.LayoutInflater;
import android.view.View;
import android.widget.TextView;
import org.raspilot.app.R;
import org.raspilot.up.commands.BaseCommand;

/** The form of one Command, while it is open. Main thread only. */
abstract class Page {
    final CommandsScreen desk;
    final View element;

    Page(CommandsScreen desk, int layout) {
        this.desk = desk;
        element = LayoutInflater.from(desk.context()).inflate(layout, null);
    }

    /** Shows the current state: offered Commands, active gains. */
    abstract void update();

    final TextView text(int id) {
        return (TextView) element.findViewById(id);
    }

    /** Sends the Command after a confirmation of these words. */
    final void confirm(BaseCommand command, String words) {
        Context context = desk.context();
        desk.confirm(context.getString(R.string.commands_send_question), words,
                context.getString(R.string.commands_send), () -> desk.send(command, words));
    }
}
