// Trajectories and a comparison for evo: write_trajectories <folder>.
#include <filesystem>

#include "vispline/core/random.h"
#include "vispline/core/so3.h"
#include "vispline/io/write.h"
#include "vispline/results/evo_result.h"

int main(int argc, char** argv) {
  using namespace vispline;
  if (argc != 2) return 2;
  const std::string root = std::string(argv[1]) + "/";
  std::filesystem::create_directories(root);
  const RandomStream numbers(11, "evo");
  std::uint64_t next = 0;
  const auto vector = [&] {
    const double x = numbers.normal(next++), y = numbers.normal(next++);
    return Vector3d(x, y, numbers.normal(next++));
  };
  Signal<Pose> reference, estimate;
  const Pose T_r_e{SO3::exp<double>(Vector3d(0.2, -0.4, 1.1)), {3.0, -1.0, 0.5}};
  for (int i = 0; i < 200; ++i) {
    const Time time = time_from_ns(1'520'530'308'000'000'000 + 50'000'000LL * i + i * i);
    const Pose T_w_b{SO3::exp<double>(0.3 * vector()), Vector3d(0.1 * i, std::sin(0.07 * i), std::cos(0.05 * i))};
    reference.push_back(time, T_w_b);
    const Pose noisy{T_w_b.R * SO3::exp<double>(0.01 * vector()), T_w_b.p + 0.05 * vector()};
    estimate.push_back(time, T_r_e.inverse() * noisy);
  }
  write_trajectory_tum(root + "reference.tum", reference, {.force = true});
  write_trajectory_euroc(root + "reference.csv", reference, {.force = true});
  write_trajectory_kitti(root + "reference.kitti", reference, {.force = true});
  write_trajectory_tum(root + "estimate.tum", estimate, {.force = true});
  const TrajectoryComparison comparison = compare_trajectories(estimate, reference);
  write_file(root + "result.zip", evo_result_zip(comparison, "reference.tum", "estimate.tum"), {.force = true});
  return 0;
}
