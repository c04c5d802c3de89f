#include "vispline/results/sigma_checks.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

/// Two-sided 99 % bands, to the two digits that tables of chi-square give.
TEST(SigmaChecks, BandOfTheMean) {
  struct Row {
    int states, runs;
    double low, high;
  };
  for (const Row& row :
       {Row{6, 50, 0.80, 1.22}, Row{6, 100, 0.86, 1.16}, Row{6, 200, 0.90, 1.11}, Row{15, 200, 0.94, 1.07}}) {
    const Band band = nees_band(row.states, row.runs);
    EXPECT_NEAR(band.low, row.low, 6e-3) << row.states << " " << row.runs;
    EXPECT_NEAR(band.high, row.high, 6e-3) << row.states << " " << row.runs;
  }
}

}  // namespace
}  // namespace vispline
