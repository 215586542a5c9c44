"""The documentation as a web site: the documents, and pages made from runs and docstrings.

``scripts/site`` builds it into ``out/site``.
"""
