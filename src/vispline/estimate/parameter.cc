#include "vispline/estimate/parameter.h"

#include <cmath>

#include "vispline/core/error.h"
#include "vispline/core/so3.h"

namespace vispline {
namespace {

using Numbers = Eigen::Map<Eigen::VectorXd>;
using NumbersOf = std::function<std::vector<Numbers>(State&)>;  ///< the same numbers, in one place or more
using PosesOf = std::function<std::vector<Pose*>(State&)>;

/// Reads through an accessor that hands out references.
template <class Of>
auto first_of(const Of& of, const State& state) {
  return of(const_cast<State&>(state)).front();
}

Parameter vector_parameter(std::string name, std::string unit, int size, const NumbersOf& of) {
  return {std::move(name),
          std::move(unit),
          size,
          {Role::kFixed},
          [of](const State& s) { return Eigen::VectorXd(first_of(of, s)); },
          [of](State& s, const Eigen::VectorXd& d) {
            for (Numbers numbers : of(s)) numbers += d;
          },
          [of](const State& from, const State& to) { return Eigen::VectorXd(first_of(of, to) - first_of(of, from)); }};
}

/// Three of the six numbers that `of` gives.
Parameter part_parameter(std::string name, const std::array<int, 3>& index,
                         const std::function<Vector6d&(State&)>& of) {
  const auto part = [of, index](const State& s) {
    return Eigen::VectorXd(of(const_cast<State&>(s))(std::vector<int>(index.begin(), index.end())));
  };
  return {std::move(name),
          "1",
          3,
          {Role::kFixed},
          part,
          [of, index](State& s, const Eigen::VectorXd& d) {
            for (int i = 0; i < 3; ++i) of(s)(index[static_cast<std::size_t>(i)]) += d(i);
          },
          [part](const State& from, const State& to) { return Eigen::VectorXd(part(to) - part(from)); }};
}

Parameter translation_parameter(const std::string& name, const PosesOf& of) {
  return vector_parameter(name + ".translation", "m", 3, [of](State& s) {
    std::vector<Numbers> numbers;
    for (Pose* pose : of(s)) numbers.emplace_back(pose->p.data(), 3);
    return numbers;
  });
}

Parameter rotation_parameter(const std::string& name, const PosesOf& of) {
  return {name + ".rotation",
          "rad",
          3,
          {Role::kFixed},
          [of](const State& s) { return Eigen::VectorXd(SO3::log<double>(first_of(of, s)->R)); },
          [of](State& s, const Eigen::VectorXd& d) {
            for (Pose* pose : of(s)) pose->R = pose->R * SO3::exp<double>(Vector3d(d));
          },
          [of](const State& from, const State& to) {
            return Eigen::VectorXd(SO3::log<double>(Matrix3d(first_of(of, from)->R.transpose() * first_of(of, to)->R)));
          }};
}

Parameter gravity_direction() {
  return {"gravity.direction",
          "1",
          2,
          {Role::kFixed},
          [](const State& s) { return Eigen::VectorXd(s.g_w.normalized()); },
          [](State& s, const Eigen::VectorXd& d) {
            const double angle = d.norm();
            if (angle == 0.0) return;
            const double size = s.g_w.norm();
            const Vector3d across = plane_across(s.g_w) * d / angle;
            s.g_w = size * (std::cos(angle) * s.g_w / size + std::sin(angle) * across).normalized();
          },
          [](const State& from, const State& to) {
            const Vector3d n = from.g_w.normalized(), m = to.g_w.normalized();
            const Vector3d across = m - n * n.dot(m);
            const double sine = across.norm();
            if (sine == 0.0) return Eigen::VectorXd(Eigen::VectorXd::Zero(2));
            return Eigen::VectorXd(std::atan2(sine, n.dot(m)) / sine * (plane_across(from.g_w).transpose() * across));
          }};
}

Parameter gravity_magnitude() {
  return {"gravity.magnitude",
          "m/s^2",
          1,
          {Role::kFixed},
          [](const State& s) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, s.g_w.norm())); },
          [](State& s, const Eigen::VectorXd& d) { s.g_w *= 1.0 + d(0) / s.g_w.norm(); },
          [](const State& from, const State& to) {
            return Eigen::VectorXd(Eigen::VectorXd::Constant(1, to.g_w.norm() - from.g_w.norm()));
          }};
}

/// Over the clock of the gyroscope, which moves both.
Parameter accelerometer_clock(std::string name, std::size_t i) {
  const auto late = [i](const State& s) {
    const Imu& imu = s.rig.imus[i];
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, imu.accelerometer.time_offset_s - imu.gyroscope.time_offset_s));
  };
  return {std::move(name),
          "s",
          1,
          {Role::kFixed},
          late,
          [i](State& s, const Eigen::VectorXd& d) { s.rig.imus[i].accelerometer.time_offset_s += d(0); },
          [late](const State& from, const State& to) { return Eigen::VectorXd(late(to) - late(from)); }};
}

void add_imu(std::vector<Parameter>& all, const State& state, std::size_t i) {
  const std::string name = state.rig.imus[i].name;
  const PosesOf poses = [i](State& s) {
    return std::vector<Pose*>{&s.rig.imus[i].accelerometer.T_b_i, &s.rig.imus[i].gyroscope.T_b_i};
  };
  all.push_back(translation_parameter(name + ".T_b_i", poses));
  all.push_back(rotation_parameter(name + ".T_b_i", poses));
  all.push_back(vector_parameter(name + ".time_offset", "s", 1, [i](State& s) {
    return std::vector<Numbers>{{&s.rig.imus[i].gyroscope.time_offset_s, 1},
                                {&s.rig.imus[i].accelerometer.time_offset_s, 1}};
  }));
  const auto add = [&](const char* what, const char* unit, int size, auto numbers) {
    all.push_back(vector_parameter(name + what, unit, size, [i, size, numbers](State& s) {
      return std::vector<Numbers>{{numbers(s.rig.imus[i]), size}};
    }));
  };
  add(".gyroscope.bias", "rad/s", 3, [](Imu& imu) { return imu.gyroscope.bias.data(); });
  add(".gyroscope.scale", "1", 3, [](Imu& imu) { return imu.gyroscope.scale.data(); });
  for (const auto& [part, index] : {std::pair{"lower", kLower}, std::pair{"upper", kUpper}}) {
    all.push_back(part_parameter(name + ".gyroscope.misalignment." + part, index,
                                 [i](State& s) -> Vector6d& { return s.rig.imus[i].gyroscope.misalignment; }));
  }
  add(".gyroscope.g_sensitivity", "(rad/s)/(m/s^2)", 9, [](Imu& imu) { return imu.gyroscope.g_sensitivity.data(); });
  all.push_back(accelerometer_clock(name + ".accelerometer.time_offset", i));
  add(".accelerometer.bias", "m/s^2", 3, [](Imu& imu) { return imu.accelerometer.bias.data(); });
  add(".accelerometer.scale", "1", 3, [](Imu& imu) { return imu.accelerometer.scale.data(); });
  for (const auto& [part, index] : {std::pair{"lower", kLower}, std::pair{"upper", kUpper}}) {
    all.push_back(part_parameter(name + ".accelerometer.misalignment." + part, index,
                                 [i](State& s) -> Vector6d& { return s.rig.imus[i].accelerometer.misalignment; }));
  }
}

void add_camera(std::vector<Parameter>& all, const State& state, std::size_t c) {
  const Camera& camera = state.rig.cameras[c];
  const PosesOf pose = [c](State& s) { return std::vector<Pose*>{&s.rig.cameras[c].T_c_b}; };
  all.push_back(translation_parameter(camera.name + ".T_c_b", pose));
  all.push_back(rotation_parameter(camera.name + ".T_c_b", pose));
  const auto size = static_cast<int>(camera.lens.params.size());
  all.push_back(vector_parameter(camera.name + ".intrinsics", "px, 1", size, [c](State& s) {
    LensParams& params = s.rig.cameras[c].lens.params;
    return std::vector<Numbers>{{params.data(), params.size()}};
  }));
  all.push_back(vector_parameter(camera.name + ".time_offset", "s", 1, [c](State& s) {
    return std::vector<Numbers>{{&s.rig.cameras[c].time_offset_s, 1}};
  }));
  all.push_back(vector_parameter(camera.name + ".line_delay", "s", 1, [c](State& s) {
    return std::vector<Numbers>{{&s.rig.cameras[c].shutter.line_delay_s, 1}};
  }));
}

void add_reference(std::vector<Parameter>& all, std::size_t r) {
  const std::string name = "reference" + std::to_string(r);
  const PosesOf world = [r](State& s) { return std::vector<Pose*>{&s.references[r].T_m_w}; };
  const PosesOf body = [r](State& s) { return std::vector<Pose*>{&s.references[r].T_b_k}; };
  for (const auto& [what, pose] : {std::pair{".T_m_w", world}, std::pair{".T_b_k", body}}) {
    all.push_back(translation_parameter(name + what, pose));
    all.push_back(rotation_parameter(name + what, pose));
  }
  all.push_back(vector_parameter(name + ".time_offset", "s", 1, [r](State& s) {
    return std::vector<Numbers>{{&s.references[r].time_offset_s, 1}};
  }));
}

/// `*` stands for any run of characters but a dot.
bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty() || name.front() == '.';
  if (pattern.front() == '*') {
    for (std::size_t skip = 0; skip <= name.size(); ++skip) {
      if (matches(pattern.substr(1), name.substr(skip))) return true;
      if (skip < name.size() && name[skip] == '.') break;
    }
    return false;
  }
  return !name.empty() && name.front() == pattern.front() && matches(pattern.substr(1), name.substr(1));
}

}  // namespace

std::vector<Parameter> parameters_of(const State& state) {
  std::vector<Parameter> all{gravity_direction(), gravity_magnitude()};
  for (std::size_t i = 0; i < state.rig.imus.size(); ++i) add_imu(all, state, i);
  for (std::size_t c = 0; c < state.rig.cameras.size(); ++c) add_camera(all, state, c);
  for (std::size_t r = 0; r < state.references.size(); ++r) add_reference(all, r);
  return all;
}

std::vector<Parameter*> find_parameters(std::vector<Parameter>& parameters, const std::string& pattern) {
  std::vector<Parameter*> found;
  std::string names;
  for (Parameter& parameter : parameters) {
    names += (names.empty() ? "" : ", ") + parameter.name;
    if (matches(pattern, parameter.name)) found.push_back(&parameter);
  }
  if (!found.empty()) return found;
  throw Error(ExitCode::kUsage, {.code = "E-CONFIG",
                                 .message = "no parameter is called " + quoted(pattern),
                                 .where = "",
                                 .effect = "nothing estimated",
                                 .next = "parameters of this rig: " + names});
}

ParameterColumns columns_of(const State& state, const std::vector<Parameter>& parameters) {
  ParameterColumns columns;
  for (const Parameter& parameter : parameters) columns.by_name[parameter.name] = parameter.column;
  const auto of = [&](const std::string& name) { return columns.by_name.at(name); };
  columns.gravity = {of("gravity.direction"), of("gravity.magnitude")};
  for (const Imu& imu : state.rig.imus) {
    const std::string g = imu.name + ".gyroscope.", a = imu.name + ".accelerometer.";
    columns.imus.push_back({of(imu.name + ".T_b_i.translation"), of(imu.name + ".T_b_i.rotation"),
                            of(imu.name + ".time_offset"), of(g + "bias"), of(g + "scale"),
                            of(g + "misalignment.lower"), of(g + "misalignment.upper"), of(g + "g_sensitivity"),
                            of(a + "time_offset"), of(a + "bias"), of(a + "scale"), of(a + "misalignment.lower"),
                            of(a + "misalignment.upper")});
  }
  for (const Camera& camera : state.rig.cameras) {
    columns.cameras.push_back({of(camera.name + ".T_c_b.translation"), of(camera.name + ".T_c_b.rotation"),
                               of(camera.name + ".intrinsics"), of(camera.name + ".time_offset"),
                               of(camera.name + ".line_delay")});
  }
  for (std::size_t r = 0; r < state.references.size(); ++r) {
    const std::string name = "reference" + std::to_string(r);
    columns.references.push_back({of(name + ".T_m_w.translation"), of(name + ".T_m_w.rotation"),
                                  of(name + ".T_b_k.translation"), of(name + ".T_b_k.rotation"),
                                  of(name + ".time_offset")});
  }
  return columns;
}

}  // namespace vispline
