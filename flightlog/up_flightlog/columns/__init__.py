"""A flight as columns, made once from its log: what a page needs to draw any window quickly."""
