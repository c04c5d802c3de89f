#include "vispline/core/edit_distance.h"

#include <gtest/gtest.h>

namespace vispline {
namespace {

TEST(EditDistance, OfWords) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("same", "same"), 0u);
}

}  // namespace
}  // namespace vispline
