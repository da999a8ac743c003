"""mechaudit audit examples/studies/quadratic.toml --exec 'python3 examples/studies/candidates/quadratic.py'"""

from math import sqrt

from serve import serve

serve("Vieta's rule", lambda b, c: c / (b + sqrt(b * b - c)))
