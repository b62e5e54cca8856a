"""What the two forms of the ridge scan on tables have in common: when an interval of thrust is settled."""

CLEAR, FOUND, UNCLEAR = 0, 1, 2  # outcomes of an interval
STABLE, FLUTTER, DIVERGENCE, UNDECIDED = 0, 1, 2, 3  # of a vehicle

RIDGES = 20  # at most
DIP = 0.5  # a ridge is looked at again that dips below this share of its height at both ends
SMALL = 1e-3  # heights below this share of the ridge's greatest are zero to the error of interpolation
FLAT = 1e-9  # and below this one to rounding
BORDER = 1e-6  # share of the thrust that separates two instabilities
SLACK = 1e-2  # share of the rise and fall in an interval by which a cubic may miss the ridge between its ends
NEAR = 0.25  # share of the step by which interpolation may be wrong
NARROW = 1e-7  # share of the panel below which an interval is not halved
HALVINGS = 48  # of intervals, for one vehicle
NEWTON = 12
ROUNDING = 5e-14  # of D, as a share of the sum of its Chebyshev coefficients
