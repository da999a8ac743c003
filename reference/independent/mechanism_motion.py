"""Motions of mechanisms by mpmath, from their files: a witness of `mechaudit motion --digits`.

Each body has three coordinates (x, y, θ) of its own frame, each pin two and each slide two equations; accelerations come from
the equations with multipliers (17 unknowns and more), the motion from the extrapolated midpoint rule (Gragg, Bulirsch,
Stoer) at 40 digits. Neither the coordinates nor the method are those of mechaudit.

Usage: python mechanism_motion.py [--check] writes, or compares, mechanism_motion.csv beside it: the quantities of
each example at two times, and of the car axis. `--check` recomputes the first time of one example, which takes seconds.
"""

import csv
import re
import sys
import tomllib
from pathlib import Path

from mpmath import cos, matrix, lu_solve, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 40
ROOT = Path(__file__).resolve().parents[2]
TABLE = Path(__file__).with_suffix(".csv")
EXAMPLES = ["four-bar-damped", "four-bar-spring", "slider-crank-damped", "double-pendulum", "watt-six-bar"]
TIMES = ["0.05", "0.1"]
# Of the paper reference/papers/ivp-test-set.
CAR_AXIS = ["3"]
UNITS = {"m": 1, "cm": mpf(1) / 100, "deg": pi / 180, "kg": 1, "kg m^2": 1, "rad/s": 1, "m/s^2": 1, "N/m": 1}
UNITS |= {"N s/m": 1, "N m s": 1, "N m": 1}


def si(text):
    number, unit = text.split(" ", 1)
    return mpf(number) * UNITS[unit]


def turned(z, angle):
    c, s = cos(angle), sin(angle)
    return (c * z[0] - s * z[1], s * z[0] + c * z[1])


class Moving:
    """A motion of coordinates q with rates w, by their accelerations."""

    def step(self, t, y, h, columns=12):
        """One step of the extrapolated midpoint rule."""
        f = lambda t, y: y[self.n :] + self.accelerations(t, y[: self.n], y[self.n :])
        first, table = f(t, y), []
        for k in range(columns):
            n = 2 * (k + 1)
            d = h / n
            a, b = y, [x + d * v for x, v in zip(y, first)]
            for i in range(1, n):
                v = f(t + i * d, b)
                a, b = b, [x + 2 * d * s for x, s in zip(a, v)]
            v = f(t + h, b)
            row = [[(x + z + d * s) / 2 for x, z, s in zip(a, b, v)]]
            for j in range(k):
                ratio = (mpf(k + 1) / (k - j)) ** 2 - 1
                row.append([x + (x - p) / ratio for x, p in zip(row[j], table[j])])
            table = row
        return table[-1]

class Mechanism(Moving):
    def __init__(self, name):
        f = tomllib.loads((ROOT / f"examples/motion/{name}.toml").read_text())
        self.file = f
        drawn = {k: [si(x) for x in v] for k, v in f.get("points", {}).items()}
        self.names = ["ground"]
        self.points = [{k: [si(x) for x in v] for k, v in f["ground"].get("points", {}).items()}]
        self.points[0] |= {k: drawn[k] for k in f["ground"].get("drawn", [])}
        self.lines, self.mass, self.inertia, self.centre = [mpf(0)], [None], [None], [None]
        for b in f["body"]:
            p = {k: [si(x) for x in v] for k, v in b.get("points", {}).items()}
            line = mpf(0)
            if "ends" in b:
                p[b["ends"][0]], p[b["ends"][1]] = [mpf(0), mpf(0)], [si(b["length"]), mpf(0)]
            if "drawn" in b:
                o = drawn[b["drawn"][0]]
                for k in b["drawn"]:
                    p[k] = [drawn[k][0] - o[0], drawn[k][1] - o[1]]
                x, y = p[b["drawn"][1]]
                line = mp.atan2(y, x)
            self.names.append(b["name"])
            self.points.append(p)
            self.lines.append(line)
            self.mass.append(si(b["mass"]))
            self.inertia.append(si(b.get("inertia", "0 kg m^2")))
            self.centre.append([si(x) for x in b["centre"]])
        self.g = si(f["gravity"])
        self.pins, self.slides = [], []
        for j in f["joint"]:
            if j["kind"] == "pin":
                on = [k for k, p in enumerate(self.points) if j["point"] in p]
                self.pins += [(on[0], b, j["point"]) for b in on[1:]]
            else:
                # Slides along the ground's x axis alone.
                self.slides.append((self.names.index(j["body"]), j["point"], self.points[0][j["through"]], j["name"]))
        self.n = 3 * (len(self.names) - 1)

    def frame(self, q, b):
        return (mpf(0), mpf(0), mpf(0)) if b == 0 else tuple(q[3 * b - 3 : 3 * b])

    def at(self, q, b, z):
        x, y, a = self.frame(q, b)
        u, v = turned(z, a)
        return (x + u, y + v)

    def rows(self, q):
        """Each equation: residual, {coordinate: derivative}, and a function of the rates for the quadratic part."""
        out = []
        for a, b, name in self.pins:
            pa, pb = self.at(q, a, self.points[a][name]), self.at(q, b, self.points[b][name])
            for c in range(2):
                row, quad = {}, []
                for body, sign in ((a, 1), (b, -1)):
                    if body:
                        u = turned(self.points[body][name], self.frame(q, body)[2])
                        row[3 * body - 3 + c] = mpf(sign)
                        row[3 * body - 1] = sign * (-u[1] if c == 0 else u[0])
                        quad.append((3 * body - 1, -sign * u[c]))
                out.append((pa[c] - pb[c], row, quad))
        for body, name, through, _ in self.slides:
            p = self.at(q, body, self.points[body][name])
            u = turned(self.points[body][name], self.frame(q, body)[2])
            out.append((p[1] - through[1], {3 * body - 2: mpf(1), 3 * body - 1: u[0]}, [(3 * body - 1, -u[1])]))
            out.append((self.frame(q, body)[2], {3 * body - 1: mpf(1)}, []))
        return out

    def quantity(self, q, w, t):
        values = {"t": t}
        for b, name in enumerate(self.names[1:], 1):
            values[f"theta_{name}"] = q[3 * b - 1] + self.lines[b]
            values[f"omega_{name}"] = w[3 * b - 1]
        for body, name, through, joint in self.slides:
            p, v = self.point_rate(q, w, body, self.points[body][name])
            values[f"s_{joint}"], values[f"v_{joint}"] = p[0] - through[0], v[0]
        return values

    def point_rate(self, q, w, b, z):
        p = self.at(q, b, z)
        if b == 0:
            return p, (mpf(0), mpf(0))
        u = turned(z, self.frame(q, b)[2])
        return p, (w[3 * b - 3] - w[3 * b - 1] * u[1], w[3 * b - 2] + w[3 * b - 1] * u[0])

    def find(self, text):
        body, _, name = text.rpartition(".")
        for b, p in enumerate(self.points):
            if name in p and (not body or self.names[b] == body):
                return b, p[name]
        raise KeyError(text)

    def accelerations(self, t, q, w):
        n, rows = self.n, self.rows(q)
        f = [mpf(0)] * n

        def push(b, z, force):
            if b:
                u = turned(z, self.frame(q, b)[2])
                f[3 * b - 3] += force[0]
                f[3 * b - 2] += force[1]
                f[3 * b - 1] += u[0] * force[1] - u[1] * force[0]

        def couple(section, torque):
            f[3 * self.names.index(section["body"]) - 1] += torque
            if "from" in section:
                f[3 * self.names.index(section["from"]) - 1] -= torque

        def rate(section):
            w_of = lambda name: w[3 * self.names.index(name) - 1]
            return w_of(section["body"]) - (w_of(section["from"]) if "from" in section else 0)

        k = matrix(n + len(rows), n + len(rows))
        for b in range(1, len(self.names)):
            m, u = self.mass[b], turned(self.centre[b], self.frame(q, b)[2])
            i = 3 * b - 3
            k[i, i] = k[i + 1, i + 1] = m
            k[i, i + 2] = k[i + 2, i] = -m * u[1]
            k[i + 1, i + 2] = k[i + 2, i + 1] = m * u[0]
            k[i + 2, i + 2] = self.inertia[b] + m * (u[0] ** 2 + u[1] ** 2)
            f[i] += m * u[0] * w[i + 2] ** 2
            f[i + 1] += m * u[1] * w[i + 2] ** 2
            push(b, self.centre[b], (mpf(0), -m * self.g))
        for s in self.file.get("torque", []):
            couple(s, si(s["value"]))
        for s in self.file.get("torsion_damper", []):
            couple(s, -si(s["damping"]) * rate(s))
        for s in self.file.get("spring", []) + self.file.get("damper", []):
            (a, za), (b, zb) = map(self.find, s["ends"])
            (p, vp), (r, vr) = self.point_rate(q, w, a, za), self.point_rate(q, w, b, zb)
            d, v = (r[0] - p[0], r[1] - p[1]), (vr[0] - vp[0], vr[1] - vp[1])
            length = sqrt(d[0] ** 2 + d[1] ** 2)
            tension = si(s["stiffness"]) * (length - si(s["length"])) if "stiffness" in s else (
                si(s["damping"]) * (d[0] * v[0] + d[1] * v[1]) / length)
            pull = (d[0] / length * tension, d[1] / length * tension)
            push(a, za, pull)
            push(b, zb, (-pull[0], -pull[1]))
        motion = self.file["motion"]
        for s in motion.get("torque", []):
            known = {name: mpf(value) for name, value in motion.get("parameters", {}).items()}
            known |= self.quantity(q, w, t) | {"sin": sin, "cos": cos}
            # Decimals are read in full.
            text = re.sub(r"(?<![\w.])(\d+\.?\d*)", r"mpf('\1')", s["formula"]).replace("^", "**")
            couple(s, eval(text, {"__builtins__": {}, "mpf": mpf}, known))
        right = matrix(n + len(rows), 1)
        for i in range(n):
            right[i] = f[i]
        for r, (_, row, quad) in enumerate(rows):
            for i, d in row.items():
                k[n + r, i] = k[i, n + r] = d
            right[n + r] = -sum(c * w[i] ** 2 for i, c in quad)
        return list(lu_solve(k, right))[:n]

    def start(self):
        """Newton's method on the pins and the given angles, from the angles near which bodies are."""
        motion = self.file["motion"]
        guess = {name: si(a) for name, a in motion.get("near", {}).items()}
        for name, g in motion["start"].items():
            guess[name] = si(g["at"]) + (guess[g["from"]] if "from" in g else 0)
        q = [mpf(0)] * self.n
        for b, name in enumerate(self.names[1:], 1):
            q[3 * b - 1] = guess.get(name, mpf(0)) - self.lines[b]

        def given(g, name):
            b = self.names.index(name)
            row = {3 * b - 1: mpf(1)}
            off = q[3 * b - 1] + self.lines[b] - si(g["at"])
            if "from" in g:
                a = self.names.index(g["from"])
                row[3 * a - 1] = mpf(-1)
                off -= q[3 * a - 1] + self.lines[a]
            return off, row

        def system(right):
            rows = [(r, row) for r, row, _ in self.rows(q)]
            rows += [given(g, name) for name, g in sorted(motion["start"].items())]
            k, b = matrix(len(rows), self.n), matrix(len(rows), 1)
            for r, (off, row) in enumerate(rows):
                for i, d in row.items():
                    k[r, i] = d
                b[r] = right(r, off, len(rows))
            return lu_solve(k, b)

        for _ in range(30):
            step = system(lambda r, off, n: -off)
            q = [x + s for x, s in zip(q, step)]
            if max(abs(s) for s in step) < mpf(10) ** -35:
                break
        speeds = [si(g.get("speed", "0 rad/s")) for _, g in sorted(motion["start"].items())]
        w = system(lambda r, off, n: speeds[r - n + len(speeds)] if r >= n - len(speeds) else mpf(0))
        return q, list(w)


class CarAxis(Moving):
    """The car axis of the Test Set for Initial Value Problem Solvers: two points with two multipliers."""

    n = 4

    def start(self):
        half = mpf(1) / 2
        return [mpf(0), half, mpf(1), half], [-half, mpf(0), -half, mpf(0)]

    def solved(self, t, q, w):
        """Accelerations and multipliers."""
        m, speed, half = mpf(10) / 10**4 / 2, mpf(10), mpf(1) / 2
        yb, yb1 = sin(speed * t) / 10, speed * cos(speed * t) / 10
        xb = sqrt(1 - yb**2)
        xb1, yb2 = -yb * yb1 / xb, -(speed**2) * yb
        xb2 = -(yb1**2 + yb * yb2 + xb1**2) / xb
        left, right = sqrt(q[0] ** 2 + q[1] ** 2), sqrt((q[2] - xb) ** 2 + (q[3] - yb) ** 2)
        dx, dy = q[0] - q[2], q[1] - q[3]
        k, b = matrix(6, 6), matrix(6, 1)
        forces = [(half - left) * q[0] / left, (half - left) * q[1] / left - m,
                  (half - right) * (q[2] - xb) / right, (half - right) * (q[3] - yb) / right - m]
        for i, (force, row) in enumerate(zip(forces, [(xb, 2 * dx), (yb, 2 * dy), (0, -2 * dx), (0, -2 * dy)])):
            k[i, i], b[i] = m, force
            k[i, 4], k[i, 5] = -row[0], -row[1]
        k[4, 0], k[4, 1] = xb, yb
        b[4] = -(2 * xb1 * w[0] + 2 * yb1 * w[1] + xb2 * q[0] + yb2 * q[1])
        k[5, 0], k[5, 1], k[5, 2], k[5, 3] = dx, dy, -dx, -dy
        b[5] = -((w[0] - w[2]) ** 2 + (w[1] - w[3]) ** 2)
        return list(lu_solve(k, b))

    def accelerations(self, t, q, w):
        return self.solved(t, q, w)[:4]

    def quantity(self, q, w, t):
        names = "xl yl xr yr xl1 yl1 xr1 yr1 lam1 lam2".split()
        return dict(zip(names, [*q, *w, *self.solved(t, q, w)[4:]]), t=t)


def motion(name, times, h):
    m = CarAxis() if name == "car-axis" else Mechanism(name)
    q, w = m.start()
    y, t, out = q + w, mpf(0), []
    for due in times:
        steps = int(mp.ceil((mpf(due) - t) / h))
        d = (mpf(due) - t) / steps
        for _ in range(steps):
            y = m.step(t, y, d)
            t += d
        values = m.quantity(y[: m.n], y[m.n :], t)
        out.append((due, {k: nstr(v, 22) for k, v in values.items() if k != "t"}))
    return out


def main():
    if "--check" in sys.argv:
        with TABLE.open() as f:
            known = {(r["example"], r["t"], r["quantity"]): r["value"] for r in csv.DictReader(f)}
        for time, values in motion("double-pendulum", TIMES[:1], mpf("0.05")):
            for k, v in values.items():
                due = mpf(known["double-pendulum", time, k])
                assert abs(mpf(v) - due) < mpf(10) ** -18 * max(1, abs(due)), (k, v, due)
        print("mechanism_motion.csv: agrees")
        return
    rows = []
    for name in [*EXAMPLES, "car-axis"]:
        times = CAR_AXIS if name == "car-axis" else TIMES
        fine, finer = (motion(name, times, mpf(h)) for h in ("0.025", "0.02"))
        worst = 0
        for (time, a), (_, b) in zip(fine, finer):
            for k in a:
                off = abs(mpf(a[k]) - mpf(b[k])) / max(1, abs(mpf(b[k])))
                worst = max(worst, off)
                rows.append({"example": name, "t": time, "quantity": k, "value": b[k]})
        print(f"{name}: two steps differ by {nstr(worst, 2)}", flush=True)
    with TABLE.open("w", newline="") as f:
        out = csv.DictWriter(f, ["example", "t", "quantity", "value"], lineterminator="\n")
        out.writeheader()
        out.writerows(rows)


if __name__ == "__main__":
    main()
