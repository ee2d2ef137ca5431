# SPDX-License-Identifier: MIT
"""Finds the fewest N x N samples per pixel that meet an error. Bisects between the measured values
of N, and assumes that more samples never increase the error."""

# The largest N to try.
LARGEST = 64


def next_power(side):
    """Returns the smallest power of 2 that is at least `side`."""
    return 1 << (side - 1).bit_length()


def side_of(row):
    """Returns N of a uniform setting."""
    return int(row["setting"][len("aa="):])


def side_that_holds(error, tried, rmse_of):
    """Returns the smallest N that meets the error, or None if even LARGEST does not. `tried` maps N
    to its RMSE. Adds values from `rmse_of(N)` to `tried`."""
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
