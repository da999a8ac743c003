// The C++ side: overloads of mechaudit.h, of libcerf's names and of the MIT package's.
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "check.h"
#include <mechaudit.h>
#include <mechaudit/Faddeeva.hh>
#include <mechaudit/cerf.h>

using C = std::complex<double>;

static bool same(C a, C b) { return same(a.real(), b.real()) && same(a.imag(), b.imag()); }

int main() {
    const double inf = std::numeric_limits<double>::infinity();
    std::vector<C> points{{0, 0}, {1, 1}, {-2.5, -0.125}, {inf, 1}, {1, -inf}, {std::nan(""), 0}, {0, 30}};
    for (int k = 0; k < 1000; ++k) {
        points.emplace_back(between(-8, 8), between(-5, 8));
    }
    for (const C z : points) {
        double re, im;
        mechaudit_faddeeva(z.real(), z.imag(), &re, &im);
        CHECK(same(mechaudit::faddeeva(z), C(re, im)));
        CHECK(same(w_of_z(z), C(re, im)) && same(Faddeeva::w(z), C(re, im)) && same(Faddeeva::w(z, 1e-3), C(re, im)));
        CHECK(same(cerf(z), mechaudit::erf(z)) && same(Faddeeva::erf(z), cerf(z)));
        CHECK(same(cerfc(z), mechaudit::erfc(z)) && same(Faddeeva::erfc(z), cerfc(z)));
        CHECK(same(cerfcx(z), mechaudit::erfcx(z)) && same(Faddeeva::erfcx(z), cerfcx(z)));
        CHECK(same(cerfi(z), mechaudit::erfi(z)) && same(Faddeeva::erfi(z), cerfi(z)));
        CHECK(same(cdawson(z), mechaudit::dawson(z)) && same(Faddeeva::Dawson(z), cdawson(z)));
        const double x = z.real();
        CHECK(same(im_w_of_x(x), mechaudit::faddeeva(x).imag()) && same(Faddeeva::w_im(x), im_w_of_x(x)));
        CHECK(same(re_w_of_z(x, z.imag()), re) && same(im_w_of_z(x, z.imag()), im));
        CHECK(same(erfcx(x), Faddeeva::erfcx(x)) && same(erfi(x), Faddeeva::erfi(x)));
        CHECK(same(dawson(x), Faddeeva::Dawson(x)) && same(dawson(x), mechaudit::dawson(x)));
        CHECK(same(Faddeeva::erf(x), mechaudit::erf(x)) && same(Faddeeva::erfc(x), mechaudit::erfc(x)));
        CHECK(same(voigt(x, 1, 2), mechaudit::voigt(x, 1, 2)) && same(voigt(x, -1, -2), voigt(x, 1, 2)));
    }
    CHECK(voigt_hwhm(-1, 1) == mechaudit::voigt_hwhm(1, 1));
    std::vector<C> values(points.size());
    CHECK(mechaudit::batch(MECHAUDIT_FUNCTION_ERFC, points.size(), points.data(), values.data()) == MECHAUDIT_STATUS_OK);
    for (std::size_t k = 0; k < points.size(); ++k) {
        CHECK(same(values[k], cerfc(points[k])));
    }
    return verdict("names");
}
