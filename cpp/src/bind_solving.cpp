// SPDX-License-Identifier: BSD-3-Clause
/// \file Solving scenes: one, many, or one again and again with other numbers.
#include "parts.hpp"

#include <pyrod/core/parallel.hpp>
#include <pyrod/statics/solver.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <concepts>
#include <iterator>
#include <tuple>

namespace pyrod::bind {

namespace {

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
    Shape known_shape;
    for (const auto& rod : given.cast<py::list>()) {
      const auto arrays = rod.cast<py::tuple>();
      RodSolution<Spatial> known;
      known.curve.positions = vectors<3>(arrays[0].cast<Array>(), "start");
      known.vertex_frames = quaternions(arrays[1].cast<Array>(), "start");
      known.curve.frames = quaternions(arrays[2].cast<Array>(), "start");
      known_shape.rods.push_back(std::move(known));
    }
    shape.emplace(std::move(known_shape));
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

/// The scene, or that of before, with these parts; from what was found last.
std::shared_ptr<Equilibrium> solve_changed(
    Solver& solver, const Solver* given, const Changes::Of<const GivenRod*>& rods,
    const Changes::Of<Support>& supports, const Changes::Of<Joint>& joints,
    const Changes::Of<Load>& loads, const Changes::Of<Actuator>& actuators, const Options& options,
    bool stable, bool eigenvalue, std::optional<double> tol) {
  Changes changes{{}, supports, joints, loads, actuators};
  for (const auto& [i, rod] : rods) changes.rods.emplace_back(i, rod->spec);
  Settings settings = settings_of(options, tol, stable, eigenvalue);
  settings.trace = python_interrupt();
  const py::gil_scoped_release release;
  if (!given) return std::make_shared<Equilibrium>(solver.solve(changes, settings));
  Scene scene = given->scene();
  changes.apply(scene);
  return std::make_shared<Equilibrium>(solver.solve(std::move(scene), settings));
}

/// Whether of a load, else of a support; its number, an entry, and a component, −1: all.
using Entry = std::tuple<bool, std::size_t, std::string_view, int>;

/// A new value of a vector, or of one of its components.
void set(Vec3& vector, int component, const py::handle& value) {
  if (component >= 0)
    vector[component] = value.cast<double>();
  else
    vector = Vec3(value.cast<std::array<double, 3>>().data());
}

template <class T>
void set_entry(T& entry, int component, const py::handle& value) {
  Vec3* vector = nullptr;
  if constexpr (std::same_as<T, Vec3>)
    vector = &entry;
  else if constexpr (std::same_as<T, Along<Vec3>>)
    vector = std::get_if<Vec3>(&entry);
  else if constexpr (std::same_as<T, std::optional<Vec3>>)
    vector = entry ? &*entry : nullptr;
  require(vector != nullptr, "changes: no vector is there");
  set(*vector, component, value);
}

/// The part, which may be among the new ones already, with a new value.
template <class Part>
void put(const Entry& entry, const py::handle& value, const std::vector<Part>& parts,
         Changes::Of<Part>& changes) {
  const auto& [of_load, number, name, component] = entry;
  const auto is = [i = number](const auto& one) { return one.first == i; };
  auto found = std::ranges::find_if(changes, is);
  if (found == changes.end()) {
    changes.emplace_back(number, parts.at(number));
    found = std::prev(changes.end());
  }
  const auto look = [&, name = name, component = component](auto& part, const auto& field) {
    if (name == field.name) set_entry(part.*field.member, component, value);
  };
  std::visit(
      [&](auto& part) {
        std::apply([&](const auto&... field) { (look(part, field), ...); }, part.fields());
      },
      found->second);
}

/// The scene of before with these numbers; from what was found last.
std::shared_ptr<Equilibrium> solve_numbers(Solver& solver, const py::list& numbers,
                                           const Options& options, bool stable, bool eigenvalue,
                                           std::optional<double> tol) {
  Changes changes;
  const Scene& scene = solver.scene();
  for (const auto& number : numbers) {
    const auto [entry, value] = number.cast<std::pair<Entry, py::object>>();
    if (std::get<0>(entry))
      put(entry, value, scene.loads, changes.loads);
    else
      put(entry, value, scene.supports, changes.supports);
  }
  Settings settings = settings_of(options, tol, stable, eigenvalue);
  settings.trace = python_interrupt();
  const py::gil_scoped_release release;
  return std::make_shared<Equilibrium>(solver.solve(changes, settings));
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

void solving(py::module_& module, py::class_<Solver>& scene) {
  scene.def("solve", &solve_one, py::arg("start"), py::arg("options"), py::arg("tol"),
            py::arg("stable"), py::arg("eigenvalue"), py::arg("trace"), py::arg("progress"));
  py::class_<Going>(module, "Solver", "A scene that is solved again and again.")
      .def(py::init([](const Solver& scene) { return Going{scene}; }), py::arg("scene"))
      .def(
          "solve",
          [](Going& going, const Solver* scene, const Changes::Of<const GivenRod*>& rods,
             const Changes::Of<Support>& supports, const Changes::Of<Joint>& joints,
             const Changes::Of<Load>& loads, const Changes::Of<Actuator>& actuators,
             const Options& options, bool stable, bool eigenvalue, std::optional<double> tol) {
            return solve_changed(going.solver, scene, rods, supports, joints, loads, actuators,
                                 options, stable, eigenvalue, tol);
          },
          py::arg("scene").none(true), py::arg("rods"), py::arg("supports"), py::arg("joints"),
          py::arg("loads"), py::arg("actuators"), py::arg("options"), py::arg("stable"),
          py::arg("eigenvalue"), py::arg("tol"))
      .def("forget", [](Going& going) { going.solver.forget(); })
      .def(
          "solve_numbers",
          [](Going& going, const py::list& numbers, const Options& options, bool stable,
             bool eigenvalue, std::optional<double> tol) {
            return solve_numbers(going.solver, numbers, options, stable, eigenvalue, tol);
          },
          py::arg("numbers"), py::arg("options"), py::arg("stable"), py::arg("eigenvalue"),
          py::arg("tol"));
  module.def("solve_all", &solve_all, py::arg("scenes"), py::arg("starts"), py::arg("options"),
             py::arg("tol"), py::arg("stable"), py::arg("eigenvalue"), py::arg("threads"),
             py::arg("progress"));
}

}  // namespace pyrod::bind
