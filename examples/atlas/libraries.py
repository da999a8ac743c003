"""w(z) by libraries that Python reaches: candidates for `mechaudit audit reference/atlas/w.toml --exec`.

    python3 libraries.py NAME            reads "re,im" in hexadecimal, writes a line for each

Ends with 3 where the library is not installed. astropy and lmfit have the profile alone: Re w, with sigma and gamma so
that the profile's argument is z (sigma = 1/sqrt 2 is rounded: up to an ulp of Re z is theirs). mht is N. Stolarczyk's
spectral-line-shapes, whose folder Python has to be on PYTHONPATH; numba compiles it. numba-scipy has no w: its
functions are those of real arguments.
"""

import ctypes
import ctypes.util
import importlib.metadata
import math
import os
import sys

SQRT_PI = math.sqrt(math.pi)


def scipy():
    from scipy.special import wofz

    return wofz, importlib.metadata.version("scipy")


def libcerf():
    path = ctypes.util.find_library("cerf")
    if path is None:
        raise ImportError("libcerf")
    library = ctypes.CDLL(path)
    for name in ("re_w_of_z", "im_w_of_z"):
        function = getattr(library, name)
        function.restype = ctypes.c_double
        function.argtypes = [ctypes.c_double, ctypes.c_double]
    w = lambda z: complex(library.re_w_of_z(z.real, z.imag), library.im_w_of_z(z.real, z.imag))
    return w, loaded(path)


def loaded(name):
    """The file that the loader took, which has the version in its name; on Linux."""
    try:
        with open("/proc/self/maps") as maps:
            files = {line.split()[-1] for line in maps if name.split(".so")[0] in line}
    except OSError:
        files = set()
    return os.path.basename(os.path.realpath(min(files))) if files else name


def mpmath():
    import mpmath as mp

    mp.mp.dps = 15

    def w(z):
        try:
            z = mp.mpc(z)
            return complex(mp.exp(-z * z) * mp.erfc(mp.mpc(0, -1) * z))
        except (OverflowError, ValueError, mp.libmp.NoConvergence):
            return complex(math.nan, math.nan)

    return w, mp.__version__ + " at 15 digits"


def jax():
    import jax as package

    package.config.update("jax_enable_x64", True)
    from jax.scipy.special import wofz

    function = package.jit(wofz)
    return lambda z: complex(function(z)), package.__version__


def astropy():
    import astropy as package
    from astropy.modeling.models import Voigt1D

    # z = (2 x + i fwhm_L) sqrt(ln 2)/fwhm_G: the widths make the factor one.
    width = 2 * math.sqrt(math.log(2))

    def w(z):
        if z.imag == 0:
            # The profile of no Lorentzian width is no profile here.
            return math.nan
        profile = Voigt1D(x_0=0.0, amplitude_L=1.0, fwhm_L=2 * z.imag, fwhm_G=width)
        return float(profile(z.real)) / (SQRT_PI * z.imag)

    return w, package.__version__


def lmfit():
    import lmfit as package
    from lmfit.lineshapes import voigt

    sigma = math.sqrt(0.5)
    return lambda z: float(voigt(z.real, 1.0, 0.0, sigma, z.imag)) * SQRT_PI, package.__version__


def mht(name):
    import numba
    from mHT import CPF

    one = getattr(CPF, name)
    return lambda z: one(z.real, z.imag), "mHT on numba " + numba.__version__


def mht_accurate():
    return mht("cpf_accurate")


def mht_fast():
    return mht("cpf_fast")


def hapi():
    import contextlib
    import io

    # It greets on standard output.
    with contextlib.redirect_stdout(io.StringIO()):
        import hapi as package
    import numpy

    def w(z):
        re, im = package.hum1_wei(numpy.array([z.real]), numpy.array([z.imag]))
        return complex(re[0], im[0])

    return w, importlib.metadata.version("hitran-api")


def main():
    name = sys.argv[1].replace("-", "_")
    try:
        w, version = globals()[name]()
    except (ImportError, OSError, AttributeError, importlib.metadata.PackageNotFoundError):
        sys.exit(3)
    print(f"# name: {sys.argv[1]}\n# version: {version}")
    for line in sys.stdin:
        if line.startswith("#") or not line.strip():
            continue
        re, im = map(float.fromhex, line.split(","))
        try:
            value = w(complex(re, im))
        except (ArithmeticError, ValueError) as error:
            print(f"refuse {type(error).__name__}")
            continue
        if isinstance(value, float):
            print(value.hex(), flush=False)
        else:
            value = complex(value)
            print(f"{value.real.hex()},{value.imag.hex()}", flush=False)


main()
