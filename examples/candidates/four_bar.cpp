// The four-bar linkage in C++, to be audited:
//
//     c++ -std=c++17 -O2 -o four_bar examples/candidates/four_bar.cpp
//     mechaudit audit four-bar --region crank-rocker --exec ./four_bar
//
// Input: crank a, coupler b, rocker c, frame d, phi1, assembly (1 or -1). strtod reads hexadecimal
// floats, std::hexfloat writes them.
//
// a e1 + b e2 = (d, 0) + c e3. With s = (d, 0) - a e1, the coupler stands at the angle alpha to s,
// tan(alpha/2)^2 = (c - b + L)(c + b - L) / ((b + L - c)(b + L + c)), L = |s|; the rocker likewise. The
// rest is differentiation. Where coupler or rocker turn fully, the method counts the turns of their angles,
// which is not done here: a crank-rocker passes, a double-crank is whole turns off.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

static std::vector<double> numbers(const std::string &line) {
    std::vector<double> v;
    const char *at = line.c_str();
    for (char *end;; at = end) {
        at += *at == ',';
        const double x = std::strtod(at, &end);
        if (end == at) {
            return v;
        }
        v.push_back(x);
    }
}

// The angle between sides p and q of a triangle whose third side is r; NaN if that is no triangle.
static double angle(double p, double q, double r) {
    const double above = (r - p + q) * (r + p - q), below = (p + q - r) * (p + q + r);
    return above > 0 && below > 0 ? 2 * std::atan2(std::sqrt(above), std::sqrt(below)) : NAN;
}

static bool solve(const std::vector<double> &v, std::vector<double> &out) {
    const double a = v[0], b = v[1], c = v[2], d = v[3], phi = v[4], assembly = v[5];
    // d - a cos(phi), where d and a may be next to each other.
    const double half = std::sin(phi / 2), x = (d - a) + 2 * a * half * half, y = a * std::sin(phi);
    const double span = std::hypot(x, y), beta = std::atan2(-y, x);
    const double mu = angle(b, c, span);
    if (!(mu > 0)) {
        return false;
    }
    // Both angles are seen from the span; the rocker's from its other end.
    const double phi2 = beta + assembly * angle(b, span, c);
    const double phi3 = phi2 + assembly * mu;
    // a e1' + b phi2' e2' = c phi3' e3', across e3 and e2, and once more.
    const double sine = assembly * std::sin(mu), cosine = std::cos(mu);
    const double p2 = a * std::sin(phi - phi3) / (b * sine);
    const double p3 = a * std::sin(phi - phi2) / (c * sine);
    const double q2 = (a * std::cos(phi - phi3) + b * p2 * p2 * cosine - c * p3 * p3) / (b * sine);
    const double q3 = (a * std::cos(phi - phi2) + b * p2 * p2 - c * p3 * p3 * cosine) / (c * sine);
    out = {phi2, phi3, p2, p3, q2, q3, mu, d + c * std::cos(phi3), c * std::sin(phi3)};
    return std::isfinite(q2) && std::isfinite(q3);
}

int main() {
    std::ios::sync_with_stdio(false);
    std::cout << "# name: four-bar in C++\n# version: 1.0\n" << std::hexfloat;
    std::vector<double> out;
    for (std::string line; std::getline(std::cin, line);) {
        if (line.rfind('#', 0) == 0) {
            continue;
        }
        const std::vector<double> v = numbers(line);
        if (v.size() != 6 || !solve(v, out)) {
            std::cout << "refuse\n";
            continue;
        }
        for (std::size_t k = 0; k < out.size(); k++) {
            std::cout << (k ? "," : "") << out[k];
        }
        std::cout << '\n';
    }
}
