// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include <pyrod/core/dispatch.hpp>

#include <cholmod.h>
#include <Eigen/Core>

#include <sstream>

namespace pyrod::bind {

/// What the module was made with and runs on.
py::dict build() {
  int version[3];
  cholmod_version(version);
  std::ostringstream cholmod, eigen;
  cholmod << version[0] << '.' << version[1] << '.' << version[2];
  eigen << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.' << EIGEN_MINOR_VERSION;
  constexpr const char* instructions[] = {"baseline", "avx2", "avx512"};
  py::dict out;
  out["cholmod"] = cholmod.str();
  out["eigen"] = eigen.str();
  out["compiler"] = __VERSION__;
  out["instructions"] = instructions[int(machine())];
  return out;
}

}  // namespace pyrod::bind

PYBIND11_MODULE(_core, module, pybind11::mod_gil_not_used()) {
  module.doc() = "The compiled part of pyrod. Use it through the package.";
  pyrod::bind::rotation(module);
  pyrod::bind::section(module);
  pyrod::bind::curve(module);
  pyrod::bind::arc(module);
  pyrod::bind::rod(module);
  pyrod::bind::breaks(module);
  pyrod::bind::options(module);
  pyrod::bind::parts(module);
  pyrod::bind::equilibrium(module);
  pyrod::bind::scene(module);
  pyrod::bind::linear(module);
  pyrod::bind::paths(module);
  module.def("build", &pyrod::bind::build,
             "Versions of CHOLMOD and Eigen, the compiler, and the instructions that are used.");
}
