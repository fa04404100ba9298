#include "portable_math/functions.hpp"

#include <sleef.h>

// "cinz" are SLEEF's functions that give the same bits in every build, "u10" those within 1 ulp; "purec" is plain C.
namespace vibrosow::portable_math {

double sin(double angle) {
  return Sleef_cinz_sind1_u10purec(angle);
}

double cos(double angle) {
  return Sleef_cinz_cosd1_u10purec(angle);
}

double tan(double angle) {
  return Sleef_cinz_tand1_u10purec(angle);
}

SineCosine sine_cosine(double angle) {
  const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(angle);
  return {both.x, both.y};
}

double asin(double value) {
  return Sleef_cinz_asind1_u10purec(value);
}

double acos(double value) {
  return Sleef_cinz_acosd1_u10purec(value);
}

double atan2(double y, double x) {
  return Sleef_cinz_atan2d1_u10purec(y, x);
}

double exp(double value) {
  return Sleef_cinz_expd1_u10purec(value);
}

double log(double value) {
  return Sleef_cinz_logd1_u10purec(value);
}

double log1p(double value) {
  return Sleef_cinz_log1pd1_u10purec(value);
}

double pow(double base, double exponent) {
  return Sleef_cinz_powd1_u10purec(base, exponent);
}

double pow(double base, int exponent) {
  double power = 1;
  for (int factor = 0; factor < exponent; ++factor) power *= base;
  return power;
}

double cbrt(double value) {
  return Sleef_cinz_cbrtd1_u10purec(value);
}

double acosh(double value) {
  return Sleef_cinz_acoshd1_u10purec(value);
}

double hypot(double x, double y) {
  return Sleef_cinz_hypotd1_u05purec(x, y);
}

double erfc(double value) {
  return Sleef_cinz_erfcd1_u15purec(value);
}

}  // namespace vibrosow::portable_math
