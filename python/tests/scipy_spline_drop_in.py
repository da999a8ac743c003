"""A plugin for pytest: our `CubicSpline` in place of scipy's while scipy's own tests run."""

import mechaudit
import scipy._lib._array_api
import scipy.interpolate
import scipy.interpolate._cubic

# The facts on array libraries for scipy's tests are looked up by the class.
capabilities = scipy._lib._array_api.xp_capabilities_table
capabilities[mechaudit.CubicSpline] = capabilities[scipy.interpolate.CubicSpline]

for module in (scipy.interpolate, scipy.interpolate._cubic):
    assert hasattr(module, "CubicSpline"), module
    module.CubicSpline = mechaudit.CubicSpline
