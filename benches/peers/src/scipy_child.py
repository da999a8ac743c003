"""Serves scipy.special.wofz over standard input and output, as asked by scipy.rs.

Start: one line with the version. Then requests of 8 bytes, the number n of values, and n complex
numbers; each answered by 8 bytes, the nanoseconds of processor time that wofz took, and n complex
numbers. Little-endian; the end of the input ends the program.
"""

import sys
import time

import numpy
import scipy
from scipy.special import wofz

numpy.seterr(all="ignore")
requests, answers = sys.stdin.buffer, sys.stdout.buffer
answers.write(f"scipy {scipy.__version__}, numpy {numpy.__version__}\n".encode())
answers.flush()
while len(head := requests.read(8)) == 8:
    n = int.from_bytes(head, "little")
    z = numpy.frombuffer(requests.read(16 * n), dtype="<c16")
    w = numpy.empty_like(z)
    start = time.thread_time_ns()
    wofz(z, out=w)
    taken = time.thread_time_ns() - start
    answers.write(taken.to_bytes(8, "little"))
    answers.write(w.tobytes())
    answers.flush()
