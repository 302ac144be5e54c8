package org.raspilot.app;

import android.app.Fragment;

/** The log screen. */
public final class LogFragment extends Fragment {
}
