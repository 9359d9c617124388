// SPDX-License-Identifier: BSD-3-Clause
#include "function.hpp"
#include "parts.hpp"

namespace pyrod::bind {

namespace {

std::optional<Vec3> maybe_vector(const std::optional<Array>& a, const char* name) {
  return a ? std::optional(vector3(*a, name)) : std::nullopt;
}
std::optional<Quaternion> maybe_frame(const std::optional<Array>& a) {
  return a ? std::optional(quaternion(*a, "frame")) : std::nullopt;
}

/// Along a rod: (3,), (n, 3) or a function of arc length.
Along<Vec3> along(const py::object& values, const char* name) {
  if (PyCallable_Check(values.ptr()))
    return [f = Function(values), name](double s) {
      return f(s, [name](const py::object& v) { return vector3(v.cast<Array>(), name); });
    };
  const auto a = values.cast<Array>();
  if (a.ndim() == 1) return vector3(a, name);
  return vectors<3>(a, name);
}

void supports(py::module_& module) {
  using MaybeArray = std::optional<Array>;
  py::class_<Clamp>(module, "Clamp")
      .def(py::init([](const MaybeArray& r, const MaybeArray& q, const py::object& at, int turns) {
        return Clamp{maybe_vector(r, "position"), maybe_frame(q), place(at), turns};
      }));
  py::class_<Hinge>(module, "Hinge").def(py::init([](const MaybeArray& r, const py::object& at) {
    return Hinge{maybe_vector(r, "position"), place(at)};
  }));
  py::class_<Slider>(module, "Slider")
      .def(py::init([](const MaybeArray& along, const MaybeArray& normal, const MaybeArray& r,
                       const MaybeArray& q, bool clamped, const py::object& at) {
        return Slider{maybe_vector(along, "along"),
                      maybe_vector(normal, "normal"),
                      maybe_vector(r, "position"),
                      maybe_frame(q),
                      clamped,
                      place(at)};
      }));
  py::class_<Sleeve>(module, "Sleeve")
      .def(py::init([](const MaybeArray& r, const MaybeArray& q, const py::object& at) {
        return Sleeve{maybe_vector(r, "position"), maybe_frame(q), place(at)};
      }));
  py::class_<Pivot>(module, "Pivot")
      .def(py::init([](const Array& axis, const MaybeArray& r, const MaybeArray& q,
                       const py::object& at, const MaybeArray& along) {
        return Pivot{vector3(axis, "axis"), maybe_vector(r, "position"), maybe_frame(q), place(at),
                     maybe_vector(along, "along")};
      }));
  py::class_<Spring>(module, "Spring")
      .def(py::init([](double stiffness, double torsion, const MaybeArray& r, const MaybeArray& q,
                       const py::object& at) {
        return Spring{stiffness, torsion, maybe_vector(r, "position"), maybe_frame(q), place(at)};
      }));
  py::class_<Joint>(module, "Joint")
      .def(py::init([](const py::tuple& points, const std::string& kind, int turns,
                       const std::optional<bool>& aligned, const MaybeArray& axis) {
        Joint out{{},
                  kind == "rigid"   ? JointKind::rigid
                  : kind == "hinge" ? JointKind::hinge
                                    : JointKind::ball,
                  turns,
                  aligned,
                  maybe_vector(axis, "axis")};
        for (const auto& point : points) out.points.push_back(place(point));
        return out;
      }));
}

void loads(py::module_& module) {
  py::class_<Force>(module, "Force")
      .def(py::init([](const Array& F, const py::object& at, bool follower) {
        return Force{vector3(F, "force"), place(at), follower};
      }));
  py::class_<Moment>(module, "Moment")
      .def(py::init([](const Array& M, const py::object& at, bool follower) {
        return Moment{vector3(M, "moment"), place(at), follower};
      }));
  py::class_<DistributedForce>(module, "DistributedForce")
      .def(py::init([](const py::object& f, int rod, bool follower) {
        return DistributedForce{along(f, "force_per_length"), rod, follower};
      }));
  py::class_<DistributedMoment>(module, "DistributedMoment")
      .def(py::init([](const py::object& l, int rod, bool follower) {
        return DistributedMoment{along(l, "moment_per_length"), rod, follower};
      }));
  py::class_<Gravity>(module, "Gravity").def(py::init([](const Array& g) {
    return Gravity{vector3(g, "acceleration")};
  }));
}

}  // namespace

Place place(const py::handle& at) {
  const auto on = [](const py::handle& one, auto&& make) {
    if (!py::isinstance<py::str>(one)) return make(one.cast<double>());
    return make(one.cast<std::string>() == "start" ? End::start : End::end);
  };
  if (!py::isinstance<py::tuple>(at)) return on(at, [](auto end) { return Place(end); });
  const auto pair = at.cast<py::tuple>();
  return on(pair[1], [rod = pair[0].cast<int>()](auto end) { return Place(rod, end); });
}

void parts(py::module_& module) {
  supports(module);
  loads(module);
}

}  // namespace pyrod::bind
