package org.raspilot.app.commands;

import android.view.View;

/** The form of one Command, while it is open. Main thread only. */
interface Page {
    View element();

    /** Shows the current state: offered Commands, active gains. */
    void update();
}
