"""Numbers of a case sought so that the machine shows what was measured, and how sure they are.

``measurement`` the contract of a measurement, ``along_axis`` and ``numbers`` its kinds, ``unknown``
what is sought, ``trial`` a machine with trial values, ``weighing`` differences without tare and
drift, ``problem`` predictions and derivatives, ``search`` the best values.
"""
