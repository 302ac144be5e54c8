"""Mathematics of navigation: estimation and path control. No Twisted."""
