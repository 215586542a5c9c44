"""Many machines: a case solved with many values of its parameters.

A sweep: ``parameter`` is what varies, ``design`` the points (combinations of values), ``point``
solves one of them, ``workers`` distributes them over processes, ``journal`` keeps outcomes on disk
as they come, ``dataset`` joins them in one xarray Dataset, ``solve`` is the call; ``deliver``
writes the folder, with ``summary`` and ``figures``. An ``interval``: ``machines`` with changed
parameters, ``quantiles`` of their results, ``sensitivity``; ``run`` adds it to a run. ``optimum``
searches the best machine, ``identification`` the one that was measured.

Shared: ``read`` reads study files, ``neighbours`` reuses what machines have in common, ``record``
appends lines to a file, ``page`` makes an HTML page of a folder from the ``columns`` of its table.
"""
