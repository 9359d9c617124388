// SPDX-License-Identifier: BSD-3-Clause
// Rods clamped at one end, from few edges to very many: iterations on all grids and on the finest,
// and the solve of a network that is posed, beside a bare CHOLMOD factor + solve of the finest
// matrix in the same run. `first`: its coarser grids are made as well; `again`: they are there.
#include "clamped.hpp"
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <vector>

namespace pyrod::benchmark {

enum class Loading { tip, precurved, heavy, moment };
constexpr const char* names[] = {"tip force", "precurved", "heavy", "moment"};

template <class Space>
Network<Space> cantilever(int n, Loading loading) {
  const bool bent = loading == Loading::precurved;
  const auto made = rod<Space>(n, bent ? Vec3(0.5, 2, 1) : Vec3(0, 0, 0));
  Loads<Space> loads(n);
  const auto force = restrict_point<Space>({10, bent ? 3. : 0., 1});
  if (loading == Loading::heavy)
    loads.add_force_per_length(made.grid, std::vector(std::size_t(n), force));
  else
    loads.add_force(made.grid, force, 1);
  if (loading == Loading::moment) loads.add_moment(made.grid, restrict_spin<Space>({0.5, 1, 1}), 1);
  return clamped(made, loads);
}

template <class Space>
void row(int n, Loading loading) {
  const auto net = cantilever<Space>(n, loading);
  std::optional<Posed<Space>> posed(net);
  Found<Space> found;
  const auto solve = [&] { found = find<Space>(*posed, {}, {}, {}, {}); };
  auto here = posed->problem().linearisation();
  const auto start = ClampedStart<Space>(posed->layout()).state();
  posed->problem().linearise(start, Hessian::exact, here);
  Ldlt factor(here.hessian);
  Vector x(here.gradient.size());
  const double scale = 1e9 / n;
  const double bare = scale * seconds([&] { factor.factorise(), factor.solve(here.gradient, x); });
  const double pose = scale * seconds([&] { posed.emplace(net); }, 3);
  const double first = scale * seconds([&] { posed.emplace(net), solve(); }, 5) - pose;
  const double again = scale * seconds(solve, 5);
  const auto finest = std::ranges::count(found.record, found.unknowns, &Iteration::unknowns);
  std::printf("%-8s %-10s %8d %4d %6d %7.0f %7.0f %7.0f %7.2f %7.2f\n",
              Space::spin == 3 ? "spatial" : "planar", names[int(loading)], n,
              int(found.record.size()), int(finest), bare, first, again, first / bare,
              again / bare);
  std::fflush(stdout);
}

}  // namespace pyrod::benchmark

int main(int argc, char** argv) {
  using namespace pyrod;
  using benchmark::Loading;
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1000000;
  std::puts(
      "iterations on all grids, and on the finest; ns per edge of bare CHOLMOD factor + solve,");
  std::puts("of a first solve, and of one again; both over bare\n");
  std::puts("space    load              n   it finest    bare   first   again  /bare   /bare");
  for (const int n : {64, 256, 1000, 10000, 100000, 1000000}) {
    if (n > largest) break;
    for (const auto loading : {Loading::tip, Loading::precurved, Loading::heavy, Loading::moment}) {
      benchmark::row<Planar>(n, loading);
      benchmark::row<Spatial>(n, loading);
    }
  }
}
