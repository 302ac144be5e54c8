"""Where the pilot's sticks come from: a script, a keyboard, a game controller, a circling pilot."""
