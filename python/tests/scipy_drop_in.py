"""A plugin for pytest: our functions in place of scipy's while scipy's own tests run.

``pytest -p scipy_drop_in --pyargs scipy.special.tests.test_faddeeva`` with this folder on the path.
"""

import scipy._lib._array_api
import scipy.special
import scipy.special._ufuncs
from mechaudit import special

NAMES = ("dawsn", "erf", "erfc", "erfcx", "erfi", "voigt_profile", "wofz")

# The facts on array libraries for scipy's tests are looked up by the function.
capabilities = scipy._lib._array_api.xp_capabilities_table
for name in NAMES:
    known = capabilities.get(getattr(scipy.special, name))
    if known is not None:
        capabilities[getattr(special, name)] = known

for module in (scipy.special, scipy.special._ufuncs):
    for name in NAMES:
        # A name that moves elsewhere in scipy has to be followed.
        assert hasattr(module, name), (module, name)
        setattr(module, name, getattr(special, name))


def pytest_collection_finish(session):
    """What the tests see is ours."""
    for module in {item.module for item in session.items}:
        for name in NAMES:
            for home in (module, getattr(module, "special", None), getattr(module, "cephes", None)):
                found = getattr(home, name, None)
                assert found is None or found is getattr(special, name), (module, name)
