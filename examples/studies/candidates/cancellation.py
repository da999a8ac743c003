"""mechaudit audit examples/studies/cancellation.toml --exec 'python3 examples/studies/candidates/cancellation.py'"""

from math import sqrt

from serve import serve

serve("quotient of square roots", lambda x: 1.0 / (sqrt(x + 1.0) + sqrt(x)))
