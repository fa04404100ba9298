#pragma once

/// Functions that IEEE 754 leaves to the C library, whose last bit differs between libraries and even between
/// processors of one: here from one source (SLEEF's deterministic functions: plain C, no fused multiply-add), so that
/// the same arguments give the same bits on every machine. Within 1 ulp of the exact value, erfc within 1.5; tested
/// against 240 bits. Arguments, results and errors are those of <cmath>, but errno is left alone. What is exact by IEEE
/// (sqrt, floor, remainder and the like) is taken from <cmath>.
///
/// All that decides where a grain goes uses these.
namespace vibrosow::portable_math {

double sin(double angle);  // rad
double cos(double angle);
double tan(double angle);

struct SineCosine {
  double sine, cosine;
};
/// Both for little more than one of them. Their last bit may differ from `sin` and `cos`.
SineCosine sine_cosine(double angle);

double asin(double value);
double acos(double value);
double atan2(double y, double x);

double exp(double value);
double log(double value);
double log1p(double value);
double pow(double base, double exponent);
double pow(double base, int exponent);  // exponent >= 0: that many factors, each product rounded
double cbrt(double value);
double acosh(double value);  // up to 1e150
double hypot(double x, double y);
double erfc(double value);

}  // namespace vibrosow::portable_math
