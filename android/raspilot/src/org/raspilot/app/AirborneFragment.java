package org.raspilot.app;

import android.app.Fragment;

/** The airborne screen. */
public final class AirborneFragment extends Fragment {
}
