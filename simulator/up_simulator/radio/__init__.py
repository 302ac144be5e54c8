"""Sources of the pilot's sticks: a script, a keyboard, a game controller, a circling pilot."""
