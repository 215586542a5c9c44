"""Many machines: a case solved at many points of what is varied in it.

``parameter`` what is varied, ``design`` which points, ``point`` one of them solved, ``journal``
results on disk as they come, ``workers`` who solves, ``dataset`` all of them as one xarray Dataset,
``solve`` the call that joins these, ``optimum`` the best of them, ``page`` the page of a folder.
"""
