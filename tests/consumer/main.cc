#include <vispline/core/random.h>
#include <vispline/core/so3.h>

// A header-only part and a compiled part of the installed library.
int main() {
  const vispline::Vector3d w(0.1, -0.2, 0.3);
  const double error = (vispline::SO3::log<double>(vispline::SO3::exp<double>(w)) - w).norm();
  const double normal = vispline::RandomStream(1, "consumer").normal(0);
  return error < 1e-15 && normal == vispline::RandomStream(1, "consumer").normal(0) ? 0 : 1;
}
