"""mechaudit audit examples/studies/haversine.toml --exec 'python3 examples/studies/candidates/haversine.py'"""

from math import asin, cos, sin, sqrt

from serve import serve


def distance(lat1, lat2, dlon):
    """The haversine formula."""
    s, t = sin((lat2 - lat1) / 2.0), sin(dlon / 2.0)
    return 2.0 * asin(sqrt(s * s + cos(lat1) * cos(lat2) * t * t))


serve("haversine", distance)
