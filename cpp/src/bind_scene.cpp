// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"

#include <pyrod/core/parallel.hpp>
#include <pyrod/scene/plane.hpp>
#include <pyrod/statics/known_start.hpp>
#include <pyrod/statics/solver.hpp>

#include <atomic>
#include <chrono>

namespace pyrod::bind {

namespace {

Solver scene_of(const std::vector<const GivenRod*>& rods, std::vector<Support> supports,
                std::vector<Joint> joints, std::vector<Load> loads, const std::string& space) {
  std::vector<RodSpec> specs;
  for (const auto* rod : rods) specs.push_back(rod->spec);
  return Solver(Scene(std::move(specs), std::move(supports), std::move(loads), space_of(space),
                      std::move(joints)));
}

/// Others may find it just now, and ask functions of Python for it: the lock must be free.
const ReadyScene& climbing(const Solver& scene) {
  const py::gil_scoped_release release;
  return scene.climbing();
}

/// The rods of a scene that is ready; None for those that are as `given`.
py::list rods_of(const ReadyScene& ready, const std::vector<const GivenRod*>& given) {
  py::list out;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto& now = ready.scene().rods[i];
    out.append(same_grid(now, given[i]->spec) ? py::object(py::none()) : py::cast(GivenRod(now)));
  }
  return out;
}

py::tuple placement(const Placement<Spatial>& at) {
  return py::make_tuple(locked(array<3>(at.position)), locked(array(at.frame)));
}

/// Numbers of the rod and of its vertex.
py::tuple vertex(const Solver& scene, const py::object& at) {
  const Place there = place(at);
  const auto& rods = scene.plain().scene().rods;
  require(there.rod < int(rods.size()), "at: there is no rod ", there.rod, ", the scene has ",
          rods.size());
  return py::make_tuple(there.rod, scene.plain().grid().vertex(there));
}

/// Directions (k, 3) in which a support lets its point move, if its frame is the given one.
py::array free_directions(const Solver& scene, int support, const Array& frame) {
  const auto& supports = scene.plain().scene().supports;
  const auto free = hold(supports.at(std::size_t(support)), quaternion(frame, "frame")).free;
  std::vector<Vec3> rows;
  for (Eigen::Index i = 0; i < free.cols(); ++i) rows.emplace_back(free.col(i));
  return array<3>(rows);
}

/// Whether finer grids ask more of the rods than what is linear between their vertices.
bool rods_are_asked(const Solver& scene) {
  return scene.plain().corners() ||
         std::ranges::any_of(scene.plain().scene().rods, [](const RodSpec& rod) {
           return !rod.arrays && (rod.section.index() > 0 || is_function(rod.curvature));
         });
}

/// Frames of the edges without a tolerance, on those with one.
py::array on_climbing_edges(const Solver& scene, const Array& frames) {
  const auto more =
      detail::on_more_edges(quaternions(frames, "start"), scene.plain(), climbing(scene));
  return more.empty() ? py::array(frames) : py::array(array(more));
}

/// Dead forces on the vertices, and moments on the edges and at both ends.
py::tuple dead(const Loads<Spatial>& on) {
  return py::make_tuple(array<3>(on.force), array<3>(on.moment), array<3>(on.start_moment),
                        array<3>(on.end_moment));
}

/// A grid of a solve with a tolerance: edges of the rods, where they are held and joined, loads.
py::tuple level(const Solver& scene, int number) {
  const auto network = [&] {
    const py::gil_scoped_release release;
    return scene.climbing().network_on(number).network;
  }();
  py::list edges, attached, loads;
  for (const auto& rod : network.rods) edges.append(rod.edges());
  for (const auto& a : network.attachments) attached.append(py::make_tuple(a.rod, a.vertex));
  for (const auto& acting : network.loads) loads.append(dead(acting));
  return py::make_tuple(edges, attached, loads);
}

/// What to start from: frames of all edges, or positions, vertex frames and frames of each rod.
struct Known {
  std::vector<Quaternion> frames;
  std::optional<Equilibrium> shape;

  explicit Known(const py::object& given) {
    if (given.is_none()) return;
    if (!py::isinstance<py::list>(given)) {
      frames = quaternions(given.cast<Array>(), "start");
      return;
    }
    shape.emplace();
    for (const auto& rod : given.cast<py::list>()) {
      const auto arrays = rod.cast<py::tuple>();
      RodSolution<Spatial> known;
      known.curve.positions = vectors<3>(arrays[0].cast<Array>(), "start");
      known.vertex_frames = quaternions(arrays[1].cast<Array>(), "start");
      known.curve.frames = quaternions(arrays[2].cast<Array>(), "start");
      shape->found.rods.push_back(std::move(known));
    }
  }

  void start(Settings& settings) const {
    settings.frames = frames;
    if (shape) settings.start = &*shape;
  }
};

/// Looks for Ctrl-C every so often: who takes the lock each time waits for all other threads.
Trace python_interrupt() {
  using Clock = std::chrono::steady_clock;
  return [last = Clock::now()](const Iteration&) mutable {
    constexpr auto often = std::chrono::milliseconds(20);
    if (const auto now = Clock::now(); now - last < often) return true;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    last = Clock::now();
    return true;
  };
}

/// Shows each iteration to Python, if that is wanted, and looks for Ctrl-C.
Trace python_trace(const std::optional<py::function>& show) {
  if (!show) return python_interrupt();
  return [&show](const Iteration& i) {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const auto go_on = (*show)(i.energy, i.residual, i.step, i.fraction, i.shift);
    return go_on.is_none() || go_on.cast<bool>();
  };
}

std::function<void(const SoFar&)> python_progress(const std::optional<py::function>& show) {
  if (!show) return {};
  return [&show](const SoFar& reached) {
    const py::gil_scoped_acquire gil;
    (*show)(reached.grids, reached.edges, reached.error);
  };
}

Settings settings_of(const Options& options, std::optional<double> tol, bool stable,
                     bool eigenvalue) {
  Settings out;
  out.options = options;
  out.tol = tol;
  out.stable = stable;
  out.eigenvalue = eigenvalue;
  return out;
}

std::shared_ptr<Equilibrium> solve_one(const Solver& scene, const py::object& start,
                                       const Options& options, std::optional<double> tol,
                                       bool stable, bool eigenvalue,
                                       const std::optional<py::function>& trace,
                                       const std::optional<py::function>& progress) {
  const Known known(start);
  Settings settings = settings_of(options, tol, stable, eigenvalue);
  known.start(settings);
  settings.trace = python_trace(trace);
  settings.progress = python_progress(progress);
  const py::gil_scoped_release release;
  return std::make_shared<Equilibrium>(scene.solve(settings));
}

/// A solver whose scene changes; that of a scene does not.
struct Going {
  Solver solver;
};

/// Parts that take the place of others, with their numbers.
template <class T>
using Changes = std::vector<std::pair<std::size_t, T>>;

/// The scene, or that of before, with these parts; from what was found last.
std::shared_ptr<Equilibrium> solve_changed(Solver& solver, const Solver* given,
                                           const Changes<const GivenRod*>& rods,
                                           const Changes<Support>& supports,
                                           const Changes<Joint>& joints, const Changes<Load>& loads,
                                           const Options& options, std::optional<double> tol,
                                           bool stable, bool eigenvalue) {
  Scene scene = given ? given->scene() : solver.scene();
  for (const auto& [i, rod] : rods) scene.rods.at(i) = rod->spec;
  for (const auto& [i, support] : supports) scene.supports.at(i) = support;
  for (const auto& [i, joint] : joints) scene.joints.at(i) = joint;
  for (const auto& [i, load] : loads) scene.loads.at(i) = load;
  Settings settings = settings_of(options, tol, stable, eigenvalue);
  settings.trace = python_interrupt();
  const py::gil_scoped_release release;
  return std::make_shared<Equilibrium>(solver.solve(std::move(scene), settings));
}

/// The scenes on several threads; `progress` sees how many are done. What a solve throws is thrown
/// here, with the number of its scene, when all threads have ended.
std::vector<std::shared_ptr<Equilibrium>> solve_all(const std::vector<const Solver*>& scenes,
                                                    const py::list& starts, const Options& options,
                                                    std::optional<double> tol, bool stable,
                                                    bool eigenvalue, int threads,
                                                    const std::optional<py::function>& progress) {
  std::vector<Known> known;
  for (const auto& start : starts) {
    const auto number = known.size();
    try {
      known.emplace_back(py::reinterpret_borrow<py::object>(start));
    } catch (const InvalidArgument& refused) {
      throw InvalidArgument(text("scene ", number, ": ", refused.what()));
    }
  }
  const Settings common = settings_of(options, tol, stable, eigenvalue);
  std::vector<std::shared_ptr<Equilibrium>> out(scenes.size());
  std::atomic<int> done{0};
  const auto look = [&] {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress) (*progress)(done.load());
    return true;
  };
  {
    const py::gil_scoped_release release;
    for_each_row(int(scenes.size()), threads, look, [&](int i) {
      Settings settings = common;
      known[std::size_t(i)].start(settings);
      try {
        out[std::size_t(i)] =
            std::make_shared<Equilibrium>(scenes[std::size_t(i)]->solve(settings));
      } catch (const InvalidArgument& refused) {
        throw InvalidArgument(text("scene ", i, ": ", refused.what()));
      }
      ++done;
    });
  }
  if (progress) (*progress)(done.load());
  return out;
}

}  // namespace

void scene(py::module_& module) {
  py::class_<Solver>(module, "Scene", "A scene that is ready to be solved.")
      .def(py::init(&scene_of), py::arg("rods"), py::arg("supports"), py::arg("joints"),
           py::arg("loads"), py::arg("space"))
      .def(
          "rods",
          [](const Solver& s, const std::vector<const GivenRod*>& given) {
            return rods_of(s.plain(), given);
          },
          py::arg("given"), "As they are solved; None for those that are as given.")
      .def(
          "climbing_rods",
          [](const Solver& s, const std::vector<const GivenRod*>& given) {
            return rods_of(climbing(s), given);
          },
          py::arg("given"), "The same of a solve with a tolerance.")
      .def("on_climbing_edges", &on_climbing_edges, py::arg("frames"))
      .def("vertex", &vertex, py::arg("at"))
      .def(
          "held",
          [](const Solver& s, int i) {
            return placement(s.plain().network().held.at(std::size_t(i)));
          },
          py::arg("support"))
      .def_property_readonly("plane",
                             [](const Solver& s) { return placement(s.plain().network().plane); })
      .def(
          "leaving_plane",
          [](const Solver& s, int across) {
            return leaving_plane(s.plain().grid(), s.plain().network(), across);
          },
          py::arg("across"), "What leaves the plane across a1 (0) or a2 (1), in words.")
      .def(
          "dead_loads", [](const Solver& s, int rod) { return dead(s.plain().grid().loads(rod)); },
          py::arg("rod"))
      .def("free_directions", &free_directions, py::arg("support"), py::arg("frame"))
      .def_property_readonly("rods_are_asked", &rods_are_asked)
      .def("level", &level, py::arg("number"))
      .def("solve", &solve_one, py::arg("start"), py::arg("options"), py::arg("tol"),
           py::arg("stable"), py::arg("eigenvalue"), py::arg("trace"), py::arg("progress"));
  py::class_<Going>(module, "Solver", "A scene that is solved again and again.")
      .def(py::init([](const Solver& scene) { return Going{scene}; }), py::arg("scene"))
      .def(
          "solve",
          [](Going& going, const Solver* scene, const Changes<const GivenRod*>& rods,
             const Changes<Support>& supports, const Changes<Joint>& joints,
             const Changes<Load>& loads, const Options& options, std::optional<double> tol,
             bool stable, bool eigenvalue) {
            return solve_changed(going.solver, scene, rods, supports, joints, loads, options, tol,
                                 stable, eigenvalue);
          },
          py::arg("scene").none(true), py::arg("rods"), py::arg("supports"), py::arg("joints"),
          py::arg("loads"), py::arg("options"), py::arg("tol"), py::arg("stable"),
          py::arg("eigenvalue"));
  module.def("solve_all", &solve_all, py::arg("scenes"), py::arg("starts"), py::arg("options"),
             py::arg("tol"), py::arg("stable"), py::arg("eigenvalue"), py::arg("threads"),
             py::arg("progress"));
}

}  // namespace pyrod::bind
