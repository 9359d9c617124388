// SPDX-License-Identifier: BSD-3-Clause
#include "job.hpp"

#include <pyrod/rod/refinement.hpp>
#include <pyrod/statics/ready_ladder.hpp>

namespace pyrod::bind {

namespace {

/// What Python makes of a level.
class Source {
 public:
  explicit Source(py::function make) : make_(std::move(make)) {}

  /// Takes the lock of Python itself.
  template <class Read>
  auto operator()(int level, const Read& read) const {
    const py::gil_scoped_acquire gil;
    return read(make_(level).cast<py::tuple>());
  }

 private:
  py::function make_;
};

/// A rod and its loads on halved edges, made without Python: where no functions of arc length are
/// to be asked.
LoadedRod halved(Rod<Spatial> rod, const GridLoads& loads, int level) {
  if (level == 0) return {std::move(rod), loads.loads};
  for (int k = 0; k < level; ++k) rod = halved(rod);
  auto on = loads.on(rod.grid);
  return {std::move(rod), std::move(on)};
}

/// The same of a network.
Network<Spatial> halved(Network<Spatial> network, const std::vector<GridLoads>& loads, int level) {
  for (std::size_t i = 0; i < network.rods.size(); ++i) {
    auto [rod, on] = halved(std::move(network.rods[i]), loads[i], level);
    network.rods[i] = std::move(rod);
    network.loads[i] = std::move(on);
  }
  for (auto& a : network.attachments) a.vertex <<= level;
  return network;
}

/// `make`: gives the rod and the loads of a level above 0; none: edges are halved.
std::unique_ptr<ReadyLadder> of_cantilever(const Rod<Spatial>& rod, const GridLoads& loads,
                                           const std::optional<py::function>& make,
                                           Dimension dimension, ModelKind model,
                                           const Array& position, const Array& frame,
                                           bool corners) {
  const Placement<Spatial> clamp{vector3(position, "position"), quaternion(frame, "frame")};
  LoadedLevel loaded;
  if (make)
    loaded = [source = Source(*make)](int level) {
      return source(level, [](const py::tuple& made) {
        return LoadedRod{made[0].cast<const Rod<Spatial>&>(),
                         made[1].cast<const GridLoads&>().loads};
      });
    };
  else
    loaded = [rod, loads](int level) { return halved(rod, loads, level); };
  const auto of_model = [loaded, model](int level) {
    LoadedRod out = loaded(level);
    out.rod = in_model(std::move(out.rod), model);
    return out;
  };
  const auto level = in_space(
      dimension, [&]<class Space>(Space) { return cantilever_level<Space>(of_model, clamp); });
  return std::make_unique<ReadyLadder>(std::vector{rod}, level, corners);
}

/// `make`: gives the network of a level above 0 and its plane; none: edges are halved.
std::unique_ptr<ReadyLadder> of_network(const Network<Spatial>& network, const Array& origin,
                                        const Array& frame, const std::vector<GridLoads>& loads,
                                        const std::optional<py::function>& make,
                                        Dimension dimension, bool corners) {
  const Placement<Spatial> plane{vector3(origin, "origin"), quaternion(frame, "frame")};
  PlacedLevel placed;
  if (make)
    placed = [source = Source(*make)](int level) {
      return source(level, [](const py::tuple& made) {
        return PlacedNetwork{
            made[0].cast<const Network<Spatial>&>(),
            {vector3(made[1].cast<Array>(), "origin"), quaternion(made[2].cast<Array>(), "frame")}};
      });
    };
  else
    placed = [network, loads, plane](int level) {
      return PlacedNetwork{halved(network, loads, level), plane};
    };
  const auto level =
      in_space(dimension, [&]<class Space>(Space) { return network_level<Space>(placed); });
  return std::make_unique<ReadyLadder>(network.rods, level, corners);
}

Job ladder_job(const py::object& self, const std::optional<py::tuple>& start,
               const Options& options, bool stable, bool eigenvalue, double tolerance) {
  auto& ladder = self.cast<ReadyLadder&>();
  const auto from = start_of(start);
  if (from)
    require_count(Eigen::Index(from->frames.size()), ladder.edges(), "start", "one frame per edge");
  const NetworkOptions more{stable, eigenvalue};
  const auto work = [=, &ladder](const Trace& trace) -> Outcome {
    auto climbed = ladder.climb(from, options, more, tolerance, trace);
    return {std::move(climbed.solution), climbed.reached};
  };
  const auto so_far = [&ladder]() -> py::object {
    const auto& [grids, edges, error] = ladder.so_far();
    return py::make_tuple(grids, edges, error);
  };
  return {work, {self}, so_far};
}

}  // namespace

void ladder(py::module_& module) {
  py::class_<ReadyLadder>(module, "Ladder", "A scene on ever finer grids.")
      .def_static("of_cantilever", &of_cantilever, py::arg("rod"), py::arg("loads"),
                  py::arg("make"), py::arg("dimension"), py::arg("model"), py::arg("position"),
                  py::arg("frame"), py::arg("corners"))
      .def_static("of_network", &of_network, py::arg("network"), py::arg("origin"),
                  py::arg("frame"), py::arg("loads"), py::arg("make"), py::arg("dimension"),
                  py::arg("corners"))
      .def("job", &ladder_job, py::arg("start"), py::arg("options"), py::arg("stable"),
           py::arg("eigenvalue"), py::arg("tolerance"));
}

}  // namespace pyrod::bind
