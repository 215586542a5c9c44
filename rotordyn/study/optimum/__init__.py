"""The best machine for stated goals within stated limits.

``criterion`` reads numbers of a solved case, ``goals`` holds goals and limits on them, ``problem``
the choices and the evaluation of one of them, ``trials`` those made so far, kept on disk,
``search`` chooses the next ones, ``front`` the trade-off of two goals, ``solve`` is the call;
``deliver`` writes the folder, with ``summary``, tables and ``figures``; ``page`` its HTML page.
"""
