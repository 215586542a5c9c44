"""The axial arrangement of shaft, sleeves, springs and stops, and its state at every speed.

``growth``, ``shortening`` and ``mounting`` enter the ``arrangement``, whose forces are a
``network`` and whose balance is its ``equilibrium``; with ``stops`` it gives the ``state``, which
refers to the machine ``as_assembled``; ``together`` solves several machines at once. ``friction``
adds what remains of the ``history``, ``under_load`` adds loads across the axis by the ``balance``
of shaft and bearings, solved by ``balance_search``. ``heat_balance`` and ``on_films`` repeat these
steps until temperatures or films agree with the state, ``warming`` follows it in time.
``axial_force`` and ``ring_stress`` are computed from the state; ``play`` is a faster method for
identification. A history represents bearings by ``axial_tables``, ``play`` by ``axial_curves``;
both use ``axial_ends``.
"""
