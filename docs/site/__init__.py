"""The documentation as a site: documents as they are, and pages made by running and by reading.

``scripts/site`` builds it into ``out/site``.
"""
