"""What is warned of points and frames."""


class CurveWarning(UserWarning):
    """Points or frames of a curve that are probably not what was meant."""
