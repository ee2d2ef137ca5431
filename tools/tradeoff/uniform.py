# SPDX-License-Identifier: MIT
"""The fewest samples along a pixel's side that hold an error: what goals are compared with.
Between sides of the grid they are found by halves, as if more samples were never more wrong."""

# More samples than these along a side are not tried.
LARGEST = 64


def side_that_holds(error, tried, rmse_of):
    """The side, None where none up to LARGEST holds.  `tried` maps sides to their RMSE and is added
    to, by `rmse_of(side)`."""
    def holds(side):
        if side not in tried:
            tried[side] = rmse_of(side)
        return tried[side] <= error

    high = next((side for side in sorted(tried) if holds(side)), None)
    while high is None:
        side = min(2 * max(tried), LARGEST) if tried else 1
        if holds(side):
            high = side
        elif side == LARGEST:
            return None
    low = max((side for side in tried if side < high), default=0)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if holds(middle) else (middle, high)
    return high
