"""From checked entries to the frozen descriptions of ``machine`` and ``analysis``."""
