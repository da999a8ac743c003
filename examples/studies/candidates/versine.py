"""mechaudit audit 'examples/studies/textbook.fpcore#versine' --exec 'python3 examples/studies/candidates/versine.py'"""

from math import sin

from serve import serve

serve("half angle", lambda x: 2.0 * sin(x / 2.0) ** 2)
