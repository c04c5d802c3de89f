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

Eigen::MatrixXd lower_of(const Skyline& skyline) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(skyline.size(), skyline.size());
  constexpr int kTile = Skyline::kTile;
  for (int r = 0; r < skyline.size(); ++r) {
    for (int c = skyline.first(r / kTile) * kTile; c <= r; ++c) {
      H(r, c) = skyline.tile(r / kTile, c / kTile)(r % kTile, c % kTile);
    }
  }
  return H;
}

/// Columns in runs of many lengths, out of order, shared by both factors.
TEST(Skyline, ProductsOfRows) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  std::vector<int> a, b;
  for (int c = 100; c < 149; ++c) a.push_back(c);
  for (const int c : {3, 4, 5, 160, 7}) a.push_back(c);
  for (int c = 90; c < 111; ++c) b.push_back(c);
  b.push_back(2);
  b.push_back(160);
  std::vector<int> all = a;
  all.insert(all.end(), b.begin(), b.end());
  Skyline skyline(161);
  skyline.couple(all);
  skyline.allocate();
  const auto matrix = [&](std::size_t rows, int columns) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(static_cast<Eigen::Index>(rows), columns, [&] { return normal(random); }));
  };
  const Eigen::MatrixXd A_t = matrix(a.size(), 3), B_t = matrix(b.size(), 3), J_t = matrix(a.size(), 2);
  skyline.add_products(a, A_t, b, B_t);
  skyline.add(a, J_t * J_t.transpose());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 161), B = A, J = Eigen::MatrixXd::Zero(2, 161);
  for (std::size_t i = 0; i < a.size(); ++i) {
    A.col(a[i]) = A_t.row(static_cast<Eigen::Index>(i));
    J.col(a[i]) = J_t.row(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; i < b.size(); ++i) B.col(b[i]) = B_t.row(static_cast<Eigen::Index>(i));
  const Eigen::MatrixXd expected = A.transpose() * B + B.transpose() * A + J.transpose() * J;
  EXPECT_LT((lower_of(skyline) - Eigen::MatrixXd(expected.triangularView<Eigen::Lower>())).norm(), 1e-12);
}

TEST(Skyline, CovarianceOfTheLastUnknowns) {
  Example e;
  const Eigen::MatrixXd inverse = e.dense.llt().solve(Eigen::MatrixXd::Identity(Example::kSize, Example::kSize));
  ASSERT_TRUE(e.skyline.factor());
  for (const int n : {1, 7, 50}) {
    EXPECT_LT((e.skyline.tail_of_inverse(n) - inverse.bottomRightCorner(n, n)).norm(),
              1e-10 * inverse.bottomRightCorner(n, n).norm());
    EXPECT_TRUE((e.skyline.tail_information(n) * e.skyline.tail_of_inverse(n)).isIdentity(1e-9));
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
