"""Modes over speed: followed, named, their critical speeds and errors."""
