"""Tolerances and step limits of the bearing solver."""

from __future__ import annotations

TOLERANCE = 1e-11  # of the largest ball load (ball balance) and ring load (ring balance)
ROUNDING = 16.0  # roundings of the lengths, tolerated in addition
SLOW = 2e-9  # of the distance of the centres: a ball that Fc presses in less counts as at rest
LIGHT = 1.0  # N or N·m: a load below it overloads nothing
TOGETHER = 8000  # balls in one batch, so that its arrays stay in the cache of the processor

# contacts of a solved state
LEAST = 0.5  # share of an approach that a step leaves at least
IDLE = 64.0  # roundings of the lengths: a smaller approach of a ball at rest counts as none

# linear equations of a ring
PLAINLY_REGULAR = 1e-14  # determinant of K over its largest entry
SINGULAR = 1e-13  # least singular value of K over its largest entry: there it is rounding
NEUTRAL = 1e-13  # the same, below which a motion of the ring counts as unrestrained

# first stage
CONVEX_STEPS = 100
SEAT_STEPS = 200  # of one ball
HALVINGS = 40
BALANCED = 1e-6  # of the loads: enough to start the second stage from
LET_DOWN = 100.0  # factor between the loads of two stages on the way to a light one
SOFTEST = 1e-7  # of the ring's stiffness, added to it while the whole load is unbalanced
HARDEST = 1e-4  # least share of that, added to the end
SOFT = 1e-13  # of a bearing's stiffness at an approach of BD/1000, added for unrestrained motions
LONGEST_STEP = 0.2  # of the free distance

# second stage
NEWTON_STEPS = 5  # more lead to other states across a fold
QUICK_STEPS = 3  # a stride that took no more is followed by a longer one
ON_THE_WAY = 1e-7  # scaled residual of a state that is only followed further
FIRST_BLEND = 0.5  # tried from the convex problem
MOST_STRIDES = 1000  # of one path; no solved state of thousands of random thrust bearings took 300
SHORTEST_BLEND = 2.0**-17  # paths of light balls may begin steeply
LONGEST_TURN = 0.15  # rad, largest turn of the vector from a ball to a groove middle in one stride
JUMP = 1e-5  # of the largest ball load: sudden change of the moment of a ball that is accepted

# free motions on the way
FIRST_FREE = 1e-4  # stride after a free motion
MOST_FREE_MOTIONS = 4  # of one state
FADING = 1e-2  # of the largest inner load: a smaller one vanishes in the next stride
TOUCHING = 1e-3  # of the largest inner load: load of the ball that makes contact
HELD = 1e-9  # of the largest singular value: a smaller one restrains nothing

# the words about a state
CRUSHED = 3e10  # Pa: no contact is elastic there by far, and an approach is no small part of a ball
PERMANENT = 4.2e9  # Pa: ISO 76, the pressure that leaves a ten-thousandth of the ball diameter
GROSS = 0.3  # friction that no lubricated contact gives
IMPOSSIBLE = 1.0  # Mg/D over the load of a race, above which a ball is thrown off
