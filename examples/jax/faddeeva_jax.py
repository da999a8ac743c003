"""W(z) in JAX by way of XLA's foreign function interface, differentiable to any order.

    c++ -std=c++17 -O2 -shared -fPIC faddeeva_ffi.cc -o libfaddeeva_ffi.so \\
        -I"$(python3 -c 'import jax; print(jax.ffi.include_dir())')" $(pkg-config --cflags --libs mechaudit)
    python3 faddeeva_jax.py

`faddeeva` and `voigt` work under jit, vmap and grad on the CPU, in double precision.
"""
import ctypes
import os
import pathlib

import jax
import jax.numpy as jnp
import numpy as np

jax.config.update("jax_enable_x64", True)

_here = pathlib.Path(__file__).parent
_library = ctypes.CDLL(os.environ.get("FADDEEVA_FFI", str(_here / "libfaddeeva_ffi.so")))
jax.ffi.register_ffi_target("mechaudit_batch", jax.ffi.pycapsule(_library.MechauditBatch), platform="cpu")

FADDEEVA, DERIVATIVE = 0, 1  # mechaudit_function


def _batch(function, z):
    z = jnp.asarray(z, jnp.complex128)
    call = jax.ffi.ffi_call(
        "mechaudit_batch", jax.ShapeDtypeStruct(z.shape, z.dtype), vmap_method="broadcast_all"
    )
    return call(z, function=np.int32(function))


@jax.custom_jvp
def faddeeva(z):
    """w(z) = exp(-z^2) erfc(-iz)."""
    return _batch(FADDEEVA, z)


@jax.custom_jvp
def faddeeva_derivative(z):
    """w'(z) = -2z w(z) + 2i/sqrt(pi), without the cancellation of that sum."""
    return _batch(DERIVATIVE, z)


@faddeeva.defjvp
def _(primals, tangents):
    (z,), (dz,) = primals, tangents
    return faddeeva(z), faddeeva_derivative(z) * dz


@faddeeva_derivative.defjvp
def _(primals, tangents):
    # w'' = -2 (z w' + w), DLMF 7.10.3.
    (z,), (dz,) = primals, tangents
    w, slope = faddeeva(z), faddeeva_derivative(z)
    return slope, -2 * (z * slope + w) * dz


def voigt(x, sigma, gamma):
    """The Voigt profile; sigma > 0."""
    z = (x + 1j * gamma) / (sigma * np.sqrt(2))
    return faddeeva(z).real / (sigma * np.sqrt(2 * np.pi))


def main():
    z = jnp.array([1 + 1j, 3 - 0.5j, -2 + 1e-9j, 0.25 + 8j, 1e5 - 2j])
    w = jax.jit(faddeeva)(z)
    print("w(1 + i) =", complex(w[0]))

    # dw/dz by JAX, by the equation where it does not cancel, and by differences.
    slope = jax.vmap(jax.grad(faddeeva, holomorphic=True))(z)
    equation = -2 * z * w + 2j / np.sqrt(np.pi)
    assert np.allclose(slope[:4], equation[:4], rtol=1e-12), (slope, equation)
    h = 1e-6
    differences = (faddeeva(z + h) - faddeeva(z - h)) / (2 * h)
    assert np.allclose(slope[:4], differences[:4], rtol=1e-8, atol=1e-9)
    # At 1e5 the equation has lost what w'(z) = -i/(sqrt(pi) z^2) ... keeps.
    assert abs(slope[4] * z[4] ** 2 * np.sqrt(np.pi) / -1j - 1) < 1e-9

    third = jax.grad(jax.grad(jax.grad(faddeeva, holomorphic=True), holomorphic=True), holomorphic=True)
    # w''' = -2 (z w'' + 2 w').
    second = -2 * (z * slope + w)
    assert np.allclose(third(z[0]), -2 * (z[0] * second[0] + 2 * slope[0]), rtol=1e-12)

    # Fitting a line needs the slopes of its profile.
    x = jnp.linspace(-4, 4, 201)
    of_widths = jax.jacfwd(lambda p: voigt(x, p[0], p[1]))(jnp.array([0.8, 0.3]))
    again = (voigt(x, 0.8 + h, 0.3) - voigt(x, 0.8 - h, 0.3)) / (2 * h)
    assert np.allclose(of_widths[:, 0], again, rtol=1e-6, atol=1e-9)
    backwards = jax.grad(lambda p: jnp.sum(voigt(x, p[0], p[1])))(jnp.array([0.8, 0.3]))
    assert np.allclose(backwards, of_widths.sum(axis=0), rtol=1e-12)
    print("all derivatives agree")


if __name__ == "__main__":
    main()
