"""The dynamic preload state of every bearing, spring and stop."""
