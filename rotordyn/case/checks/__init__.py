"""What no single value shows: names that must exist, order, geometry that must fit together.

Every check takes an entry (possibly with unknown values: NaN, empty names), the tree it was read
from and the faults to add to; none of them raises.
"""
