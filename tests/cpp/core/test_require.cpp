// SPDX-License-Identifier: BSD-3-Clause
#include "support/near.hpp"

#include <limits>

using namespace pyrod;
using namespace pyrod::test;

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
}  // namespace

TEST_CASE("require throws what it is told, and only then") {
  CHECK_NOTHROW(require(true, "never"));
  CHECK(refusal([] { require(false, "width: must be positive, got ", -1.5, " (", 3, ')'); }) ==
        "width: must be positive, got -1.5 (3)");
  CHECK_THROWS_AS(require(false, "x"), std::invalid_argument);
}

TEST_CASE("text keeps six digits") { CHECK(text(1. / 3, '|', 2) == "0.333333|2"); }

TEST_CASE("arrays: the message names the first entry that is wrong") {
  CHECK_NOTHROW(require_finite(Vec3(1, 0, -2), "h"));
  CHECK(refusal([] { require_finite(Vec3(1, undefined, infinite), "h"); }) ==
        "h[1]: expected finite numbers, got nan");
  Mat<2> m;
  m << 1, 2, 3, -infinite;
  CHECK(refusal([&] { require_finite(m, "m"); }) == "m[1]: expected finite numbers, got -inf");

  CHECK_NOTHROW(require_positive(Vec3(1, 2, 1e-300), "h"));
  CHECK(refusal([] { require_positive(Vec3(1, 2, 0), "h"); }) == "h[2]: must be positive, got 0");
  CHECK_REFUSED("h[0]: must be positive", require_positive(Vec3(-1, 2, 0), "h"));
  CHECK_REFUSED("h[1]: expected finite", require_positive(Vec3(1, infinite, 0), "h"));
}

TEST_CASE("counts") {
  CHECK_NOTHROW(require_count(3, 3, "K0", "one per vertex"));
  CHECK(refusal([] { require_count(2, 3, "K0", "one per vertex"); }) ==
        "K0: expected 3 rows (one per vertex), got 2");
}
