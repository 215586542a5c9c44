"""Results as one HTML page: verdict, machine, inputs, what every analysis shows, where it is from.

``whole`` joins the sections; ``machine``, ``inputs``, ``variants`` and ``origin`` are its own,
``asked`` asks the analyses.
"""

REPORT = "report.html"  # in a results folder
