#include "vispline/trajectory/banded_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace vispline {
namespace {

TEST(BandedCholesky, SolvesLikeADenseFactorisation) {
  for (const Eigen::Index n : {1, 3, 20}) {
    const Eigen::Index bandwidth = 4;
    std::srand(3);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    BandedCholesky banded(n, bandwidth);
    for (Eigen::Index row = 0; row < n; ++row) {
      for (Eigen::Index col = std::max<Eigen::Index>(0, row - bandwidth); col <= row; ++col) {
        const double value = row == col ? 10.0 + static_cast<double>(row) : Eigen::internal::random(-1.0, 1.0);
        A(row, col) = A(col, row) = value;
        banded(row, col) = value;
      }
    }
    const Eigen::VectorXd b = Eigen::VectorXd::Random(n);
    ASSERT_TRUE(banded.factorize());
    EXPECT_LT((banded.solve(b) - A.llt().solve(b)).norm(), 1e-13);
  }
}

TEST(BandedCholesky, RefusesAnIndefiniteMatrix) {
  BandedCholesky banded(2, 1);
  banded(0, 0) = 1.0;
  banded(1, 0) = 2.0;
  banded(1, 1) = 1.0;
  EXPECT_FALSE(banded.factorize());
}

}  // namespace
}  // namespace vispline
