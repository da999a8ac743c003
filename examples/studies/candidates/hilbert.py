"""mechaudit audit examples/studies/hilbert.toml --exec 'python3 examples/studies/candidates/hilbert.py'"""

from serve import serve


def solution(*numbers):
    """Gaussian elimination with partial pivoting."""
    n = 5
    rows = [list(numbers[n * i : n * i + n]) + [numbers[n * n + i]] for i in range(n)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if rows[k][k] == 0.0:
            raise ValueError("singular")
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return tuple(x)


serve("Gaussian elimination", solution)
