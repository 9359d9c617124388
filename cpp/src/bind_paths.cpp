// SPDX-License-Identifier: BSD-3-Clause
/// \file Paths of equilibria.
#include "parts.hpp"

#include <pyrod/paths/branch.hpp>
#include <pyrod/solve/path_end.hpp>
#include <pyrod/statics/solver.hpp>

#include <chrono>
#include <functional>
#include <utility>

namespace pyrod::bind {

namespace {

/// While a path is followed: whether Ctrl-C was pressed when a function of Python made a scene.
class Pressed {
 public:
  Pressed() : before_(std::exchange(now_, this)) {}
  ~Pressed() { now_ = before_; }
  Pressed(const Pressed&) = delete;
  Pressed& operator=(const Pressed&) = delete;

  bool yes = false;

  /// That of the path that this thread follows, or null.
  static Pressed* now() { return now_; }

 private:
  Pressed* before_;
  static thread_local Pressed* now_;
};
thread_local Pressed* Pressed::now_ = nullptr;

/// A scene by a function of Python. What it refuses ends a path, and so does Ctrl-C; whatever else
/// it raises is raised.
Scene scene_by(const py::function& make, double λ) {
  const py::gil_scoped_acquire gil;
  try {
    return make(λ).cast<const Solver&>().scene();
  } catch (py::error_already_set& error) {
    auto* path = Pressed::now();
    if (path && error.matches(PyExc_KeyboardInterrupt))
      path->yes = true;
    else if (!error.matches(PyExc_ValueError))
      throw;
    throw InvalidArgument(py::str(error.value()).cast<std::string>());
  }
}

/// Two scenes for 0 and 1, or a function.
SceneFamily family_of(const py::object& given) {
  if (py::isinstance<py::tuple>(given)) {
    const auto [first, second] = given.cast<std::pair<const Solver*, const Solver*>>();
    return {first->scene(), second->scene()};
  }
  const std::shared_ptr<py::function> make(new py::function(given), [](py::function* held) {
    const py::gil_scoped_acquire gil;
    delete held;
  });
  return SceneFamily([make](double λ) { return scene_by(*make, λ); });
}

using Look = std::optional<py::function>;

/// Ctrl-C ends a path, and what was found is kept. `look` sees how far it is.
std::function<bool(int, double)> looking(const Look& look, const Pressed& pressed) {
  using Clock = std::chrono::steady_clock;
  return [&look, &pressed, last = Clock::now()](int points, double value) mutable {
    if (pressed.yes) return false;
    constexpr auto often = std::chrono::milliseconds(20);
    const auto now = Clock::now();
    if (now - last < often) return true;
    last = now;
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) {
      if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) throw py::error_already_set();
      PyErr_Clear();
      return false;
    }
    if (look) (*look)(points, value);
    return true;
  };
}

PathSettings settings_of(double start, double stop, int max_points, const Look& look,
                         const Pressed& pressed) {
  PathSettings out;
  out.start = start, out.stop = stop, out.max_points = max_points;
  out.look = looking(look, pressed);
  return out;
}

Branch follow_path(const py::object& family, double start, double stop, int max_points,
                   const Equilibrium* from, const Options& options, const Look& look) {
  const Pressed pressed;
  PathSettings settings = settings_of(start, stop, max_points, look, pressed);
  settings.from = from;
  settings.options = options;
  SceneFamily scenes = family_of(family);
  const py::gil_scoped_release release;
  return follow(std::move(scenes), settings);
}

Branch switched(const Branch& branch, std::size_t number, int side, double start, double stop,
                int max_points, const Look& look) {
  const Pressed pressed;
  const PathSettings settings = settings_of(start, stop, max_points, look, pressed);
  const py::gil_scoped_release release;
  return branch.switched(number, side, settings);
}

template <class Get>
py::array column(const Branch& branch, const Get& get) {
  using T = std::decay_t<decltype(get(branch.points()[0]))>;
  py::array_t<T> out{py::ssize_t(branch.points().size())};
  for (std::size_t i = 0; i < branch.points().size(); ++i)
    out.mutable_at(py::ssize_t(i)) = get(branch.points()[i]);
  return locked(std::move(out));
}

py::list special(const Branch& branch) {
  py::list out;
  for (const auto& one : branch.special())
    out.append(py::make_tuple(name(one.kind), one.value, one.error, one.index_before,
                              one.index_behind, one.behind, locked(array(one.mode)), one.switches));
  return out;
}

template <class Make>
std::shared_ptr<Equilibrium> made(const Make& make) {
  const py::gil_scoped_release release;
  return std::make_shared<Equilibrium>(make());
}

}  // namespace

void paths(py::module_& module) {
  py::class_<Branch>(module, "Branch", "Equilibria one behind the other.")
      .def_property_readonly(
          "values", [](const Branch& b) { return column(b, [](auto& p) { return p.value; }); })
      .def_property_readonly(
          "indices", [](const Branch& b) { return column(b, [](auto& p) { return p.index; }); })
      .def_property_readonly("special", &special)
      .def_property_readonly("ended", [](const Branch& b) { return std::string(name(b.ended())); })
      .def_property_readonly("reason", &Branch::reason)
      .def(
          "equilibrium",
          [](const Branch& b, std::size_t point, bool eigenvalue) {
            return made([&] { return b.equilibrium(point, eigenvalue); });
          },
          py::arg("point"), py::arg("eigenvalue"))
      .def(
          "special_equilibrium",
          [](const Branch& b, std::size_t number) {
            return made([&] { return b.special_equilibrium(number); });
          },
          py::arg("number"))
      .def(
          "derivative",
          [](const Branch& b, std::size_t number, const py::object& family, double apart) {
            const SceneFamily change = family_of(family);
            const py::gil_scoped_release release;
            return b.derivative(number, change, apart);
          },
          py::arg("number"), py::arg("family"), py::arg("apart"))
      .def("switched", &switched, py::arg("number"), py::arg("side"), py::arg("start"),
           py::arg("stop"), py::arg("max_points"), py::arg("look"));
  module.def("follow", &follow_path, py::arg("family"), py::arg("start"), py::arg("stop"),
             py::arg("max_points"), py::arg("equilibrium").none(true), py::arg("options"),
             py::arg("look"));
}

}  // namespace pyrod::bind
