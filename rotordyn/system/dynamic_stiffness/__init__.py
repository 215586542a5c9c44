"""Bending of rotors on their supports by dynamic stiffness, frequency by frequency, without modes.

What lies between the places where something acts, or is asked for, is eliminated exactly, and the
few equations left are solved. With supports that answer alike in all directions forward and
backward whirl are apart, and ω has either sign; otherwise the two planes stand side by side.
"""
