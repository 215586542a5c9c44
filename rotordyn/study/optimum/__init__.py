"""The best machine for stated goals within stated limits.

``criterion`` what is read of a solved case, ``goals`` and limits on it, ``problem`` the choices and
what a trial of one comes to, ``trials`` those made so far, on disk as they come, ``search`` which
are made next, ``front`` the trade-off of two goals, ``solve`` the call; ``deliver`` writes its
folder: ``summary`` and tables, ``figures``; ``page`` shows it.
"""
