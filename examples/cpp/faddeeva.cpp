// W(z) with std::complex, under three names: mechaudit's, libcerf's and the MIT package's.
#include <complex>
#include <cstdio>
#include <mechaudit/Faddeeva.hh>
#include <mechaudit/cerf.h>
#include <vector>

int main() {
    const std::complex<double> z(1.9914668428, -1.3548101281); // next to a zero of w
    for (const std::complex<double> w : {mechaudit::faddeeva(z), w_of_z(z), Faddeeva::w(z)}) {
        std::printf("%.16g %+.16gi\n", w.real(), w.imag());
    }
    std::vector<std::complex<double>> points(1000, z), values(1000);
    mechaudit::batch(MECHAUDIT_FUNCTION_FADDEEVA, points.size(), points.data(), values.data());
    std::printf("%d\n", values.back() == mechaudit::faddeeva(z));
}
