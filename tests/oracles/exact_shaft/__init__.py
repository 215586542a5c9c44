"""The stepped Timoshenko rotor without discretisation: a truth to measure elements against.

``bending`` asks it for a whole machine: poles, shapes and receptances. ``count`` tells how many
modes lie below a frequency, proven.
"""
