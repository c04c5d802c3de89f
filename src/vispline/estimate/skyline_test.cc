#include "vispline/estimate/skyline.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

namespace vispline {
namespace {

/// Band of width 60 with an arrow of 7, and one far pair.
struct Example {
  static constexpr int kSize = 331;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Identity(kSize, kSize) * 0.1;
  Skyline skyline{kSize};

  Example() {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::vector<std::vector<int>> sets;
    for (int begin = 0; begin + 60 < kSize - 7; begin += 17) {
      std::vector<int> columns;
      for (int c = begin; c < begin + 60; ++c) columns.push_back(c);
      for (int c = kSize - 7; c < kSize; ++c) columns.insert(columns.begin(), c);
      sets.push_back(columns);
    }
    sets.push_back({250, 3, 90});
    for (const auto& set : sets) skyline.couple(set);
    skyline.allocate();
    skyline.add_to_diagonal(Eigen::VectorXd::Constant(kSize, 0.1));
    for (const auto& set : sets) {
      const auto n = static_cast<Eigen::Index>(set.size());
      const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(2 * n, n, [&] { return normal(random); });
      const Eigen::MatrixXd H = J.transpose() * J;
      skyline.add(set, H);
      for (Eigen::Index a = 0; a < n; ++a) {
        for (Eigen::Index b = 0; b < n; ++b) {
          dense(set[static_cast<std::size_t>(a)], set[static_cast<std::size_t>(b)]) += H(a, b);
        }
      }
    }
  }
};

TEST(Skyline, SolvesAsTheFullMatrixDoes) {
  Example e;
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(Example::kSize, -1.0, 2.0);
  EXPECT_LT((e.skyline.diagonal() - e.dense.diagonal()).norm(), 1e-9);
  ASSERT_TRUE(e.skyline.factor());
  const Eigen::VectorXd x = e.skyline.solve(b);
  EXPECT_LT((e.dense * x - b).norm(), 1e-9 * b.norm());
}

TEST(Skyline, CovarianceOfTheLastUnknowns) {
  Example e;
  const Eigen::MatrixXd inverse = e.dense.llt().solve(Eigen::MatrixXd::Identity(Example::kSize, Example::kSize));
  ASSERT_TRUE(e.skyline.factor());
  for (const int n : {1, 7, 50}) {
    EXPECT_LT((e.skyline.tail_of_inverse(n) - inverse.bottomRightCorner(n, n)).norm(),
              1e-10 * inverse.bottomRightCorner(n, n).norm());
  }
}

TEST(Skyline, TellsAMatrixThatIsNotPositive) {
  Example e;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(Example::kSize);
  d(200) = -1e4;
  e.skyline.add_to_diagonal(d);
  EXPECT_FALSE(e.skyline.factor());
}

}  // namespace
}  // namespace vispline
