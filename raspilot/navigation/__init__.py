"""The mathematics of navigation: no module, no Twisted."""
