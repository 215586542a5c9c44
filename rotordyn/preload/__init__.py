"""The axial arrangement of shaft, sleeves, springs and stops, and its state at every speed.

``growth``, ``shortening`` and ``mounting`` go into the ``arrangement``, whose forces are a
``network`` and whose balance is its ``equilibrium``; with ``stops`` it gives the ``state``, counted
from the machine ``as_assembled``, of several machines ``together``. ``friction`` adds what the
``history`` leaves, ``under_load`` loads across the axis by the ``balance`` of shaft and bearings,
found by ``balance_search``.
``heat_balance`` and ``on_films`` repeat all that until temperatures or films agree with it,
``warming`` does as the spindle warms up.
``axial_force`` and ``ring_stress`` follow from it, ``play`` is a quicker way for identification.
A history has bearings as ``axial_tables``, ``play`` as ``axial_curves``; both know their
``axial_ends``.
"""
