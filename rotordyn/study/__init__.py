"""Many machines: a case solved at many points of what is varied in it.

A sweep: ``parameter`` what is varied, ``design`` which points, ``point`` one of them solved,
``workers`` who solves, ``journal`` outcomes on disk as they come, ``dataset`` all of them as one
xarray Dataset, ``solve`` the call; ``deliver`` writes its folder: ``summary``, ``figures``.
An ``interval``: ``machines`` that are off, ``quantiles`` of what they come to, ``sensitivity``;
``run`` joins it to a run. ``optimum`` the best machine, ``identification`` the one measured.

Shared: ``read`` the door for files, ``neighbours`` what machines have in common, ``record`` lines
on disk, ``page`` the page of any folder from the ``columns`` of its table.
"""
