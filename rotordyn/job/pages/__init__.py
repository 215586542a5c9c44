"""Results as one HTML page: verdict, machine, inputs, blocks of every analysis, provenance.

``whole`` joins the sections; ``machine``, ``inputs``, ``variants`` and ``origin`` are its own,
``asked`` asks the analyses.
"""

REPORT = "report.html"  # in a results folder
